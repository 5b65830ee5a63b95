//! Huber's M-estimator: readings far off the others are weighed down, by least squares that are weighted anew.
//!
//! With residuals e, a robust scale s of each recording (the median of their sizes over 0.6745) and k = 1.345 (95 % efficient for
//! normal noise), a reading weighs `w = min(1, k s/|e|)`. The covariance is Huber's (*Robust Statistics*, 1981, 7.6):
//!
//! ```text
//! K² Σ (w e)²/(n − p) / m² · (X'X)⁻¹,  m = share of readings with w = 1,  K = 1 + (p/n)(1 − m)/m
//! ```

use super::fill::{Collected, places};
use super::fit::{Failure, Fit, FitError};
use super::misfit::Sizes;
use super::recording::Recording;
use super::rows::blocks;
use super::setup::Setup;
use super::weighed_down::WeighedDown;
use std::collections::BTreeSet;
use trunnion_codegen::graph::LANES;
use trunnion_solver::sized::{self, Columns};

/// Huber's k.
const K: f64 = 1.345;
/// Rounds of weighting anew, at most: each takes a third off what is left or more.
const ROUNDS: usize = 60;
/// Changes of all coefficients below this share of their standard deviation end the rounds.
const SETTLED: f64 = 1e-6;
/// Readings that are named, those weighed down most.
const NAMED: usize = 8;

/// A pass over a recording.
#[derive(Default)]
struct Pass {
    sizes: Sizes,
    samples: usize,
    down: usize,
    squares: f64,
    /// Weights and sweeps as bits, which are in their order for positive numbers, and the position.
    least: BTreeSet<(u64, usize, u64)>,
}

impl Pass {
    fn add(&mut self, sweep: f64, residual: f64, weight: f64, of_samples: f64) {
        self.sizes.add(residual.abs());
        self.squares += of_samples * (weight * residual).powi(2);
        if weight < 1.0 {
            self.down += 1;
            self.least.insert((weight.to_bits(), self.samples, sweep.to_bits()));
            if self.least.len() > NAMED {
                self.least.pop_last();
            }
        }
        self.samples += 1;
    }
}

/// Weighs readings down until nothing changes; `fit` is the plain one and becomes the robust one but for what its residuals look
/// like.
pub(super) fn weigh_down<R: Recording>(
    setup: &Setup,
    recordings: &[R],
    fit: &mut Fit,
    columns: &Columns,
    plain: &dyn sized::Estimate,
) -> Result<Vec<WeighedDown>, Failure<R::Error>> {
    let std: Vec<f64> = fit.covariance.diagonal().iter().map(|variance| variance.max(0.0).sqrt()).collect();
    let mut scales = vec![f64::INFINITY; recordings.len()];
    let mut passes = Vec::new();
    for round in 0..ROUNDS {
        let mut problem = sized::estimator(columns).ok_or(FitError::NotFinite)?;
        passes.clear();
        for ((at, recording), scale) in recordings.iter().enumerate().zip(&mut scales) {
            let step = fit.step(at);
            let base = fit.places(setup, recording.run());
            let mut pass = Pass::default();
            let mut collected = Collected::new(columns.of(step).len());
            let to = places(setup, recording.run(), &fit.base, &columns.of(step));
            let (mut refused, mut sweeps) = (false, Vec::with_capacity(LANES));
            let sweeps = core::cell::RefCell::new(&mut sweeps);
            blocks(
                setup,
                recording,
                |sample| sweeps.borrow_mut().push(sample.sweep),
                |rows| {
                    let residuals = fit.residual(rows, &base);
                    let weight = |e: f64| if e.abs() > K * *scale { K * *scale / e.abs() } else { 1.0 };
                    let weights = residuals.map(weight);
                    for ((sweep, e), w) in sweeps.borrow_mut().drain(..).zip(residuals).zip(weights) {
                        pass.add(sweep, e, w, recording.weight());
                    }
                    collected.take(rows, &to, Some(&weights));
                    if collected.is_full() {
                        refused |= collected.push(step, recording.weight(), problem.as_mut()).is_err();
                    }
                },
            )
            .map_err(Failure::Recording)?;
            refused |= collected.push(step, recording.weight(), problem.as_mut()).is_err();
            if refused {
                return Err(FitError::NotFinite.into());
            }
            *scale = pass.sizes.median() / 0.6745;
            passes.push(pass);
        }
        if round == 0 {
            // The first pass only finds the scales.
            continue;
        }
        let Ok(coefficients) = problem.coefficients() else { return Err(FitError::NotFinite.into()) };
        let change = coefficients.iter().zip(fit.values.iter()).zip(&std);
        let change = change.map(|((a, b), std)| (a - b).abs() / std.max(f64::MIN_POSITIVE)).fold(0.0, f64::max);
        fit.values = coefficients;
        if change < SETTLED {
            break;
        }
    }
    let sum = |of: fn(&Pass) -> f64| passes.iter().map(of).sum::<f64>();
    let (samples, unknowns) = (sum(|p| p.samples as f64), fit.base.len() as f64);
    let whole = 1.0 - sum(|p| p.down as f64) / samples;
    let correction = 1.0 + unknowns / samples * (1.0 - whole) / whole;
    let sigma = correction * (sum(|p| p.squares) / (samples - unknowns)).sqrt() / whole;
    let Ok(solved) = plain.solve(Some(sigma)) else { return Err(FitError::NotFinite.into()) };
    (fit.covariance, fit.sensitivity) = (solved.covariance, solved.sensitivity);
    let told = |((recording, pass), &scale): ((&R, &Pass), &f64)| WeighedDown {
        run: recording.run(),
        samples: pass.down,
        scale,
        most: pass.least.iter().map(|(w, _, sweep)| (f64::from_bits(*sweep), f64::from_bits(*w))).collect(),
    };
    Ok(recordings.iter().zip(&passes).zip(&scales).map(told).collect())
}
