//! Sharing of factors between products, greedily: the pair of factors that occurs most often becomes a factor of its
//! own, until no pair occurs twice. A square is a pair like any other, so powers come out by repeated squaring.

use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::node::{Id, Power};

/// What a product is multiplied out of.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Literal {
    Base(Id),
    Inverse(Id),
    Pair(u32, u32),
}

/// A literal's index and how often it is multiplied in.
type Multiplicity = (u32, u64);

/// Products as powers of literals.
#[derive(Default)]
pub(super) struct Products {
    pub(super) literals: Vec<Literal>,
    pub(super) products: Vec<Vec<Multiplicity>>,
    known: FxHashMap<Literal, u32>,
}

impl Products {
    pub(super) fn push(&mut self, factors: &[Power]) {
        let mut powers: Vec<Multiplicity> = Vec::with_capacity(factors.len());
        for factor in factors {
            let literal = if factor.exponent < 0 { Literal::Inverse(factor.base) } else { Literal::Base(factor.base) };
            let literal = self.literal(literal);
            let exponent = u64::from(factor.exponent.unsigned_abs());
            // A base stands twice where the exponents' sum would have overflowed.
            match powers.iter_mut().find(|power| power.0 == literal) {
                Some(power) => power.1 += exponent,
                None => powers.push((literal, exponent)),
            }
        }
        self.products.push(powers);
    }

    fn literal(&mut self, literal: Literal) -> u32 {
        *self.known.entry(literal).or_insert_with(|| {
            self.literals.push(literal);
            (self.literals.len() - 1) as u32
        })
    }

    /// Replaces pairs until none occurs twice.
    pub(super) fn share(&mut self) {
        let mut counts = FxHashMap::default();
        for product in &self.products {
            each_pair(product, |pair, n| *counts.entry(pair).or_insert(0_u64) += n);
        }
        loop {
            counts.retain(|_, count| *count > 0);
            let best = counts.iter().max_by_key(|&(&pair, &count)| (count, Reverse(pair)));
            let Some((&pair, _)) = best.filter(|&(_, &count)| count > 1) else {
                return;
            };
            let shared = self.literal(Literal::Pair(pair.0, pair.1));
            for product in &mut self.products {
                if has_pair(product, pair) {
                    each_pair(product, |pair, n| *counts.entry(pair).or_insert(0) -= n);
                    take_pair(product, pair, shared);
                    each_pair(product, |pair, n| *counts.entry(pair).or_insert(0) += n);
                }
            }
        }
    }

    /// How often each literal is multiplied in, over all products and pairs.
    pub(super) fn occurrences(&self) -> Vec<u64> {
        let mut occurrences = vec![0; self.literals.len()];
        for &(literal, exponent) in self.products.iter().flatten() {
            occurrences[literal as usize] += exponent;
        }
        for literal in &self.literals {
            if let Literal::Pair(a, b) = *literal {
                occurrences[a as usize] += 1;
                occurrences[b as usize] += 1;
            }
        }
        occurrences
    }
}

/// Every pair of literals in a product and how many disjoint times it occurs there.
fn each_pair(product: &[Multiplicity], mut count: impl FnMut((u32, u32), u64)) {
    for (at, &(a, m)) in product.iter().enumerate() {
        if m > 1 {
            count((a, a), m / 2);
        }
        for &(b, n) in &product[at + 1..] {
            count((a.min(b), a.max(b)), m.min(n));
        }
    }
}

fn exponent(product: &[Multiplicity], literal: u32) -> u64 {
    product.iter().find(|power| power.0 == literal).map_or(0, |power| power.1)
}

fn has_pair(product: &[Multiplicity], (a, b): (u32, u32)) -> bool {
    exponent(product, a) > u64::from(a == b) && exponent(product, b) > 0
}

fn take_pair(product: &mut Vec<Multiplicity>, (a, b): (u32, u32), shared: u32) {
    let times = if a == b { exponent(product, a) / 2 } else { exponent(product, a).min(exponent(product, b)) };
    for literal in [a, b] {
        if let Some(power) = product.iter_mut().find(|power| power.0 == literal) {
            power.1 -= times;
        }
    }
    product.retain(|power| power.1 > 0);
    product.push((shared, times));
}
