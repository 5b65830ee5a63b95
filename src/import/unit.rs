//! The unit of readings that do not say it: found by how round the run is said to be.

use super::error::Inconclusive;
use nalgebra::{Matrix3, Vector3};
use trunnion_codegen::quantity::Unit;

/// By how much the circularity of the readings may differ from what the run says, which may be filtered or about another centre.
const ALIKE: f64 = 2.0;

/// The width of the readings about their least-squares circle: of r = c₀ + c₁ cos θ + c₂ sin θ + residual, the largest
/// residual less the smallest. None where they do not determine one.
pub(super) fn circularity(samples: impl Iterator<Item = (f64, f64)> + Clone) -> Option<f64> {
    let row = |angle: f64| Vector3::new(1.0, angle.cos(), angle.sin());
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (angle, reading) in samples.clone() {
        normal += row(angle) * row(angle).transpose();
        right += row(angle) * reading;
    }
    let circle = normal.cholesky()?.solve(&right);
    let residuals = samples.map(|(angle, reading)| reading - row(angle).dot(&circle));
    let (low, high) = residuals.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| (low.min(r), high.max(r)));
    Some(high - low).filter(|width| width.is_finite())
}

/// The unit in which a circularity of `readings` is one of `told_mm`.
pub(super) fn unit(readings: f64, told_mm: f64) -> Result<Unit, Inconclusive> {
    let alike = |unit: &Unit| {
        let ratio = unit.to_inner(readings) / told_mm;
        (1.0 / ALIKE..=ALIKE).contains(&ratio)
    };
    [Unit::Mm, Unit::Um].into_iter().find(alike).ok_or(Inconclusive::Unlike { readings, told_mm })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oval_has_its_width_whatever_its_centre_and_the_unit_is_found_by_it() {
        let samples = (0..360).map(|i| {
            let a = f64::from(i).to_radians();
            (a, 7.0 + 30.0 * a.cos() - 12.0 * a.sin() + 2.5 * (2.0 * a).cos())
        });
        let width = circularity(samples).unwrap();
        assert!((width - 5.0).abs() < 1e-9, "{width}");
        assert_eq!(circularity([(0.0, 1.0), (0.0, 2.0)].into_iter()), None);
        assert_eq!(unit(0.0061, 0.006), Ok(Unit::Mm));
        assert_eq!(unit(6.1, 0.006), Ok(Unit::Um));
        for (readings, told_mm) in [(0.1, 0.006), (6.1, 0.0), (0.0, 0.0), (0.0, 0.006), (6.1, f64::NAN)] {
            assert!(unit(readings, told_mm).is_err(), "{readings} {told_mm}");
        }
    }
}
