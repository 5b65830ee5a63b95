//! ε_xa from a target or from C against the host's `f64`.

use crate::{Outcome, qemu};
use std::path::Path;
use trunnion_solver::lstsq::student_t_95;
use trunnion_solver::tilting::{Estimate, Joint, Lengths, TwoStep};

/// Largest difference from the host's `f64`, µrad: what is asked of `f32` at 360 samples, and the digits printed.
const BOUNDS: [(&str, f64); 2] = [("f32", 0.01), ("f64", 2e-9)];

/// Holds every line `f32 joint 30 = 6.004 0.502` of a program's output to the host.
pub fn check(file: &Path) -> Outcome {
    let text = qemu::output(file)?;
    let host = Host::new().ok_or("the host has no estimate")?;
    let (mut lines, mut worst) = (0, [0.0_f64; 2]);
    for (name, value) in qemu::values(&text) {
        let words: Vec<&str> = name.split(' ').collect();
        let numbers: Vec<f64> = value.split(' ').filter_map(|number| number.parse().ok()).collect();
        let ([kind, estimator, degree], [eps, band]) = (&words[..], &numbers[..]) else {
            return Err(format!("not understood: {name} = {value}"));
        };
        let degree: f64 = degree.parse().map_err(|_| format!("not an angle: {name}"))?;
        let expected = host.at(estimator, degree).ok_or(format!("no such estimator: {name}"))?;
        let place = BOUNDS.iter().position(|(name, _)| name == kind).ok_or(format!("no such type: {name}"))?;
        let differences = [eps - expected[0], band - expected[1]].map(f64::abs);
        // NaN is within nothing.
        if !differences.iter().all(|difference| *difference <= BOUNDS[place].1) {
            return Err(format!("{name} = {value} where the host has {expected:?} µrad"));
        }
        worst[place] = differences.into_iter().fold(worst[place], f64::max);
        lines += 1;
    }
    if lines < 13 {
        return Err(format!("{}: {lines} results", file.display()));
    }
    println!("{lines} values of ε_xa within {:.6} µrad (f32) and {:.1e} µrad (f64) of the host's", worst[0], worst[1]);
    Ok(())
}

struct Host {
    joint: Estimate<f64>,
    two_step: Estimate<f64>,
}

impl Host {
    fn new() -> Option<Self> {
        let lengths = Lengths { r: runs::RADIUS };
        let (mut joint, mut two_step) = (Joint::new(lengths).ok()?, TwoStep::new(lengths).ok()?);
        for sample in runs::turn() {
            let [y_a, z_a] = sample.known;
            joint.push_tilting(sample.angle, sample.tilting, y_a, z_a).ok()?;
            joint.push_separation(sample.angle, sample.separation).ok()?;
            two_step.push_tilting(sample.angle, sample.tilting, y_a, z_a).ok()?;
            two_step.push_separation(sample.angle, sample.separation).ok()?;
        }
        Some(Self { joint: joint.solve().ok()?, two_step: two_step.solve().ok()? })
    }

    /// ε_xa and half the width of its band, µrad.
    fn at(&self, estimator: &str, degree: f64) -> Option<[f64; 2]> {
        let estimate = match estimator {
            "joint" => &self.joint,
            "two-step" => &self.two_step,
            _ => return None,
        };
        let (eps, std) = estimate.e_xa(degree.to_radians()).ok()?;
        Some([eps, student_t_95::<f64>(estimate.solution.degrees_of_freedom) * std].map(|rad| rad * 1e6))
    }
}
