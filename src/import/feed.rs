//! Readings while the bar is still on its way to the circle, or away from it.
//!
//! That way is a straight radial move. At the end of the record the readings go one way, far more steeply than a circle has them
//! go, however far out of centre it is, up to a knee. Around a circle the steepest step of any part that is not a mere corner is at
//! most about twice as steep as the steepest ones of the record's middle: r = c₀ + c₁ cos θ + c₂ sin θ, which an eccentric set-up
//! makes, has its steepest step within any half turn.

use super::unit::circle;

/// The way is at least so long, mm: what is shorter may be a reversal spike.
const LEAST: f64 = 0.1;

/// Steps that are so many times the steepest ones of the middle are those of the way.
const STEEP: f64 = 3.0;

/// Steps that are such a part of the way's own are no longer those of the way.
const SLOW: f64 = 0.1;

/// The part of the middle's steps that are no steeper than its steepest ones: the rest may be reversal spikes.
const USUAL: f64 = 0.95;

/// Not more than this part of the readings at either end.
const PART: usize = 4;

/// Readings before the way that are no nearer to the circle than this part of it: the bar waits to set off.
const WAITS: f64 = 0.1;

/// At the knee the readings are so many times steeper before than behind, over this part of the way.
const SHARP: f64 = 2.0;
const BEND: usize = 8;

/// An end that is so many times the usual distance off the circle may be a way to it that was not made out.
const FAR: f64 = 5.0;

/// How many readings, mm, at the beginning and at the end belong to feed-in and feed-out.
pub(super) fn feed_arcs(readings: &[f64]) -> [usize; 2] {
    [length(readings), length(&readings.iter().rev().copied().collect::<Vec<_>>())]
}

/// Whether the first and the last sample, rad and mm, are so far off the circle of all that they may belong to a way to it.
pub(super) fn doubtful(samples: impl Iterator<Item = (f64, f64)> + Clone) -> [bool; 2] {
    let Some(residual) = circle(samples.clone()) else { return [false; 2] };
    let off: Vec<f64> = samples.map(|sample| residual(sample).abs()).collect();
    let far = LEAST.max(FAR * quantile(off.clone(), 0.5));
    [off.first(), off.last()].map(|end| end.is_some_and(|off| *off > far))
}

/// Of the way at the beginning, by the shortest step over which it stands out of the readings' noise.
fn length(along: &[f64]) -> usize {
    let most = along.len() / PART;
    let strides =
        std::iter::successors(Some(1), |stride| Some(2 * stride)).take_while(|stride| 4 * stride <= most.max(4));
    strides.filter_map(|stride| knee(along, stride, most)).next().unwrap_or(0)
}

/// Where a way ends whose readings are steep over each `stride` of them; none where there is no such way.
fn knee(along: &[f64], stride: usize, most: usize) -> Option<usize> {
    let step = |at: usize| along.get(at + stride).zip(along.get(at)).map_or(0.0, |(next, own)| next - own);
    let steep = STEEP * quantile((most..along.len() - most).map(|at| step(at).abs()).collect(), USUAL);
    let begin = (0..most).find(|at| step(*at).abs() > steep)?;
    let inward = step(begin).signum();
    let ahead = |at: usize| along.get(at).map_or(0.0, |own| (own - along[begin]) * inward);
    let end = (begin..=most).find(|at| step(*at) * inward <= steep)?;
    // What goes on far more slowly than the way is a reversal spike behind it.
    let slope = ahead(end) / (end - begin) as f64;
    let steep = steep.max(SLOW * slope * stride as f64);
    let end = 1 + (begin..end).rev().find(|at| step(*at) * inward > steep)?;
    // The last of these steps lies within the way as far as it is steep, but not on a way that goes nowhere.
    let knee = end + (steep / slope).min(stride as f64) as usize;
    let length = ahead(knee);
    let waits = (0..begin).all(|at| ahead(at) <= WAITS * length);
    // A circle's course bends, but has no knee.
    let (near, part) = (ahead(end), stride.max((end - begin) / BEND));
    let sharp = near - ahead(end.saturating_sub(part).max(begin)) > SHARP * (ahead(knee + part) - length);
    (knee <= most && length >= LEAST && waits && sharp).then_some(knee)
}

/// The value that a share of all are below; 0 of none.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    let at = (values.len() as f64 * share) as usize;
    if at >= values.len() { 0.0 } else { *values.select_nth_unstable_by(at, f64::total_cmp).1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use chacha20::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// A circle without its feed-in: out of centre, oval, drifting, noisy, with spikes where its axes turn round.
    struct Circle {
        readings: Vec<f64>,
        /// What no step of it is beyond, mm.
        steep: f64,
        /// Samples in which a spike falls by two thirds: one that goes on from the feed-in is no knee.
        spike: usize,
    }

    fn drawn(random: &mut ChaCha8Rng) -> Circle {
        let mut from = |low: f64, high: f64| random.random_range(low..high);
        let count = from(200.0, 3000.0) as usize;
        let begins = if from(0.0, 1.0) < 0.5 { 0.0 } else { from(-3.0, 3.0) };
        let arc = if from(0.0, 1.0) < 0.5 { TAU } else { from(1.8, 7.0) };
        let (eccentric, towards) = (from(0.0, 0.5), from(-3.0, 3.0));
        let (oval, drift, spike, noise) = (from(-0.05, 0.05), from(-0.02, 0.02), from(-0.03, 0.03), from(0.0, 0.001));
        let decay = 0.012;
        let reading = |at: usize| {
            let share = at as f64 / (count - 1) as f64;
            let angle = begins + arc * share;
            let spiked = spike * (-angle.rem_euclid(FRAC_PI_2) / decay).exp();
            let waves = eccentric * (angle - towards).cos() + oval * (2.0 * angle + 0.7).cos();
            waves + spiked + drift * share + noise * random.random_range(-1.0..1.0)
        };
        let readings = (0..count).map(reading).collect();
        let step = arc / count as f64;
        let steep = step * (eccentric + 2.0 * oval.abs()) + spike.abs() * (1.0 - (-step / decay).exp()) + 2.0 * noise;
        Circle { readings, steep, spike: (decay / step) as usize }
    }

    #[test]
    fn what_has_no_feed_in_is_left_alone() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for round in 0..3000 {
            assert_eq!(feed_arcs(&drawn(&mut random).readings), [0, 0], "{round}");
        }
    }

    #[test]
    fn a_feed_in_goes_and_nothing_else() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let mut trimmed = 0;
        for round in 0..3000 {
            let Circle { readings, steep, spike } = drawn(&mut random);
            // Inward or outward, into the record and out of it; before it the bar may wait.
            let mut way = |end: f64| {
                let length = random.random_range(0.25_f64..1.8) * if random.random() { 1.0 } else { -1.0 };
                let most = (0.2 * readings.len() as f64).min(length.abs() / (4.0 * steep)) as usize;
                let steps = random.random_range(0..=most);
                let waits = if steps == 0 { 0 } else { random.random_range(0..20) };
                let moving = (0..steps).map(|at| end + length * (1.0 - at as f64 / steps as f64));
                std::iter::repeat_n(end + length, waits).chain(moving).collect::<Vec<f64>>()
            };
            let (into, out) = (way(readings[0]), way(readings[readings.len() - 1]));
            let all: Vec<f64> = into.iter().chain(&readings).chain(out.iter().rev()).copied().collect();
            let found = feed_arcs(&all);
            let expected = [into.len(), out.len()];
            trimmed += expected.iter().filter(|count| **count > 0).count();
            let near = (0..2).all(|at| found[at].abs_diff(expected[at]) <= 2 + spike);
            assert!(near, "{round}: {found:?}, not {expected:?} of {}", all.len());
        }
        assert!(trimmed > 4000, "{trimmed}");
    }

    #[test]
    fn ramps_are_found_and_circles_left_alone() {
        // A shifted, oval circle with noise.
        let circle = |i: usize| {
            let a = i as f64 * 0.01;
            0.02 * a.cos() - 0.015 * a.sin() + 0.004 * (2.0 * a).sin() + 1e-4 * ((i * i * 37 % 101) as f64 / 50.0 - 1.0)
        };
        let plain: Vec<f64> = (0..620).map(circle).collect();
        assert_eq!(feed_arcs(&plain), [0, 0]);
        for count in [0, 1, 2, 3, 100] {
            assert_eq!(feed_arcs(&vec![3.0; count]), [0, 0]);
        }
        // From a millimetre inside onto it in 40 steps, and away outward in 25.
        let to = |n: usize| (0..n).map(move |i| i as f64 / n as f64 - 1.0 + circle(0));
        let from = (1..=25).map(|i| 0.9 * i as f64 / 25.0 + circle(619));
        let fed: Vec<f64> = to(40).chain(plain.iter().copied()).chain(from).collect();
        assert_eq!(feed_arcs(&fed), [40, 25]);
        // Reversal spikes at the ends are part of the circle.
        let mut spikes = plain.clone();
        [0, 1, 618, 619].iter().for_each(|at| spikes[*at] += 0.012);
        assert_eq!(feed_arcs(&spikes), [0, 0]);
    }

    #[test]
    fn a_way_that_goes_nowhere_is_none() {
        let zigzag = (4..120).map(|at| if at % 2 == 0 { 1.0 } else { -1.0 } + 0.01 * at as f64);
        let readings: Vec<f64> = [0.0, 0.0, 1.0, 0.0].into_iter().chain(zigzag).collect();
        assert_eq!(feed_arcs(&readings), [0, 0]);
    }

    #[test]
    fn a_way_as_slow_as_the_circle_is_doubted() {
        let circle = |i: usize| 0.3 * (i as f64 * 0.01).cos() + 0.003 * (i as f64 * 0.02).sin();
        let plain: Vec<_> = (0..620).map(|i| (i as f64 * 0.01, circle(i))).collect();
        assert_eq!(doubtful(plain.iter().copied()), [false, false]);
        let mut fed = plain;
        (0..50).for_each(|i| fed[i].1 -= 0.25 * (1.0 - i as f64 / 50.0));
        let readings: Vec<f64> = fed.iter().map(|sample| sample.1).collect();
        assert_eq!((feed_arcs(&readings), doubtful(fed.iter().copied())), ([0, 0], [true, false]));
    }
}
