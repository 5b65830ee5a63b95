//! The linear model of a trace, fitted to all paths together.

use super::direction::Direction;
use super::plane::Reversal;
use super::terms::Term;
use super::trace::{Trace, Traces};
use super::undetermined::Undetermined;
use crate::study::Look;
use nalgebra::SVector;
use std::f64::consts::{PI, TAU};
use trunnion_solver::lstsq::{Factor, Solution, SolveError, student_t_95};

/// How far after a reversal a spike may be, rad: samples there take no part in the model.
pub(super) const SETTLING: f64 = TAU / 36.0;
/// A standard deviation this many times that of a mean of as many readings is none of a figure that the arc determines.
const MOST: f64 = 30.0;
/// Coefficients there are at most.
const TERMS: usize = 10;

/// A figure read from the trace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// What it is.
    pub term: Term,
    /// How large, or why that is not told.
    pub estimate: Result<Estimate, Undetermined>,
}

/// A number with its uncertainty, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard deviation, from what the model leaves of the readings.
    pub std: f64,
    /// Half the 95 % interval by the same.
    pub u95: f64,
}

/// What the model leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Standard deviation of the residuals, mm.
    pub std: f64,
    /// How many samples stand for an independent one.
    pub alike: f64,
    /// Samples that the model is fitted to: those within 10° after a reversal are not.
    pub samples: usize,
}

/// Angle (rad) and deviation (mm) on the way in a direction.
type Sample = (Direction, (f64, f64));

/// A fitted model.
pub(super) struct Model {
    pub effects: Vec<Effect>,
    /// None where there are too few samples for any.
    pub scatter: Option<Scatter>,
    terms: Vec<(Term, bool)>,
    coefficients: Vec<f64>,
}

impl Model {
    /// Fits all terms that these paths may tell.
    pub fn fit(traces: &Traces) -> Self {
        let terms = terms(traces);
        let settled = |(direction, (angle, _)): &Sample| !settles(*angle, *direction);
        let samples = traces.each().flat_map(|(direction, trace)| trace.samples().iter().map(move |s| (direction, *s)));
        let samples: Vec<Sample> = samples.filter(settled).collect();
        let Some(Separated { solution, squares, degrees, told }) = separated(&terms, &samples) else {
            return Self::none(traces, terms);
        };
        let coefficients: Vec<f64> = (0..terms.len()).map(|at| solution.coefficients[at]).collect();
        let mut model = Self { effects: Vec::new(), scatter: None, terms, coefficients };
        let alike = traces.each().map(|(direction, trace)| model.look(direction, trace).alike()).fold(1.0, f64::max);
        let scatter = (squares / degrees as f64).sqrt();
        let factor = student_t_95::<f64>((degrees as f64 / alike).max(1.0) as u32);
        let effect = |(at, (term, _)): (usize, &(Term, bool))| {
            let gain = solution.covariance[(at, at)].max(0.0).sqrt();
            let times = gain * (samples.len() as f64).sqrt();
            let std = scatter * gain * alike.sqrt();
            let estimate = match told[at] {
                Some(why) => Err(why),
                None if times > MOST => Err(Undetermined::Arc { times }),
                None => Ok(Estimate { value: model.coefficients[at], std, u95: factor * std }),
            };
            Effect { term: *term, estimate }
        };
        let fitted: Vec<Effect> = model.terms.iter().enumerate().map(effect).collect();
        model.effects = every(traces, &fitted);
        model.scatter = Some(Scatter { std: scatter, alike, samples: samples.len() });
        model
    }

    /// What it leaves of a path, one sample after the other.
    fn look(&self, direction: Direction, trace: &Trace) -> Look {
        let path = trace.path(direction).into_iter().filter(|(angle, _)| !settles(*angle, direction));
        let left = path.map(|(angle, deviation)| deviation - self.at(angle, direction));
        Look::at(&left.collect::<Vec<_>>())
    }

    /// Nothing is told.
    fn none(traces: &Traces, terms: Vec<(Term, bool)>) -> Self {
        let few = |(term, _): &(Term, bool)| Effect { term: *term, estimate: Err(Undetermined::Samples) };
        let fitted: Vec<Effect> = terms.iter().map(few).collect();
        Self { effects: every(traces, &fitted), scatter: None, coefficients: vec![0.0; terms.len()], terms }
    }

    /// What it makes of the deviation at an angle (rad), mm.
    pub fn at(&self, angle: f64, direction: Direction) -> f64 {
        let terms = self.terms.iter().zip(&self.coefficients);
        terms.map(|((term, lone), value)| value * term.at(angle, direction, *lone)).sum()
    }
}

/// Whether an axis has turned round just before.
fn settles(angle: f64, direction: Direction) -> bool {
    Reversal::ALL.iter().any(|reversal| (0.0..=SETTLING).contains(&after(*reversal, angle, direction)))
}

/// How far after a reversal an angle is, on the shorter way, rad.
pub(super) fn after(reversal: Reversal, angle: f64, direction: Direction) -> f64 {
    direction.sign() * ((angle - reversal.angle() + PI).rem_euclid(TAU) - PI)
}

/// Whether a reversal is passed.
fn passes(traces: &Traces, reversal: Reversal) -> bool {
    traces.each().any(|(_, trace)| trace.profile().covers(reversal.angle() - SETTLING, 2.0 * SETTLING))
}

/// The terms that these paths may tell, and which of the backlashes are of axes that are seen to reverse at one end only.
fn terms(traces: &Traces) -> Vec<(Term, bool)> {
    let both = traces.both();
    let tells = |term: &Term| match term {
        Term::Backlash(reversal) => passes(traces, *reversal),
        Term::Squareness | Term::Servo => both,
        _ => true,
    };
    let lone = |term| matches!(term, Term::Backlash(reversal) if !passes(traces, reversal.other()));
    Term::all(both).into_iter().filter(tells).map(|term| (term, lone(term))).collect()
}

/// Every figure there is, fitted or not.
fn every(traces: &Traces, fitted: &[Effect]) -> Vec<Effect> {
    let missing = |term| match term {
        Term::Backlash(_) => Undetermined::NoReversal { before: SETTLING, after: SETTLING },
        _ => Undetermined::OneDirection,
    };
    let of = |term| {
        let own = fitted.iter().find(|effect| effect.term == term);
        own.copied().unwrap_or_else(|| Effect { term, estimate: Err(missing(term)) })
    };
    Term::all(traces.both()).into_iter().map(of).collect()
}

/// A solution, and the terms that it does not tell.
struct Separated {
    /// Its covariance is that of readings of a standard deviation of one.
    solution: Solution<f64, TERMS>,
    squares: f64,
    degrees: usize,
    told: Vec<Option<Undetermined>>,
}

/// The least-squares solution; none where there are too few samples.
fn separated(terms: &[(Term, bool)], samples: &[Sample]) -> Option<Separated> {
    let mut told = vec![None; terms.len()];
    let mut held = vec![false; terms.len()];
    loop {
        let free = held.iter().filter(|held| !**held).count();
        let degrees = samples.len().checked_sub(free).filter(|degrees| *degrees > 0)?;
        match solved(terms, &held, samples) {
            Ok((solution, squares)) => return Some(Separated { solution, squares, degrees, told }),
            Err(SolveError::RankDeficient(confounded)) => {
                // With one of them held, the estimates of those outside stand as they are.
                confounded.involved.iter().for_each(|at| told[at] = Some(Undetermined::Confounded));
                if std::mem::replace(held.get_mut(confounded.pivot)?, true) {
                    return None;
                }
            }
            Err(_) => return None,
        }
    }
}

/// The solution with the sum of its residuals' squares; what is held is zero, as are coefficients without a term.
fn solved(
    terms: &[(Term, bool)],
    held: &[bool],
    samples: &[Sample],
) -> Result<(Solution<f64, TERMS>, f64), SolveError<TERMS>> {
    let mut factor = Factor::<f64, TERMS>::new();
    let mut push = |row: &SVector<f64, TERMS>, y| factor.push(row, y).map_err(|_| SolveError::NotFinite);
    for at in (0..TERMS).filter(|at| held.get(*at).is_none_or(|held| *held)) {
        push(&SVector::from_fn(|k, _| f64::from(u8::from(k == at))), 0.0)?;
    }
    for (direction, (angle, deviation)) in samples {
        let term = |at: usize, _| match (terms.get(at), held.get(at)) {
            (Some((term, lone)), Some(false)) => term.at(*angle, *direction, *lone),
            _ => 0.0,
        };
        push(&SVector::from_fn(term), *deviation)?;
    }
    Ok((factor.solve_with_sigma(1.0)?, factor.residual_sum_of_squares()))
}
