//! `trunnion circular`: the circular test of ISO 230-4.

use super::model::millimetres;
use super::number;
use super::output::{Picture, print, say};
use super::trimmed::trimmed;
use super::{Refused, seen};
use clap::{ArgGroup, Args};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use trunnion::circular::{
    At, Circles, Circular, Direction, Effect, Estimate, Plane, Radial, Spike, Test, Trace, Traces, Undetermined,
    circular, picture,
};
use trunnion::data::{Columns, FileError, Form, Radius, Unit, import};
use trunnion::import::{Cut, Imported, Stated, Trace as Run};
use trunnion::study::decimal;

/// Seconds of a minute.
const MINUTE: f64 = 60.0;

/// Arguments of `circular`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("paths").args(["file", "cw", "ccw"]).multiple(true).required(true))]
pub struct CircularArguments {
    /// Both paths, or one, in one file: a .b5r of Renishaw Ballbar 20, or CSV as below whose angles go one way, then the other.
    #[arg(value_name = "FILE", conflicts_with_all = ["cw", "ccw"])]
    file: Option<PathBuf>,
    /// Readings of the clockwise path: CSV with an angle (a_deg, or another name with _deg or _rad) and dr_um or dr_mm.
    #[arg(long, value_name = "FILE")]
    cw: Option<PathBuf>,
    /// Readings of the counterclockwise path: from the first axis of the plane to the second.
    #[arg(long, value_name = "FILE")]
    ccw: Option<PathBuf>,
    /// What columns of a table are called where they have other names: a="Angle [deg]",dr="Radius [µm]"; or, with the unit
    /// stated, dr_um="Radius".
    #[arg(long, value_name = "NAME=TEXT,…")]
    columns: Option<Columns>,
    /// Nominal length of the ball-bar, mm; a .b5r says it itself.
    #[arg(long, value_name = "MM", allow_negative_numbers = true, value_parser = millimetres)]
    radius: Option<f64>,
    /// The two axes: angles count from the first to the second; XY, or what a .b5r says.
    #[arg(long, value_name = "AXES", value_parser = plane)]
    plane: Option<Plane>,
    /// Feed along the path, mm/min: gives the servo mismatch as a time. A .b5r may say it itself.
    #[arg(long, value_name = "MM/MIN", value_parser = number::feed, allow_negative_numbers = true)]
    feed: Option<f64>,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    picture: Picture,
}

/// A plane by its axes.
pub fn plane(text: &str) -> Result<Plane, &'static str> {
    Plane::named(text).ok_or("not a plane\n  expected two of the axes X, Y, Z, U, V, W, such as XY, YZ or ZX")
}

impl CircularArguments {
    /// What is tested, one file with all it says or a file of each direction; and what of each path was trimmed.
    fn test(&self) -> Result<(Test, Vec<Cut>), Refused> {
        let radius = |of_file: Option<f64>| match self.radius.or(of_file) {
            Some(mm) => Ok(Radius::new(mm)?),
            None => Err(Refused::NoLength),
        };
        let columns = self.columns.clone().unwrap_or_default();
        if let Some(name) = columns.names().find(|name| !["a", "dr"].contains(name)) {
            return Err(Refused::Option("columns", name.to_owned(), "no column of a circle\n  expected a and dr"));
        }
        let feed = |of_file: Option<f64>| self.feed.or(of_file).map(|feed| feed / MINUTE);
        if let Some(file) = &self.file {
            let stated = Stated { plane: self.plane, ..Stated::default() };
            let read = import(file, None, &columns, &stated).map_err(Refused::Run)?;
            if read.form == Form::B5r && self.columns.is_some() {
                let idle = "a .b5r has no columns\n  expected it left out";
                return Err(Refused::Option("columns", "without effect".to_owned(), idle));
            }
            let Imported { about, traces } = read.imported;
            if let Some(problem) = self.radius.and_then(|mm| about.fits(mm).err()) {
                return Err(Refused::Run(FileError { file: file.clone(), problem: problem.into() }));
            }
            let (traces, cuts) = paths(file, read.form, &traces)?;
            let plane = self.plane.or(about.plane).unwrap_or_default();
            return Ok((Test { traces, radius: radius(about.bar_mm)?, plane, feed: feed(about.feed) }, cuts));
        }
        let files = [&self.cw, &self.ccw];
        if let [Some(cw), Some(ccw)] = files
            && cw == ccw
        {
            let same = "the same file as --cw\n  expected the readings of the other direction";
            return Err(Refused::Option("ccw", ccw.display().to_string(), same));
        }
        let radius = radius(None)?;
        let path = |file: &Option<PathBuf>| file.as_deref().map(|file| path(file, &columns)).transpose();
        let [cw, ccw] = files.map(path);
        let ((cw, cut), (ccw, other_cut)) = (cw?.unzip(), ccw?.unzip());
        let traces = Traces::of(cw, ccw).ok_or(Refused::NoRuns)?;
        let test = Test { traces, radius, plane: self.plane.unwrap_or_default(), feed: feed(None) };
        Ok((test, cut.into_iter().chain(other_cut).collect()))
    }

    /// Reads, works out, prints.
    pub fn run(self) -> Result<(), Refused> {
        let (test, cuts) = self.test()?;
        let figures = circular(&test)?;
        let title = format!("Circular test {}, R = {} mm", test.plane, test.radius.mm());
        let files = [&self.file, &self.cw, &self.ccw].into_iter().flatten();
        self.picture.draw(files, || Ok::<_, Refused>(picture(&test, &figures, &title).svg()?))?;
        for warning in figures.warnings() {
            say(format_args!("warning: {warning}"));
        }
        Ok(print(&if self.json { format!("{:#}\n", document(&figures, &cuts)) } else { figures.to_string() })?)
    }
}

/// The path of a file that has one alone, and what of it was trimmed.
fn path(file: &Path, columns: &Columns) -> Result<(Trace, Cut), Refused> {
    let read = import(file, None, columns, &Stated::default()).map_err(Refused::Run)?;
    match (read.form, read.imported.traces.as_slice()) {
        (Form::Table, [run]) => taken(file, read.form, run),
        (Form::Table, runs) => Err(Refused::OnePath(file.to_owned(), format!("{} runs", runs.len()))),
        (Form::B5r, _) => Err(Refused::OnePath(file.to_owned(), "a test of Ballbar 20".to_owned())),
    }
}

/// The runs of one file, one in each direction at most, and what of each was trimmed.
fn paths(file: &Path, form: Form, runs: &[Run]) -> Result<(Traces, Vec<Cut>), Refused> {
    let path = |direction| {
        let mut own = runs.iter().filter(|run| run.direction == Some(direction));
        let (run, more) = (own.next(), own.count());
        if more > 0 {
            return Err(Refused::Paths(file.to_owned(), format!("{} {direction} runs", more + 1)));
        }
        Ok(run.map(|run| taken(file, form, run)).transpose()?.unzip())
    };
    let (clockwise, cut) = path(Direction::Clockwise)?;
    let (counterclockwise, other_cut) = path(Direction::Counterclockwise)?;
    let in_order = Traces::of(clockwise, counterclockwise);
    let traces = in_order.ok_or_else(|| Refused::Paths(file.to_owned(), "samples in no order in time".to_owned()))?;
    Ok((traces, cut.into_iter().chain(other_cut).collect()))
}

/// What of a run is no feed-in and no overshoot; said is what was taken for what, where it is not all as the file has it.
fn taken(file: &Path, form: Form, run: &Run) -> Result<(Trace, Cut), Refused> {
    if form == Form::B5r || run.cut != Cut::default() {
        say(format_args!("note: {}: {}", seen(&file.display().to_string()), run.in_words()));
    }
    let trace = Trace::new(run.kept().iter().map(|sample| (sample.angle_rad, sample.reading_mm)));
    Ok((trace.map_err(|error| Refused::Trace(file.to_owned(), error))?, run.cut))
}

/// One object: the paths, with what of each was trimmed, both together, what is read from the trace, spikes, warnings.
fn document(figures: &Circular, cuts: &[Cut]) -> Value {
    let radius = figures.radius;
    let path = |(path, cut): (&trunnion::circular::Path, &Cut)| {
        let mut object = circles(&path.circles, radius);
        object["direction"] = json!(path.direction.to_string());
        object["samples"] = json!(path.samples);
        object["trimmed"] = trimmed(cut);
        object["arc_deg"] = json!(path.arc.to_degrees());
        object["whole_circle"] = json!(path.whole);
        object["start_deg"] = json!(path.start.map(f64::to_degrees));
        object["radial_deviation"] = radial(&path.radial);
        object["radial_deviation_centred"] = told(
            figures.centred(path),
            |[max, min]| json!({ "max_um": Unit::Um.from_inner(max), "min_um": Unit::Um.from_inner(min) }),
        );
        object
    };
    let both = figures.both.as_ref().map(|both| {
        let mut object = circles(&both.circles, radius);
        object["radial_deviation"] = radial(&both.radial);
        object["mean_bidirectional_radial_deviation"] =
            told(both.mean_radial, |d| json!({ "um": Unit::Um.from_inner(d) }));
        object["circular_hysteresis"] = told(both.hysteresis, at);
        object
    });
    let effect = |Effect { term, estimate }: &Effect| {
        let ways = |Estimate { value, std, u95 }: Estimate| {
            let way = |m: trunnion::circular::Measure| {
                (m.key.to_owned(), json!({ "value": value * m.factor, "std": std * m.factor, "u95": u95 * m.factor }))
            };
            Value::Object(term.measures(radius, figures.feed).into_iter().map(way).collect())
        };
        let mut object = told(*estimate, ways);
        object["name"] = json!(term.key());
        object["of"] = json!(term.name(figures.plane));
        object
    };
    let spike = |Spike { reversal, direction, height }: &Spike| {
        let mut object = told(*height, |height| {
            json!({
                "um": Unit::Um.from_inner(height.height),
                "at_deg": height.angle.to_degrees(),
                "std_um": Unit::Um.from_inner(height.std),
                "stands_out": height.stands_out(),
            })
        });
        object["reversal"] = json!(figures.plane.end(*reversal));
        object["reversal_deg"] = json!(reversal.angle().to_degrees());
        object["direction"] = json!(direction.to_string());
        object
    };
    json!({
        "plane": figures.plane.to_string(),
        "radius_mm": radius.mm(),
        "feed_mm_per_min": figures.feed.map(|feed| decimal(feed * MINUTE)),
        "paths": figures.paths.iter().zip(cuts).map(path).collect::<Vec<_>>(),
        "both": both,
        "effects": figures.effects.iter().map(effect).collect::<Vec<_>>(),
        "scatter": figures.scatter.map(|scatter| json!({
            "std_um": Unit::Um.from_inner(scatter.std),
            "samples": scatter.samples,
            "samples_as_one": scatter.alike,
        })),
        "spikes": figures.spikes.iter().map(spike).collect::<Vec<_>>(),
        "warnings": figures.warnings().map(|warning| warning.to_string()).collect::<Vec<_>>(),
    })
}

/// A figure's object, or `undetermined` with the reason.
fn told<T>(figure: Result<T, Undetermined>, object: impl FnOnce(T) -> Value) -> Value {
    figure.map_or_else(|why| json!({ "undetermined": why.to_string() }), object)
}

fn at(at: At) -> Value {
    json!({ "um": Unit::Um.from_inner(at.deviation), "at_deg": at.angle.to_degrees() })
}

fn radial(radial: &Radial) -> Value {
    json!({ "max": at(radial.max), "min": at(radial.min) })
}

fn circles(circles: &Circles, radius: Radius) -> Value {
    let (fit, zone) = (&circles.least_squares, &circles.zone);
    let um = |length: f64| Unit::Um.from_inner(length);
    json!({
        "circular_deviation": { "minimum_zone_um": um(zone.width()), "least_squares_um": um(fit.roundness()) },
        "least_squares": { "centre_um": fit.circle.centre.map(um), "radius_less_nominal_um": um(circles.radius(radius)) },
        "minimum_zone": {
            "centre_um": zone.centre.map(um),
            "inner_less_nominal_um": um(zone.inner - radius.mm()),
            "outer_less_nominal_um": um(zone.outer - radius.mm()),
        },
    })
}
