//! Powers of a sweep's sine and cosine as sines and cosines of its multiples.
//!
//! Polynomials are kept in powers, where elimination is short. In numbers high powers cancel: sin 40t in powers of sin t has
//! coefficients of 10¹⁵, and one digit is left. In multiples no coefficient is greater than the function itself.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::{Alphabet, Monomial, NominalId, Poly, Rational, SweepId, Term};

/// Powers of a higher degree are rewritten: up to it their coefficients add up to less than 10³ times the function,
/// (1 + √2)ⁿ/2, which costs three digits of sixteen.
const HIGHEST_POWER: i32 = 8;

/// A multiple of a sweep whose sine or cosine it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Harmonic {
    /// cos kt; 1 for k = 0.
    Cosine(u8),
    /// sin kt.
    Sine(u8),
}

impl Harmonic {
    /// Its value at an angle in rad.
    pub fn value(self, angle: f64) -> f64 {
        match self {
            Self::Cosine(k) => (f64::from(k) * angle).cos(),
            Self::Sine(k) => (f64::from(k) * angle).sin(),
        }
    }
}

/// A polynomial as `Σ harmonic · polynomial`, the polynomials free of the sweep's sine and cosine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Harmonics {
    /// Whose multiples they are.
    pub sweep: SweepId,
    /// Ascending.
    pub terms: Vec<(Harmonic, Poly)>,
}

impl Harmonics {
    /// The harmonics of the first sweep in which `p` has powers too high to be multiplied out in numbers; `None` if it has none.
    pub fn of(p: &Poly, alphabet: &Alphabet) -> Option<Self> {
        let too_high = |sin: NominalId, cos: NominalId| {
            let degree = |(m, _): &Term| i32::from(m.exponent(sin)) + i32::from(m.exponent(cos));
            p.terms().iter().any(|term| degree(term) > HIGHEST_POWER)
        };
        alphabet.sweeps().find_map(|sweep| {
            let [_, sin, cos] = alphabet.sweep_symbols(sweep);
            let terms = too_high(sin, cos).then(|| rewritten(p, sin, cos)).flatten()?;
            Some(Self { sweep, terms })
        })
    }
}

/// `p` in harmonics, exactly; `None` where it divides by the sine or cosine.
fn rewritten(p: &Poly, sin: NominalId, cos: NominalId) -> Option<Vec<(Harmonic, Poly)>> {
    let mut sums: BTreeMap<(Harmonic, Monomial), BigRational> = BTreeMap::new();
    for (m, c) in p.terms() {
        let powers = [m.exponent(sin), m.exponent(cos)].map(u8::try_from);
        let [Ok(i), Ok(j)] = powers else { return None };
        let rest = m.with_exponent(sin, 0).with_exponent(cos, 0);
        let c = c.to_big();
        for (harmonic, share) in of_powers(i, j) {
            *sums.entry((harmonic, rest)).or_insert_with(BigRational::zero) += share * &c;
        }
    }
    let mut harmonics: Vec<(Harmonic, Vec<Term>)> = Vec::new();
    for ((harmonic, rest), c) in sums {
        let term = (rest, Rational::from_big(c));
        match harmonics.last_mut() {
            Some((last, terms)) if *last == harmonic => terms.push(term),
            _ => harmonics.push((harmonic, vec![term])),
        }
    }
    let summed = harmonics.into_iter().map(|(harmonic, terms)| Some((harmonic, Poly::from_terms(terms).ok()?)));
    let mut summed = summed.collect::<Option<Vec<_>>>()?;
    summed.retain(|(_, poly)| !poly.is_zero());
    Some(summed)
}

/// sinⁱ t · cosʲ t in harmonics.
///
/// With z = exp(it) it is (z − 1/z)ⁱ (z + 1/z)ʲ / ((2i)ⁱ 2ʲ) = Σ wₘ zⁿ⁻²ᵐ / (iⁱ 2ⁿ), n = i + j. The w are alike from both
/// ends up to the sign (−1)ⁱ, so they go with cosines for an even i and with i times sines for an odd one.
fn of_powers(i: u8, j: u8) -> Vec<(Harmonic, BigRational)> {
    let n = usize::from(i) + usize::from(j);
    let mut w = vec![BigInt::one()];
    for factor in 0..n {
        w.push(BigInt::zero());
        for m in (1..w.len()).rev() {
            let before = w[m - 1].clone();
            if factor < usize::from(i) { w[m] -= before } else { w[m] += before }
        }
    }
    let denominator = BigInt::from(if i & 2 == 0 { 1 } else { -1 }) << n;
    // Terms of k and −k are equal: twice the first half, and what stands in the middle once.
    let half = w.into_iter().take(n / 2 + 1).enumerate();
    let harmonic = |(m, w): (usize, BigInt)| {
        let k = u8::try_from(n - 2 * m).ok()?;
        let harmonic = if i & 1 == 0 { Harmonic::Cosine(k) } else { Harmonic::Sine(k) };
        let times = if k == 0 { 1 } else { 2 };
        (harmonic != Harmonic::Sine(0)).then(|| (harmonic, BigRational::new(w * times, denominator.clone())))
    };
    half.filter_map(harmonic).collect()
}
