//! What an expression is made of.

use super::Rational;
use crate::algebra::NominalId;

/// A handle to an expression of one [`Graph`](super::Graph); equal handles are equal expressions.
///
/// Handles are numbered as expressions are made, so a part always precedes the whole: passes over a graph are loops.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Id(pub(super) u32);

impl Id {
    /// 0
    pub const ZERO: Id = Id(0);
    /// 1
    pub const ONE: Id = Id(1);
    /// π
    pub const PI: Id = Id(2);
    /// √2
    pub const SQRT_2: Id = Id(3);

    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A variable, by what it stands for: whoever prints an expression names it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Symbol {
    /// A length of the set-up or a sweep.
    Nominal(NominalId),
    /// The coordinate that a function of the machine depends on, mm or rad.
    Coordinate,
    /// The input at this place of a function that comes from no model.
    Input(u32),
}

/// What a sum adds: `coefficient · node`.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Addend {
    /// Never zero.
    pub coefficient: Rational,
    /// [`Id::ONE`] for the sum's constant.
    pub node: Id,
}

/// `base ^ exponent` in a product.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Power {
    /// What is raised.
    pub base: Id,
    /// Never zero; negative divides.
    pub exponent: i32,
}

/// One operation over earlier expressions, in normal form.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Node {
    /// A variable.
    Symbol(Symbol),
    /// An exact constant in lowest terms.
    Rational(Rational),
    /// π
    Pi,
    /// √2
    Sqrt2,
    /// At least two terms, ordered by node; like terms are one.
    Sum(Box<[Addend]>),
    /// A constant other than zero times factors, ordered by base; like factors are one. A power is a product of one factor.
    Product(Rational, Box<[Power]>),
    /// Square root.
    Sqrt(Id),
    /// Sine of an angle in rad.
    Sin(Id),
    /// Cosine of an angle in rad.
    Cos(Id),
    /// The largest whole number that is not above a number of turns; not a number where too few digits are left of them.
    WholeTurns(Id),
}

impl Node {
    /// The expressions this one is made of, with repetition; the unit of a sum's constant is not one of them.
    pub fn children(&self) -> impl Iterator<Item = Id> + '_ {
        let (terms, factors, argument): (&[Addend], &[Power], Option<Id>) = match self {
            Node::Symbol(_) | Node::Rational(_) | Node::Pi | Node::Sqrt2 => (&[], &[], None),
            Node::Sum(terms) => (terms, &[], None),
            Node::Product(_, factors) => (&[], factors, None),
            Node::Sqrt(u) | Node::Sin(u) | Node::Cos(u) | Node::WholeTurns(u) => (&[], &[], Some(*u)),
        };
        let terms = terms.iter().map(|term| term.node).filter(|&node| node != Id::ONE);
        let factors = factors.iter().map(|factor| factor.base);
        terms.chain(factors).chain(argument)
    }
}
