//! Square roots, sines and cosines, with the exact values that fixed axes need (multiples of 45°).

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::build::Graph;
use super::node::{Id, Node, Power};
use super::rational::{self, Rational};

impl Graph {
    /// √a; exact for rational squares and twice rational squares.
    pub fn sqrt(&mut self, a: Id) -> Id {
        if let Node::Rational(r) = self.node(a) {
            let r = *r;
            if let Some(root) = rational::exact_root(&r) {
                return self.rational(root);
            }
            let half = rational::times(&r, &Rational::new_raw(1, 2));
            if let Some(root) = half.and_then(|half| rational::exact_root(&half)) {
                return self.monomial(root, &[(Id::SQRT_2, 1)]);
            }
        }
        self.intern(Node::Sqrt(a))
    }

    /// sin a, a in rad; exact at multiples of π/4, and odd.
    pub fn sin(&mut self, a: Id) -> Id {
        if let Some(eighth) = self.eighths(a) {
            return self.sine_of_eighth(eighth);
        }
        if self.leads_negative(a) {
            let positive = self.negate(a);
            let sine = self.intern(Node::Sin(positive));
            return self.negate(sine);
        }
        self.intern(Node::Sin(a))
    }

    /// cos a, a in rad; exact at multiples of π/4, and even.
    pub fn cos(&mut self, a: Id) -> Id {
        if let Some(eighth) = self.eighths(a) {
            return self.sine_of_eighth((eighth + 2) % 8);
        }
        let a = if self.leads_negative(a) { self.negate(a) } else { a };
        self.intern(Node::Cos(a))
    }

    /// How many eighths of a turn `a` is, modulo 8, if it is a whole number of them.
    fn eighths(&self, a: Id) -> Option<u8> {
        let multiple = match self.node(a) {
            Node::Rational(r) if r.is_zero() => *r,
            Node::Pi => Rational::one(),
            Node::Product(multiple, factors) if **factors == [Power { base: Id::PI, exponent: 1 }] => *multiple,
            _ => return None,
        };
        let eighths = rational::times(&multiple, &Rational::from_integer(4))?;
        eighths.is_integer().then(|| eighths.numer().mod_floor(&8) as u8)
    }

    fn sine_of_eighth(&mut self, eighth: u8) -> Id {
        let size = match eighth % 4 {
            0 => Id::ZERO,
            2 => Id::ONE,
            _ => self.monomial(Rational::new_raw(1, 2), &[(Id::SQRT_2, 1)]),
        };
        if eighth > 4 { self.negate(size) } else { size }
    }

    /// Exactly one of a and −a does, unless a is zero.
    fn leads_negative(&self, a: Id) -> bool {
        match self.node(a) {
            Node::Rational(r) | Node::Product(r, _) => r.is_negative(),
            Node::Sum(terms) => terms.first().is_some_and(|term| term.coefficient.is_negative()),
            _ => false,
        }
    }

    /// Applies (√u)² = u in a product, so that at most one of √u and 1/√u is left, and never beside a power of u of
    /// the other sign. Says whether the factors must be collected again.
    pub(super) fn reduce_roots(&mut self, constant: &mut Rational, flat: &mut Vec<Power>) -> bool {
        for at in 0..flat.len() {
            let Power { base, exponent } = flat[at];
            let (radicand, left) = match *self.node(base) {
                Node::Sqrt2 => (None, exponent.rem_euclid(2)),
                Node::Sqrt(u) => {
                    let beside = flat.iter().find(|factor| factor.base == u).map_or(0, |factor| factor.exponent);
                    let opposite = matches!(exponent, -1 | 1) && beside.signum() == -exponent.signum();
                    (Some(u), if opposite { -exponent } else { exponent % 2 })
                }
                _ => continue,
            };
            if left == exponent {
                continue;
            }
            flat[at].exponent = left;
            let whole = (exponent - left) / 2;
            match radicand {
                Some(u) => self.flatten_factor(u, whole, constant, flat),
                None => {
                    let two = self.integer(2);
                    self.flatten_factor(two, whole, constant, flat);
                }
            }
            return true;
        }
        false
    }
}
