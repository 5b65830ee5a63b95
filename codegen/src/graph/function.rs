//! Square roots, sines and cosines, with the exact values that fixed axes need (multiples of 45°).

use super::Rational;
use super::build::Graph;
use super::node::{Id, Node, Power};

impl Graph {
    /// √a; exact for rational squares and twice rational squares.
    pub fn sqrt(&mut self, a: Id) -> Id {
        if let Node::Rational(r) = self.node(a) {
            let half = r * &Rational::new(1, 2);
            if let Some(root) = r.sqrt() {
                return self.rational(root);
            }
            if let Some(root) = half.sqrt() {
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

    /// ⌊a⌋ of `a` turns; not a number where they are so many that half the digits of what is left over are lost.
    pub fn whole_turns(&mut self, a: Id) -> Id {
        match self.node(a) {
            Node::Rational(r) if r.to_integer().is_some() => a,
            _ => self.intern(Node::WholeTurns(a)),
        }
    }

    /// An angle less whole turns, in `start · π/12` and a turn from there.
    pub fn wrapped(&mut self, angle: Id, start: i32) -> Id {
        let turns = Rational::new(start.into(), 24);
        let of_turn = self.monomial(Rational::new(1, 2), &[(angle, 1), (Id::PI, -1)]);
        let from = self.rational(-turns);
        let past = self.sum(&[of_turn, from]);
        let whole = self.whole_turns(past);
        let back = self.monomial(Rational::from(-2), &[(Id::PI, 1), (whole, 1)]);
        self.sum(&[angle, back])
    }

    /// How many eighths of a turn `a` is, modulo 8, if it is a whole number of them.
    fn eighths(&self, a: Id) -> Option<u8> {
        let multiple = match self.node(a) {
            Node::Rational(r) if r.is_zero() => r,
            Node::Pi => &Rational::ONE,
            Node::Product(multiple, factors) if **factors == [Power { base: Id::PI, exponent: 1 }] => multiple,
            _ => return None,
        };
        let eighths = (multiple * &Rational::from(4)).to_integer()?;
        Some(eighths.rem_euclid(8) as u8)
    }

    fn sine_of_eighth(&mut self, eighth: u8) -> Id {
        let size = match eighth % 4 {
            0 => Id::ZERO,
            2 => Id::ONE,
            _ => self.monomial(Rational::new(1, 2), &[(Id::SQRT_2, 1)]),
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
