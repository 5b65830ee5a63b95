//! What a simulation put in, beside the files it wrote.

use std::collections::BTreeMap;
use std::path::Path;

use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::ser::PrettyFormatter;

use super::output::{LISTED, WriteError, WriteProblem, write_atomically};
use trunnion_codegen::quantity::Unit;

/// What a simulation was made of: written as `truth.json`.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// The seed it was drawn with.
    pub seed: u64,
    /// Nominal length of the bar, mm; none where displacements are read.
    pub radius_mm: Option<f64>,
    /// Samples of each run.
    pub samples: usize,
    /// Half width of the uniform noise on the readings, µm.
    pub noise_um: f64,
    /// First and last angle, degrees.
    pub range_deg: (f64, f64),
    /// Functions at points.
    pub functions: Vec<TruthFunction>,
    /// Single parameters by name, in mm or rad.
    pub constants: Vec<(String, f64)>,
}

/// One function of the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct TruthFunction {
    /// Its name, such as `eps_xa`.
    pub name: String,
    /// The unit its values are written in, which is their key.
    pub unit: Unit,
    /// Its axis' coordinate with its unit: `a_deg`, `x_mm`.
    pub coordinate: String,
    /// Coordinate and value in `unit`.
    pub points: Vec<(f64, f64)>,
}

impl Truth {
    /// The text of `truth.json`: one object with the fields' names as keys, each function a list of
    /// `{"<coordinate>": …, "<unit>": …}` under its name, each constant a number under its.
    ///
    /// # Errors
    /// [`WriteProblem::NotFinite`] (line 0, column 0) where a value is not finite: JSON has no such number.
    pub fn to_json(&self) -> Result<String, WriteProblem> {
        self.listing(&BTreeMap::new())
    }

    /// The same with the files that are written with it, by name and digest, so that they are known again.
    pub(super) fn listing(&self, files: &BTreeMap<String, String>) -> Result<String, WriteProblem> {
        if !self.numbers().all(f64::is_finite) {
            return Err(WriteProblem::NotFinite { line: 0, column: 0 });
        }
        let mut text = Vec::new();
        let mut serializer = serde_json::Serializer::with_formatter(&mut text, PrettyFormatter::with_indent(b" "));
        let invalid = WriteProblem::Refused(std::io::ErrorKind::InvalidData);
        Listing(self, files).serialize(&mut serializer).map_err(|_| invalid)?;
        text.push(b'\n');
        String::from_utf8(text).map_err(|_| invalid)
    }

    /// Writes `truth.json`.
    ///
    /// # Errors
    /// [`WriteError`] where the file cannot be written or a value is not finite.
    pub fn write(&self, file: &Path) -> Result<(), WriteError> {
        let text = self.to_json().map_err(|problem| WriteError { file: file.to_owned(), problem })?;
        write_atomically(file, text.as_bytes())
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let points = self.functions.iter().flat_map(|function| &function.points).flat_map(|(a, v)| [*a, *v]);
        let single = [self.radius_mm.unwrap_or(0.0), self.noise_um, self.range_deg.0, self.range_deg.1];
        single.into_iter().chain(points).chain(self.constants.iter().map(|(_, value)| *value))
    }
}

/// A truth and the files written with it, by name and digest.
struct Listing<'a>(&'a Truth, &'a BTreeMap<String, String>);

impl Serialize for Listing<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(truth, files) = self;
        let mut map = serializer.serialize_map(None)?;
        if !files.is_empty() {
            map.serialize_entry(LISTED, files)?;
        }
        map.serialize_entry("seed", &truth.seed)?;
        map.serialize_entry("radius_mm", &truth.radius_mm)?;
        map.serialize_entry("samples", &truth.samples)?;
        map.serialize_entry("noise_um", &truth.noise_um)?;
        map.serialize_entry("range_deg", &truth.range_deg)?;
        for TruthFunction { name, unit, coordinate, points } in &truth.functions {
            let points: Vec<_> =
                points.iter().map(|(a, value)| Point([(coordinate, *a), (unit.suffix(), *value)])).collect();
            map.serialize_entry(name, &points)?;
        }
        for (name, value) in &truth.constants {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

/// A small object that keeps its keys' order.
struct Point<'a>([(&'a str, f64); 2]);

impl Serialize for Point<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0)
    }
}
