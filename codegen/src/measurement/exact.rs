//! What an instrument reads exactly: nothing truncated, at any sizes of the errors.

use crate::algebra::at;
use crate::kinematics::{ErrorValues, ExactRun, Places};
use crate::lanes::{LANES, Lanes, in_blocks};
use crate::model::{Model, ReadingKind, Run};

/// A run and its instrument with everything nominal worked out at each of its samples; only the errors are missing.
#[derive(Clone, Debug)]
pub struct ExactReading {
    run: ExactRun,
    instrument: Instrument,
}

#[derive(Clone, Debug)]
enum Instrument {
    /// The bar's nominal length, mm.
    Bar(f64),
    /// The unit vector at every sample.
    Displacement([Vec<Lanes>; 3]),
}

impl ExactReading {
    /// Works out `run` at the given values of its sweep (rad); `constant` gives the set-up's lengths in mm.
    pub fn new(model: &Model, run: &Run, sweeps: &[f64], constant: &impl Fn(&str) -> f64) -> Self {
        let instrument = match &run.reading {
            ReadingKind::BarLength(radius) => Instrument::Bar(constant(&model.alphabet.nominal_name(*radius))),
            ReadingKind::Displacement(direction) => Instrument::Displacement(
                direction
                    .each_ref()
                    .map(|p| in_blocks(sweeps.iter().map(|&sweep| at(p, &model.alphabet, sweep, constant)))),
            ),
        };
        Self { run: ExactRun::new(model, run, sweeps, constant), instrument }
    }

    /// The machine along the run.
    pub fn run(&self) -> &ExactRun {
        &self.run
    }

    /// The reading at every sample, mm: the bar's length less its nominal length, T(4), or `n · (TB − WB)`.
    pub fn values(&self, errors: &impl ErrorValues) -> impl Iterator<Item = f64> {
        let mut readings = vec![0.0; self.run.samples()];
        self.read(errors, &mut readings);
        readings.into_iter()
    }

    /// Writes the reading at every sample, mm; without allocating, to be inlined where vector instructions are at hand.
    #[inline(always)]
    pub fn read(&self, errors: &impl ErrorValues, readings: &mut [f64]) {
        let blocks = self.run.samples().div_ceil(LANES);
        let mut balls = [[[0.0; LANES]; 3]; 2];
        for (block, readings) in readings.chunks_mut(LANES).take(blocks).enumerate() {
            self.run.balls(block, errors, &mut balls);
            let [workpiece, tool] = &balls;
            let mut values = [0.0; LANES];
            match &self.instrument {
                Instrument::Bar(radius) => {
                    for (i, value) in values.iter_mut().enumerate() {
                        let (x, y, z) = apart(workpiece, tool, i);
                        *value = (x * x + y * y + z * z).sqrt() - radius;
                    }
                }
                Instrument::Displacement([along_x, along_y, along_z]) => {
                    let (nx, ny, nz) = (&along_x[block], &along_y[block], &along_z[block]);
                    for (i, value) in values.iter_mut().enumerate() {
                        let (x, y, z) = apart(workpiece, tool, i);
                        *value = nx[i] * x + ny[i] * y + nz[i] * z;
                    }
                }
            }
            readings.copy_from_slice(&values[..readings.len()]);
        }
    }
}

/// TB − WB at a sample of a block.
#[inline(always)]
fn apart(workpiece: &Places, tool: &Places, i: usize) -> (f64, f64, f64) {
    (tool[0][i] - workpiece[0][i], tool[1][i] - workpiece[1][i], tool[2][i] - workpiece[2][i])
}
