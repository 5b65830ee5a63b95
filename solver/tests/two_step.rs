//! Two steps against brute force: the whole linear map from readings to estimates, made of dense pseudo-inverses, and the readings'
//! covariance put through it.

use nalgebra::{DMatrix, DVector, SVector};
use proptest::prelude::*;
use trunnion_solver::lstsq::{Factor, Order, OrderError, SolveError, Step, TwoStepError};

const P: usize = 7;
/// Of the base parameters the first four are the first step's.
const FIRST: usize = 4;

/// A run: which step, which base parameters it sees, its samples' regressors and readings.
#[derive(Clone, Debug)]
struct Run {
    step: Step,
    seen: [bool; P],
    samples: Vec<([f64; P], f64)>,
}

impl Run {
    /// The full row of a sample.
    fn row(&self, regressors: &[f64; P]) -> [f64; P] {
        core::array::from_fn(|b| if self.seen[b] { regressors[b] } else { 0.0 })
    }
}

fn run(step: Step) -> impl Strategy<Value = Run> {
    let sample = (prop::array::uniform7(-2.0..2.0f64), -1.0..1.0f64);
    (prop::array::uniform7(any::<bool>()), prop::collection::vec(sample, 6..14)).prop_map(move |(mut seen, samples)| {
        // A first-step run sees none of the second's own; every run sees one of its own step's.
        seen[FIRST..].iter_mut().for_each(|s| *s &= step == Step::Second);
        seen[if step == Step::First { 0 } else { FIRST }] = true;
        Run { step, seen, samples }
    })
}

/// Several runs of each step: some of the second step do not see what others are given.
fn runs() -> impl Strategy<Value = Vec<Run>> {
    let of = |step| prop::collection::vec(run(step), 2..4);
    (of(Step::First), of(Step::Second)).prop_map(|(first, second)| first.into_iter().chain(second).collect())
}

fn dense(runs: &[Run], step: Step) -> (DMatrix<f64>, DVector<f64>) {
    let samples: Vec<_> =
        runs.iter().filter(|r| r.step == step).flat_map(|r| r.samples.iter().map(|(x, y)| (r.row(x), *y))).collect();
    let x = DMatrix::from_fn(samples.len(), P, |i, b| samples[i].0[b]);
    (x, DVector::from_iterator(samples.len(), samples.iter().map(|(_, y)| *y)))
}

/// Coefficients, their covariance, and the two maps from readings to coefficients.
struct Brute {
    values: DVector<f64>,
    covariance: DMatrix<f64>,
    maps: [DMatrix<f64>; 2],
}

/// `None` where a step's design is nearly singular.
fn brute(runs: &[Run]) -> Option<Brute> {
    let ((x1, y1), (x2, y2)) = (dense(runs, Step::First), dense(runs, Step::Second));
    let (k, e, given) = (x1.columns(0, FIRST), x2.columns(FIRST, P - FIRST), x2.columns(0, FIRST));
    let inverse = |x: DMatrix<f64>| {
        let svd = x.svd(true, true);
        let values = &svd.singular_values;
        (values.min() > 1e-3 * values.max()).then(|| svd.pseudo_inverse(0.0).ok()).flatten()
    };
    let (k_of, e_of) = (inverse(k.into_owned())?, inverse(e.into_owned())?);
    let gain = -&e_of * given;
    let mut first = DMatrix::zeros(P, y1.len());
    first.rows_mut(0, FIRST).copy_from(&k_of);
    first.rows_mut(FIRST, P - FIRST).copy_from(&(&gain * &k_of));
    let mut second = DMatrix::zeros(P, y2.len());
    second.rows_mut(FIRST, P - FIRST).copy_from(&e_of);
    let values = &first * &y1 + &second * &y2;
    let variance = |x: &DMatrix<f64>, y: &DVector<f64>, columns: usize| {
        (y - x * &values).norm_squared() / (y.len() - columns) as f64
    };
    let covariance = &first * first.transpose() * variance(&x1, &y1, FIRST)
        + &second * second.transpose() * variance(&x2, &y2, P - FIRST);
    Some(Brute { values, covariance, maps: [first, second] })
}

/// The second step's own columns first, then all that the first gives.
const ORDER: Order<P, P, P> = match Order::new(&[0, 1, 2, 3], &[4, 5, 6], &[0, 1, 2, 3]) {
    Ok(order) => order,
    Err(_) => panic!("an order of two steps"),
};

fn factors(runs: &[Run]) -> [Factor<f64, P>; 2] {
    let (mut first, mut second) = (Factor::<f64, P>::new(), Factor::<f64, P>::new());
    for run in runs {
        for (x, y) in &run.samples {
            let row = run.row(x);
            match run.step {
                Step::First => first.push(&SVector::from(row), *y),
                Step::Second => second.push(&SVector::from_fn(|i, _| row[(i + FIRST) % P]), *y),
            }
            .unwrap();
        }
    }
    [first, second]
}

fn near(a: &DMatrix<f64>, b: &DMatrix<f64>) -> bool {
    (a - b).amax() <= 1e-8 * (1e-6 + b.amax())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn estimates_and_covariance_are_those_of_brute_force(runs in runs()) {
        let Some(brute) = brute(&runs) else { return Ok(()) };
        let [first, second] = factors(&runs);
        let solution = ORDER.solve(&first, &second).unwrap();
        let matrix = |values: &mut dyn Iterator<Item = f64>, columns| DMatrix::from_iterator(P, columns, values);
        prop_assert!(near(&matrix(&mut solution.coefficients.iter().copied(), 1), &brute.values.columns(0, 1).into_owned()));
        prop_assert!(near(&matrix(&mut solution.covariance.iter().copied(), P), &brute.covariance));

        let sensitivity = ORDER.sensitivity(&first, &second).unwrap();
        for (step, of, map) in [(Step::First, sensitivity.first, &brute.maps[0]), (Step::Second, sensitivity.second, &brute.maps[1])] {
            let (x, _) = dense(&runs, step);
            prop_assert!(near(&(matrix(&mut of.iter().copied(), P) * x.transpose()), map));
        }
        let known = ORDER.solve_with_sigma(&first, &second, 2.0).unwrap();
        let expected = brute.maps.iter().map(|m| m * m.transpose() * 4.0).sum::<DMatrix<f64>>();
        prop_assert!(near(&matrix(&mut known.covariance.iter().copied(), P), &expected));
    }
}

#[test]
fn what_is_given_need_not_be_told_apart_by_the_second_step() {
    let (mut first, mut second) = (Factor::<f64, 2>::new(), Factor::<f64, 3>::new());
    let order = Order::<3, 2, 3>::new(&[1, 2], &[0], &[1, 2]).unwrap();
    for i in 0..10 {
        let x = f64::from(i);
        first.push(&SVector::from([1.0, x]), 0.5 + x).unwrap();
        second.push(&SVector::from([x * x, 1.0, 1.0]), 3.0 * x * x + 1.5).unwrap();
    }
    let solution = order.solve(&first, &second).unwrap();
    assert!((solution.coefficients - SVector::from([3.0, 0.5, 1.0])).amax() < 1e-12);
    assert!(matches!(second.solve(), Err(SolveError::RankDeficient(_))));
}

#[test]
fn a_step_that_fails_is_named_with_its_base_parameters() {
    let order = Order::<3, 2, 2>::new(&[1, 2], &[0], &[2]).unwrap();
    let (mut first, mut second) = (Factor::<f64, 2>::new(), Factor::<f64, 2>::new());
    for _ in 0..5 {
        first.push(&SVector::from([1.0, 2.0]), 1.0).unwrap();
        second.push(&SVector::from([1.0, 0.0]), 1.0).unwrap();
    }
    let TwoStepError { step, why } = order.solve(&first, &second).unwrap_err();
    let SolveError::RankDeficient(confounded) = why else { panic!("{why:?}") };
    assert_eq!((step, confounded.involved.iter().collect::<Vec<_>>()), (Step::First, vec![1, 2]));
    let few = order.solve(&Factor::new(), &second).unwrap_err();
    assert!(matches!(few, TwoStepError { step: Step::First, why: SolveError::TooFewSamples { samples: 0, .. } }));
}

#[test]
fn an_order_that_is_none_is_refused_by_name() {
    assert_eq!(Order::<2, 1, 1>::new(&[0], &[0], &[]), Err(OrderError::Repeated(0)));
    assert_eq!(Order::<3, 1, 1>::new(&[0], &[1], &[]), Err(OrderError::Missing(2)));
    assert_eq!(Order::<2, 1, 2>::new(&[0], &[1], &[1]), Err(OrderError::NotEstimated(1)));
    assert_eq!(Order::<2, 1, 1>::new(&[2], &[1], &[]), Err(OrderError::OutOfRange(2)));
    assert_eq!(Order::<2, 1, 1>::new(&[0], &[1], &[0]), Err(OrderError::TooWide));
}
