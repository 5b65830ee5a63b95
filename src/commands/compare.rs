//! `trunnion compare`: what has changed between reports.

use super::Refused;
use super::output::print;
use clap::{ArgGroup, Args};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::PathBuf;
use trunnion::data::{Guard, read_document, write_picture};
use trunnion::history::{Change, Compared, HistoryError, Outcome, Reported, changes, compare, over_time};

/// Arguments of `compare`.
#[derive(Debug, Args)]
#[command(group = ArgGroup::new("drawn").args(["svg", "over_time"]).multiple(true))]
pub struct CompareArguments {
    /// Reports that `trunnion fit --json` printed, the first one first.
    #[arg(required = true, value_name = "FILE")]
    reports: Vec<PathBuf>,
    /// The function that is drawn; without it the first.
    #[arg(long, value_name = "NAME", requires = "drawn")]
    function: Option<String>,
    /// A picture of the function in every report, and of what differs.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// A picture of the function over the days between the reports, which all have a date, where its change is clearest.
    #[arg(long, value_name = "FILE")]
    over_time: Option<PathBuf>,
    /// Replaces files that are no pictures of Trunnion's.
    #[arg(long, requires = "drawn")]
    force: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl CompareArguments {
    /// Reads, compares, draws, prints.
    pub fn run(self) -> Result<(), Refused> {
        let read = |file: &PathBuf| {
            let text = read_document(file).map_err(|e| Refused::Text(file.clone(), e))?;
            Ok((file.display().to_string(), text))
        };
        let texts = self.reports.iter().map(read).collect::<Result<Vec<_>, Refused>>()?;
        let reports = Reported::read(&texts).map_err(|(at, e)| Refused::History(self.reports[at].clone(), e))?;
        let found = compare(&reports);
        if self.svg.is_some() || self.over_time.is_some() {
            let function = self.drawn(&reports)?;
            let drawn = self.svg.as_ref().map(|file| Ok::<_, Refused>((file, changes(&reports, &found, function)?)));
            let over_time = self.over_time.as_ref().map(|file| {
                if let Some(at) = reports.iter().position(|report| report.day.is_none()) {
                    return Err(Refused::History(self.reports[at].clone(), HistoryError::NoDate));
                }
                let own = found.iter().filter(|change| change.function == function).filter_map(compared);
                let most = own.max_by(|a, b| a.share().total_cmp(&b.share())).map(|most| most.clearest[0]);
                Ok((file, over_time(&reports, function, most.unwrap_or(0.0))?))
            });
            let pictures = drawn.into_iter().chain(over_time).collect::<Result<Vec<_>, Refused>>()?;
            let guard = Guard { inputs: self.reports.clone(), force: self.force };
            pictures.iter().try_for_each(|(file, _)| guard.admits(file))?;
            pictures.iter().try_for_each(|(file, svg)| write_picture(file, svg, &guard))?;
        }
        Ok(print(&match self.json {
            true => format!("{:#}\n", object(&reports, &found)),
            false => text(&reports, &found),
        })?)
    }

    fn drawn<'a>(&'a self, reports: &'a [Reported]) -> Result<&'a str, Refused> {
        let names: Vec<&str> = reports[0].functions.iter().map(|f| f.name.as_str()).collect();
        let wanted = self.function.as_deref().or(names.first().copied()).unwrap_or_default();
        if names.contains(&wanted) {
            return Ok(wanted);
        }
        Err(Refused::NoSuchFunction(wanted.to_owned(), names.join(", ")))
    }
}

fn compared(change: &Change) -> Option<&Compared> {
    if let Outcome::Compared(compared) = &change.outcome { Some(compared) } else { None }
}

/// The unit of a function's values, and that of its coordinate.
fn units<'a>(reports: &'a [Reported], function: &str) -> (&'a str, &'a str) {
    let own = reports[0].functions.iter().find(|f| f.name == function);
    let across = own.map_or("", |f| f.axis().1);
    (own.map_or("", |f| f.unit.as_str()), across)
}

fn text(reports: &[Reported], found: &[Change]) -> String {
    let mut out = format!("changes since {}\n", reports[0].name);
    for change in found {
        let Change { function, report, outcome } = change;
        let (unit, across) = units(reports, function);
        let _ = write!(out, "  {function} in {}: ", reports[*report].name);
        let _ = match outcome {
            Outcome::Compared(own) => {
                let point =
                    |[at, difference, u95]: [f64; 3]| format!("{difference:+.3} ± {u95:.3} {unit} at {at} {across}");
                let words = if own.changed() { "changed" } else { "no change beyond the uncertainty" };
                writeln!(
                    out,
                    "{words}; largest {}, clearest for its uncertainty {} (95 %); beyond ± at {} of {} points",
                    point(own.largest),
                    point(own.clearest),
                    own.beyond,
                    own.points.len()
                )
            }
            Outcome::OtherSums([first, later]) => writeln!(out, "not comparable: {later}, where the first has {first}"),
            Outcome::Apart => writeln!(out, "not comparable: no coordinate that both have"),
            Outcome::Absent => writeln!(out, "not in this report"),
        };
    }
    out += "\nReports are taken as independent: U² = U₁² + U₂². A function has changed where a difference is larger than chance\n\
            explains at any of its points (95 %, by Bonferroni).\n";
    out
}

fn object(reports: &[Reported], found: &[Change]) -> Value {
    let one = |change: &Change| {
        let (unit, across) = units(reports, &change.function);
        let mut one = json!({ "function": change.function, "report": reports[change.report].name, "unit": unit });
        match &change.outcome {
            Outcome::Compared(own) => {
                let point =
                    |[at, difference, u95]: &[f64; 3]| json!({ "at": at, "difference": difference, "u95": u95 });
                one["coordinate_unit"] = json!(across);
                one["changed"] = json!(own.changed());
                one["allowed"] = json!(own.allowed);
                one["beyond"] = json!(own.beyond);
                one["largest"] = point(&own.largest);
                one["clearest"] = point(&own.clearest);
                one["points"] = own.points.iter().map(point).collect();
            }
            Outcome::OtherSums(sums) => one["not_comparable"] = json!(sums),
            Outcome::Apart => one["not_comparable"] = json!("no coordinate that both have"),
            Outcome::Absent => one["not_comparable"] = json!("not in this report"),
        }
        one
    };
    let reports = reports.iter().map(|report| json!({ "file": report.name, "day": report.day }));
    json!({ "reports": reports.collect::<Vec<_>>(), "changes": found.iter().map(one).collect::<Vec<_>>() })
}
