//! Angles with an exact sine and cosine.

use super::{AlgebraError, Alphabet, Monomial, Order, Poly, Rational, SweepId};

/// An angle `multiple · sweep + eighths · π/4`, or one given by its sine and cosine: what has an exact sine and cosine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Angle {
    /// The sweep it turns with and how often; `None` at a fixed angle.
    pub sweep: Option<(SweepId, i32)>,
    /// The sine and cosine it is given by, and how often; `None` of an angle of the sweep.
    pub given: Option<(Box<[Poly; 2]>, i32)>,
    /// The fixed part in steps of 45°.
    pub eighths: i32,
    /// The angle itself as a polynomial in the sweep and π, rad.
    pub poly: Poly,
}

impl Angle {
    /// The angle 0.
    pub fn zero() -> Self {
        Self { sweep: None, given: None, eighths: 0, poly: Poly::ZERO }
    }

    /// Sine and cosine as polynomials in the sweep's sine and cosine, in normal form (Chebyshev's, by repeated rotation).
    pub fn sin_cos(&self, alphabet: &Alphabet) -> Result<(Poly, Poly), AlgebraError> {
        let half_root = Poly::term(Monomial::nominal(Alphabet::ROOT2, 1), Rational::new(1, 2));
        let eighth = (half_root.clone(), half_root);
        let mut turned = rotate_times((Poly::ZERO, Poly::one()), &eighth, self.eighths.rem_euclid(8), alphabet)?;
        if let Some((sweep, multiple)) = self.sweep {
            let [_, sin, cos] = alphabet.sweep_symbols(sweep);
            let sin = if multiple < 0 { Poly::nominal(sin).negated() } else { Poly::nominal(sin) };
            turned = rotate_times(turned, &(sin, Poly::nominal(cos)), multiple.abs(), alphabet)?;
        }
        if let Some((given, multiple)) = &self.given {
            let [sin, cos] = &**given;
            let sin = if *multiple < 0 { sin.negated() } else { sin.clone() };
            turned = rotate_times(turned, &(sin, cos.clone()), multiple.abs(), alphabet)?;
        }
        Ok(turned)
    }

    /// The same angle `n` times over.
    pub fn times(&self, n: i32) -> Result<Self, AlgebraError> {
        let sweep = self.sweep.map(|(s, m)| (s, m * n));
        let given = self.given.clone().map(|(given, m)| (given, m * n));
        Ok(Self { sweep, given, eighths: self.eighths * n, poly: self.poly.scaled(&Rational::from(i128::from(n)))? })
    }
}

/// Adds the angle of `step` to that of `(sin, cos)`, `count` times.
fn rotate_times(
    start: (Poly, Poly),
    step: &(Poly, Poly),
    count: i32,
    alphabet: &Alphabet,
) -> Result<(Poly, Poly), AlgebraError> {
    let times = |a: &Poly, b: &Poly| a.times(b, Order::NOMINAL);
    (0..count).try_fold(start, |(s, c), _| {
        let sin = times(&s, &step.1)?.plus(&times(&c, &step.0)?)?.normal(alphabet)?;
        let cos = times(&c, &step.1)?.minus(&times(&s, &step.0)?)?.normal(alphabet)?;
        Ok((sin, cos))
    })
}
