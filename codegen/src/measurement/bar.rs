//! The ball-bar: `(R + ΔR)² = |WB − TB|²`, T(4), solved for ΔR to any order.

use super::error::{ReadingError, length};
use crate::algebra::{Monomial, NominalId, Order, Poly, Rational, difference, dot, integer};
use crate::kinematics::ball_positions;
use crate::model::{Model, Run};

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
    if !nominal.minus(&expected)?.vanishes(alphabet)? {
        return Err(ReadingError::NotTheBar(length(&nominal)?));
    }
    let over = Poly::term(Monomial::nominal(radius, -2), integer(1));
    let u = square.minus(&nominal)?.times(&over, order)?;
    let mut power = Poly::nominal(radius);
    let mut sum = Poly::ZERO;
    let mut binomial = integer(1);
    for n in 1..=order.get() as i128 {
        // (½ − (n − 1)) / n
        binomial = &binomial * &Rational::new(3 - 2 * n, 2 * n);
        power = power.times(&u, order)?;
        sum = sum.plus(&power.scaled(&binomial)?)?;
    }
    Ok(sum.normal(alphabet)?)
}
