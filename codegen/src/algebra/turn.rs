//! Angles less whole turns.

use super::wrapped::WrappedAngle;
use super::{AlgebraError, Alphabet, Angle, Poly, Rational};

/// Steps of 15° in a turn.
pub const TURN: i32 = 24;

/// An angle less whole turns in terms of a [`WrappedAngle`]: `±wrapped + fixed`. Angles that differ by a sign, or by a fixed part,
/// have the same one wherever they jump at the same places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turned {
    /// What jumps; `None` of an angle that does not move.
    pub wrapped: Option<WrappedAngle>,
    /// Whether it counts against the sweep.
    pub against: bool,
    /// The rest, in steps of 15°.
    pub fixed: i32,
}

impl Turned {
    /// `angle` in `start · π/12` and a turn from there.
    pub fn new(angle: &Angle, start: i32) -> Self {
        let offset = 3 * angle.eighths;
        let Some((sweep, multiple)) = angle.sweep.filter(|(_, multiple)| *multiple != 0) else {
            return Self { wrapped: None, against: false, fixed: start + (offset - start).rem_euclid(TURN) };
        };
        // w(mθ + o; s) = w(mθ; s − o) + o, and against the sweep −w(mθ; o − s − 24) + o; w(·; s + 24k) = w(·; s) + 24k.
        let against = multiple < 0;
        let from = if against { offset - start - TURN } else { start - offset };
        let (start, whole) = (from.rem_euclid(TURN), from.div_euclid(TURN) * TURN);
        let wrapped = Some(WrappedAngle { sweep, multiple: multiple.abs(), start });
        Self { wrapped, against, fixed: offset + if against { -whole } else { whole } }
    }

    /// As a polynomial; the angle itself where the alphabet has no symbol for what jumps.
    pub fn poly(&self, angle: &Angle, alphabet: &Alphabet) -> Result<Poly, AlgebraError> {
        let fixed = Poly::nominal(Alphabet::PI).scaled(&Rational::new(self.fixed.into(), 12))?;
        match self.wrapped.map(|wrapped| alphabet.find_wrapped(wrapped)) {
            None => Ok(fixed),
            Some(None) => Ok(angle.poly.clone()),
            Some(Some(id)) if self.against => fixed.minus(&Poly::nominal(id)),
            Some(Some(id)) => fixed.plus(&Poly::nominal(id)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::wrapped_value;
    use super::*;

    #[test]
    fn every_angle_in_every_turn_is_itself_less_whole_turns() {
        let mut alphabet = Alphabet::default();
        let sweep = alphabet.sweep("a").unwrap();
        let step = core::f64::consts::PI / 12.0;
        for multiple in [-3, -1, 1, 2] {
            for eighths in -9..9 {
                for start in -30..30 {
                    let angle = Angle { sweep: Some((sweep, multiple)), eighths, ..Angle::zero() };
                    let turned = Turned::new(&angle, start);
                    let own = turned.wrapped.unwrap();
                    assert!(own.multiple > 0 && (0..TURN).contains(&own.start));
                    for theta in [-7.3, -0.1, 0.2, 1.0, 3.3, 9.9] {
                        let w = wrapped_value(f64::from(own.multiple) * theta, own.start);
                        let is = if turned.against { -w } else { w } + f64::from(turned.fixed) * step;
                        let whole = f64::from(multiple) * theta + f64::from(3 * eighths) * step;
                        assert!(
                            (is - wrapped_value(whole, start)).abs() < 1e-12,
                            "{multiple} {eighths} {start} {theta}"
                        );
                    }
                }
            }
        }
    }
}
