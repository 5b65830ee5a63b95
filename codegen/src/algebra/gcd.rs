//! Exact division and greatest common divisors of polynomials in constants, over the rationals.
//!
//! Inputs have no errors, no √2 and no negative exponents. Euclid's algorithm on them would make numbers of thousands of
//! digits of dozens of terms; modulo primes none grows.

use super::modular::{Field, Image, primes};
use super::{AlgebraError, Alphabet, MAX_NOMINALS, Monomial, NominalId, Order, Poly, Powers, Rational, Term};
use core::cmp::Ordering;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive};
use std::collections::BTreeMap;

/// `a / b` if it leaves no remainder.
pub(super) fn divide(a: &Poly, b: &Poly) -> Result<Option<Poly>, AlgebraError> {
    let Some((lead, coefficient)) = b.terms().last() else { return Err(AlgebraError::DivisionByZero) };
    let inverse = lead.recip()?;
    let (mut rest, mut quotient) = (a.clone(), Vec::new());
    while let Some((m, c)) = rest.terms().last() {
        let Some(monomial) = m.times(&inverse, 0)?.filter(|m| m.powers().iter().all(|p| *p >= 0)) else {
            return Ok(None);
        };
        let step = Poly::term(monomial, c.over(coefficient)?);
        rest = rest.minus(&step.times(b, Order::NOMINAL)?)?;
        quotient.extend_from_slice(step.terms());
    }
    Poly::from_terms(quotient).map(Some)
}

/// `a / b`, which leaves no remainder.
pub(super) fn exact(a: &Poly, b: &Poly) -> Result<Poly, AlgebraError> {
    Ok(divide(a, b)?.unwrap_or_else(|| a.clone()))
}

/// The greatest common divisor with coprime whole coefficients, so that what is divided by it stays whole.
///
/// Its images modulo primes are put together until they no longer change; what then divides both polynomials is it, since no
/// image is of lower degree.
pub(super) fn gcd(a: &Poly, b: &Poly) -> Result<Poly, AlgebraError> {
    if a.is_zero() || b.is_zero() || a == b {
        return Ok(if a.is_zero() { b } else { a }.primitive()?.1);
    }
    let scale = Scale::of(a, b);
    let mut lifted: Option<(Lifted, [Poly; 2])> = None;
    for field in primes() {
        let (whole_a, whole_b) = lifted.as_ref().map_or((a, b), |(_, [a, b])| (a, b));
        let (Some(x), Some(y)) = (image(whole_a, scale.unit, field), image(whole_b, scale.unit, field)) else {
            continue;
        };
        let common = field.gcd(&x, &y);
        let lead = common.keys().next_back();
        match &mut lifted {
            _ if lead == Some(Monomial::ONE.powers()) => return scale.restored(Poly::one()),
            Some((lifted, whole)) => {
                if lifted.add(&common, field) {
                    let candidate = scale.restored(lifted.poly()?)?;
                    if divide(&whole[0], &candidate)?.is_some() && divide(&whole[1], &candidate)?.is_some() {
                        return Ok(candidate);
                    }
                }
            }
            None if lead == y.keys().next_back() && divide(a, b)?.is_some() => return Ok(b.primitive()?.1),
            None if lead == x.keys().next_back() && divide(b, a)?.is_some() => return Ok(a.primitive()?.1),
            None => {
                let whole = [a.primitive()?.1, b.primitive()?.1];
                let mut first = Lifted::new(&whole);
                first.add(&common, field);
                lifted = Some((first, whole));
            }
        }
    }
    Ok(Poly::one())
}

/// Lengths may be counted in one of them where all terms have the same power of lengths, as by their units they do: a symbol less.
struct Scale {
    unit: Option<NominalId>,
    /// The power of that length in the common divisor of all terms.
    power: i8,
}

impl Scale {
    fn of(a: &Poly, b: &Poly) -> Self {
        let powers = |p: &Poly, id: NominalId| p.terms().iter().map(|(m, _)| m.exponent(id)).min().unwrap_or(0);
        let homogeneous = |p: &Poly| {
            let mut degrees = p.terms().iter().map(|(m, _)| degree(m));
            let first = degrees.next();
            degrees.all(|d| Some(d) == first)
        };
        let present = |id: &NominalId| [a, b].iter().any(|p| p.terms().iter().any(|(m, _)| m.exponent(*id) != 0));
        // Without the last the terms keep their order.
        let unit = lengths().filter(present).last().filter(|_| homogeneous(a) && homogeneous(b));
        Self { unit, power: unit.map_or(0, |id| powers(a, id).min(powers(b, id))) }
    }

    /// A divisor with the length put in again.
    fn restored(&self, p: Poly) -> Result<Poly, AlgebraError> {
        let Some(id) = self.unit else { return Ok(p) };
        let highest = p.terms().iter().map(|(m, _)| degree(m)).max().unwrap_or(0);
        let term = |(m, c): &Term| {
            let power = i8::try_from(highest - degree(m)).ok().and_then(|missing| missing.checked_add(self.power));
            Ok((m.with_exponent(id, power.ok_or(AlgebraError::ExponentOverflow)?), c.clone()))
        };
        Poly::from_terms(p.terms().iter().map(term).collect::<Result<_, AlgebraError>>()?)
    }
}

/// All that is neither π nor √2: in a divisor these are lengths.
fn lengths() -> impl Iterator<Item = NominalId> {
    let ids = (0..MAX_NOMINALS).map(|i| NominalId(i as u8));
    ids.filter(|id| ![Alphabet::PI, Alphabet::ROOT2].contains(id))
}

/// The power of lengths.
fn degree(m: &Monomial) -> i32 {
    lengths().map(|id| i32::from(m.exponent(id))).sum()
}

/// Modulo a prime, a symbol taken as 1; `None` where its leading term vanishes or the prime stands below a line.
fn image(p: &Poly, one: Option<NominalId>, field: Field) -> Option<Image> {
    let mut image = Image::new();
    for (m, c) in p.terms() {
        let m = one.map_or(*m, |id| m.with_exponent(id, 0));
        image.insert(*m.powers(), c.residue(field)?);
    }
    (image.values().next_back() != Some(&0)).then(|| {
        image.retain(|_, c| *c != 0);
        image
    })
}

/// A polynomial with whole coefficients by its residues modulo a growing product of primes, each of the least size.
struct Lifted {
    /// What its leading coefficient is a divisor of, and is made to be.
    lead: BigInt,
    modulus: BigInt,
    terms: BTreeMap<Powers, BigInt>,
}

impl Lifted {
    /// Of a divisor of both.
    fn new(whole: &[Poly; 2]) -> Self {
        let lead = |p: &Poly| p.terms().last().map_or_else(BigInt::one, |(_, c)| c.numer());
        Self { lead: lead(&whole[0]).gcd(&lead(&whole[1])), modulus: BigInt::one(), terms: BTreeMap::new() }
    }

    /// Takes an image whose leading coefficient is 1; true where it changes nothing. One of lower degree shows that those
    /// before were too high.
    fn add(&mut self, image: &Image, field: Field) -> bool {
        match image.keys().next_back().cmp(&self.terms.keys().next_back()) {
            Ordering::Greater if !self.terms.is_empty() => return false,
            Ordering::Less => (self.modulus, self.terms) = (BigInt::one(), BTreeMap::new()),
            _ => {}
        }
        let (lead, inverse) = (residue(&self.lead, field), field.inverse(residue(&self.modulus, field)));
        let mut same = true;
        for powers in image.keys() {
            self.terms.entry(*powers).or_default();
        }
        for (powers, c) in &mut self.terms {
            let own = image.get(powers).map_or(0, |i| i * lead % field.0);
            let step = (own + field.0 - residue(c, field)) % field.0 * inverse % field.0;
            if step != 0 {
                same = false;
                let least = if 2 * step > field.0 { i128::from(step) - i128::from(field.0) } else { step.into() };
                *c += &self.modulus * least;
            }
        }
        self.modulus *= field.0;
        same
    }

    fn poly(&self) -> Result<Poly, AlgebraError> {
        let term =
            |(powers, c): (&Powers, &BigInt)| (Monomial::of_powers(*powers), Rational::from_big(c.clone().into()));
        Ok(Poly::from_terms(self.terms.iter().map(term).collect())?.primitive()?.1)
    }
}

fn residue(n: &BigInt, field: Field) -> u64 {
    n.mod_floor(&field.0.into()).to_u64().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::Alphabet;
    use super::*;

    #[test]
    fn common_factors_of_several_symbols_are_found() {
        let mut alphabet = Alphabet::default();
        let [r, h, l] = ["R", "H", "L"].map(|n| Poly::nominal(alphabet.constant(n).unwrap()));
        let times = |a: &Poly, b: &Poly| a.times(b, Order::NOMINAL).unwrap();
        let (u, v, w) = (r.plus(&h).unwrap(), r.minus(&l).unwrap(), times(&h, &l).plus(&Poly::integer(3)).unwrap());
        let (a, b) = (times(&times(&u, &v), &u), times(&times(&u, &w), &u));
        let g = gcd(&a, &b).unwrap();
        assert!(divide(&g, &times(&u, &u)).unwrap().unwrap().as_number().is_some());
        assert!(gcd(&v, &w).unwrap().as_number().is_some());
        assert_eq!(divide(&a, &u).unwrap(), Some(times(&u, &v)));
        assert_eq!(divide(&v, &u).unwrap(), None);
    }
}
