//! Reports as `trunnion fit --json` prints them.

use crate::data::day;
use serde::Deserialize;
use serde_json::{Map, Value};
use thiserror::Error;

/// A report, as far as it is compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Reported {
    /// What it is called: its file.
    pub name: String,
    /// The day it was measured, counted from 1970-01-01, where the report has a date.
    pub day: Option<i64>,
    /// Its functions.
    pub functions: Vec<Measured>,
}

/// An estimated function.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Its name.
    pub name: String,
    /// The unit of its values: µm or µrad.
    pub unit: String,
    /// The key of its coordinate: `a_deg`.
    pub coordinate: String,
    /// Itself, or the sum that it is seen in.
    pub value_of: Option<String>,
    /// In the order of the coordinate.
    pub points: Vec<MeasuredPoint>,
}

impl Measured {
    /// The name of its coordinate and the unit's suffix: `a`, `deg`.
    pub fn axis(&self) -> (&str, &str) {
        self.coordinate.rsplit_once('_').unwrap_or((&self.coordinate, ""))
    }

    /// Its point at a coordinate, but for rounding.
    pub fn at(&self, at: f64) -> Option<&MeasuredPoint> {
        self.points.iter().find(|point| (point.at - at).abs() <= 1e-9 * at.abs().max(1.0))
    }
}

/// One of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredPoint {
    /// Coordinate, degrees or mm.
    pub at: f64,
    /// Value.
    pub value: f64,
    /// Expanded uncertainty, 95 %.
    pub u95: f64,
}

/// Why a text is no report.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum HistoryError {
    /// Not JSON, or not a report's.
    #[error("{0}\n  expected what `trunnion fit --json` prints")]
    Format(String),
    /// A function of another model.
    #[error("a report of {0}, the first is one of {1}\n  expected reports of one model")]
    OtherModel(String, String),
    /// No date where one is due.
    #[error("measured on {0:?}\n  expected a date such as 2026-04-01 or 2026-04-01T08:00:00")]
    Date(String),
    /// No date of one that is drawn over time.
    #[error(
        "no date of this report\n  expected one in each, `date = \"2026-04-01\"` in [machine] of its project, to draw over time"
    )]
    NoDate,
    /// One report is no history.
    #[error("one report\n  expected two or more to compare")]
    One,
}

#[derive(Deserialize)]
struct File {
    model: String,
    machine: Option<Machine>,
    functions: Vec<Function>,
}

#[derive(Deserialize)]
struct Machine {
    date: Option<String>,
}

#[derive(Deserialize)]
struct Function {
    name: String,
    unit: String,
    value_of: Option<String>,
    points: Vec<Map<String, Value>>,
}

impl Reported {
    /// Reads reports of one model, each with its name.
    ///
    /// # Errors
    /// [`HistoryError`] with the number of the report that is none.
    pub fn read(texts: &[(String, String)]) -> Result<Vec<Self>, (usize, HistoryError)> {
        let (mut reports, mut models) = (Vec::new(), Vec::new());
        for (at, (name, text)) in texts.iter().enumerate() {
            let format = |e: String| (at, HistoryError::Format(e));
            let file: File = serde_json::from_str(text).map_err(|e| format(e.to_string()))?;
            models.push(file.model);
            if models[at] != models[0] {
                return Err((at, HistoryError::OtherModel(models.swap_remove(at), models.swap_remove(0))));
            }
            let functions = file.functions.into_iter().map(measured).collect::<Result<_, _>>().map_err(format)?;
            let date = file.machine.and_then(|machine| machine.date);
            let dated = date.filter(|date| !date.trim().is_empty());
            let day = dated.map(|date| day(&date).ok_or((at, HistoryError::Date(date))));
            reports.push(Self { name: name.clone(), day: day.transpose()?, functions });
        }
        if reports.len() < 2 { Err((0, HistoryError::One)) } else { Ok(reports) }
    }
}

fn measured(function: Function) -> Result<Measured, String> {
    let Function { name, unit, value_of, points } = function;
    let is_coordinate = |key: &&String| key.ends_with("_deg") || key.ends_with("_mm");
    let coordinate = points.first().and_then(|point| point.keys().find(is_coordinate)).cloned().unwrap_or_default();
    let point = |point: &Map<String, Value>| {
        let number = |key: &str| {
            let number = point.get(key).and_then(Value::as_f64).filter(|x| x.is_finite());
            number.ok_or_else(|| format!("function {name}: a point without {key}"))
        };
        Ok(MeasuredPoint { at: number(&coordinate)?, value: number("value")?, u95: number("u95")? })
    };
    let points = points.iter().map(point).collect::<Result<_, String>>()?;
    Ok(Measured { name, unit, coordinate, value_of, points })
}
