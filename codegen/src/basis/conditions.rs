//! All polynomials up to a degree that satisfy linear conditions, exactly: T(10) from its conditions.

use super::Univariate;
use crate::algebra::{AlgebraError, Alphabet, Fraction, Order, Poly, Row, reduce};

/// A homogeneous linear condition `Σ factor · f⁽ⁿ⁾(point) = 0`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinearCondition {
    /// Order of the derivative, the point, the factor.
    pub terms: Vec<(u32, Poly, Poly)>,
}

/// Why there is no basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoBasis {
    /// Only f = 0 satisfies the conditions at this degree.
    OnlyZero,
    /// A coefficient would be a quotient that is no polynomial in the constants.
    NotPolynomial,
    /// An exact computation failed.
    Algebra(AlgebraError),
}

impl From<AlgebraError> for NoBasis {
    fn from(e: AlgebraError) -> Self {
        Self::Algebra(e)
    }
}

impl core::fmt::Display for NoBasis {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::OnlyZero => f.write_str("no function of this degree but zero satisfies the conditions"),
            Self::NotPolynomial => f.write_str("the conditions divide by a sum of constants"),
            Self::Algebra(e) => core::fmt::Display::fmt(e, f),
        }
    }
}

impl core::error::Error for NoBasis {}

/// A basis of the polynomials of degree ≤ `degree` that satisfy `conditions`, highest degree first.
///
/// Zeros that the conditions imply are divided out, `f = Π(x − zᵢ) · g`, and the rest is solved for g with its highest
/// coefficients free: so each basis function is monic, shows its zeros, and the choice does not depend on how the
/// conditions were written. For f(0) = 0, f(2π) = f(0), f′(2π) = f′(0) and degree 4 this gives
/// `x(x − 2π)(x² − 2π²)` and `x(x − 2π)(x − π)`, which is T(10).
pub fn satisfying(degree: u8, conditions: &[LinearCondition], alphabet: &Alphabet) -> Result<Vec<Univariate>, NoBasis> {
    let (zeros, rest) = split_zeros(conditions, alphabet)?;
    let mut factor = Univariate(vec![Poly::one()]);
    for zero in &zeros {
        factor = factor.times(&Univariate(vec![zero.negated(), Poly::one()]))?;
    }
    let unknowns = (usize::from(degree) + 1).checked_sub(zeros.len()).ok_or(NoBasis::OnlyZero)?;
    let candidates = (0..unknowns).map(|n| factor.times(&Univariate::power(n))).collect::<Result<Vec<_>, _>>()?;
    let mut rows = Vec::new();
    for condition in &rest {
        let apply = |f: &Univariate| Ok(Fraction::whole(value(condition, f)?.normal(alphabet)?));
        rows.push(candidates.iter().map(apply).collect::<Result<Row<usize>, AlgebraError>>()?);
    }
    let kernel = reduce(rows, 0..unknowns, alphabet)?.kernel(unknowns);
    let mut basis = Vec::new();
    for g in kernel.iter().rev() {
        let mut f = Univariate(Vec::new());
        for (coefficient, candidate) in g.iter().zip(&candidates) {
            let coefficient = coefficient.as_poly().ok_or(NoBasis::NotPolynomial)?;
            f = f.plus(&Univariate(vec![coefficient.clone()]).times(candidate)?)?;
        }
        let mut coefficients = f.0.iter().map(|c| c.normal(alphabet)).collect::<Result<Vec<_>, _>>()?;
        let length = coefficients.iter().rposition(|c| !c.is_zero()).map_or(0, |n| n + 1);
        coefficients.truncate(length);
        basis.push(Univariate(coefficients));
    }
    if basis.is_empty() { Err(NoBasis::OnlyZero) } else { Ok(basis) }
}

/// The points where the conditions make f vanish, and conditions equivalent to the others.
fn split_zeros(
    conditions: &[LinearCondition],
    alphabet: &Alphabet,
) -> Result<(Vec<Poly>, Vec<LinearCondition>), NoBasis> {
    let mut functionals: Vec<(u32, Poly)> = Vec::new();
    for (n, point, _) in conditions.iter().flat_map(|c| &c.terms) {
        let functional = (*n, point.normal(alphabet)?);
        if !functionals.contains(&functional) {
            functionals.push(functional);
        }
    }
    let mut rows = Vec::new();
    for condition in conditions {
        let mut row = vec![Poly::ZERO; functionals.len()];
        for (n, point, factor) in &condition.terms {
            let functional = (*n, point.normal(alphabet)?);
            for (entry, _) in row.iter_mut().zip(&functionals).filter(|(_, f)| **f == functional) {
                *entry = entry.plus(factor)?;
            }
        }
        rows.push(row.iter().map(|p| p.normal(alphabet).map(Fraction::whole)).collect::<Result<Row<usize>, _>>()?);
    }
    let (mut zeros, mut rest) = (Vec::new(), Vec::new());
    for (pivot, row) in reduce(rows, 0..functionals.len(), alphabet)?.rows {
        let single = row.iter().filter(|f| !f.is_zero()).count() == 1;
        if single && functionals[pivot].0 == 0 {
            zeros.push(functionals[pivot].1.clone());
        } else {
            let present = row.iter().zip(&functionals).filter(|(f, _)| !f.is_zero());
            let term = |(factor, (n, point)): (&Fraction, &(u32, Poly))| {
                Ok((*n, point.clone(), factor.as_poly().ok_or(NoBasis::NotPolynomial)?.clone()))
            };
            rest.push(LinearCondition { terms: present.map(term).collect::<Result<_, NoBasis>>()? });
        }
    }
    Ok((zeros, rest))
}

fn value(condition: &LinearCondition, f: &Univariate) -> Result<Poly, AlgebraError> {
    let mut sum = Poly::ZERO;
    for (n, point, factor) in &condition.terms {
        sum = sum.plus(&f.derivative(*n)?.at(point)?.times(factor, Order::NOMINAL)?)?;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rational;

    fn at(n: u32, turns: i128, factor: i128) -> (u32, Poly, Poly) {
        (n, Poly::nominal(Alphabet::PI).scaled(&Rational::from(2 * turns)).unwrap(), Poly::integer(factor))
    }

    fn periodic() -> Vec<LinearCondition> {
        [vec![at(0, 0, 1)], vec![at(0, 1, 1), at(0, 0, -1)], vec![at(1, 1, 1), at(1, 0, -1)]]
            .map(|terms| LinearCondition { terms })
            .into()
    }

    fn pi(power: u32, factor: i128) -> Poly {
        Poly::nominal(Alphabet::PI).power(power, Order::NOMINAL).unwrap().scaled(&Rational::from(factor)).unwrap()
    }

    #[test]
    fn equation_10_comes_out_of_its_conditions() {
        let basis = satisfying(4, &periodic(), &Alphabet::default()).unwrap();
        let f1 = Univariate(vec![Poly::ZERO, pi(3, 4), pi(2, -2), pi(1, -2), Poly::one()]);
        let f2 = Univariate(vec![Poly::ZERO, pi(2, 2), pi(1, -3), Poly::one()]);
        assert_eq!(basis, [f1, f2]);
    }

    #[test]
    fn the_way_conditions_are_written_does_not_matter() {
        let mut written = periodic();
        written[1] = LinearCondition { terms: vec![at(0, 1, 3)] };
        written.reverse();
        let alphabet = Alphabet::default();
        assert_eq!(satisfying(5, &written, &alphabet), satisfying(5, &periodic(), &alphabet));
    }

    #[test]
    fn too_many_conditions_leave_only_zero() {
        assert_eq!(satisfying(2, &periodic(), &Alphabet::default()), Err(NoBasis::OnlyZero));
        assert_eq!(satisfying(0, &periodic(), &Alphabet::default()), Err(NoBasis::OnlyZero));
    }
}
