//! An estimated function over the range of the data, with its band and what linearisation leaves in it.

use super::budget::{Budget, Combined, Detail, Source, Sources};
use super::fit::{Fit, Observation};
use super::limits::ErrorLimits;
use super::neglected::Neglected;
use super::seen::Seen;
use super::setup::{Setup, SetupError, coordinate};
use super::systematic::{Contribution, Linearised};
use super::told::Told;
use super::visited::{marks, sweeps, visited};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::quantity::Unit;

/// An estimated function over the range of the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The function.
    pub function: FunctionId,
    /// `eps_xa`
    pub name: String,
    /// Whether it is a location error: the same everywhere, its one point at 0.
    pub is_location: bool,
    /// How far it is determined, and what the values are of.
    pub told: Told,
    /// Unit of its values: µrad or µm.
    pub unit: Unit,
    /// Name of its coordinate: the axis' letter.
    pub coordinate: String,
    /// Unit of its coordinate: degrees or mm.
    pub coordinate_unit: Unit,
    /// Points every 5° (or over 20 steps of a linear axis) within the range, and at its ends.
    pub points: Vec<CurvePoint>,
    /// Where its uncertainty is largest, and the budget there, in its unit.
    pub largest: Option<(f64, Budget)>,
    /// The rows of that budget.
    pub detail: Option<Detail>,
    /// The largest systematic error that the dropped second-order terms can leave in it, in its unit.
    pub neglected: f64,
    /// The same on machines drawn within the limits: root mean square where it is largest, in its unit.
    pub neglected_typical: f64,
    /// The products of two errors that contribute most there, in its unit.
    pub neglected_terms: Vec<Contribution>,
}

/// One point of a curve, in its units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Coordinate.
    pub at: f64,
    /// Estimate: of the function, or of the sum it is seen in.
    pub value: f64,
    /// Standard uncertainty of that from the scatter of the readings alone.
    pub noise_std: f64,
    /// Standard uncertainty of that as the function's value from all else.
    pub other_std: f64,
    /// Combined standard uncertainty of that as the function's value.
    pub std: f64,
    /// Expanded uncertainty of the same, 95 %.
    pub u95: f64,
    /// Coverage factor of that.
    pub factor: f64,
    /// Expanded uncertainty as the sum's value; the same where the function is determined.
    pub sum_u95: f64,
    /// Coverage factor of that.
    pub sum_factor: f64,
}

impl Curve {
    /// The point with the largest value; none of a function that is not seen.
    pub fn extreme(&self) -> Option<&CurvePoint> {
        self.points.iter().max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))
    }
}

/// Terms of second order that are named with a function.
const NAMED_TERMS: usize = 8;

/// What the curves of a fit's functions are worked out from.
pub(super) struct Curves<'a> {
    setup: &'a Setup,
    observations: &'a [Observation],
    fit: &'a Fit,
    sources: &'a Sources<'a>,
    linearised: Linearised<'a>,
    /// Per run, what linearisation drops.
    pub neglected: Vec<Neglected>,
}

impl<'a> Curves<'a> {
    /// # Errors
    /// [`SetupError`] where the second-order derivation overflows.
    pub fn new(
        setup: &'a Setup,
        observations: &'a [Observation],
        fit: &'a Fit,
        sources: &'a Sources<'a>,
        limits: ErrorLimits,
    ) -> Result<Self, SetupError> {
        let linearised = Linearised::new(setup, observations, sources, limits)?;
        let neglected = linearised.neglected();
        Ok(Self { setup, observations, fit, sources, linearised, neglected })
    }

    /// An estimated function where the runs that see it went.
    pub fn of(&self, seen: &Seen) -> Option<Curve> {
        let Self { setup, fit, sources, .. } = *self;
        let function = seen.function();
        let along = setup.axis(function)?;
        let coordinate_unit = coordinate(along).coordinate();
        let visited = visited(setup, function, sweeps(self.observations)).filter(|_| seen.extent() != Extent::NotSeen);
        let unit = setup.quantity(function).deviation();
        let mut dropped = 0.0f64;
        let (mut points, mut largest) = (Vec::new(), None);
        for at in visited.map_or(Vec::new(), |range| marks(range, coordinate_unit)) {
            let x = coordinate_unit.to_inner(at);
            let (value, noise_std) = fit.function(setup, function, x);
            let budget = sources.function(seen, x).times(unit.from_inner(1.0));
            let Combined { std, expanded: u95, factor, .. } = budget.combined;
            let of_the_sum = budget.of_the_sum().combined;
            let (sum_u95, sum_factor) = (of_the_sum.expanded, of_the_sum.factor);
            let other_std = budget.without(Source::Noise).combined.std;
            let (value, noise_std) = (unit.from_inner(value), unit.from_inner(noise_std));
            points.push(CurvePoint { at, value, noise_std, other_std, std, u95, factor, sum_u95, sum_factor });
            if largest.as_ref().is_none_or(|(_, before): &(f64, Budget)| u95 > before.combined.expanded) {
                largest = Some((at, budget));
            }
            let weights = sources.dependence().weights(&fit.functional(setup, function, x));
            let sum = |(w, n): (&[f64], &Neglected)| w.iter().zip(&n.bound).map(|(w, b)| w.abs() * b).sum::<f64>();
            dropped = dropped.max(unit.from_inner(weights.observations().zip(&self.neglected).map(sum).sum::<f64>()));
        }
        let coordinates: Vec<f64> = points.iter().map(|p| coordinate_unit.to_inner(p.at)).collect();
        let detail = largest.as_ref().map(|(at, _)| sources.detail(seen, coordinate_unit.to_inner(*at), unit));
        let weights = sources.dependence().of_coefficients(seen);
        let left = self.linearised.left_in(&weights, |x| seen.basis(setup, x), &coordinates);
        let scaled = |t: &Contribution| Contribution {
            name: t.name.clone(),
            typical: unit.from_inner(t.typical),
            bound: unit.from_inner(t.bound),
        };
        Some(Curve {
            function,
            name: setup.function_name(function),
            is_location: setup.model.functions[function].is_location(),
            told: seen.told(setup),
            unit,
            coordinate: along.coordinate.clone(),
            coordinate_unit,
            points,
            largest,
            detail,
            neglected: dropped,
            neglected_typical: unit.from_inner(left.typical),
            neglected_terms: left.terms.iter().take(NAMED_TERMS).filter(|t| t.typical > 0.0).map(scaled).collect(),
        })
    }
}
