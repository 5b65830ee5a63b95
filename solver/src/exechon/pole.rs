//! Poses near A = 0, where E(5) turns quickly with the platform: found by the A axis' direction instead.
//!
//! Let the A axis' y point along ŷ(ψ), square to the tool. Then pS − yt ŷ is a point of the platform, and three equations that
//! are regular everywhere give the platform. The A axis is square to the C axis, x̂(ψ)·ẑ = 0 with x̂ = ŷ × t, for single
//! ψ only, and there ŷ·ẑ = sin A.

use super::vector::{cross, dot, norm, plus};
use super::{Machine, Start, Vector, equations, newton};
use crate::Real;

/// Directions that are tried around the tool; between two of them the condition changes its sign at most once.
const DIRECTIONS: u32 = 64;

/// A platform, x̂·ẑ and sin A there.
#[derive(Clone, Copy)]
struct Tried<T> {
    angle: T,
    platform: Vector<T>,
    off: T,
    sine: T,
}

/// What is found around a tool.
pub(super) struct Around<T> {
    /// The platform on the branch that is nearest to the start.
    pub platform: Option<Vector<T>>,
    /// Whether some platform has the tool along the C axis.
    pub along_c: bool,
}

/// The tool, and where the search for platforms begins.
struct Tool<'a, T> {
    machine: &'a Machine<T>,
    /// The spindle axis' crossing with the A axis' plane, mm.
    crossing: Vector<T>,
    /// Two directions square to the tool and to each other.
    square: [Vector<T>; 2],
}

impl<T: Real> Machine<T> {
    /// All platforms with the tool along `t` and the spindle axis through `crossing`, on the branch of `start`.
    pub(super) fn around(&self, crossing: &Vector<T>, t: &Vector<T>, start: &Start<T>) -> Around<T> {
        let (one, zero) = (T::one(), T::zero());
        // The base axis least along the tool.
        let [x, y, z] = t.map(T::abs);
        let least = if x <= y && x <= z {
            [one, zero, zero]
        } else if y <= z {
            [zero, one, zero]
        } else {
            [zero, zero, one]
        };
        let aside = cross(t, &least);
        let first = aside.map(|v| v / norm(&aside));
        let tool = Tool { machine: self, crossing: *crossing, square: [first, cross(t, &first)] };
        let small = T::epsilon().sqrt();
        let mut found = Around { platform: None, along_c: false };
        let mut nearest = T::infinity();
        let step = T::of(core::f64::consts::TAU) / T::of_count(DIRECTIONS);
        let mut last = tool.at(zero, &start.platform);
        for k in 1..=DIRECTIONS {
            let from = last.map_or(start.platform, |last| last.platform);
            let next = tool.at(step * T::of_count(k), &from);
            found.along_c |= next.is_some_and(|tried| tried.off.hypot(tried.sine) <= small);
            if let (Some(a), Some(b)) = (last, next)
                && (a.off < zero) != (b.off < zero)
                && let Some(Tried { platform, sine, .. }) = tool.between(a, b)
            {
                let apart = plus(&platform, -one, &start.platform);
                found.along_c |= sine.abs() <= small;
                if sine * start.branch.sign() > small && norm(&apart) < nearest {
                    nearest = norm(&apart);
                    found.platform = Some(platform);
                }
            }
            last = next;
        }
        found
    }
}

impl<T: Real> Tool<'_, T> {
    fn at(&self, angle: T, from: &Vector<T>) -> Option<Tried<T>> {
        let d = self.machine.dimensions();
        let [e, f] = &self.square;
        let (sin, cos) = angle.sin_cos();
        let y_a = plus(&e.map(|v| v * cos), sin, f);
        let x_a = plus(&e.map(|v| v * sin), -cos, f);
        let [a, b, c] = plus(&self.crossing, -d.yt, &y_a);
        // Without an offset of the spindle E(5) says where a point of the platform is, whatever the tool's direction.
        let zero = T::zero();
        let root = newton::solve(from, self.machine.home().struts_mean(), |[x, y, z]| {
            equations::closure(d.ys2, d.ycp, d.zc, zero, a, b, c, T::one(), zero, zero, *x, *y, *z)
        })
        .ok()?;
        let [_, _, z_axis] = self.machine.orientation(&root.at).ok()?;
        Some(Tried { angle, platform: root.at, off: dot(&x_a, &z_axis), sine: dot(&y_a, &z_axis) })
    }

    /// Where the condition changes its sign, by halving.
    fn between(&self, mut low: Tried<T>, mut high: Tried<T>) -> Option<Tried<T>> {
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = self.at(T::of(0.5) * (low.angle + high.angle), &low.platform)?;
            if (middle.off < T::zero()) == (low.off < T::zero()) {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(low)
    }
}
