//! The measuring plan, Markdown.

use super::{Planned, program_file};
use crate::program::Control;
use crate::study::plan::rotary_axes;
use crate::study::{Measurement, Path, Setup};
use std::fmt::Write;
use trunnion_codegen::algebra::at;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Axis, AxisKind, Ball};
use trunnion_codegen::problems::visible;
use trunnion_codegen::quantity::Unit;

/// The standard deviation of a reading that predictions are for, mm.
const MICROMETRE: f64 = Unit::Um.factor();

/// The text of a measuring plan: what the runs give, in which order they are made, and how.
pub fn plan(planned: &Planned) -> String {
    let setup = planned.setup;
    let mut out = format!("# Measuring plan\n\n{}\n\n", cell(&setup.model.title));
    let lengths: Vec<String> =
        setup.model.alphabet.constants().map(|name| format!("{name} = {} mm", setup.constant(name))).collect();
    let _ = writeln!(out, "Set-up: {}. The model is `{}`.\n", cell(&lengths.join(", ")), cell(planned.model));
    let _ = write!(
        out,
        "## What the runs give\n\n\
         The valuation number is the standard deviation of a function, where it is largest, for each µm of the standard \
         deviation\nof a reading, with {}. Noise alone is in it: the report of `trunnion fit` has the other \
         sources.\n\n| function | valuation number | what is determined |\n|---|---:|---|\n",
        planned.samples.map_or("those of the runs".to_owned(), |samples| format!("{samples} readings a run"))
    );
    for function in &planned.prediction.functions {
        let name = setup.function_name(function.function);
        let valuation = function.valuation(setup, MICROMETRE).map_or("–".to_owned(), |own| own.to_string());
        let _ = writeln!(out, "| {} | {valuation} | {} |", cell(&name), cell(&function.told.words));
    }
    out += &rotary(planned);
    out += &zero(planned.setup);
    out += "\n## The runs, in this order\n\n\
            Warm the machine up. Where the placing is the same as before, leave the balls where they are: the model counts on \
            it.\n";
    if planned.paths.iter().any(|(measurement, _)| !planned.is_probed(measurement)) {
        out += "Each run goes there and back.\n";
    }
    out.push('\n');
    let mut before = None;
    for (at, (measurement, path)) in ordered(planned).into_iter().enumerate() {
        let own = placing(planned, measurement);
        out += &one(planned, at, measurement, path, before.is_some() && before == own);
        before = own;
    }
    out += "\n## Afterwards\n\nPut the readings into the files named above, beside `trunnion.toml`, and enter there what is known \
            of machine and\ninstrument. Then, in this folder:\n\n    trunnion fit\n\n";
    if planned.touch_mm.is_some() {
        out += PROBED;
    }
    if planned.paths.iter().any(|(measurement, _)| !planned.is_probed(measurement)) {
        out += DRIVEN;
    }
    out
}

/// Where the model's coordinates begin, and which way its axes turn.
fn zero(setup: &Setup) -> String {
    let turns = |axis: &Axis| format!("{} about {}", cell(&axis.name), direction(setup, axis));
    let rotary: Vec<String> = setup.model.axes().filter(|axis| axis.kind == AxisKind::Rotary).map(turns).collect();
    if rotary.is_empty() {
        return String::new();
    }
    format!(
        "\n## The zero point, and which way axes turn\n\n\
         The coordinates are those of the axes, as the model has them: no transformation (TRAORI, M128, G43.4, switched kinematics) \
         may be\nactive. Their zero point, to be set as work offset, is where the rotary axes meet; of a single one any point, as far \
         along it as\nthe balls are. With every axis at 0 what carries either ball has its (0, 0, 0) there.\n\n\
         A positive angle turns what the axis carries by the right-hand rule: {}.\n\
         Jog each a little and look, before anything is clamped. If one turns the other way, copy the model file, turn the signs of \
         its\ndirection and of its coordinate in each run (`rotary = \"-y\"`, `B = \"-b\"`), and begin again with that file.\n",
        rotary.join(", ")
    )
}

/// An axis' direction: along one of the machine's, or in components.
fn direction(setup: &Setup, axis: &Axis) -> String {
    let value = |p| at(p, &setup.model.alphabet, 0.0, |name| setup.constant(name)) + 0.0;
    let components = axis.direction.each_ref().map(value);
    let along = ["x", "y", "z"].iter().zip(components).find(|(_, size)| size.abs() == 1.0);
    along.map_or_else(
        || format!("({})", components.map(|size| format!("{size:.4}")).join(", ")),
        |(name, size)| format!("{}{name}", if size > 0.0 { '+' } else { '\u{2212}' }),
    )
}

/// Of programs that touch a sphere.
const PROBED: &str = "The NC programs touch the sphere from above and from four sides at each position, and write the displacements.\n\
                      Those for LinuxCNC were run in its simulation; those for SINUMERIK, Heidenhain and Fanuc are templates that no \
                      control has\nread: a Heidenhain stops for each row to be noted, a Fanuc prints its rows without commas. See that \
                      neither the sphere's\nstem nor anything else is in the way.\n";

/// Of programs that follow a path.
const DRIVEN: &str = "The NC programs move in straight blocks that all take the same time, so that the sweep goes at a constant rate. They \
            were\nnot run on a machine, and for SINUMERIK, Heidenhain and Fanuc not read by a control either: prove them without the \
            bar. The\nHeidenhain programs have no time for a block but a feed for its way, which a control may take differently \
            where rotary and\nlinear axes move together.\n";

/// One number for each rotary axis, and which of its location errors have none.
fn rotary(planned: &Planned) -> String {
    let setup = planned.setup;
    let estimated: Vec<FunctionId> = setup.estimated().collect();
    let axes = rotary_axes(setup, planned.prediction, &estimated, MICROMETRE);
    if axes.is_empty() {
        return String::new();
    }
    let mut out =
        "\nOf each rotary axis the largest valuation number of its linear and of its angular location errors:\n\n\
                   | rotary axis | largest valuation number | of |\n|---|---:|---|\n"
            .to_owned();
    for own in axes {
        let name = setup.model.axis(own.axis).map_or(String::new(), |axis| cell(&axis.name));
        let mut row = |number: String, of: Vec<String>, words: &str| {
            let _ = writeln!(out, "| {name} | {number} | {}{words} |", cell(&of.join(", ")));
        };
        let names = |of: &[FunctionId]| of.iter().map(|f| setup.function_name(*f)).collect::<Vec<_>>();
        for largest in [&own.linear, &own.angular].into_iter().flatten() {
            row(largest.valuation.to_string(), names(&largest.of), "");
        }
        let without = own.without.iter().map(|e| setup.model.alphabet.error_name(*e).to_owned()).collect();
        for (of, words) in [(names(&own.not_determined), ": not determined"), (without, ": not estimated")] {
            if !of.is_empty() {
                row("–".to_owned(), of, words);
            }
        }
    }
    out
}

/// Runs of one placing together, in the order in which the placings come first.
fn ordered<'a>(planned: &Planned<'a>) -> Vec<(&'a Measurement, &'a Path)> {
    let mut placings = Vec::new();
    let mut runs: Vec<(usize, &Measurement, &Path)> = Vec::new();
    for (measurement, path) in planned.paths {
        let own = placing(planned, measurement);
        let at = placings.iter().position(|placing| *placing == own).unwrap_or_else(|| {
            placings.push(own);
            placings.len() - 1
        });
        runs.push((at, measurement, path));
    }
    runs.sort_by_key(|(placing, measurement, _)| (*placing, measurement.first()));
    runs.into_iter().map(|(_, measurement, path)| (measurement, path)).collect()
}

/// What a placing is known by: the errors of where its balls are.
fn placing<'a>(planned: &Planned<'a>, measurement: &Measurement) -> Option<[&'a Ball; 2]> {
    let run = &planned.setup.model.runs[measurement.first()?];
    Some([&run.workpiece_ball, &run.tool_ball])
}

fn one(planned: &Planned, at: usize, measurement: &Measurement, path: &Path, as_before: bool) -> String {
    let (setup, name) = (planned.setup, &measurement.name);
    let [from, to] = path.measured.map(f64::to_degrees);
    let mut out = format!("### {}. {}\n\n", at + 1, cell(name));
    match measurement.first().and_then(|run| setup.bar(run)) {
        None if planned.is_probed(measurement) => {
            let positions = path.sweeps.len();
            let all: Vec<String> = path.sweeps.iter().map(|sweep| format!("{:.2}", sweep.to_degrees() + 0.0)).collect();
            let _ = writeln!(out, "* A sphere probed at {positions} positions, sweep {from:.1}° to {to:.1}°.");
            let _ = writeln!(out, "* Positions: {}.", all.join("°, ") + "°");
        }
        Some(bar) => {
            let _ = writeln!(out, "* Bar of {bar} mm, sweep {from:.1}° to {to:.1}°.");
        }
        None => {
            let _ = writeln!(out, "* Displacements, sweep {from:.1}° to {to:.1}°.");
        }
    }
    if path.overshoot > 0.0 {
        let _ = writeln!(
            out,
            "* The programs go on for {:.1}° beyond both ends, for the axes to come to speed and to rest: no readings from there.",
            path.overshoot.to_degrees()
        );
    }
    for (whose, ball) in ["workpiece", "tool"].iter().zip(&path.balls) {
        let [x, y, z] = ball.map(|x| format!("{:.3}", x + 0.0));
        let _ = writeln!(out, "* Ball of the {whose} at ({x}, {y}, {z}) mm of what carries it.");
    }
    if as_before {
        out += "* The placing is the same as before.\n";
    }
    for (axis, (name, kind)) in path.axes.iter().enumerate() {
        let unit = if *kind == AxisKind::Rotary { Unit::Deg } else { Unit::Mm };
        let along = path.points.iter().map(|point| unit.from_inner(point[axis]));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = (format!("{:.2}", low + 0.0), format!("{:.2}", high + 0.0));
        let _ = writeln!(out, "* Axis {} goes from {low} to {high} {unit}.", cell(name));
    }
    let programs = Control::ALL.map(|control| format!("`{}`", program_file(name, control)));
    let _ = writeln!(out, "* Programs: {}.", cell(&programs.join(", ")));
    let readings: Vec<String> = planned.readings(measurement).iter().map(|file| format!("`{file}`")).collect();
    let _ = writeln!(out, "* Readings into {}.\n", cell(&readings.join(" and ")));
    out
}

/// A text within a line of a table.
fn cell(text: &str) -> String {
    visible(text).replace('|', "\\|")
}
