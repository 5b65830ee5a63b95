//! The blocked factor, coefficients alone or all that is known of them: with generated rows, as a program with a model of its own has them, and with those of a model read at run time.

use trunnion_codegen::catalogue;
use trunnion_codegen::emit::model::run;
use trunnion_codegen::graph::{BlockEvaluator, LANES, Tape};
use trunnion_codegen::identify::derive;
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{
    Block, Column, Columns, Estimate, ROWS, Solved, Work, blocks, estimator, spread, vectorised,
};
use trunnion_solver::tilting::{rows_of_separation, rows_of_tilting};

/// Generated rows of both runs.
struct Rows<'a> {
    radius: f64,
    angles: &'a Column<f64>,
    tilting: &'a mut [Column<f64>; 12],
    separation: &'a mut [Column<f64>; 8],
}

impl Work for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        rows_of_tilting(self.radius, self.angles, self.tilting);
        rows_of_separation(self.radius, self.angles, self.separation);
    }
}

/// The coefficients, by a fit with generated rows.
pub fn fit(radius: f64, angles: &[f64], readings: &[Vec<f64>; 2]) -> Vec<f64> {
    coefficients(&*filled(radius, angles, readings))
}

/// The same with covariance, sensitivities and condition.
pub fn solve(radius: f64, angles: &[f64], readings: &[Vec<f64>; 2]) -> Solved {
    filled(radius, angles, readings).solve(None).ok().expect("a whole turn")
}

fn coefficients(problem: &dyn Estimate) -> Vec<f64> {
    problem.coefficients().expect("a whole turn").as_slice().to_vec()
}

fn filled(radius: f64, angles: &[f64], readings: &[Vec<f64>; 2]) -> Box<dyn Estimate> {
    // Of the tilting run, the coefficients that only it sees come first: k6, k7, k8 are copied before e_xa1 and e_xa2.
    let columns =
        Columns { first: vec![2, 3, 4, 5, 6, 10, 11, 12], own: vec![7, 8, 9, 0, 1], given: vec![2, 3, 4, 5, 6] };
    let mut problem = estimator(&columns).expect("a size");
    let (mut tilting, mut separation) = ([[0.0; ROWS]; 15], [[0.0; ROWS]; 8]);
    let (mut a, mut y) = ([0.0; ROWS], [[0.0; ROWS]; 2]);
    for block in 0..blocks(angles.len()) {
        let count = spread(angles, block, &mut a);
        for (y, readings) in y.iter_mut().zip(readings) {
            spread(readings, block, y);
        }
        let of_tilting = tilting.last_chunk_mut().expect("twelve columns");
        vectorised(Rows { radius, angles: &a, tilting: of_tilting, separation: &mut separation });
        tilting.copy_within(10..13, 0);
        let [first, second] = &mut y;
        let pushed = Block { columns: &mut tilting[..10], y: first };
        problem.push(Step::Second, pushed, count, 1.0).expect("samples");
        problem.push(Step::First, Block { columns: &mut separation, y: second }, count, 1.0).expect("samples");
    }
    problem
}

/// The tapes of both runs' rows, and what each step's columns are.
pub struct Model {
    tapes: [Tape; 2],
    columns: Columns,
    /// Column in its step of each regressor of a run.
    places: [Vec<usize>; 2],
}

struct Evaluate<'a, 'b>(&'a mut BlockEvaluator<'b>);

impl Work for Evaluate<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        self.0.evaluate();
    }
}

impl Model {
    pub fn new() -> Self {
        let model = catalogue::model("tilting-table-a").expect("in the catalogue").expect("a model");
        let derivation = derive(&model).expect("a derivation");
        let runs: Vec<_> = model.runs.keys().collect();
        let tape = |k: usize| Tape::new(run(&model, &derivation, runs[k]).expect("a row").program());
        let columns =
            Columns { first: vec![2, 3, 4, 5, 6, 10, 11, 12], own: vec![0, 1, 7, 8, 9], given: vec![2, 3, 4, 5, 6] };
        let place = |k: usize, step: Step| {
            let order = columns.of(step);
            let seen = derivation.runs[runs[k]].regressors.iter().map(|(b, _)| usize::from(*b));
            seen.map(|b| order.iter().position(|c| *c == b).expect("a column")).collect()
        };
        Self { tapes: [tape(0), tape(1)], places: [place(0, Step::Second), place(1, Step::First)], columns }
    }

    pub fn fit(&self, radius: f64, angles: &[f64], readings: &[Vec<f64>; 2]) -> Vec<f64> {
        let mut problem = estimator(&self.columns).expect("a size");
        for ((tape, places), (step, readings)) in
            self.tapes.iter().zip(&self.places).zip([Step::Second, Step::First].into_iter().zip(readings))
        {
            let mut rows = tape.block_evaluator();
            rows.inputs()[0] = [radius; LANES];
            let (mut columns, mut a, mut y) = (vec![[0.0; ROWS]; places.len()], [0.0; ROWS], [0.0; ROWS]);
            for block in 0..blocks(angles.len()) {
                let count = spread(angles, block, &mut a);
                spread(readings, block, &mut y);
                for (half, angles) in a.chunks(LANES).enumerate() {
                    rows.inputs()[1].copy_from_slice(angles);
                    vectorised(Evaluate(&mut rows));
                    for (at, &place) in places.iter().enumerate() {
                        let x = rows.output(at).expect("a regressor");
                        columns[place][half * LANES..(half + 1) * LANES].copy_from_slice(x);
                    }
                }
                let block = Block { columns: &mut columns, y: &mut y };
                problem.push(step, block, count, 1.0).expect("samples");
            }
        }
        coefficients(&*problem)
    }
}
