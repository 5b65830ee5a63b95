//! The minimum zone of a long path.

use trunnion_solver::circle::{CircleError, Point, Zone, minimum_zone};

/// Points that the search begins with, evenly along the path.
const FIRST: usize = 24;

/// The minimum zone of any number of points (as [`minimum_zone`], whose time grows with their number's square or cube).
///
/// A few points have a zone that is no wider than that of all. The points that are farthest outside of it are joined to them,
/// again and again: once it encloses all points, it is that of all.
pub(super) fn zone(points: &[Point<f64>]) -> Result<Zone<f64>, CircleError> {
    let step = points.len().div_ceil(FIRST).max(1);
    let mut chosen: Vec<usize> = (0..points.len()).step_by(step).collect();
    loop {
        let few: Vec<_> = chosen.iter().filter_map(|at| points.get(*at).copied()).collect();
        let zone = minimum_zone(&few)?;
        let radii = || points.iter().map(|p| about(zone.centre, p).1).enumerate();
        let farthest = radii().max_by(|a, b| a.1.total_cmp(&b.1));
        let nearest = radii().min_by(|a, b| a.1.total_cmp(&b.1));
        let (Some((out, outer)), Some((inside, inner))) = (farthest, nearest) else { return Ok(zone) };
        let outside = [(out, outer > zone.outer), (inside, inner < zone.inner)];
        let outside = outside.into_iter().filter(|(at, is)| *is && !chosen.contains(at)).map(|(at, _)| at);
        let outside: Vec<usize> = outside.collect();
        if outside.is_empty() {
            let contacts = zone.contacts.and_then(|held| {
                let [a, b, c, d] = held.map(|at| chosen.get(at).copied());
                Some([a?, b?, c?, d?])
            });
            return Ok(Zone { inner, outer, contacts, ..zone });
        }
        chosen.extend(outside);
    }
}

/// A point's direction (rad) and distance (mm) from a centre.
pub(super) fn about([x, y]: Point<f64>, p: &Point<f64>) -> (f64, f64) {
    let (u, v) = (p[0] - x, p[1] - y);
    (v.atan2(u), u.hypot(v))
}
