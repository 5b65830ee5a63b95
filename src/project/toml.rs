//! The project file.

use super::Planned;
use crate::data::positions_text;
use crate::study::{Measurement, coordinate, in_unit};
use std::fmt::Write;
use trunnion_codegen::model::{Axis, key, string};

/// The text of a project file: what there is to be said, and as a comment what may be.
pub fn project(planned: &Planned) -> String {
    let setup = planned.setup;
    let mut out = format!(
        "# {}\n# `trunnion fit` in this folder reads the files below; the measuring plan says how they come about.\n\n\
         # A name from `trunnion models`, or a model file.\nmodel = {}\n\n",
        setup.model.title,
        string(planned.model)
    );
    out += "# For the report.\n[machine]\n# name = \"\"\n# serial = \"\"\n# operator = \"\"\n# date = \"\"\n\n";
    out += "# Nominal lengths of the set-up.\n[lengths]\n";
    for name in setup.model.alphabet.constants() {
        let _ = writeln!(out, "{} = {}", key(&format!("{name}_mm")), setup.constant(name));
    }
    out += "\n# How large errors are at most: for what the runs do not tell.\n[limits]\n# length_um = 30\n# angle_urad = 100\n\n";
    out += "# What is known of the errors beforehand, in the names that `trunnion derive` shows: the runs then determine more, and it is told\n\
            # with the result.\n# [assume]\n# NAME = \"0\"\n\n";
    out += "# What the instrument's certificate says; without it no uncertainty has the instrument's part.\n[instrument]\n\
            # preset = \"QC20-W\"\n# constant_um = 0.7\n# proportional = 0.003\n# bar_length_um = 1\n\
            # temperature_k = 1\n# expansion_per_k = 1.2e-5\n\n";
    for axis in setup.model.axes() {
        out += &range(axis);
    }
    out += "[fit]\nestimator = \"joint\"\n# robust = \"huber\"\n# table = \"table.csv\"         # known functions\n\n";
    out += "# What columns are called in files of other programs; with the unit stated, dr_um = \"Radius\".\n[columns]\n\
            # a = \"Angle [deg]\"\n# dr = \"Radius [µm]\"\n\n";
    // Of runs of which some do not stop there would be no table.
    if planned.paths.iter().all(|(measurement, _)| planned.is_probed(measurement)) {
        let (measurements, sweeps): (Vec<Measurement>, Vec<Vec<f64>>) =
            planned.paths.iter().map(|(measurement, path)| (measurement.clone(), path.sweeps.clone())).unzip();
        let comment =
            "Where the runs are probed. After a change `trunnion new --force` here writes plan and programs anew.";
        out += &positions_text(comment, &measurements, &sweeps);
        out.push('\n');
    }
    if let Some(mm) = planned.touch_mm {
        let _ = writeln!(
            out,
            "# Half of the diameters of the sphere and of the probe's ball together.\n[probe]\ntouch_mm = {mm}\n"
        );
    }
    for (measurement, _) in planned.paths {
        let files: Vec<String> = planned.readings(measurement).iter().map(|file| string(file)).collect();
        let files = files.join(", ");
        let _ = writeln!(out, "[run.{}]\nfiles = [{files}]\n", key(&measurement.name));
    }
    out.truncate(out.trim_end().len());
    out + "\n"
}

/// The range of an axis: its own, or a comment.
fn range(axis: &Axis) -> String {
    let unit = coordinate(axis).coordinate();
    let (mark, [low, high]) = match axis.range {
        Some(range) => ("", range.map(|end| in_unit(unit, end))),
        None if unit.suffix() == "deg" => ("# ", [-30.0, 120.0]),
        None => ("# ", [-250.0, 250.0]),
    };
    format!("{mark}[axis.{}]\n{mark}range = [{low}, {high}]          # {unit}\n\n", key(&axis.name))
}
