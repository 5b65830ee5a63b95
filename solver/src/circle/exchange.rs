//! Exchange of the four contacts of a zone.

use super::zone::{ahead, angle, take};
use super::{Point, Zone, distance, extremes};
use crate::Real;

/// Steps after which an exchange is taken to go round in circles.
const MOST: u32 = 1000;

/// From four points spread by angle to contacts that enclose all points.
pub(super) fn run<T: Real>(points: &[Point<T>], start: &Point<T>, slack: T) -> Option<Zone<T>> {
    let mut contacts = spread(points, start)?;
    for _ in 0..MOST {
        let held = take(points, contacts)?;
        let centre = meeting(&held)?;
        let radii = held.map(|p| distance(&centre, &p));
        let half = T::of(0.5);
        let (even, odd) = (half * (radii[0] + radii[2]), half * (radii[1] + radii[3]));
        let (inner, outer) = (even.min(odd), even.max(odd));
        let (worst, excess, outside) = most_violating(points, &centre, inner, outer)?;
        if excess <= slack {
            // Rounding is the points' own: the circles go through the outermost and innermost ones.
            let (inner, outer) = extremes(points, &centre);
            return Some(Zone { centre, inner, outer, contacts: Some(contacts) });
        }
        let even_is_outer = even >= odd;
        let point = points.get(worst)?;
        // The place of the new point among the contacts: after `before`, which or whose successor is on its side.
        let first = angle(&centre, &held[0]);
        let mine = ahead(first, angle(&centre, point));
        let before = held.iter().rposition(|p| ahead(first, angle(&centre, p)) <= mine)?;
        let side = |contact: usize| contact.is_multiple_of(2) == even_is_outer;
        let place = if side(before) == outside { before } else { (before + 1) % 4 };
        *contacts.get_mut(place)? = worst;
    }
    None
}

/// The point farthest out of the zone, how far, and whether on the outer side.
fn most_violating<T: Real>(points: &[Point<T>], centre: &Point<T>, inner: T, outer: T) -> Option<(usize, T, bool)> {
    let mut worst: Option<(usize, T, bool)> = None;
    for (at, point) in points.iter().enumerate() {
        let r = distance(centre, point);
        let (over, under) = (r - outer, inner - r);
        let (excess, outside) = if over >= under { (over, true) } else { (under, false) };
        if worst.is_none_or(|(_, most, _)| excess > most) {
            worst = Some((at, excess, outside));
        }
    }
    worst
}

/// Where the bisector of points 0 and 2 meets that of points 1 and 3.
fn meeting<T: Real>([p, q, r, s]: &[Point<T>; 4]) -> Option<Point<T>> {
    let half = T::of(0.5);
    // About the first point, so that offsets cost no digits.
    let local = |v: &Point<T>| [v[0] - p[0], v[1] - p[1]];
    let (q, r, s) = (local(q), local(r), local(s));
    let square = |v: &Point<T>| v[0] * v[0] + v[1] * v[1];
    let (a, b) = (r, [s[0] - q[0], s[1] - q[1]]);
    let (e, f) = (half * square(&r), half * (square(&s) - square(&q)));
    let determinant = a[0] * b[1] - a[1] * b[0];
    let centre = [(e * b[1] - f * a[1]) / determinant, (a[0] * f - b[0] * e) / determinant];
    let finite = centre[0].is_finite() && centre[1].is_finite();
    finite.then(|| [centre[0] + p[0], centre[1] + p[1]])
}

/// Four points as evenly spread over the angles taken up by all as there are.
fn spread<T: Real>(points: &[Point<T>], centre: &Point<T>) -> Option<[usize; 4]> {
    // Angles from the direction in which most points are: an arc is then not cut.
    let n = T::of_count(u32::try_from(points.len()).ok()?);
    let sum = points.iter().fold([T::zero(); 2], |s, p| [s[0] + p[0] - centre[0], s[1] + p[1] - centre[1]]);
    let middle = (sum[1] / n).atan2(sum[0] / n);
    let half_turn = T::of(core::f64::consts::PI);
    let of = |p: &Point<T>| ahead(middle - half_turn, angle(centre, p));
    let (low, high) = points.iter().map(of).fold((T::infinity(), T::zero()), |(l, h), a| (l.min(a), h.max(a)));
    let mut chosen = [0; 4];
    let mut past = -T::one();
    for (k, place) in (0u32..).zip(&mut chosen) {
        // Of the points past the last one chosen, the one nearest to its share of the span.
        let wish = low + (high - low) * (T::of_count(k) + T::of(0.5)) / T::of(4.0);
        let candidates = points.iter().enumerate().map(|(at, p)| (at, of(p))).filter(|(_, a)| *a > past);
        let nearest =
            candidates.reduce(|best, next| if (next.1 - wish).abs() < (best.1 - wish).abs() { next } else { best });
        let (at, angle) = nearest?;
        (*place, past) = (at, angle);
    }
    Some(chosen)
}
