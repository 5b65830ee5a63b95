//! Exact sums of cosines and sines of multiples of the sweep: paths, balls and probes are drawn in them.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// Lengths of the set-up, mm, the first the bar's: no small multiples of each other, lest what differs be equal in numbers.
pub const LENGTHS: [(&str, f64); 3] = [("R", 101.0), ("L", 149.0), ("H", 83.0)];
/// In place of a length: a bare number.
const NUMBER: usize = LENGTHS.len();

/// A rational number, its denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio(i64, i64);

impl Ratio {
    pub const ZERO: Self = Self(0, 1);
    pub const ONE: Self = Self(1, 1);

    pub fn new(numer: i64, denom: i64) -> Self {
        let (mut a, mut b) = (numer.abs(), denom.abs());
        while b != 0 {
            (a, b) = (b, a % b);
        }
        let by = a.max(1) * denom.signum();
        Self(numer / by, denom / by)
    }

    pub fn plus(self, other: Self) -> Self {
        Self::new(self.0 * other.1 + other.0 * self.1, self.1 * other.1)
    }

    pub fn times(self, other: Self) -> Self {
        Self::new(self.0 * other.0, self.1 * other.1)
    }

    pub fn negated(self) -> Self {
        Self(-self.0, self.1)
    }

    pub fn value(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.1 == 1 { write!(f, "{}", self.0) } else { write!(f, "{}/{}", self.0, self.1) }
    }
}

/// A length, a multiple of the sweep that is not negative, and whether it is the sine.
type Term = (usize, i32, bool);

/// `Σ factor · length · cos or sin(multiple · sweep)`
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wave(BTreeMap<Term, Ratio>);

/// A vector of them.
pub type Waves = [Wave; 3];

impl Wave {
    /// `factor` times one of [`LENGTHS`].
    pub fn length(length: usize, factor: Ratio) -> Self {
        let mut wave = Self::default();
        wave.add((length, 0, false), factor);
        wave
    }

    pub fn number(factor: Ratio) -> Self {
        Self::length(NUMBER, factor)
    }

    /// Cosine and sine of `multiple · sweep + quarters · π/2`.
    pub fn turn(multiple: i32, quarters: i32) -> [Self; 2] {
        [0, -1].map(|lag| {
            let mut wave = Self::default();
            let (sine, sign) =
                [(false, 1), (true, -1), (false, -1), (true, 1)][(quarters + lag).rem_euclid(4) as usize];
            wave.add((NUMBER, multiple, sine), Ratio::new(sign, 1));
            wave
        })
    }

    fn add(&mut self, (length, multiple, sine): Term, factor: Ratio) {
        let factor = if sine && multiple < 0 { factor.negated() } else { factor };
        let term = (length, multiple.abs(), sine);
        let sum = self.0.get(&term).map_or(factor, |f| f.plus(factor));
        if sum == Ratio::ZERO || (sine && multiple == 0) {
            self.0.remove(&term);
        } else {
            self.0.insert(term, sum);
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.0.iter().for_each(|(term, factor)| sum.add(*term, *factor));
        sum
    }

    pub fn scaled(&self, by: Ratio) -> Self {
        self.times(&Self::number(by))
    }

    /// The product with one that has no length, by `2 cos x cos y = cos(x + y) + cos(x − y)` and its like.
    pub fn times(&self, number: &Self) -> Self {
        let mut product = Self::default();
        for (&(length, m, sine), &f) in &self.0 {
            for (&(_, n, other_sine), &g) in &number.0 {
                let half = f.times(g).times(Ratio::new(1, 2));
                let (of_sum, of_difference) = match (sine, other_sine) {
                    (false, false) | (true, false) => (half, half),
                    (false, true) => (half, half.negated()),
                    (true, true) => (half.negated(), half),
                };
                product.add((length, m + n, sine != other_sine), of_sum);
                product.add((length, m - n, sine != other_sine), of_difference);
            }
        }
        product
    }

    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The part that does not move.
    pub fn constant(&self) -> Self {
        Self(self.0.iter().filter(|((_, multiple, _), _)| *multiple == 0).map(|(t, f)| (*t, *f)).collect())
    }

    pub fn value(&self, sweep: f64) -> f64 {
        let term = |(&(length, multiple, sine), factor): (&Term, &Ratio)| {
            let lag = if sine { FRAC_PI_2 } else { 0.0 };
            let length = LENGTHS.get(length).map_or(1.0, |(_, mm)| *mm);
            factor.value() * length * (f64::from(multiple) * sweep - lag).cos()
        };
        self.0.iter().map(term).sum()
    }
}

/// As an expression of a model file, the sweep called t.
impl fmt::Display for Wave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("0")?;
        for (&(length, multiple, sine), factor) in &self.0 {
            write!(f, " + ({factor})")?;
            if let Some((name, _)) = LENGTHS.get(length) {
                write!(f, "*{name}")?;
            }
            if multiple != 0 {
                write!(f, "*{}({multiple}*t)", if sine { "sin" } else { "cos" })?;
            }
        }
        Ok(())
    }
}

pub fn sum(a: &Waves, b: &Waves) -> Waves {
    std::array::from_fn(|i| a[i].plus(&b[i]))
}

/// `by · direction`
pub fn along(direction: &[Ratio; 3], by: &Wave) -> Waves {
    direction.map(|d| by.scaled(d))
}

pub fn dot(a: &Waves, b: &[Ratio; 3]) -> Wave {
    (0..3).fold(Wave::default(), |sum, i| sum.plus(&a[i].scaled(b[i])))
}

/// Rodrigues: `cos · p + sin · n × p + (1 − cos) (n · p) n`.
pub fn rotated(n: &[Ratio; 3], [cos, sin]: &[Wave; 2], p: &Waves) -> Waves {
    let in_line = along(n, &dot(p, n));
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let cross = p[k].scaled(n[j]).plus(&p[j].scaled(n[k].negated()));
        let across = p[i].plus(&in_line[i].scaled(Ratio::new(-1, 1)));
        in_line[i].plus(&across.times(cos)).plus(&cross.times(sin))
    })
}
