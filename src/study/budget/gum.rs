//! The law of propagation of uncertainty: JCGM 100:2008 (GUM), equations (10), (G.2b) and (G.1d).

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// The probability of every interval that is reported.
pub const COVERAGE: f64 = 0.95;

/// One contribution to a combined standard uncertainty: `|c|·u(x)` of the GUM.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// Standard uncertainty, in the unit of the result.
    pub std: f64,
    /// Its degrees of freedom; `None` for one that is taken as exactly known.
    pub degrees_of_freedom: Option<u32>,
}

/// A combined uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combined {
    /// Combined standard uncertainty.
    pub std: f64,
    /// Effective degrees of freedom, Welch and Satterthwaite's, not rounded; infinite where no contribution has any.
    pub degrees_of_freedom: f64,
    /// Coverage factor: Student's t for the degrees of freedom, rounded down.
    pub factor: f64,
    /// Expanded uncertainty: half the width of the interval.
    pub expanded: f64,
}

/// Combines uncorrelated contributions; `probability` is that of the interval, 0.95 in every report.
pub fn combine(contributions: impl IntoIterator<Item = Contribution>, probability: f64) -> Combined {
    let (mut square, mut fourth) = (0.0, 0.0);
    for Contribution { std, degrees_of_freedom } in contributions {
        square += std * std;
        fourth += degrees_of_freedom.map_or(0.0, |n| std.powi(4) / f64::from(n));
    }
    let degrees_of_freedom = if fourth > 0.0 { whole(square * square / fourth) } else { f64::INFINITY };
    let factor = student(degrees_of_freedom, probability);
    Combined { std: square.sqrt(), degrees_of_freedom, factor, expanded: factor * square.sqrt() }
}

/// The whole number that rounding has moved a little: to be rounded down, it would lose one.
fn whole(degrees_of_freedom: f64) -> f64 {
    let nearest = degrees_of_freedom.round();
    if (degrees_of_freedom - nearest).abs() <= 1e-9 * nearest { nearest } else { degrees_of_freedom }
}

/// The coverage factor of every interval that is reported, of a standard uncertainty with these degrees of freedom; none for
/// one that is taken as exactly known.
pub fn coverage_factor(degrees_of_freedom: Option<u32>) -> f64 {
    student(degrees_of_freedom.map_or(f64::INFINITY, f64::from), COVERAGE)
}

/// Student's t: the interval ±t holds `probability`.
fn student(degrees_of_freedom: f64, probability: f64) -> f64 {
    let below = 0.5 + probability / 2.0;
    let whole = degrees_of_freedom.floor().max(1.0);
    if whole <= MANY {
        return StudentsT::new(0.0, 1.0, whole).map_or(f64::INFINITY, |t| t.inverse_cdf(below));
    }
    // The first term of Cornish and Fisher's expansion leaves 1/n².
    let z = Normal::standard().inverse_cdf(below);
    z + (z.powi(3) + z) / (4.0 * whole)
}

/// Degrees of freedom above which the normal distribution stands in for Student's.
const MANY: f64 = 1e4;

#[cfg(test)]
mod tests {
    use super::*;

    /// JCGM 100:2008, H.1: calibration of a gauge block, nm.
    #[test]
    fn the_gauge_block_of_the_guide() {
        let part = |std, n| Contribution { std, degrees_of_freedom: Some(n) };
        // H.1.3.2: repeated observations, random and systematic effects of the comparator.
        let difference = combine([part(5.8, 24), part(3.9, 5), part(6.7, 8)], 0.99);
        assert_eq!(format!("{:.1}", difference.std), "9.7");
        assert_eq!(difference.degrees_of_freedom.floor(), 25.0);
        let total = combine([part(25.0, 18), part(9.7, 25), part(2.9, 50), part(16.6, 2)], 0.99);
        assert_eq!(format!("{:.0}", total.std), "32");
        assert_eq!(total.degrees_of_freedom.floor(), 16.0);
        assert_eq!(format!("{:.2}", total.factor), "2.92");
        assert_eq!(format!("{:.0}", total.expanded), "93");
    }

    #[test]
    fn one_contribution_keeps_its_degrees_of_freedom() {
        for n in 1..200 {
            for std in [0.1, 0.3, 1.7e-4, 157.0] {
                let alone = combine([Contribution { std, degrees_of_freedom: Some(n) }], 0.95);
                assert_eq!((alone.degrees_of_freedom, alone.factor), (f64::from(n), coverage_factor(Some(n))));
            }
        }
    }

    #[test]
    fn what_is_exactly_known_has_the_normal_factor() {
        let known = combine([Contribution { std: 3.0, degrees_of_freedom: None }], 0.95);
        assert!((known.factor - 1.959_964).abs() < 1e-6 && known.degrees_of_freedom.is_infinite());
    }
}
