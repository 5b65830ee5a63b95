//! Homogeneous 4×4 transforms and points with polynomial entries.

use super::{AlgebraError, Order, Poly};
use core::array;

/// A point or displacement in space, mm.
pub type PolyVector = [Poly; 3];

/// A 4×4 homogeneous transform; its last row is always (0, 0, 0, 1) and so is not stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transform {
    rows: [[Poly; 4]; 3],
}

impl Transform {
    /// The transform that changes nothing.
    pub fn identity() -> Self {
        Self::new(
            array::from_fn(|i| array::from_fn(|j| if i == j { Poly::one() } else { Poly::ZERO })),
            Default::default(),
        )
    }

    /// From the 3×3 part and the translation.
    pub fn new(linear: [[Poly; 3]; 3], translation: PolyVector) -> Self {
        let mut translation = translation.into_iter();
        let rows = linear.map(|[x, y, z]| [x, y, z, translation.next().unwrap_or_default()]);
        Self { rows }
    }

    /// A pure translation.
    pub fn translation(by: PolyVector) -> Self {
        Self::new(Self::identity().linear(), by)
    }

    /// The small rotation [1 −c b; c 1 −a; −b a 1] by the angles (a, b, c) about x, y, z, with a translation:
    /// the matrix SM (location errors) or EM (motion errors) of T(1) and T(2).
    pub fn small([a, b, c]: PolyVector, translation: PolyVector) -> Self {
        let one = Poly::one;
        let linear = [[one(), c.negated(), b.clone()], [c, one(), a.negated()], [b.negated(), a, one()]];
        Self::new(linear, translation)
    }

    /// The 3×3 part.
    pub fn linear(&self) -> [[Poly; 3]; 3] {
        array::from_fn(|i| array::from_fn(|j| self.rows[i][j].clone()))
    }

    /// Image of a point, truncated at `order` errors.
    pub fn apply(&self, point: &PolyVector, order: Order) -> Result<PolyVector, AlgebraError> {
        let mut image = PolyVector::default();
        for (out, row) in image.iter_mut().zip(&self.rows) {
            let mut terms = row[3].terms().to_vec();
            for (entry, coordinate) in row.iter().zip(point) {
                entry.product_into(coordinate, order, &mut terms)?;
            }
            *out = Poly::from_terms(terms)?;
        }
        Ok(image)
    }
}

/// `p · q`, truncated at `order` errors.
pub(crate) fn dot(p: &PolyVector, q: &PolyVector, order: Order) -> Result<Poly, AlgebraError> {
    let mut terms = Vec::new();
    for (a, b) in p.iter().zip(q) {
        a.product_into(b, order, &mut terms)?;
    }
    Poly::from_terms(terms)
}

/// `p − q`.
pub(crate) fn difference(p: &PolyVector, q: &PolyVector) -> Result<PolyVector, AlgebraError> {
    let mut out = PolyVector::default();
    for (o, (a, b)) in out.iter_mut().zip(p.iter().zip(q)) {
        *o = a.minus(b)?;
    }
    Ok(out)
}
