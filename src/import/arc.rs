//! Where the readings of a run begin and end, and the angles between.

use std::f64::consts::TAU;

use super::error::NoArc;

/// Angles are rounded to such a part of a degree: what is computed from the ends has no more to it.
const GRAINS: f64 = 1e9;

/// An arc, counted in the direction of growing angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where it begins, degrees.
    pub from_deg: f64,
    /// Where it ends, degrees; beyond its beginning.
    pub to_deg: f64,
    /// How far the readings go beyond either end, degrees.
    pub overshoot_deg: f64,
}

impl Arc {
    /// The arc that the name of a test has, "YZ 220grad 150mm": a whole turn from 0°; what is half a turn or more lies
    /// symmetrically to 90°, as the arcs of vertical planes do. Where a shorter one begins is not known.
    pub(super) fn named(name: &str) -> Result<Self, NoArc> {
        let degrees = degrees(name).ok_or_else(|| NoArc::NotNamed(name.to_owned()))?;
        let (from_deg, to_deg) = match degrees {
            360.0 => (0.0, 360.0),
            180.0..360.0 => (90.0 - degrees / 2.0, 90.0 + degrees / 2.0),
            _ => return Err(NoArc::Open(name.to_owned())),
        };
        Ok(Self { from_deg, to_deg, overshoot_deg: 0.0 })
    }

    /// The angle of reading `at` of `count` that were taken evenly along all of it, rad; readings before the first one and after
    /// the last one go on in the same steps.
    pub(super) fn angle_rad(&self, at: f64, count: usize) -> f64 {
        let (from, to) = (self.from_deg - self.overshoot_deg, self.to_deg + self.overshoot_deg);
        let degrees = from + (to - from) * at / (count.max(2) - 1) as f64;
        ((degrees * GRAINS).round() / GRAINS).to_radians()
    }

    /// Whether an angle, rad, is within its ends.
    pub(super) fn has(&self, angle_rad: f64) -> bool {
        let slack = TAU * 1e-9;
        (self.from_deg.to_radians() - slack..=self.to_deg.to_radians() + slack).contains(&angle_rad)
    }
}

/// The number before a word for degrees.
fn degrees(name: &str) -> Option<f64> {
    let lower = name.to_lowercase();
    let ends = ["grad", "deg", "°", "º"].into_iter().flat_map(|word| lower.match_indices(word));
    ends.filter_map(|(end, _)| {
        let before = lower.get(..end)?.trim_end();
        let digits = before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len();
        before.get(digits..)?.parse().ok()
    })
    .find(|degrees| (0.0..=360.0).contains(degrees))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_carry_arcs() {
        let ends = |name| Arc::named(name).map(|arc| (arc.from_deg, arc.to_deg));
        assert_eq!(ends("YZ 220grad 150mm"), Ok((-20.0, 200.0)));
        assert_eq!(ends("150mm 220 deg YZ"), Ok((-20.0, 200.0)));
        assert_eq!(ends("XY µ360°"), Ok((0.0, 360.0)));
        assert_eq!(ends("180°"), Ok((0.0, 180.0)));
        assert_eq!(ends("XY 90deg"), Err(NoArc::Open("XY 90deg".to_owned())));
        for name in ["50mm YZ 1500", "", "grad", "upgrade 4000deg"] {
            assert_eq!(ends(name), Err(NoArc::NotNamed(name.to_owned())));
        }
        let arc = Arc { from_deg: -20.0, to_deg: 200.0, overshoot_deg: 10.0 };
        let angles = [0.0, 24.0, 12.0, -1.0].map(|at| arc.angle_rad(at, 25));
        assert_eq!(angles, [-30.0, 210.0, 90.0, -40.0].map(f64::to_radians));
        assert!(arc.has(200f64.to_radians()) && !arc.has(200.1f64.to_radians()));
    }
}
