//! What is written: a function at the coordinates of a table, and where it belongs on the machine.

use super::grid::Grid;
use crate::study::{Setup, coordinate};
use thiserror::Error;
use trunnion_codegen::algebra::at;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Axis, AxisKind, Component, iso_motion};
use trunnion_codegen::quantity::{Quantity, Unit};

/// A turn, degrees.
pub(super) const TURN: f64 = 360.0;

/// A motion error as a function of its axis' coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Subject {
    /// What reports call it: `eps_xa`.
    pub name: String,
    /// What ISO 230-1 calls it: `EAA`.
    pub iso: String,
    /// Which of the six it is, in the order X Y Z A B C.
    pub component: Component,
    /// What the control calls the axis.
    pub axis: String,
    /// Length or angle.
    pub quantity: Quantity,
    /// The unit of the coordinate: degrees or mm.
    pub along: Unit,
    /// What can take it off.
    pub taken_off: TakenOff,
}

/// Which axis' position can take an error off. The sense is 1 where that axis, further along its own motion, does to the tool against
/// the workpiece what the error does, −1 where it does the opposite.
#[derive(Clone, Debug, PartialEq)]
pub enum TakenOff {
    /// Its own: the error is one of its position.
    Own(f64),
    /// That of another axis, which moves along the error.
    Other(String, f64),
    /// None.
    None,
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
        let Some((own, (id, component))) = setup.axis(function).zip(setup.model.axis_of(error)) else {
            return Err(NoAxis(name));
        };
        Ok(Self {
            name,
            iso: iso_motion(component, &own.name),
            component,
            axis: axis.unwrap_or(&own.name).to_owned(),
            quantity: setup.quantity(function),
            along: coordinate(own).coordinate(),
            taken_off: taken_off(setup, (usize::from(id), own), component),
        })
    }
}

fn taken_off(setup: &Setup, (place, own): (usize, &Axis), component: Component) -> TakenOff {
    let along = |axis: &Axis| direction(setup, axis)[component.index() % 3];
    let is_along = |axis: &Axis| (along(axis).abs() - 1.0).abs() < 1e-12;
    let kind = if component.is_rotation() { AxisKind::Rotary } else { AxisKind::Linear };
    if own.kind == kind && is_along(own) {
        return TakenOff::Own(along(own).signum());
    }
    // An axis that a rotary one carries moves along it only here and there.
    let upright = |place: usize| carriers(setup, place).all(|axis| axis.kind == AxisKind::Linear);
    let side = |place: usize| if place < setup.model.workpiece.len() { -1.0 } else { 1.0 };
    let other = setup
        .model
        .axes()
        .enumerate()
        .find(|(place, axis)| kind == AxisKind::Linear && axis.kind == kind && is_along(axis) && upright(*place));
    match other.filter(|_| upright(place)) {
        Some((at, axis)) => TakenOff::Other(axis.name.clone(), side(place) * side(at) * along(axis).signum()),
        None => TakenOff::None,
    }
}

/// The axes that carry an axis, the workpiece's side first in its count.
fn carriers(setup: &Setup, place: usize) -> impl Iterator<Item = &Axis> {
    let workpiece = setup.model.workpiece.len();
    let side = if place < workpiece { &setup.model.workpiece[..place] } else { &setup.model.tool[..place - workpiece] };
    side.iter()
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

    /// The same for formats with one value for both directions: their mean.
    #[must_use]
    pub(super) fn mean(&self) -> Self {
        let [forward, reverse] = &self.errors;
        let mean: Vec<f64> = forward.iter().zip(reverse).map(|(forward, reverse)| (forward + reverse) / 2.0).collect();
        Self { errors: [mean.clone(), mean], both: false, ..self.clone() }
    }

    /// Errors in degrees or mm, times a factor.
    pub(super) fn scaled(&self, factor: f64) -> [Vec<f64>; 2] {
        let unit = self.subject.quantity.coordinate();
        self.errors.each_ref().map(|errors| errors.iter().map(|e| unit.from_inner(factor * e)).collect())
    }

    /// What of such values, times the same factor, is taken off: mm or rad.
    pub(super) fn kept(&self, values: &[Vec<f64>; 2], factor: f64) -> [Vec<f64>; 2] {
        let unit = self.subject.quantity.coordinate();
        values.each_ref().map(|values| values.iter().map(|value| factor * unit.to_inner(*value)).collect())
    }

    /// The sense of the axis' own position, where it is that which is wrong.
    pub(super) fn own(&self) -> Option<f64> {
        if let TakenOff::Own(sense) = self.subject.taken_off { Some(sense) } else { None }
    }

    /// Whether it goes over a whole turn, once.
    pub(super) fn is_a_turn(&self) -> bool {
        let over = self.grid.to() - self.grid.from();
        self.subject.along == Unit::Deg && (over - TURN).abs() < 1e-6
    }

    /// A coordinate in degrees or mm where a control that repeats a whole turn looks it up.
    pub(super) fn within_its_turn(&self, at: f64) -> f64 {
        let from = self.grid.from();
        if self.is_a_turn() { from + (at - from).rem_euclid(TURN) } else { at }
    }

    /// Coordinates with both errors there.
    pub(super) fn rows<'a>(&self, errors: &'a [Vec<f64>; 2]) -> impl Iterator<Item = (f64, f64, f64)> + use<'a> {
        let points: Vec<f64> = self.grid.points().collect();
        points.into_iter().zip(errors[0].iter().zip(&errors[1])).map(|(at, (more, less))| (at, *more, *less))
    }
}
