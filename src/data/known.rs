//! The known functions of a model from their table, along its runs.

use super::error::FileProblem;
use super::refused::ObservationsError;
use super::stamp::Stamp;
use super::table::{Known, Table, TableValues};
use crate::study::{Sample, Setup};
use std::path::Path;
use std::rc::Rc;
use trunnion_codegen::algebra::{Monomial, Poly, Rational, at};
use trunnion_codegen::basis::Coordinate;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::{FunctionId, RunId};

/// The known functions that the runs see, and what their table calls the swept angle: as the first run that sees one does.
pub(super) fn known_functions(setup: &Setup) -> Option<(&str, Vec<FunctionId>)> {
    let sees = setup.derivation.runs.iter_enumerated().find(|(_, run)| !run.known.is_empty());
    let angle = setup.model.alphabet.sweep_name(setup.model.runs[sees?.0].sweep);
    Some((angle, setup.known(setup.derivation.runs.keys())))
}

/// The coordinate of an axis that stands, rad or mm.
fn fixed(setup: &Setup, coordinate: &Coordinate) -> Option<f64> {
    let poly = coordinate.poly()?;
    let alphabet = &setup.model.alphabet;
    let moves = |(m, _): &(Monomial, Rational)| {
        alphabet.nominals().any(|(id, _)| m.exponent(id) != 0 && !alphabet.is_constant(id))
    };
    (!poly.terms().iter().any(moves)).then(|| at(poly, alphabet, 0.0, |name| setup.constant(name)))
}

/// The table of all known functions that the runs see.
pub(super) struct KnownTable {
    table: Table,
    stamp: Stamp,
    functions: Vec<FunctionId>,
}

impl KnownTable {
    pub fn read(setup: &Setup, file: &Path) -> Result<Self, ObservationsError> {
        let (angle, functions) = known_functions(setup).unwrap_or(("a", Vec::new()));
        for (run, &f) in setup.model.runs.iter().flat_map(|r| functions.iter().map(move |f| (r, f))) {
            let Some((axis, _)) = setup.model.axis_of(setup.model.functions[f].error) else { continue };
            let own = setup.model.alphabet.sweep_symbols(run.sweep)[0];
            let is_sweep = |c: &Coordinate| c.poly().is_none_or(|p| *p == Poly::nominal(own));
            if !is_sweep(&run.at[axis]) && fixed(setup, &run.at[axis]).is_none() {
                let axis = setup.model.axis(axis).map_or_else(String::new, |axis| axis.name.clone());
                return Err(ObservationsError::TableCoordinate { function: known_name(&setup.model, f), axis });
            }
        }
        let known = |&f: &FunctionId| Known { name: known_name(&setup.model, f), quantity: setup.quantity(f) };
        let (table, stamp) = Table::read_stamped(file, angle, &functions.iter().map(known).collect::<Vec<_>>())?;
        Ok(Self { table, stamp, functions })
    }

    /// What it gives along a run.
    pub fn along(self: &Rc<Self>, setup: &Setup, run: RunId) -> KnownAlong {
        let functions = setup.derivation.runs[run].known.iter();
        // An axis that stands has the table's value where it stands.
        let place = |(f, _): &(FunctionId, _)| {
            let (axis, _) = setup.model.axis_of(setup.model.functions[*f].error)?;
            let standing = fixed(setup, &setup.model.runs[run].at[axis]);
            Some((self.functions.iter().position(|own| own == f)?, standing.and_then(|x| self.table.at(x))))
        };
        KnownAlong { table: Some(Rc::clone(self)), places: functions.filter_map(place).collect() }
    }
}

/// The known functions along a run: of a table, or zero.
#[derive(Default)]
pub(super) struct KnownAlong {
    table: Option<Rc<KnownTable>>,
    /// Of each function its place in the table, and its values where its axis stands.
    places: Vec<(usize, Option<TableValues>)>,
}

impl KnownAlong {
    /// What was read of the table.
    pub fn stamp(&self) -> Option<&Stamp> {
        self.table.as_ref().map(|known| &known.stamp)
    }

    /// Whether there are values at an angle, rad.
    pub fn covers(&self, angle_rad: f64) -> bool {
        self.table.as_ref().is_none_or(|known| known.table.covers(angle_rad))
    }

    /// What is wrong with samples that the table does not cover, by their lines and angles.
    pub fn outside(&self, samples: Vec<(u64, f64)>) -> Option<FileProblem> {
        let known = self.table.as_ref().filter(|_| !samples.is_empty())?;
        Some(FileProblem::OutsideTable {
            table: known.table.file().to_owned(),
            range: known.table.range_rad(),
            samples,
        })
    }

    /// Writes the functions' values at an angle into a sample.
    pub fn write(&self, angle_rad: f64, sample: &mut Sample) {
        let Some(moving) = self.table.as_ref().and_then(|known| known.table.at(angle_rad)) else { return };
        for (k, (at, standing)) in self.places.iter().enumerate() {
            let TableValues { values, stds } = standing.as_ref().unwrap_or(&moving);
            if let (Some(value), Some(std)) = (sample.known.get_mut(k), sample.known_std.get_mut(k)) {
                *value = values.get(*at).copied().unwrap_or(0.0);
                *std = stds.get(*at).copied().unwrap_or(0.0);
            }
        }
    }
}
