//! Which way a sweep goes, from samples in the order in which they were taken.

use core::f64::consts::{PI, TAU};

/// Samples between two turns of the direction, at least: fewer are no order in time.
const PER_TURN: usize = 8;

/// 1 at each sample where the sweep (rad) increases, −1 where it decreases; 0 everywhere where the samples are in no order in
/// time. An angle that starts again at the end of a turn goes on, and a repeated one belongs to the way it was reached.
pub fn directions(sweeps: &[f64]) -> Vec<f64> {
    let step = |pair: &[f64]| match pair[1] - pair[0] {
        by if by.abs() > PI && by.is_finite() => by - TAU * (by / TAU).round(),
        by => by,
    };
    let mut directions: Vec<f64> = Vec::with_capacity(sweeps.len());
    for pair in sweeps.windows(2) {
        let by = step(pair);
        let last = directions.last().copied().unwrap_or(0.0);
        directions.push(if by == 0.0 { last } else { by.signum() });
    }
    // A step leads to the sample behind it; what comes before the first one goes as it does.
    let first = directions.iter().copied().find(|d| *d != 0.0).unwrap_or(0.0);
    directions.iter_mut().take_while(|d| **d == 0.0).for_each(|d| *d = first);
    directions.insert(0, first);
    directions.truncate(sweeps.len());
    let turns = directions.windows(2).filter(|pair| pair[0] != pair[1]).count();
    if turns * PER_TURN > sweeps.len() {
        directions.fill(0.0);
    }
    directions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_down_wrapped_repeated_and_in_no_order() {
        let up: Vec<f64> = (0..20).map(|i| 0.3 * f64::from(i)).collect();
        let both: Vec<f64> = up.iter().chain(up.iter().rev()).copied().collect();
        let expected: Vec<f64> = [1.0; 21].into_iter().chain([-1.0; 19]).collect();
        assert_eq!(directions(&both), expected, "the turning point was reached upwards, both times");
        let wrapped: Vec<f64> = up.iter().map(|a| (a + 1.0) % TAU).collect();
        assert_eq!(directions(&wrapped), [1.0; 20]);
        let shuffled: Vec<f64> = (0..20).map(|i| f64::from((i * 7) % 20)).collect();
        assert_eq!(directions(&shuffled), [0.0; 20]);
        assert_eq!(directions(&[1.0]), [0.0]);
        assert!(directions(&[]).is_empty());
        assert_eq!(directions(&[2.0; 5]), [0.0; 5]);
    }
}
