//! The quintic φ(θ) that a control follows around a ring, E(10).

use super::{ALONG, PointError, rotation_at};
use nalgebra::SVector;
use std::f64::consts::{PI, TAU};
use trunnion_solver::{exechon::Machine, lstsq::Factor};

/// Places between touches at which the quintic is held against the inverse kinematics.
const FINE: u32 = 3600;

/// The spindle angle over a ring's angle θ, as a polynomial: φ(θ) = Σ cₙ θⁿ, n = 0…5, E(10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compensation {
    /// Centre of the ring, mm.
    pub centre: [f64; 3],
    /// Radius of the spindle's path, mm: that of the ring less the stylus ball's.
    pub radius: f64,
    /// c₀…c₅ with φ in rad over θ in rad, 0 ≤ θ < 2π.
    pub coefficients: [f64; 6],
    /// Largest difference from the inverse kinematics at the touches fitted, rad.
    pub at_touches: f64,
    /// Largest difference from the inverse kinematics anywhere on the ring, rad.
    pub anywhere: f64,
}

/// Why there is no quintic.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompensationError {
    /// The machine does not reach the ring.
    #[error("at {0:.1}° of the ring: {1}")]
    Point(f64, #[source] PointError),
    /// Too few touches for six coefficients.
    #[error("{0} touches do not give a polynomial of six coefficients")]
    TooFew(u32),
}

impl Compensation {
    /// Fits the quintic to the inverse kinematics at `touches` evenly spread places.
    ///
    /// # Errors
    /// [`CompensationError`].
    pub fn fit(machine: &Machine<f64>, centre: [f64; 3], radius: f64, touches: u32) -> Result<Self, CompensationError> {
        let rotation = |theta: f64| {
            let point = [centre[0] + radius * theta.cos(), centre[1] + radius * theta.sin(), centre[2]];
            rotation_at(machine, point, ALONG).map_err(|e| CompensationError::Point(theta.to_degrees(), e))
        };
        let mut factor = Factor::<f64, 6>::new();
        let few = CompensationError::TooFew(touches);
        for k in 0..touches {
            let theta = TAU * f64::from(k) / f64::from(touches);
            factor.push(&powers(theta), rotation(theta)?).map_err(|_| few)?;
        }
        let shifted = factor.solve().map_err(|_| few)?.coefficients.into();
        let mut fit = Self { centre, radius, coefficients: expanded(shifted), at_touches: 0.0, anywhere: 0.0 };
        let worst = |n: u32| {
            (0..n).try_fold(0f64, |worst, k| {
                let theta = TAU * f64::from(k) / f64::from(n);
                Ok(worst.max((fit.at(theta) - rotation(theta)?).abs()))
            })
        };
        (fit.at_touches, fit.anywhere) = (worst(touches)?, worst(FINE)?);
        Ok(fit)
    }

    /// φ at an angle of the ring, rad.
    pub fn at(&self, theta: f64) -> f64 {
        let theta = theta.rem_euclid(TAU);
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * theta + c)
    }
}

/// Powers of (θ − π)/π: far better told apart than those of θ.
fn powers(theta: f64) -> SVector<f64, 6> {
    let x = (theta - PI) / PI;
    SVector::from([1.0, x, x * x, x.powi(3), x.powi(4), x.powi(5)])
}

/// From powers of (θ − π)/π to powers of θ.
fn expanded(shifted: [f64; 6]) -> [f64; 6] {
    let mut out = [0.0; 6];
    for c in shifted.iter().rev() {
        // out · (θ/π − 1) + c
        let mut next = [0.0; 6];
        for (n, &o) in out.iter().enumerate() {
            next[n] -= o;
            if let Some(higher) = next.get_mut(n + 1) {
                *higher += o / PI;
            }
        }
        next[0] += c;
        out = next;
    }
    out
}
