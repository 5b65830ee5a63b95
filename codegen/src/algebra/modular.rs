//! Polynomials modulo a prime: greatest common divisors with no growing coefficients.
//!
//! Brown's dense algorithm: all symbols but one get values, the divisors of one symbol are Euclid's, and are interpolated.

use super::Powers;
use super::monomial::MAX_NOMINALS;
use std::collections::BTreeMap;

/// The field of a prime below 2³², whose products fit a machine word.
#[derive(Clone, Copy)]
pub(super) struct Field(pub u64);

/// A polynomial of several symbols by its powers; no coefficient is 0.
pub(super) type Image = BTreeMap<Powers, u64>;

/// A polynomial of one symbol: coefficients of its powers, the last not 0.
type Line = Vec<u64>;

/// Primes below 2³¹, descending.
pub(super) fn primes() -> impl Iterator<Item = Field> {
    (1..1 << 31).rev().step_by(2).map(Field).filter(|field| field.is_prime())
}

impl Field {
    /// Miller and Rabin's test; these bases decide all numbers below 2³¹.
    fn is_prime(self) -> bool {
        let Self(n) = self;
        let (twos, odd) = ((n - 1).trailing_zeros(), (n - 1) >> (n - 1).trailing_zeros());
        n > 7
            && [2, 3, 5, 7].into_iter().all(|base| {
                let start = self.power(base, odd);
                let mut squares = core::iter::successors(Some(start), |x| Some(x * x % n)).take(twos as usize);
                start == 1 || squares.any(|x| x == n - 1)
            })
    }

    fn power(self, base: u64, mut exponent: u64) -> u64 {
        let (mut product, mut square) = (1, base % self.0);
        while exponent > 0 {
            if exponent & 1 == 1 {
                product = product * square % self.0;
            }
            square = square * square % self.0;
            exponent >>= 1;
        }
        product
    }

    /// `1 / a` by Fermat's theorem.
    pub(super) fn inverse(self, a: u64) -> u64 {
        self.power(a, self.0 - 2)
    }

    fn minus(self, a: u64, b: u64) -> u64 {
        (a + self.0 - b) % self.0
    }

    fn at(self, line: &[u64], x: u64) -> u64 {
        line.iter().rev().fold(0, |sum, c| (sum * x + c) % self.0)
    }

    fn times(self, a: &[u64], b: &[u64]) -> Line {
        let mut product = vec![0; (a.len() + b.len()).saturating_sub(1)];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                product[i + j] = (product[i + j] + x * y) % self.0;
            }
        }
        product
    }

    /// Quotient and remainder; `b` is not 0.
    fn divided(self, mut a: Line, b: &[u64]) -> (Line, Line) {
        let inverse = self.inverse(b.last().copied().unwrap_or(1));
        let mut quotient = vec![0; (a.len() + 1).saturating_sub(b.len())];
        for (shift, q) in quotient.iter_mut().enumerate().rev() {
            *q = a.get(shift + b.len() - 1).map_or(0, |lead| lead * inverse % self.0);
            for (x, y) in a[shift..].iter_mut().zip(b) {
                *x = self.minus(*x, *q * y % self.0);
            }
        }
        trim(&mut a);
        (quotient, a)
    }

    /// With the leading coefficient 1.
    fn line_gcd(self, mut a: Line, mut b: Line) -> Line {
        while !b.is_empty() {
            let (_, rest) = self.divided(a, &b);
            (a, b) = (b, rest);
        }
        let inverse = self.inverse(a.last().copied().unwrap_or(1));
        a.iter_mut().for_each(|c| *c = *c * inverse % self.0);
        a
    }

    /// The greatest common divisor with the leading coefficient 1, but for bad luck. That of polynomials over the rationals,
    /// neither of which loses its leading term here, has no higher leading term.
    pub(super) fn gcd(self, a: &Image, b: &Image) -> Image {
        let present = |i: usize| a.keys().chain(b.keys()).any(|powers| powers[i] != 0);
        let symbols: Vec<usize> = (0..MAX_NOMINALS).filter(|i| present(*i)).collect();
        self.gcd_in(a, b, &symbols)
    }

    /// Of polynomials in `symbols`; the last is taken as a coefficient of the others.
    fn gcd_in(self, a: &Image, b: &Image, symbols: &[usize]) -> Image {
        let Some((&last, others)) = symbols.split_last() else { return constant() };
        let (mut a, mut b) = (by(a, last), by(b, last));
        let content = self.line_gcd(self.remove_content(&mut a), self.remove_content(&mut b));
        let content = || spread([([0; MAX_NOMINALS], content.clone())], last);
        if others.is_empty() {
            return content();
        }
        let lead = |p: &BTreeMap<Powers, Line>| p.last_key_value().map(|(_, line)| line.clone()).unwrap_or_default();
        let leads = [lead(&a), lead(&b)];
        let common = self.line_gcd(leads[0].clone(), leads[1].clone());
        let degree = |p: &BTreeMap<Powers, Line>| p.values().map(Vec::len).max().unwrap_or(0);
        let needed = degree(&a).min(degree(&b)) + common.len();
        let mut found = Interpolated::default();
        // Not small numbers, and others for each symbol: R − L is not to vanish wherever R − 1 does.
        let points = (1..self.0)
            .map(|n| n * (0x9e37_79b1 + last as u64) % self.0)
            .filter(|x| leads.iter().all(|lead| self.at(lead, *x) != 0));
        for x in points {
            let image = self.gcd_in(&self.fixed(&a, x), &self.fixed(&b, x), others);
            if image == constant() {
                return content();
            }
            let scale = self.at(&common, x);
            let image = image.into_iter().map(|(powers, c)| (powers, c * scale % self.0)).collect();
            if found.add(self, x, image) || found.points >= needed {
                break;
            }
        }
        self.remove_content(&mut found.lines);
        let content = content();
        let mut product = Image::new();
        for (powers, c) in spread(found.lines, last) {
            for (shift, d) in &content {
                let powers = core::array::from_fn(|i| powers[i] + shift[i]);
                let sum = product.entry(powers).or_insert(0);
                *sum = (*sum + c * d) % self.0;
            }
        }
        product.retain(|_, c| *c != 0);
        let inverse = self.inverse(product.last_key_value().map_or(1, |(_, c)| *c));
        product.values_mut().for_each(|c| *c = *c * inverse % self.0);
        product
    }

    /// Divides by the greatest common divisor of the coefficients, and returns it.
    fn remove_content(self, p: &mut BTreeMap<Powers, Line>) -> Line {
        let mut content = Line::new();
        for line in p.values() {
            content = self.line_gcd(content, line.clone());
        }
        if content.len() > 1 {
            p.values_mut().for_each(|line| *line = self.divided(core::mem::take(line), &content).0);
        }
        content
    }

    /// The last symbol at a value.
    fn fixed(self, p: &BTreeMap<Powers, Line>, x: u64) -> Image {
        let value = |(powers, line): (&Powers, &Line)| (*powers, self.at(line, x));
        p.iter().map(value).filter(|(_, c)| *c != 0).collect()
    }
}

/// Newton's interpolation of polynomials whose leading terms agree; a lower one shows that those before were too high.
#[derive(Default)]
struct Interpolated {
    points: usize,
    lines: BTreeMap<Powers, Line>,
    /// Π (x − point)
    vanishing: Line,
}

impl Interpolated {
    /// True where the point changes nothing, as one more than there are to be found does.
    fn add(&mut self, field: Field, x: u64, image: Image) -> bool {
        let lead = |keys: Option<&Powers>| keys.copied();
        match lead(image.keys().next_back()).cmp(&lead(self.lines.keys().next_back())) {
            _ if self.points == 0 => self.vanishing = vec![1],
            core::cmp::Ordering::Less => *self = Self { vanishing: vec![1], ..Self::default() },
            core::cmp::Ordering::Equal => {}
            core::cmp::Ordering::Greater => return false,
        }
        let inverse = field.inverse(field.at(&self.vanishing, x));
        let mut same = true;
        for powers in image.keys() {
            self.lines.entry(*powers).or_default();
        }
        for (powers, line) in &mut self.lines {
            let missing = field.minus(image.get(powers).copied().unwrap_or(0), field.at(line, x));
            let step = missing * inverse % field.0;
            same &= step == 0;
            line.resize(line.len().max(self.vanishing.len()), 0);
            line.iter_mut().zip(&self.vanishing).for_each(|(c, v)| *c = (*c + step * v) % field.0);
            trim(line);
        }
        self.vanishing = field.times(&self.vanishing, &[field.minus(0, x), 1]);
        self.points += 1;
        same
    }
}

fn trim(line: &mut Line) {
    line.truncate(line.iter().rposition(|c| *c != 0).map_or(0, |last| last + 1));
}

fn constant() -> Image {
    Image::from([([0; MAX_NOMINALS], 1)])
}

/// With a symbol's powers as the coefficients of the others'.
fn by(image: &Image, symbol: usize) -> BTreeMap<Powers, Line> {
    let mut lines: BTreeMap<Powers, Line> = BTreeMap::new();
    for (powers, c) in image {
        let mut others = *powers;
        let power = usize::from(core::mem::take(&mut others[symbol]).unsigned_abs());
        let line = lines.entry(others).or_default();
        line.resize(line.len().max(power + 1), 0);
        line[power] = *c;
    }
    lines
}

/// The reverse of [`by`].
fn spread(lines: impl IntoIterator<Item = (Powers, Line)>, symbol: usize) -> Image {
    let mut image = Image::new();
    for (powers, line) in lines {
        for (power, c) in line.into_iter().enumerate().filter(|(_, c)| *c != 0) {
            let mut own = powers;
            own[symbol] = power as i8;
            image.insert(own, c);
        }
    }
    image
}
