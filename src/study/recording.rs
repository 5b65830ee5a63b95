//! The samples of a run, wherever they are kept.

use super::observation::{Observation, Sample};
use core::convert::Infallible;
use trunnion_codegen::ids::RunId;

/// A recorded run, whose samples can be gone through more than once.
pub trait Recording {
    /// Why they cannot.
    type Error;

    /// The run.
    fn run(&self) -> RunId;

    /// Weight of each sample: one over the variance of its reading, up to a common factor.
    fn weight(&self) -> f64;

    /// Whether it is known which way the sweep went.
    fn is_ordered(&self) -> bool;

    /// Calls `each` for every sample, in the order in which they were taken.
    ///
    /// # Errors
    /// The samples cannot be had.
    fn each(&self, each: &mut dyn FnMut(&Sample)) -> Result<(), Self::Error>;
}

impl Recording for Observation {
    type Error = Infallible;

    fn run(&self) -> RunId {
        self.run
    }

    fn weight(&self) -> f64 {
        self.weight
    }

    fn is_ordered(&self) -> bool {
        self.samples.iter().any(|s| s.direction != 0.0)
    }

    fn each(&self, each: &mut dyn FnMut(&Sample)) -> Result<(), Infallible> {
        self.samples.iter().for_each(each);
        Ok(())
    }
}

/// Samples of a recording that stand for all of it where a smooth function of the sweep is summed or looked at.
pub(super) const FEW: usize = 720;

/// Every so many-th sample of a recording, the last one, and those at either end of the sweep.
#[derive(Clone, Debug, Default)]
pub struct Few {
    kept: Vec<(usize, Sample)>,
    step: usize,
    samples: usize,
    ends: Option<[(usize, Sample); 3]>,
}

impl Few {
    /// The next sample.
    pub fn add(&mut self, sample: &Sample) {
        let at = self.samples;
        self.samples += 1;
        self.step = self.step.max(1);
        if at.is_multiple_of(self.step) {
            if self.kept.len() == FEW {
                self.step *= 2;
                let step = self.step;
                self.kept.retain(|(at, _)| at.is_multiple_of(step));
            }
            if at.is_multiple_of(self.step) {
                self.kept.push((at, sample.clone()));
            }
        }
        match &mut self.ends {
            None => self.ends = Some(std::array::from_fn(|_| (at, sample.clone()))),
            Some([low, high, last]) => {
                let put = |to: &mut (usize, Sample)| {
                    to.0 = at;
                    to.1.clone_from(sample);
                };
                if sample.sweep < low.1.sweep {
                    put(low);
                }
                if sample.sweep > high.1.sweep {
                    put(high);
                }
                put(last);
            }
        }
    }

    /// The samples kept and those at `others`, as an observation in which all together weigh as much as the recording.
    ///
    /// # Errors
    /// The recording cannot be gone through again.
    pub fn standing_for<R: Recording>(self, recording: &R, others: &[usize]) -> Result<Observation, R::Error> {
        let mut kept = self.kept;
        kept.extend(self.ends.into_iter().flatten());
        if self.step > 1 && !others.is_empty() {
            let mut at = 0;
            recording.each(&mut |sample| {
                if others.binary_search(&at).is_ok() {
                    kept.push((at, sample.clone()));
                }
                at += 1;
            })?;
        }
        kept.sort_by_key(|(at, _)| *at);
        kept.dedup_by_key(|(at, _)| *at);
        let each = self.samples as f64 / kept.len().max(1) as f64;
        let samples = kept.into_iter().map(|(_, sample)| sample).collect();
        Ok(Observation { run: recording.run(), weight: recording.weight() * each, samples })
    }
}
