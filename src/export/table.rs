//! What is written: a function at the coordinates of a table, and where it belongs on the machine.

use super::grid::Grid;
use crate::study::{Setup, coordinate};
use thiserror::Error;
use trunnion_codegen::algebra::at;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Axis, AxisKind, iso_motion};
use trunnion_codegen::quantity::{Quantity, Unit};

/// A motion error as a function of its axis' coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// What reports call it: `eps_xa`.
    pub name: String,
    /// What ISO 230-1 calls it: `EAA`.
    pub iso: String,
    /// What the control calls the axis.
    pub axis: String,
    /// Length or angle.
    pub quantity: Quantity,
    /// The unit of the coordinate: degrees or mm.
    pub along: Unit,
    /// 1 where the error is a position further along the axis' own motion, −1 where the axis' positive motion is against the error's
    /// direction; none where it is not the axis' position that is wrong.
    pub own: Option<f64>,
}

/// A function that is no error of an axis.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0} is the function of no axis\n  expected a motion error")]
pub struct NoAxis(pub String);

impl Subject {
    /// A function of a model, on an axis that the control calls `axis`, or as the model does.
    ///
    /// # Errors
    /// [`NoAxis`]
    pub fn new(setup: &Setup, function: FunctionId, axis: Option<&str>) -> Result<Self, NoAxis> {
        let name = setup.function_name(function);
        let error = setup.model.functions[function].error;
        let Some((own, (_, component))) = setup.axis(function).zip(setup.model.axis_of(error)) else {
            return Err(NoAxis(name));
        };
        let turns = own.kind == AxisKind::Rotary;
        let along = direction(setup, own)[component.index() % 3];
        let is_own = component.is_rotation() == turns && (along.abs() - 1.0).abs() < 1e-12;
        Ok(Self {
            name,
            iso: iso_motion(component, &own.name),
            axis: axis.unwrap_or(&own.name).to_owned(),
            quantity: setup.quantity(function),
            along: coordinate(own).coordinate(),
            own: is_own.then_some(along.signum()),
        })
    }
}

/// The direction of an axis' positive motion, in machine coordinates.
fn direction(setup: &Setup, axis: &Axis) -> [f64; 3] {
    axis.direction.each_ref().map(|p| at(p, &setup.model.alphabet, 0.0, |name| setup.constant(name)))
}

/// A function at coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Which function.
    pub subject: Subject,
    /// Coordinates in degrees or mm.
    pub grid: Grid,
    /// The errors there, actual − commanded, mm or rad: where the coordinate increases, and where it decreases.
    pub errors: [Vec<f64>; 2],
    /// Whether the two were told apart; else they are the same.
    pub both: bool,
}

impl Table {
    /// `error` gives those of either direction at a coordinate in degrees or mm.
    pub fn new(subject: Subject, grid: Grid, both: bool, error: impl Fn(f64) -> [f64; 2]) -> Self {
        let (increasing, decreasing) = grid.points().map(|at| error(at).into()).unzip();
        Self { subject, grid, errors: [increasing, decreasing], both }
    }

    /// Errors of the axis' own position, in degrees or mm further along its positive motion.
    pub(super) fn own(&self) -> Option<[Vec<f64>; 2]> {
        let sense = self.subject.own?;
        let unit = self.subject.quantity.coordinate();
        Some(self.errors.each_ref().map(|errors| errors.iter().map(|e| unit.from_inner(sense * e)).collect()))
    }

    /// Coordinates with both errors there.
    pub(super) fn rows<'a>(&self, errors: &'a [Vec<f64>; 2]) -> impl Iterator<Item = (f64, f64, f64)> + use<'a> {
        let points: Vec<f64> = self.grid.points().collect();
        points.into_iter().zip(errors[0].iter().zip(&errors[1])).map(|(at, (more, less))| (at, *more, *less))
    }
}
