//! The unit of readings that do not say it: found by how round the run is said to be.

use nalgebra::{Matrix3, Vector3};

/// By how much the circularity of the readings may differ from what the run says, which may be filtered or about another centre.
const ALIKE: f64 = 2.0;

/// What readings are off their least-squares circle: r = c₀ + c₁ cos θ + c₂ sin θ + residual. None where they do not determine
/// one.
pub(super) fn circle(samples: impl Iterator<Item = (f64, f64)>) -> Option<impl Fn((f64, f64)) -> f64> {
    let row = |angle: f64| Vector3::new(1.0, angle.cos(), angle.sin());
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (angle, reading) in samples {
        normal += row(angle) * row(angle).transpose();
        right += row(angle) * reading;
    }
    let circle = normal.cholesky()?.solve(&right);
    Some(move |(angle, reading)| reading - row(angle).dot(&circle))
}

/// The width of the readings about that circle: the largest residual less the smallest.
pub(super) fn circularity(samples: impl Iterator<Item = (f64, f64)> + Clone) -> Option<f64> {
    let residuals = samples.clone().map(circle(samples)?);
    let (low, high) = residuals.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| (low.min(r), high.max(r)));
    Some(high - low).filter(|width| width.is_finite())
}

/// Whether a circularity may be the one that is told.
pub(super) fn alike(readings_mm: f64, told_mm: f64) -> bool {
    (1.0 / ALIKE..=ALIKE).contains(&(readings_mm / told_mm))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oval_has_its_width_whatever_its_centre() {
        let samples = (0..360).map(|i| {
            let a = f64::from(i).to_radians();
            (a, 7.0 + 30.0 * a.cos() - 12.0 * a.sin() + 2.5 * (2.0 * a).cos())
        });
        let width = circularity(samples).unwrap();
        assert!((width - 5.0).abs() < 1e-9, "{width}");
        assert_eq!(circularity([(0.0, 1.0), (0.0, 2.0)].into_iter()), None);
        assert!(alike(0.0061, 0.006) && alike(0.004, 0.006));
        for (readings, told_mm) in [(0.1, 0.006), (6.1, 0.0), (0.0, 0.0), (0.0, 0.006), (6.1, f64::NAN)] {
            assert!(!alike(readings, told_mm), "{readings} {told_mm}");
        }
    }
}
