//! One product of powers: nominal symbols with signed exponents, times a few errors.

use super::{AlgebraError, ErrorId, NominalId};

/// Nominal symbols a monomial has room for.
pub const MAX_NOMINALS: usize = 24;
/// Errors a monomial has room for, so the highest order of truncation.
pub const MAX_ERROR_ORDER: usize = 8;

/// Exponents of the nominal symbols; negative ones are quotients (order 2 divides by R).
pub type Powers = [i8; MAX_NOMINALS];

/// A product of nominal powers and errors.
///
/// Fixed arrays, so that a product is two short loops without a heap allocation; the derivation multiplies
/// thousands of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Monomial {
    /// Identifiers in descending order, 0 where there is none; compared first, so terms group by their errors.
    errors: [u16; MAX_ERROR_ORDER],
    powers: Powers,
}

impl Monomial {
    /// The empty product.
    pub const ONE: Self = Self { errors: [0; MAX_ERROR_ORDER], powers: [0; MAX_NOMINALS] };

    /// A nominal symbol to a power.
    pub fn nominal(id: NominalId, exponent: i8) -> Self {
        let mut m = Self::ONE;
        m.powers[usize::from(id.0)] = exponent;
        m
    }

    /// A single error.
    pub fn error(id: ErrorId) -> Self {
        let mut m = Self::ONE;
        m.errors[0] = id.0;
        m
    }

    /// A product of nominal powers.
    pub fn of_powers(powers: Powers) -> Self {
        Self { powers, ..Self::ONE }
    }

    /// Exponent of a nominal symbol.
    pub fn exponent(&self, id: NominalId) -> i8 {
        self.powers[usize::from(id.0)]
    }

    /// All exponents.
    pub fn powers(&self) -> &Powers {
        &self.powers
    }

    /// The same monomial with one exponent replaced.
    pub fn with_exponent(mut self, id: NominalId, exponent: i8) -> Self {
        self.powers[usize::from(id.0)] = exponent;
        self
    }

    /// Number of errors, each counted as often as it occurs.
    pub fn order(&self) -> usize {
        self.errors.iter().take_while(|&&e| e != 0).count()
    }

    /// The errors, each as often as it occurs.
    pub fn errors(&self) -> impl Iterator<Item = ErrorId> {
        self.errors.iter().take_while(|&&e| e != 0).map(|&e| ErrorId(e))
    }

    /// The nominal part alone.
    pub fn without_errors(&self) -> Self {
        Self::of_powers(self.powers)
    }

    /// The errors alone.
    pub fn only_errors(&self) -> Self {
        Self { errors: self.errors, ..Self::ONE }
    }

    /// Product; `None` when it has more than `order` errors and so is dropped.
    pub fn times(&self, other: &Self, order: usize) -> Result<Option<Self>, AlgebraError> {
        let mut errors = self.errors;
        if other.errors[0] != 0 {
            if self.errors[0] == 0 {
                errors = other.errors;
            } else {
                if self.order() + other.order() > order {
                    return Ok(None);
                }
                errors = merge(&self.errors, &other.errors);
            }
        }
        let mut powers = [0; MAX_NOMINALS];
        let mut overflow = 0i8;
        for ((sum, &a), &b) in powers.iter_mut().zip(&self.powers).zip(&other.powers) {
            *sum = a.wrapping_add(b);
            overflow |= (a ^ *sum) & (b ^ *sum);
        }
        if overflow < 0 { Err(AlgebraError::ExponentOverflow) } else { Ok(Some(Self { errors, powers })) }
    }

    /// Value of the nominal part.
    pub fn evaluate(&self, nominal: impl Fn(NominalId) -> f64) -> f64 {
        let powers = self.powers.iter().enumerate().filter(|(_, p)| **p != 0);
        powers.map(|(i, &p)| nominal(NominalId(i as u8)).powi(i32::from(p))).product()
    }

    /// The greatest product of nominal powers that divides both.
    pub(super) fn lower(&self, other: &Self) -> Self {
        Self::of_powers(core::array::from_fn(|i| self.powers[i].min(other.powers[i])))
    }

    /// The inverse of the nominal part; only for a monomial without errors.
    pub fn recip(&self) -> Result<Self, AlgebraError> {
        let mut powers = self.powers;
        for p in &mut powers {
            *p = p.checked_neg().ok_or(AlgebraError::ExponentOverflow)?;
        }
        Ok(Self::of_powers(powers))
    }
}

/// Merges two descending lists; the caller has checked that they fit.
fn merge(a: &[u16; MAX_ERROR_ORDER], b: &[u16; MAX_ERROR_ORDER]) -> [u16; MAX_ERROR_ORDER] {
    let mut out = [0; MAX_ERROR_ORDER];
    let (mut i, mut j) = (0, 0);
    for slot in &mut out {
        let (x, y) = (a.get(i).copied().unwrap_or(0), b.get(j).copied().unwrap_or(0));
        if x >= y {
            *slot = x;
            i += 1;
        } else {
            *slot = y;
            j += 1;
        }
    }
    out
}
