//! `trunnion import`: files of instruments and of other programs, made files for `fit`.

use super::circular::plane;
use super::output::print;
use super::predicted::range;
use super::trimmed::trimmed;
use super::{Refused, number};
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use trunnion::circular::{Direction, Plane};
use trunnion::data::{Columns, Form, Guard, ImportedFile, Unit, import, native_files};
use trunnion::import::{Feature, Stated, Trace, UnitFrom};

/// Arguments of `import`.
#[derive(Debug, Args)]
pub struct ImportArguments {
    /// Tests of Renishaw Ballbar 20 (.b5r), or tables (CSV) with columns for the angle and the reading.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Directory for the files: of each run, of each time and direction, a CSV and a picture.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// What a model's run calls the swept angle: the column is named after it.
    #[arg(long, value_name = "NAME", default_value = "a")]
    angle: String,
    /// What columns of a table are called where they have other names: a="Angle [deg]",dr="Radius [µm]"; or, with the unit
    /// stated, dr_um="Radius".
    #[arg(long, value_name = "NAME=TEXT,…")]
    columns: Option<Columns>,
    /// Unit of the readings of a .b5r; without it the one in which they are as round as the file says.
    #[arg(long, value_enum)]
    unit: Option<ReadingUnit>,
    /// Where the arc begins and ends, degrees: samples beyond are trimmed. Without it, of a .b5r as the test's name says, of a table
    /// where its samples do.
    #[arg(long, value_name = "A:B", value_parser = range, allow_hyphen_values = true, conflicts_with_all = ["from_deg", "to_deg"])]
    range_deg: Option<(f64, f64)>,
    /// Its beginning.
    #[arg(long, value_name = "DEG", hide = true, requires = "to_deg", value_parser = number::angle, allow_negative_numbers = true)]
    from_deg: Option<f64>,
    /// Its end.
    #[arg(long, value_name = "DEG", hide = true, requires = "from_deg", value_parser = number::angle, allow_negative_numbers = true)]
    to_deg: Option<f64>,
    /// How far the readings of a .b5r go beyond either end of the arc, degrees; 0 without it.
    #[arg(long, value_name = "DEG", value_parser = number::step, allow_negative_numbers = true)]
    overshoot_deg: Option<f64>,
    /// The plane that a .b5r has to be a test of, such as YZ.
    #[arg(long, value_parser = plane)]
    plane: Option<Plane>,
    /// Replaces files of their names even if they were not imported, or were changed since.
    #[arg(long)]
    force: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// A unit of readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReadingUnit {
    /// Millimetres.
    Mm,
    /// Micrometres.
    Um,
}

impl ImportArguments {
    /// Reads, writes, says what was done.
    pub fn run(self) -> Result<(), Refused> {
        let stated = self.stated()?;
        let columns = self.columns.clone().unwrap_or_default();
        let known = [self.angle.as_str(), "dr"];
        if let Some(name) = columns.names().find(|name| !known.contains(name)) {
            let given = name.to_owned();
            return Err(Refused::Option("columns", given, "no column of a table\n  expected dr and the --angle"));
        }
        let read = |file: &PathBuf| import(file, Some(&self.angle), &columns, &stated);
        let imported = self.files.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        self.effective(&imported)?;
        let files: Vec<(&Path, &ImportedFile)> = self.files.iter().map(PathBuf::as_path).zip(&imported).collect();
        let (set, names) = native_files(&files, &self.angle)?;
        set.write(&self.out, &Guard { inputs: self.files.clone(), force: self.force })?;
        let told: Vec<(&Path, &ImportedFile, &[String])> =
            files.iter().zip(&names).map(|((path, file), names)| (*path, *file, names.as_slice())).collect();
        Ok(print(&if self.json { self.document(&told) } else { self.text(&told) })?)
    }

    fn stated(&self) -> Result<Stated, Refused> {
        let ends_deg = self.range_deg.or(self.from_deg.zip(self.to_deg));
        if let Some((_, to)) = ends_deg.filter(|(from, to)| to <= from) {
            return Err(Refused::Option(
                "to-deg",
                to.to_string(),
                "not beyond the arc's beginning\n  expected an angle beyond --from-deg",
            ));
        }
        let unit = self.unit.map(|unit| match unit {
            ReadingUnit::Mm => Unit::Mm,
            ReadingUnit::Um => Unit::Um,
        });
        Ok(Stated { unit, ends_deg, overshoot_deg: self.overshoot_deg.unwrap_or(0.0), plane: self.plane })
    }

    /// Refuses an option that no file needs.
    fn effective(&self, imported: &[ImportedFile]) -> Result<(), Refused> {
        let has = |form| imported.iter().any(|file| file.form == form);
        let of_b5r = [
            ("unit", self.unit.is_some()),
            ("overshoot-deg", self.overshoot_deg.is_some()),
            ("plane", self.plane.is_some()),
        ];
        let idle = of_b5r.into_iter().find(|(_, given)| *given && !has(Form::B5r));
        let columns = ("columns", self.columns.is_some() && !has(Form::Table));
        match idle.or(Some(columns).filter(|(_, idle)| *idle)) {
            Some((option, _)) => Err(Refused::Option(
                option,
                "without effect".to_owned(),
                "no file needs it\n  expected --columns with a table, --unit, --overshoot-deg and --plane with a .b5r",
            )),
            None => Ok(()),
        }
    }

    fn text(&self, imported: &[(&Path, &ImportedFile, &[String])]) -> String {
        let mut out = String::new();
        for (path, file, names) in imported {
            let _ = writeln!(out, "{}", path.display());
            for (what, words) in file.imported.about.lines() {
                let _ = writeln!(out, "  {what}: {words}");
            }
            for (trace, name) in file.imported.traces.iter().zip(*names) {
                let _ = writeln!(out, "  → {}", self.out.join(name).display());
                for (what, words) in trace.told() {
                    let _ = writeln!(out, "    {what}: {words}");
                }
            }
        }
        super::seen(&out)
    }

    fn document(&self, imported: &[(&Path, &ImportedFile, &[String])]) -> String {
        let file = |(path, file, names): &(&Path, &ImportedFile, &[String])| {
            let runs = file.imported.traces.iter().zip(*names).map(|(trace, name)| self.run_object(trace, name));
            let about = &file.imported.about;
            json!({
                "file": path.display().to_string(),
                "sha256": file.sha256,
                "test": about.test,
                "instrument": about.instrument,
                "serial_number": about.serial,
                "calibrated": about.calibrated,
                "machine": about.machine,
                "operator": about.operator,
                "started": about.started,
                "completed": about.completed,
                "plane": about.plane.map(|plane| plane.to_string()),
                "bar_mm": about.bar_mm,
                "feed_mm_per_min": about.feed,
                "features": features(&about.features),
                "runs": runs.collect::<Vec<_>>(),
            })
        };
        format!("{:#}\n", json!({ "files": imported.iter().map(file).collect::<Vec<_>>() }))
    }

    fn run_object(&self, trace: &Trace, name: &str) -> Value {
        let kept = trace.kept();
        let circularity = match trace.unit_from {
            UnitFrom::Circularity { readings_mm, told_mm } => Some((readings_mm, told_mm)),
            _ => None,
        };
        json!({
            "file": self.out.join(name).display().to_string(),
            "picture": self.out.join(name).with_extension("svg").display().to_string(),
            "direction": trace.direction.map(Direction::short),
            "samples": kept.len(),
            "from_deg": kept.first().map(|sample| Unit::Deg.from_inner(sample.angle_rad)),
            "to_deg": kept.last().map(|sample| Unit::Deg.from_inner(sample.angle_rad)),
            "unit": trace.unit.suffix(),
            "unit_from": trace.unit_from.to_string(),
            "circularity_mm": circularity.map(|(own, _)| own),
            "stated_circularity_mm": circularity.map(|(_, told)| told),
            "angles_from": trace.angles_from.to_string(),
            "trimmed": trimmed(&trace.cut),
            "features": features(&trace.features),
        })
    }
}

fn features(features: &[Feature]) -> Vec<Value> {
    features.iter().map(|f| json!({ "name": f.name, "value": f.value, "unit": f.unit })).collect()
}
