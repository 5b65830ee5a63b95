//! Two steps against the dense linear map from readings to estimates, and the covariance of the readings pushed through it.

use nalgebra::{DMatrix, DVector, SVector};
use proptest::prelude::*;
use trunnion_solver::lstsq::{Factor, Order, OrderError, SolveError, Step, TwoStepError};

const P: usize = 6;
type Row = [f64; P];

/// A run's samples: regressors at the base parameters' positions (zero where the run does not see one), reading, weight.
type Run = Vec<(Row, f64, f64)>;

/// The runs of both steps, and what each step is about.
#[derive(Debug)]
struct Model {
    steps: [Vec<Run>; 2],
    first: Vec<usize>,
    own: Vec<usize>,
    given: Vec<usize>,
}

impl Model {
    /// Runs that see the base parameters of their masks. What none sees is added to the last.
    fn new(first: &[[bool; P]], second: &[[bool; P]], seed: u64) -> Self {
        let mut state = seed;
        let mut uniform = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut masks = [first.to_vec(), second.to_vec()];
        let seen = |masks: &[[bool; P]], b: usize| masks.iter().any(|mask| mask[b]);
        let unseen = |b| !seen(first, b) && !seen(second, b);
        let last = masks[1].last_mut().unwrap();
        (0..P).filter(|&b| unseen(b)).for_each(|b| last[b] = true);
        let at = |wanted: &dyn Fn(usize) -> bool| (0..P).filter(|&b| wanted(b)).collect::<Vec<_>>();
        let (in_first, in_second) = (|b| seen(&masks[0], b), |b| seen(&masks[1], b));
        let [first, own, given] =
            [at(&in_first), at(&|b| in_second(b) && !in_first(b)), at(&|b| in_second(b) && in_first(b))];
        let steps = masks.map(|runs| {
            let run = |mask: [bool; P]| -> Run {
                let weight = 1.0 + 0.9 * uniform();
                (0..2 * P).map(|_| (mask.map(|sees| if sees { uniform() } else { 0.0 }), uniform(), weight)).collect()
            };
            runs.into_iter().map(run).collect()
        });
        Self { steps, first, own, given }
    }

    /// The factor of a step whose columns are the base parameters `at`; columns beyond are zero.
    fn factor(&self, step: usize, at: &[usize]) -> Factor<f64, P> {
        let mut factor = Factor::new();
        for (row, y, weight) in self.steps[step].iter().flatten() {
            let mut x = [0.0; P];
            x.iter_mut().zip(at).for_each(|(x, &b)| *x = row[b]);
            factor.push_weighted(&SVector::from(x), *y, *weight).unwrap();
        }
        factor
    }

    fn factors(&self) -> [Factor<f64, P>; 2] {
        [self.factor(0, &self.first), self.factor(1, &[&self.own[..], &self.given].concat())]
    }

    fn order(&self) -> Order<P, P, P> {
        Order::new(&self.first, &self.own, &self.given).unwrap()
    }

    fn design(&self, step: usize, at: &[usize]) -> DMatrix<f64> {
        let rows: Vec<&Row> = self.steps[step].iter().flatten().map(|(row, ..)| row).collect();
        DMatrix::from_fn(rows.len(), at.len(), |i, j| rows[i][at[j]])
    }

    fn readings(&self, step: usize) -> DVector<f64> {
        DVector::from_iterator(self.weights(step).len(), self.steps[step].iter().flatten().map(|s| s.1))
    }

    fn weights(&self, step: usize) -> DVector<f64> {
        DVector::from_vec(self.steps[step].iter().flatten().map(|s| s.2).collect())
    }

    /// The map from the readings of one step to the coefficients it estimates, its given columns being known.
    fn pseudo_inverse(&self, step: usize, at: &[usize]) -> DMatrix<f64> {
        let root = DMatrix::from_diagonal(&self.weights(step).map(f64::sqrt));
        match at {
            [] => DMatrix::zeros(0, root.ncols()),
            _ => (&root * self.design(step, at)).pseudo_inverse(1e-12).unwrap() * root,
        }
    }

    /// The whole linear map, for each step a matrix of P rows: d estimate / d readings.
    fn map(&self) -> [DMatrix<f64>; 2] {
        let k = self.pseudo_inverse(0, &self.first);
        let e = self.pseudo_inverse(1, &self.own);
        let mut maps = [DMatrix::zeros(P, k.ncols()), DMatrix::zeros(P, e.ncols())];
        let all_k = {
            let mut all = DMatrix::zeros(P, k.ncols());
            self.first.iter().enumerate().for_each(|(i, &b)| all.set_row(b, &k.row(i)));
            all
        };
        let given = DMatrix::from_fn(self.given.len(), k.ncols(), |i, j| all_k[(self.given[i], j)]);
        let moved = -&e * self.design(1, &self.given) * given;
        maps[0] = all_k;
        for (i, &b) in self.own.iter().enumerate() {
            maps[0].set_row(b, &moved.row(i));
            maps[1].set_row(b, &e.row(i));
        }
        maps
    }

    /// Residual variance at weight one, of a step from which `n` coefficients were estimated.
    fn variance(&self, step: usize, estimate: &DVector<f64>, n: usize) -> f64 {
        let all: Vec<usize> = (0..P).collect();
        let residual = self.readings(step) - self.design(step, &all) * estimate;
        residual.component_mul(&residual).dot(&self.weights(step)) / (residual.len() - n) as f64
    }
}

fn near(a: &DMatrix<f64>, b: &DMatrix<f64>) {
    assert!((a - b).amax() <= 1e-9 * b.amax().max(1e-12), "{a} {b}");
}

fn check(model: &Model) {
    let (order, [first, second]) = (model.order(), model.factors());
    let solution = order.solve(&first, &second).unwrap();
    let map = model.map();
    let estimate = &map[0] * model.readings(0) + &map[1] * model.readings(1);
    near(
        &DMatrix::from_column_slice(P, 1, solution.coefficients.as_slice()),
        &DMatrix::from_column_slice(P, 1, estimate.as_slice()),
    );

    let variances = [model.variance(0, &estimate, model.first.len()), model.variance(1, &estimate, model.own.len())];
    let pushed = |variances: [f64; 2]| -> DMatrix<f64> {
        let through = |step: usize| {
            let readings = model.weights(step).map(|w| variances[step] / w);
            &map[step] * DMatrix::from_diagonal(&readings) * map[step].transpose()
        };
        through(0) + through(1)
    };
    near(&DMatrix::from_column_slice(P, P, solution.covariance.as_slice()), &pushed(variances));
    assert!((solution.residual_std / variances[1].sqrt() - 1.0).abs() < 1e-9);
    assert_eq!(solution.degrees_of_freedom, second.samples() - model.own.len() as u32);
    let known = order.solve_with_sigma(&first, &second, 0.3).unwrap();
    near(&DMatrix::from_column_slice(P, P, known.covariance.as_slice()), &pushed([0.09; 2]));
    assert_eq!(known.coefficients, solution.coefficients);
    assert_eq!(order.coefficients(&first, &second), Ok(solution.coefficients));

    let sensitivity = order.sensitivity(&first, &second).unwrap();
    for (step, moves) in [sensitivity.first, sensitivity.second].iter().enumerate() {
        let rows: Vec<_> = model.steps[step].iter().flatten().collect();
        let of = |j: usize| rows[j].2 * moves * SVector::from(rows[j].0);
        near(&DMatrix::from_fn(P, rows.len(), |i, j| of(j)[i]), &map[step]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_covariance_is_that_of_the_dense_map(
        first in prop::collection::vec(prop::array::uniform6(any::<bool>()), 1..4),
        second in prop::collection::vec(prop::array::uniform6(any::<bool>()), 1..4),
        seed in any::<u64>(),
    ) {
        check(&Model::new(&first, &second, seed));
    }
}

/// One second-step run sees a given coefficient, the other does not: its gain comes from all samples of the step.
#[test]
fn a_run_need_not_see_what_the_other_is_given() {
    let (t, f) = (true, false);
    check(&Model::new(&[[t, t, t, f, f, f]], &[[t, t, f, t, t, t], [t, f, f, t, t, t]], 1));
    // All that the second step sees is given; and nothing is.
    check(&Model::new(&[[t; P]], &[[t, t, f, f, f, f]], 2));
    check(&Model::new(&[[t, t, t, f, f, f]], &[[f, f, f, t, t, t]], 3));
}

#[test]
fn the_given_columns_need_not_be_independent() {
    let mut model = Model::new(&[[true, true, true, false, false, false]], &[[true; P]], 4);
    for (row, ..) in model.steps[1].iter_mut().flatten() {
        row[1] = row[0];
        row[2] = 0.0;
    }
    check(&model);
}

#[test]
fn a_failed_step_is_named_with_the_base_parameters() {
    let mut model = Model::new(&[[true, true, false, false, true, false]], &[[true; P]], 5);
    let order = model.order();
    let [first, second] = model.factors();
    let few = |step, needed| Some(TwoStepError { step, why: SolveError::TooFewSamples { samples: 0, needed } });
    assert_eq!(order.solve(&Factor::new(), &second).err(), few(Step::First, 4));
    assert_eq!(order.solve(&first, &Factor::new()).err(), few(Step::Second, 4));
    assert_eq!(order.solve_with_sigma(&first, &Factor::new(), 1.0).err(), few(Step::Second, 3));
    let not_finite = TwoStepError { step: Step::Second, why: SolveError::NotFinite };
    assert_eq!(order.solve_with_sigma(&first, &second, f64::NAN), Err(not_finite));

    model.steps[1].iter_mut().flatten().for_each(|(row, ..)| row[5] = row[3] - row[2]);
    let [first, second] = model.factors();
    for failed in [
        order.solve(&first, &second).err(),
        order.coefficients(&first, &second).err(),
        order.condition(&first, &second).err(),
    ] {
        let Some(TwoStepError { step: Step::Second, why: SolveError::RankDeficient(confounded) }) = failed else {
            panic!("{failed:?}")
        };
        assert!(confounded.involved.iter().eq([2, 3, 5]));
        assert_eq!((confounded.pivot, confounded.rank, confounded.columns), (5, 2, 3));
    }
}

#[test]
fn the_condition_is_that_of_the_worse_step() {
    let mut model = Model::new(&[[true, true, false, false, true, false]], &[[true; P]], 6);
    let of = |model: &Model| model.order().condition(&model.factors()[0], &model.factors()[1]).unwrap();
    // Half the samples nearly alike in two columns.
    model.steps[0].iter_mut().flatten().for_each(|(row, ..)| row[4] = row[1] + 1e-3 * row[4]);
    let first = of(&model);
    assert!(first.number > 1e3 && first.weakest.iter().eq([1, 4]));
    model.steps[1].iter_mut().flatten().for_each(|(row, ..)| row[5] = row[3] + 1e-5 * row[5]);
    let second = of(&model);
    assert!(second.number > 1e5 && second.weakest.iter().eq([3, 5]));
}

#[test]
fn an_order_covers_each_base_parameter_once() {
    type Narrow = Order<4, 2, 3>;
    assert!(Narrow::new(&[2, 3], &[0, 1], &[3]).is_ok());
    assert_eq!(Narrow::new(&[2, 3], &[0, 1], &[3, 2]), Err(OrderError::TooWide));
    assert_eq!(Narrow::new(&[1, 2, 3], &[0], &[]), Err(OrderError::TooWide));
    assert_eq!(Narrow::new(&[2, 4], &[0, 1], &[]), Err(OrderError::OutOfRange(4)));
    assert_eq!(Narrow::new(&[2, 3], &[0, 1], &[4]), Err(OrderError::OutOfRange(4)));
    assert_eq!(Narrow::new(&[2, 3], &[0, 3], &[]), Err(OrderError::Repeated(3)));
    assert_eq!(Narrow::new(&[2, 3], &[0], &[3, 3]), Err(OrderError::Missing(1)));
    assert_eq!(Order::<3, 2, 3>::new(&[2, 1], &[0], &[1, 1]), Err(OrderError::Repeated(1)));
    assert_eq!(Narrow::new(&[2, 3], &[0, 1], &[0]), Err(OrderError::NotEstimated(0)));
}
