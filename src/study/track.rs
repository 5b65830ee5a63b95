//! Runs along which many machines are measured: what does not depend on the machine is worked out once.

use super::coordinates::Coordinates;
use super::draw::SimulatedMachine;
use super::setup::Setup;
use super::shape::{coordinates, parts};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::graph::{LANES, Lanes, in_blocks};
use trunnion_codegen::ids::{AxisId, RunId};
use trunnion_codegen::kinematics::{At, ErrorValues};
use trunnion_codegen::measurement::ExactReading;
use trunnion_solver::sized::{Work, vectorised};
use typed_index_collections::TiVec;

/// A run at its samples.
pub(super) struct Track {
    exact: ExactReading,
    coordinates: TiVec<AxisId, Coordinates>,
}

impl Track {
    /// A run at the given values of its sweep, rad.
    pub fn new(setup: &Setup, run: RunId, sweeps: &[f64]) -> Self {
        let exact = setup.exact(run, sweeps);
        let all = setup.model.alphabet.errors();
        let all: Vec<_> = all.filter_map(|(id, ..)| Some((setup.model.axis_of(id)?.0, parts(setup, id)))).collect();
        let along = |axis: AxisId| {
            let own = all.iter().filter(|(of, _)| *of == axis);
            let x = exact.run().coordinates(axis).map(|x| x.unwrap_or(0.0)).collect();
            coordinates(x, own.flat_map(|(_, shapes)| shapes))
        };
        let coordinates = (0..setup.model.axes().count()).map(|axis| along(axis.into())).collect();
        Self { exact, coordinates }
    }

    /// The run and its instrument.
    pub fn exact(&self) -> &ExactReading {
        &self.exact
    }

    /// How many samples it has.
    pub fn samples(&self) -> usize {
        self.exact.run().samples()
    }

    /// Writes what is read at every sample on a machine with all its errors times a factor, mm.
    pub fn read(&self, machine: &SimulatedMachine, factor: f64, readings: &mut [f64]) {
        vectorised(Read { on: On { track: self, machine, factor }, readings });
    }
}

/// A machine on a track, its errors times a factor.
struct On<'a> {
    track: &'a Track,
    machine: &'a SimulatedMachine,
    factor: f64,
}

impl ErrorValues for On<'_> {
    fn value(&self, error: ErrorId, coordinate: f64) -> f64 {
        self.machine.value(error, coordinate) * self.factor
    }

    #[inline(always)]
    fn along(&self, error: ErrorId, at: At, values: &mut Lanes) {
        self.machine.shape(error).along(&self.track.coordinates[at.axis], at.block, values);
        if self.factor != 1.0 {
            values.iter_mut().for_each(|value| *value *= self.factor);
        }
    }
}

struct Read<'a> {
    on: On<'a>,
    readings: &'a mut [f64],
}

impl Work for Read<'_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        self.on.track.exact.read(&self.on, self.readings);
    }
}

/// All runs of a measurement; their readings stand one behind the other.
pub(super) struct Tracks(TiVec<RunId, (Track, Vec<KnownFunction>)>);

/// A known function of a run, with its factor in every reading.
struct KnownFunction {
    error: ErrorId,
    axis: AxisId,
    factors: Vec<Lanes>,
}

impl Tracks {
    /// Every run of the model at the given values of its sweep, rad.
    pub fn new(setup: &Setup, sweeps: &TiVec<RunId, Vec<f64>>) -> Self {
        let track = |(run, sweeps): (RunId, &Vec<f64>)| {
            let mut row = setup.row(run);
            let factors: Vec<Vec<f64>> = sweeps.iter().map(|&sweep| row.at(sweep, 1.0).1.to_vec()).collect();
            let known = setup.derivation.runs[run].known.iter().enumerate().filter_map(|(at, (function, _))| {
                let error = setup.model.functions[*function].error;
                let (axis, _) = setup.model.axis_of(error)?;
                Some(KnownFunction { error, axis, factors: in_blocks(factors.iter().map(|f| f[at])) })
            });
            (Track::new(setup, run, sweeps), known.collect())
        };
        Self(sweeps.iter_enumerated().map(track).collect())
    }

    /// The runs and their instruments.
    pub fn exact(&self) -> impl Iterator<Item = &ExactReading> {
        self.0.iter().map(|(track, _)| track.exact())
    }

    /// How many readings there are.
    pub fn samples(&self) -> usize {
        self.0.iter().map(|(track, _)| track.samples()).sum()
    }

    /// Writes what is read on a machine, mm.
    pub fn read(&self, machine: &SimulatedMachine, readings: &mut [f64]) {
        let mut rest = readings;
        for (track, _) in &self.0 {
            let (own, others) = rest.split_at_mut(track.samples());
            track.read(machine, 1.0, own);
            rest = others;
        }
    }

    /// Takes the known functions' part from what is read on a machine.
    pub fn explain(&self, machine: &SimulatedMachine, readings: &mut [f64]) {
        let mut rest = readings;
        for (track, known) in &self.0 {
            let (own, others) = rest.split_at_mut(track.samples());
            let on = Read { on: On { track, machine, factor: 1.0 }, readings: own };
            vectorised(Explain { on, known });
            rest = others;
        }
    }
}

struct Explain<'a> {
    on: Read<'a>,
    known: &'a [KnownFunction],
}

impl Work for Explain<'_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        let Read { on: On { track, machine, .. }, readings } = self.on;
        for (block, readings) in readings.chunks_mut(LANES).enumerate() {
            let (mut sum, mut values) = ([0.0; LANES], [0.0; LANES]);
            for known in self.known {
                machine.shape(known.error).along(&track.coordinates[known.axis], block, &mut values);
                for (sum, (factor, value)) in sum.iter_mut().zip(known.factors[block].iter().zip(&values)) {
                    *sum += factor * value;
                }
            }
            readings.iter_mut().zip(sum).for_each(|(reading, sum)| *reading -= sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{ErrorLimits, Population, grid};
    use chacha20::ChaCha8Rng;
    use rand::SeedableRng;
    use std::f64::consts::TAU;
    use trunnion_codegen::catalogue::MODELS;

    #[test]
    fn what_was_worked_out_before_is_what_comes_out_point_by_point() {
        for (name, _) in MODELS {
            let setup = Setup::from_catalogue(name, &[]).unwrap();
            // More than a block, the last one not full.
            let sweeps: TiVec<RunId, Vec<f64>> =
                setup.model.runs.keys().map(|run| setup.swept(run, 90, (-0.3, TAU + 0.3))).collect();
            let tracks = Tracks::new(&setup, &sweeps);
            let machines = Population::new(&setup, tracks.exact(), ErrorLimits::PAPER);
            let machine = machines.draw(&mut ChaCha8Rng::seed_from_u64(3));
            let mut readings = vec![0.0; tracks.samples()];
            tracks.read(&machine, &mut readings);
            let exact: Vec<f64> = tracks.exact().flat_map(|exact| exact.values(&machine)).collect();
            assert_eq!(readings, exact, "{name}");
            tracks.explain(&machine, &mut readings);
            let explained = setup.model.runs.keys().zip(tracks.exact()).flat_map(|(run, exact)| {
                let (known, mut row) = (setup.true_known(run, exact, &machine), setup.row(run));
                let own = |(i, (reading, &sweep)): (usize, (f64, &f64))| {
                    let factors = row.at(sweep, 1.0).1.iter();
                    reading - factors.zip(known.get(i).into_iter().flatten()).map(|(f, k)| f * k).sum::<f64>()
                };
                exact.values(&machine).zip(&sweeps[run]).enumerate().map(own).collect::<Vec<f64>>()
            });
            assert_eq!(readings, explained.collect::<Vec<f64>>(), "{name}");
        }
    }

    #[test]
    fn the_largest_size_of_a_drawn_error_is_within_its_limit_and_reaches_all_of_it() {
        let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
        let sweeps: TiVec<RunId, Vec<f64>> = setup
            .model
            .runs
            .keys()
            .map(|run| grid(90, (-0.7, 1.0 + f64::from(u8::from(usize::from(run) > 0)))))
            .collect();
        let tracks = Tracks::new(&setup, &sweeps);
        let machines = Population::new(&setup, tracks.exact(), ErrorLimits::PAPER);
        let mut largest = vec![0.0f64; setup.model.alphabet.errors().count()];
        for n in 0..400 {
            let mut random = ChaCha8Rng::seed_from_u64(1);
            random.set_stream(n);
            let machine = machines.draw(&mut random);
            for (error, ..) in setup.model.alphabet.errors() {
                let axis = setup.model.axis_of(error).map(|(axis, _)| axis);
                let along = tracks.exact().flat_map(|exact| match axis {
                    Some(axis) => exact.run().coordinates(axis).flatten().collect(),
                    None => vec![0.0],
                });
                let size = along.map(|x| machine.value(error, x).abs()).fold(0.0, f64::max);
                let share = size / setup.limit(error, ErrorLimits::PAPER);
                assert!(share <= 1.0 + 1e-12, "{share}");
                largest[error.index()] = largest[error.index()].max(share);
            }
        }
        assert!(largest.iter().all(|share| *share == 0.0 || *share > 0.98), "{largest:?}");
    }
}
