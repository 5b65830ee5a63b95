//! Readings and residuals of a recording over its sweep, in steps: in constant memory, however many there are.

use super::rows::Taken;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Steps of a turn.
const STEPS: f64 = 720.0;
/// Points of one direction, at most.
const MOST: usize = 720;

/// What was read over one step of the sweep, in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracePoint {
    /// The mean sweep, rad.
    pub sweep: f64,
    /// Samples there.
    pub samples: usize,
    /// Their mean reading, mm.
    pub reading: f64,
    /// Their mean residual, mm.
    pub residual: f64,
    /// The least and the largest of their residuals, mm.
    pub residuals: [f64; 2],
}

/// A recording over its sweep, each direction in rising order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// With the sweep increasing, or in no known order.
    pub increasing: Vec<TracePoint>,
    /// With the sweep decreasing.
    pub decreasing: Vec<TracePoint>,
}

/// A recording on its way into steps: those of either direction, and the one that the last samples were in.
#[derive(Clone, Debug, Default)]
pub(super) struct Tracing {
    steps: [BTreeMap<i32, TracePoint>; 2],
    open: Option<(bool, i32, TracePoint)>,
}

impl Tracing {
    /// The next sample with its residual, mm.
    pub fn add(&mut self, taken: Taken, residual: f64) {
        let step = (taken.sweep / TAU * STEPS).floor() as i32;
        let one =
            TracePoint { sweep: taken.sweep, samples: 1, reading: taken.reading, residual, residuals: [residual; 2] };
        let back = taken.direction < 0.0;
        match &mut self.open {
            Some((way, at, sum)) if (*way, *at) == (back, step) => *sum = both(*sum, one),
            _ => {
                self.close();
                self.open = Some((back, step, one));
            }
        }
    }

    /// Puts the open step to the others.
    fn close(&mut self) {
        if let Some((back, step, open)) = self.open.take() {
            let steps = &mut self.steps[usize::from(back)];
            steps.entry(step).and_modify(|sum| *sum = both(*sum, open)).or_insert(open);
        }
    }

    /// What was recorded.
    pub fn trace(mut self) -> Trace {
        self.close();
        let [increasing, decreasing] = self.steps.map(points);
        Trace { increasing, decreasing }
    }
}

/// Two points as one: means and extremes of the samples of both.
fn both(a: TracePoint, b: TracePoint) -> TracePoint {
    let samples = a.samples + b.samples;
    let share = b.samples as f64 / samples as f64;
    let mean = |a: f64, b: f64| a + (b - a) * share;
    TracePoint {
        sweep: mean(a.sweep, b.sweep),
        samples,
        reading: mean(a.reading, b.reading),
        residual: mean(a.residual, b.residual),
        residuals: [a.residuals[0].min(b.residuals[0]), a.residuals[1].max(b.residuals[1])],
    }
}

/// Neighbouring steps put together, two by two, until there are not too many.
fn points(mut steps: BTreeMap<i32, TracePoint>) -> Vec<TracePoint> {
    while steps.len() > MOST {
        let mut coarser: BTreeMap<i32, TracePoint> = BTreeMap::new();
        for (step, point) in steps {
            coarser.entry(step.div_euclid(2)).and_modify(|sum| *sum = both(*sum, point)).or_insert(point);
        }
        steps = coarser;
    }
    steps.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_extremes_are_those_of_all_samples() {
        let mut tracing = Tracing::default();
        // Ten turns up and down: more steps than are kept, 20 samples in each.
        let samples = 10 * 720 * 20;
        for k in 0..samples {
            let turns = 10.0 * (f64::from(k) + 0.5) / f64::from(samples);
            let taken = |direction| Taken { sweep: turns * TAU, direction, reading: f64::from(k) };
            tracing.add(taken(1.0), f64::from(k % 7));
            tracing.add(taken(-1.0), -1.0);
        }
        let Trace { increasing, decreasing } = tracing.trace();
        assert_eq!((increasing.len(), decreasing.len()), (450, 450));
        assert_eq!(increasing.iter().map(|p| p.samples).sum::<usize>(), samples as usize);
        assert!(increasing.iter().all(|p| p.residuals == [0.0, 6.0] && p.samples == 320));
        let first = increasing[0];
        assert!((first.reading - 159.5).abs() < 1e-9 && (first.sweep - TAU * 10.0 / 900.0).abs() < 1e-9);
        let mean: f64 = (0..320).map(|k| f64::from(k % 7)).sum::<f64>() / 320.0;
        assert!((first.residual - mean).abs() < 1e-12 && decreasing[7].residuals == [-1.0; 2]);
    }
}
