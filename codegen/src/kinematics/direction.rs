//! Which way a sweep goes, from samples in the order in which they were taken.

use core::f64::consts::{PI, TAU};

/// Samples between two turns of the direction, at least: fewer are no order in time.
const PER_TURN: usize = 8;

/// 1 at each sample where the sweep (rad) increases, −1 where it decreases; 0 everywhere where the samples are in no order in
/// time. An angle that starts again at the end of a turn goes on, and a repeated one belongs to the way it was reached.
pub fn directions(sweeps: &[f64]) -> Vec<f64> {
    let mut survey = Headings::default();
    sweeps.iter().for_each(|&sweep| survey.add(sweep));
    let mut heading = survey.start();
    sweeps.iter().map(|&sweep| heading.at(sweep)).collect()
}

/// What a first look at the samples tells of their order.
#[derive(Clone, Copy, Debug, Default)]
pub struct Headings {
    heading: Heading,
    /// The first way that is known.
    first: f64,
    samples: usize,
    turns: usize,
}

impl Headings {
    /// The next sample's sweep, rad.
    pub fn add(&mut self, sweep: f64) {
        let before = self.heading.way;
        let way = self.heading.at(sweep);
        self.samples += 1;
        self.turns += usize::from(before != 0.0 && way != before);
        if self.first == 0.0 {
            self.first = way;
        }
    }

    /// The heading before the first sample, for the second look; what comes before the first step goes as it does.
    pub fn start(&self) -> Heading {
        let ordered = self.turns * PER_TURN <= self.samples;
        Heading { last: None, way: if ordered { self.first } else { 0.0 }, lost: !ordered }
    }
}

/// Which way the sweep goes, sample by sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct Heading {
    last: Option<f64>,
    way: f64,
    /// The samples are in no order.
    lost: bool,
}

impl Heading {
    /// Whether a way is known.
    pub fn is_known(&self) -> bool {
        self.way != 0.0
    }

    /// The way in which the next sample's sweep, rad, is reached; 0 where it is not known.
    pub fn at(&mut self, sweep: f64) -> f64 {
        if !self.lost {
            let by = self.last.map_or(0.0, |last| match sweep - last {
                by if by.abs() > PI && by.is_finite() => by - TAU * (by / TAU).round(),
                by => by,
            });
            if by != 0.0 {
                self.way = by.signum();
            }
            self.last = Some(sweep);
        }
        self.way
    }
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
