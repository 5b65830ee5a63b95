//! Random machines, each described in a model file, held to a reference that shares no code with the derivation: what a run
//! reads, what all runs determine, and both estimates with their covariance.

mod draw;
mod dual;
mod estimates;
mod machine;
mod reference;
mod space;
mod told;
mod wave;

use chacha20::ChaCha8Rng;
use machine::Machine;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;
use reference::{Linear, Reference, stacked};
use space::{Space, in_units};
use trunnion::Setup;
use trunnion_codegen::basis::Coordinate;
use trunnion_codegen::ids::{AxisId, ParameterId, RunId};

const MACHINES: u64 = 200;
const SAMPLES: usize = 72;

/// A drawn machine as the public API derives it, beside its reference.
pub struct Case<'a> {
    reference: Reference<'a>,
    setup: Setup,
    /// Sweeps of each run, rad.
    sweeps: Vec<Vec<f64>>,
    /// What each run reads of all errors, and without those that are left out of it where their axis rests.
    whole: Vec<DMatrix<f64>>,
    folded: Vec<DMatrix<f64>>,
    known: Vec<Vec<Linear>>,
    /// What the assumptions leave of the parameters.
    within: DMatrix<f64>,
    /// What all runs tell, with all errors and without those left out.
    space: Space,
    folded_space: Space,
}

impl<'a> Case<'a> {
    fn new(machine: &'a Machine, text: &str, random: &mut ChaCha8Rng) -> Self {
        let reference = Reference::new(machine);
        let setup = Setup::from_description(text, &wave::LENGTHS).expect("the drawn machine is derived");
        let sweeps: Vec<Vec<f64>> =
            machine.runs.iter().map(|_| (0..SAMPLES).map(|_| random.random_range(-4.0..10.0)).collect()).collect();
        let rows = |left_out: &dyn Fn(usize, &str) -> bool| -> Vec<Vec<Linear>> {
            let runs = machine.runs.iter().zip(&sweeps).enumerate();
            let run = |(n, (run, sweeps)): (usize, (_, &Vec<f64>))| {
                sweeps.iter().map(|sweep| reference.linear(run, *sweep, |error| left_out(n, error))).collect()
            };
            runs.map(run).collect()
        };
        let matrices = |runs: &[Vec<Linear>]| -> Vec<DMatrix<f64>> {
            runs.iter().map(|r| stacked(r.iter().map(|l| l.row.clone()).collect(), reference.width())).collect()
        };
        let known = rows(&|n, error| left_out(&setup, n, error));
        let (whole, folded) = (matrices(&rows(&|_, _| false)), matrices(&known));
        let all = together(&whole, reference.width());
        let within = in_units(&all, reference.within());
        let space = Space::new(&all, &within);
        let folded_space = Space::new(&together(&folded, reference.width()), &within);
        Self { reference, setup, sweeps, whole, folded, known, within, space, folded_space }
    }

    /// A derived parameter's place in the reference.
    fn name(&self, parameter: ParameterId) -> &str {
        &self.setup.derivation.parameters[parameter].name
    }
}

/// Whether the derivation leaves an error out of a run, as one of an axis at rest that others stand for.
fn left_out(setup: &Setup, run: usize, error: &str) -> bool {
    let (model, run) = (&setup.model, &setup.model.runs[RunId::from(run)]);
    let Some(id) = model.alphabet.find_error(error) else { return false };
    let rests = |(i, axis): (usize, &trunnion_codegen::model::Axis)| {
        let own = axis.motion.contains(&id) || axis.location.contains(&Some(id));
        own && run.at[AxisId::from(i)] == Coordinate::Rest
    };
    run.left_out.contains(&id) || model.axes().enumerate().any(rests)
}

fn together(matrices: &[DMatrix<f64>], width: usize) -> DMatrix<f64> {
    let rows = matrices.iter().flat_map(|m| m.row_iter().map(|row| row.into_owned()).collect::<Vec<_>>());
    stacked(rows.collect(), width)
}

/// Shows the machine that failed.
struct Shown(u64, String);

impl Drop for Shown {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("machine {}:\n{}", self.0, self.1);
        }
    }
}

#[test]
fn drawn_machines_are_what_dual_numbers_say() {
    (0..MACHINES).into_par_iter().for_each(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let machine = draw::draw(&mut random);
        let shown = Shown(seed, machine.text());
        let case = Case::new(&machine, &shown.1, &mut random);
        told::readings(&case);
        told::rank(&case);
        told::functions(&case);
        estimates::check(&case, &mut random);
    });
}
