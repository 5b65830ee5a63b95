//! The blocked factor with rows of a run-time model, as the program fits recorded data.

use trunnion_codegen::catalogue;
use trunnion_codegen::emit::model::run;
use trunnion_codegen::graph::{BlockEvaluator, LANES, Tape};
use trunnion_codegen::identify::derive;
use trunnion_solver::lstsq::Step;
use trunnion_solver::sized::{Block, Columns, ROWS, Work, estimator, vectorised};

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
            let (mut columns, mut y) = (vec![[0.0; ROWS]; places.len()], [0.0; ROWS]);
            for (angles, readings) in angles.chunks(ROWS).zip(readings.chunks(ROWS)) {
                for (half, angles) in angles.chunks(LANES).enumerate() {
                    rows.inputs()[1][..angles.len()].copy_from_slice(angles);
                    vectorised(Evaluate(&mut rows));
                    for (at, &place) in places.iter().enumerate() {
                        let x = rows.output(at).expect("a regressor");
                        columns[place][half * LANES..(half + 1) * LANES].copy_from_slice(x);
                    }
                }
                y[..readings.len()].copy_from_slice(readings);
                let block = Block { columns: &mut columns, y: &mut y };
                problem.push(step, block, readings.len(), 1.0).expect("samples");
            }
        }
        problem.solve(None).ok().expect("a whole turn").coefficients.as_slice().to_vec()
    }
}
