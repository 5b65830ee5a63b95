//! Numbers with a derivative, and 4×4 transforms of them.

use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

/// `value + derivative · ε`, ε² = 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dual {
    pub value: f64,
    pub derivative: f64,
}

impl From<f64> for Dual {
    fn from(value: f64) -> Self {
        Self { value, derivative: 0.0 }
    }
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, derivative: self.derivative + other.derivative }
    }
}

impl Sub for Dual {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + other * (-1.0).into()
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let derivative = self.derivative * other.value + self.value * other.derivative;
        Self { value: self.value * other.value, derivative }
    }
}

impl Dual {
    pub fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, derivative: self.derivative / (2.0 * value) }
    }
}

/// A point or a direction in homogeneous coordinates.
pub type Point = [Dual; 4];

/// A transform of them.
pub struct Transform(pub [Point; 4]);

impl Transform {
    pub fn apply(&self, point: &Point) -> Point {
        from_fn(|i| (0..4).fold(Dual::default(), |sum, j| sum + self.0[i][j] * point[j]))
    }

    /// Six small errors X Y Z A B C: `[1 −c b x; c 1 −a y; −b a 1 z; 0 0 0 1]`
    pub fn small([x, y, z, a, b, c]: [Dual; 6]) -> Self {
        let (zero, one) = (Dual::default(), Dual::from(1.0));
        Self([[one, zero - c, b, x], [c, one, zero - a, y], [zero - b, a, one, z], [zero, zero, zero, one]])
    }

    pub fn travel(direction: [f64; 3], by: f64) -> Self {
        Self::of(|i, j| match (i == j, j) {
            (true, _) => 1.0,
            (_, 3) => direction[i] * by,
            _ => 0.0,
        })
    }

    /// About a unit vector: `exp(angle [n]×) = 1 + sin [n]× + (1 − cos) [n]×²`.
    pub fn turn(n: [f64; 3], angle: f64) -> Self {
        let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
        let square = |i: usize, j: usize| (0..3).map(|k| cross[i][k] * cross[k][j]).sum::<f64>();
        Self::of(|i, j| {
            let one = if i == j { 1.0 } else { 0.0 };
            if i == 3 || j == 3 { one } else { one + angle.sin() * cross[i][j] + (1.0 - angle.cos()) * square(i, j) }
        })
    }

    fn of(entry: impl Fn(usize, usize) -> f64) -> Self {
        Self(from_fn(|i| from_fn(|j| entry(i, j).into())))
    }
}

pub fn dot(a: &Point, b: &Point) -> Dual {
    (0..3).fold(Dual::default(), |sum, i| sum + a[i] * b[i])
}
