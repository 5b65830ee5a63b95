//! The ball-bar: `(R + ΔR)² = |WB − TB|²`, eq. (4), solved for ΔR to any order.

use super::ReadingError;
use crate::algebra::{AlgebraError, Monomial, NominalId, Order, Poly, Rational, difference, dot, integer};
use crate::kinematics::ball_positions;
use crate::model::{Model, Run};

/// The nominal distance of the balls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Length {
    /// A single term, mm.
    Exactly(Poly),
    /// The square root of this, mm².
    RootOf(Poly),
}

/// ΔR up to `order` errors.
///
/// With `u = (|v|² − R²)/R²`, small of first order: `ΔR = R (√(1+u) − 1) = R Σ_{n≥1} C(½, n) uⁿ`.
pub(super) fn deviation(model: &Model, run: &Run, radius: NominalId, order: Order) -> Result<Poly, ReadingError> {
    let alphabet = &model.alphabet;
    let [workpiece, tool] = ball_positions(model, run, order)?;
    let v = difference(&workpiece, &tool)?;
    let square = dot(&v, &v, order)?.normal(alphabet)?;
    let expected = Poly::term(Monomial::nominal(radius, 2), integer(1));
    let nominal = square.of_order(0);
    if nominal != expected {
        return Err(ReadingError::NotTheBar(length(&nominal)?));
    }
    let over = Poly::term(Monomial::nominal(radius, -2), integer(1));
    let u = square.minus(&nominal)?.times(&over, order)?;
    let mut power = Poly::nominal(radius);
    let mut sum = Poly::ZERO;
    let mut binomial = integer(1);
    for n in 1..=order.get() as i128 {
        binomial *= (Rational::new(1, 2) - integer(n - 1)) / integer(n);
        power = power.times(&u, order)?;
        sum = sum.plus(&power.scaled(&binomial)?)?;
    }
    Ok(sum.normal(alphabet)?)
}

pub(super) fn length(square: &Poly) -> Result<Length, AlgebraError> {
    if let [(m, c)] = square.terms() {
        let half: Vec<i8> = m.powers().iter().map(|p| p / 2).collect();
        let root = |n: i128| (n >= 0).then(|| n.unsigned_abs().isqrt() as i128);
        if let (Ok(powers), Some(n), Some(d)) = (half.try_into(), root(*c.numer()), root(*c.denom())) {
            let candidate = Poly::term(Monomial::of_powers(powers), Rational::new(n, d));
            if candidate.times(&candidate, Order::NOMINAL)? == *square {
                return Ok(Length::Exactly(candidate));
            }
        }
    }
    Ok(Length::RootOf(square.clone()))
}
