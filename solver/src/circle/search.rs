//! Search of all zones that four points can hold.
//!
//! Where two points a and b are the farthest, the centre is on a part of their bisector. There, at m + t n with m the middle
//! of a and b, every other point p is nearer by `r_a² − r_p² = v + w t`: a line in t, and the uppermost line is the nearest
//! point's. Where the uppermost changes, two farthest and two nearest points hold the zone. Anywhere else some move of
//! the centre narrows it, be it for ever: towards the narrowest strip between parallel lines.

use super::zone::{in_turn, take};
use super::{CircleError, Point, Zone, distance, extremes};
use crate::Real;

/// Points about their middle, so that neither large offsets nor units cost digits.
#[derive(Clone, Copy)]
pub(super) struct Cloud<'a, T> {
    pub points: &'a [Point<T>],
    pub origin: Point<T>,
    pub scale: T,
}

/// Two points and the part of their bisector from which they are the farthest.
struct Edge<T> {
    ends: [usize; 2],
    middle: Point<T>,
    /// From the first to the second, of length one.
    along: Point<T>,
    /// Half their distance.
    half: T,
    /// Where the part begins and ends.
    part: [T; 2],
}

/// How much nearer a point is than the farthest, squared: `value + slope · t`.
#[derive(Clone, Copy)]
struct Gap<T> {
    point: usize,
    value: T,
    slope: T,
}

/// A centre and what holds its zone.
#[derive(Clone, Copy)]
struct Held<T> {
    centre: Point<T>,
    /// Of the zone, with what rounding may have taken off it: far out that is all there is.
    width: T,
    contacts: [usize; 4],
    /// Whether the contacts alternate, as seen from the centre.
    alternate: bool,
}

/// Coordinates are of order one: what rounding leaves of a difference of their squares.
fn rounding<T: Real>() -> T {
    T::of(16.0) * T::epsilon()
}

/// Widths that differ by less are taken for equal.
fn alike<T: Real>() -> T {
    T::of(4.0) * rounding::<T>()
}

impl<T: Real> Cloud<'_, T> {
    /// The narrowest zone there is.
    ///
    /// Time grows with the square of the number of points where they are near a circle, with its cube at worst.
    ///
    /// # Errors
    /// [`CircleError::BetweenLines`]: the farther the centre, the narrower the zone.
    pub fn narrowest(&self) -> Result<Zone<T>, CircleError> {
        let (mut best, mut strip) = (None, T::infinity());
        for (a, p) in self.local() {
            for (b, q) in self.local().skip(a + 1) {
                let length = distance(&p, &q);
                if length <= rounding() {
                    continue;
                }
                let along = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
                strip = strip.min(self.strip(&p, &along));
                let half = T::of(0.5);
                let middle = [half * (p[0] + q[0]), half * (p[1] + q[1])];
                if let Some(edge) = self.part(Edge {
                    ends: [a, b],
                    middle,
                    along,
                    half: half * length,
                    part: [-T::infinity(), T::infinity()],
                }) {
                    if let Some(centre) = self.round(&edge) {
                        return Ok(self.zone(&centre, None));
                    }
                    self.walk(&edge, &mut best);
                }
            }
        }
        let held = best.filter(|held| held.width <= strip + alike()).ok_or(CircleError::BetweenLines)?;
        Ok(self.zone(&held.centre, Some(held.contacts)))
    }

    fn zone(&self, [x, y]: &Point<T>, contacts: Option<[usize; 4]>) -> Zone<T> {
        let centre = [self.origin[0] + self.scale * *x, self.origin[1] + self.scale * *y];
        let (inner, outer) = extremes(self.points, &centre);
        Zone { centre, inner, outer, contacts }
    }

    /// The end of an edge from which all points are as far as the third that is met there: they are on one circle.
    fn round(&self, edge: &Edge<T>) -> Option<Point<T>> {
        let ends = edge.part.into_iter().filter(|t| t.is_finite());
        let mut round = ends.filter(|t| self.width(&edge.at(*t)) <= alike::<T>() * (T::one() + t.abs()));
        round.next().map(|t| edge.at(t))
    }

    /// Width of the strip along a side of the points' hull; infinite for a line between them. The narrowest strip there is has
    /// a side along the hull's.
    fn strip(&self, from: &Point<T>, along: &Point<T>) -> T {
        let (mut low, mut high) = (T::zero(), T::zero());
        for (_, p) in self.local() {
            let aside = (p[1] - from[1]) * along[0] - (p[0] - from[0]) * along[1];
            (low, high) = (low.min(aside), high.max(aside));
            if low < -rounding::<T>() && high > rounding() {
                return T::infinity();
            }
        }
        high - low
    }

    /// Width of the zone about a centre.
    fn width(&self, centre: &Point<T>) -> T {
        let radii = self.local().map(|(_, p)| distance(centre, &p));
        let (low, high) = radii.fold((T::infinity(), T::zero()), |(low, high), r| (low.min(r), high.max(r)));
        high - low
    }

    fn local(&self) -> impl Iterator<Item = (usize, Point<T>)> {
        let ([x, y], scale) = (self.origin, self.scale);
        self.points.iter().map(move |p| [(p[0] - x) / scale, (p[1] - y) / scale]).enumerate()
    }

    /// Shortens an edge to where its ends are the farthest; none where some point is always farther.
    fn part(&self, mut edge: Edge<T>) -> Option<Edge<T>> {
        for (at, point) in self.local() {
            let gap = edge.gap(at, &point);
            // Too long by a rounding does no harm: the zone is measured in the end.
            let bound = -(gap.value + rounding()) / gap.slope;
            let [low, high] = &mut edge.part;
            if gap.slope.abs() <= rounding() {
                if gap.value < -rounding::<T>() {
                    return None;
                }
            } else if gap.slope > T::zero() {
                *low = low.max(bound);
            } else {
                *high = high.min(bound);
            }
            if *low > *high {
                return None;
            }
        }
        Some(edge)
    }

    /// Goes along an edge from one nearest point to the next.
    fn walk(&self, edge: &Edge<T>, best: &mut Option<Held<T>>) {
        let [low, high] = edge.part;
        let gaps = || {
            let others = self.local().filter(|(at, _)| !edge.ends.contains(at));
            others.map(|(at, point)| edge.gap(at, &point))
        };
        // Far out the slope decides, then the value.
        let above = |a: &Gap<T>, b: &Gap<T>| {
            if low.is_finite() {
                a.at(low) > b.at(low)
            } else {
                a.slope < b.slope || a.slope == b.slope && a.value > b.value
            }
        };
        let Some(mut nearest) = gaps().reduce(|a, b| if above(&b, &a) { b } else { a }) else { return };
        while let Some((t, next)) = gaps()
            .filter(|gap| gap.slope > nearest.slope)
            .map(|gap| (nearest.meets(&gap), gap))
            .filter(|(t, _)| t.is_finite())
            .reduce(|a, b| if b.0 < a.0 || b.0 == a.0 && b.1.slope > a.1.slope { b } else { a })
        {
            if t > high {
                return;
            }
            if t >= low {
                self.offer(edge, t, [nearest, next], best);
            }
            nearest = next;
        }
    }

    /// Keeps the narrower; of two that are alike, the one whose contacts alternate.
    fn offer(&self, edge: &Edge<T>, t: T, [near, next]: [Gap<T>; 2], best: &mut Option<Held<T>>) {
        let most = best.map_or(T::infinity(), |best| best.width + if best.alternate { T::zero() } else { alike() });
        let outer = edge.half.hypot(t);
        let gap = near.at(t);
        let inner = (outer * outer - gap).max(T::zero()).sqrt();
        let centre = edge.at(t);
        // The estimate costs nothing; what it lets pass is measured.
        let width = if gap < most * (outer + inner) { self.width(&centre) + rounding::<T>() * outer } else { most };
        if width.is_nan() || width >= most {
            return;
        }
        let contacts = [edge.ends[0], near.point, edge.ends[1], next.point];
        let turns = |contacts: [usize; 4]| {
            let held = take(self.points, contacts)?;
            let ([x, y], scale) = (self.origin, self.scale);
            Some(in_turn(&centre, &held.map(|p| [(p[0] - x) / scale, (p[1] - y) / scale])))
        };
        let [a, k, b, j] = contacts;
        let turned = [[a, k, b, j], [a, j, b, k]].into_iter().find(|contacts| turns(*contacts) == Some(true));
        let clearly = best.is_none_or(|best| width < best.width - alike());
        if clearly || turned.is_some() {
            *best = Some(Held { centre, width, contacts: turned.unwrap_or(contacts), alternate: turned.is_some() });
        }
    }
}

impl<T: Real> Edge<T> {
    /// The place on the bisector at a distance from the middle.
    fn at(&self, t: T) -> Point<T> {
        [self.middle[0] - t * self.along[1], self.middle[1] + t * self.along[0]]
    }

    fn gap(&self, at: usize, p: &Point<T>) -> Gap<T> {
        let (dx, dy) = (p[0] - self.middle[0], p[1] - self.middle[1]);
        let x = dx * self.along[0] + dy * self.along[1];
        let y = dy * self.along[0] - dx * self.along[1];
        let value = (self.half - x) * (self.half + x) - y * y;
        Gap { point: at, value, slope: y + y }
    }
}

impl<T: Real> Gap<T> {
    fn at(&self, t: T) -> T {
        self.value + self.slope * t
    }

    /// Where another gap that grows faster becomes as large.
    fn meets(&self, other: &Self) -> T {
        (self.value - other.value) / (other.slope - self.slope)
    }
}
