//! Positions that are proposed for a touch probe: never worse than spread evenly, the best there are, what they are said to give.

mod axes;
mod commands;
#[path = "../program/mod.rs"]
mod program;

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use trunnion::study::plan::positions::{Asked, Chosen, Count, Proposed, propose};
use trunnion::study::{Measurement, Setup};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::basis::Basis;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::quantity::Unit;

const MODELS: [&str; 3] = ["ac-trunnion-probe", "bc-trunnion-probe", "b-head-c-table-probe"];

fn asked(setup: &Setup, count: Count, step_deg: f64) -> Asked {
    Asked { functions: setup.estimated().collect(), count, step_deg, sigma: Unit::Um.to_inner(1.0) }
}

fn stds(chosen: &Chosen, functions: &[FunctionId]) -> Vec<f64> {
    let of =
        |f: &FunctionId| chosen.prediction.functions.iter().find(|own| own.function == *f).unwrap().largest.unwrap();
    functions.iter().map(|f| of(f).std).collect()
}

/// One error that is the same everywhere or grows with its axis' coordinate, all others zero.
struct Only {
    error: ErrorId,
    slope: bool,
    size: f64,
}

impl ErrorValues for Only {
    fn value(&self, error: ErrorId, coordinate: f64) -> f64 {
        if error != self.error {
            return 0.0;
        }
        if self.slope { self.size * coordinate } else { self.size }
    }
}

/// Normal equations of the exact machine's derivatives: no base parameter, no row and no solver is in them.
struct Normal<'a> {
    setup: &'a Setup,
    measurements: &'a [Measurement],
    /// Errors that are the same everywhere, and scales.
    unknowns: Vec<(ErrorId, bool)>,
    /// Directions of which the readings say something, of unknowns in the scale of what the readings say of each.
    seen: DMatrix<f64>,
    scale: Vec<f64>,
}

impl<'a> Normal<'a> {
    /// Of what all of some positions say.
    fn new(setup: &'a Setup, measurements: &'a [Measurement], all: &[Vec<f64>]) -> Self {
        let model = &setup.model;
        let motion: Vec<ErrorId> = model.axes().flat_map(|axis| axis.motion.iter().copied()).collect();
        let grows = |error| model.functions.iter().any(|f| f.error == error && f.basis != Basis::Zero);
        let errors = model.alphabet.errors().map(|(error, _, _)| (error, motion.contains(&error)));
        let unknowns: Vec<(ErrorId, bool)> = errors.filter(|(error, moves)| !moves || grows(*error)).collect();
        let count = unknowns.len();
        let seen = DMatrix::identity(count, count);
        let mut own = Self { setup, measurements, unknowns, seen, scale: vec![1.0; count] };
        let sum = |own: &Self| {
            all.iter().enumerate().fold(DMatrix::zeros(count, count), |sum, (run, at)| sum + own.told(run, at))
        };
        own.scale = sum(&own).diagonal().iter().map(|x| x.sqrt().max(1e-9)).collect();
        let eigen = SymmetricEigen::new(sum(&own));
        let kept: Vec<usize> = (0..count).filter(|&i| eigen.eigenvalues[i] > 1e-7).collect();
        own.seen = eigen.eigenvectors.select_columns(&kept);
        own
    }

    /// What readings at positions of a run say.
    fn told(&self, run: usize, at: &[f64]) -> DMatrix<f64> {
        let columns = self.measurements[run].runs.iter().map(|&run| {
            let exact = self.setup.exact(run, at);
            let column = |(&(error, slope), scale): (&(ErrorId, bool), &f64)| {
                let read = |size: f64| exact.values(&Only { error, slope, size }).collect::<Vec<_>>();
                let (up, down) = (read(1e-5), read(-1e-5));
                DVector::from_iterator(at.len(), up.iter().zip(&down).map(|(up, down)| (up - down) / 2e-5 / scale))
            };
            DMatrix::from_columns(&self.unknowns.iter().zip(&self.scale).map(column).collect::<Vec<_>>())
        });
        let sum = columns.map(|own| own.tr_mul(&own)).reduce(|a, b| a + b).unwrap();
        self.seen.tr_mul(&sum) * &self.seen
    }

    /// Standard deviations of the estimated functions for a reading's of 1 µm, mm or rad; none of what is not determined.
    fn stds(&self, told: &DMatrix<f64>) -> Option<Vec<f64>> {
        let inverse = told.clone().cholesky()?.inverse();
        let std = |function: FunctionId| {
            let error = self.setup.model.functions[function].error;
            let at = self.unknowns.iter().position(|(own, _)| *own == error).unwrap();
            let own = self.seen.row(at);
            // All of it is seen.
            assert!((own.norm() - 1.0).abs() < 1e-6, "{}: {}", self.setup.function_name(function), own.norm());
            1e-3 * (own * &inverse * own.transpose())[(0, 0)].sqrt() / self.scale[at]
        };
        Some(self.setup.estimated().map(std).collect())
    }

    fn at(&self, positions: &[Vec<f64>]) -> Option<Vec<f64>> {
        let told = positions.iter().enumerate().map(|(run, at)| self.told(run, at)).reduce(|a, b| a + b).unwrap();
        self.stds(&told)
    }
}

#[test]
fn none_is_less_certain_than_evenly_spread_and_all_are_as_certain_as_normal_equations_say() {
    for name in MODELS {
        let setup = Setup::from_catalogue(name, &[]).unwrap();
        let of = |count| propose(&setup, &asked(&setup, count, 10.0)).unwrap();
        for (count, proposed) in [(8, of(Count::Each(8))), (24, of(Count::InAll(24)))] {
            let Proposed { measurements, evenly, proposed } = proposed;
            let functions: Vec<FunctionId> = setup.estimated().collect();
            let (even, best) = (stds(&evenly, &functions), stds(&proposed, &functions));
            let shares: Vec<f64> = best.iter().zip(&even).map(|(own, even)| own / even).collect();
            println!("{name}, {count}: {shares:.3?} {:.0?}", degrees(&proposed.positions));
            assert!(shares.iter().all(|share| *share < 1.0 + 1e-4), "{name}: {shares:?}");
            // On a cradle that tilts to one side more than to the other, there is something to be gained.
            assert!(shares.iter().fold(0.0, |a: f64, b| a.max(*b)) < 0.985, "{name}: {shares:?}");
            for (chosen, said) in [(&evenly, even), (&proposed, best)] {
                let normal = Normal::new(&setup, &measurements, &evenly.positions);
                let independent = normal.at(&chosen.positions).unwrap();
                for ((own, said), function) in independent.iter().zip(said).zip(&functions) {
                    let name = setup.function_name(*function);
                    assert!((own / said - 1.0).abs() < 1e-5, "{name}: {said} and not {own}");
                }
            }
        }
    }
}

fn degrees(positions: &[Vec<f64>]) -> Vec<Vec<f64>> {
    positions.iter().map(|own| own.iter().map(|x| x.to_degrees()).collect()).collect()
}

/// Every choice of `count` of the numbers below `of`.
fn choices(of: usize, count: usize) -> Vec<Vec<usize>> {
    (0..1usize << of)
        .filter(|bits| bits.count_ones() as usize == count)
        .map(|bits| (0..of).filter(|i| bits >> i & 1 == 1).collect())
        .collect()
}

#[test]
fn of_few_positions_the_best_of_all_subsets_are_found() {
    for (name, step, count, wanted) in [
        ("ac-trunnion-probe", 45.0, Count::InAll(17), &[][..]),
        ("ac-trunnion-probe", 45.0, Count::InAll(17), &["EB0A", "EC0A"]),
        ("bc-trunnion-probe", 45.0, Count::InAll(18), &[]),
        ("bc-trunnion-probe", 45.0, Count::InAll(18), &["EA0B", "EC0B"]),
        ("b-head-c-table-probe", 30.0, Count::Each(6), &["EX0S"]),
        ("b-head-c-table-probe", 30.0, Count::InAll(12), &["EZ0S", "EB0C"]),
        ("b-head-c-table-probe", 30.0, Count::Each(6), &["EA0C"]),
    ] {
        let setup = Setup::from_catalogue(name, &[]).unwrap();
        let Proposed { measurements, evenly, proposed } = {
            let whole = asked(&setup, count.clone(), step);
            let is = |f: &FunctionId| wanted.is_empty() || wanted.contains(&setup.function_name(*f).as_str());
            let functions = whole.functions.iter().copied().filter(is).collect();
            propose(&setup, &Asked { functions, ..whole }).unwrap()
        };
        // Where the runs can stop: as said, multiples of the step and the ends of ranges.
        let grid: Vec<Vec<f64>> = measurements
            .iter()
            .map(|own| {
                let run = &setup.model.runs[own.first().unwrap()];
                let letter = setup.model.alphabet.sweep_name(run.sweep).to_uppercase();
                let axis = setup.model.axes().find(|axis| axis.name == letter).unwrap();
                let [low, high] = axis.range.map_or([0.0, 359.9], |range| range.map(|x| x.to_degrees().round()));
                let inside = |x: &f64| *x > low && *x < high;
                let mut all: Vec<f64> = (-24..24).map(|i| f64::from(i) * step).filter(inside).collect();
                all.push(low);
                all.extend(axis.range.map(|_| high));
                all.into_iter().map(f64::to_radians).collect()
            })
            .collect();
        let normal = Normal::new(&setup, &measurements, &grid);
        let even = normal.at(&evenly.positions).unwrap();
        let names: Vec<String> = setup.estimated().map(|f| setup.function_name(f)).collect();
        let share = |stds: Vec<f64>| {
            let shares = stds.iter().zip(&even).map(|(own, even)| own / even).zip(&names);
            let of = shares.filter(|(_, name)| wanted.is_empty() || wanted.contains(&name.as_str()));
            of.map(|(share, _)| share).fold(0.0, f64::max)
        };
        let places: Vec<(usize, f64)> =
            grid.iter().enumerate().flat_map(|(run, own)| own.iter().map(move |x| (run, *x))).collect();
        let told: Vec<DMatrix<f64>> = places.iter().map(|(run, x)| normal.told(*run, &[*x])).collect();
        let all = proposed.positions.iter().map(Vec::len).sum();
        let enough = |set: &Vec<usize>| {
            (0..grid.len()).all(|run| {
                let own = set.iter().filter(|i| places[**i].0 == run).count();
                match count {
                    Count::Each(count) => own == count,
                    _ => own >= setup.least(&measurements[run].runs),
                }
            })
        };
        let weighed = |set: Vec<usize>| normal.stds(&set.iter().map(|i| &told[*i]).sum()).map_or(f64::INFINITY, share);
        let best = choices(places.len(), all).into_iter().filter(enough).map(weighed).fold(f64::INFINITY, f64::min);
        let found = share(normal.at(&proposed.positions).unwrap());
        println!("{name}, {step}°, {count:?}, {wanted:?}: {found:.5}, best {best:.5}");
        // Where none is better than evenly spread, those are proposed.
        assert!((found / best.min(1.0) - 1.0).abs() < 3e-5, "{name}, {count:?}: {found} and not {best}");
    }
}

#[test]
fn the_same_are_proposed_on_however_many_processors() {
    let setup = Setup::from_catalogue("bc-trunnion-probe", &[]).unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| propose(&setup, &asked(&setup, Count::InAll(24), 10.0)).unwrap().proposed.positions)
    };
    assert_eq!(on(1), on(3));
}

/// The fewest are enough, and a few fewer would not be.
#[test]
fn the_fewest_are_within_what_is_asked() {
    let setup = Setup::from_catalogue("b-head-c-table-probe", &[]).unwrap();
    let functions: Vec<FunctionId> = setup.estimated().collect();
    let within: Vec<f64> = functions.iter().map(|f| setup.quantity(*f).deviation().to_inner(1.0)).collect();
    let largest = |count: Count| {
        let chosen = propose(&setup, &Asked { sigma: 1e-4, ..asked(&setup, count, 15.0) }).unwrap().proposed;
        let u95 = |f| chosen.prediction.functions.iter().find(|own| own.function == f).unwrap().largest.unwrap().u95;
        let share = functions.iter().zip(&within).map(|(f, within)| u95(*f) / within).fold(0.0, f64::max);
        (chosen.positions.iter().map(Vec::len).sum::<usize>(), share)
    };
    let (count, share) = largest(Count::Fewest(within.clone()));
    println!("{count} positions: {share:.3}");
    assert!((0.85..=1.0).contains(&share));
    // Of fewer these are those that are best against what evenly spread ones give, which is nearly the same.
    assert!(largest(Count::InAll(count - 2)).1 > 1.0);
    let nothing = Asked { count: Count::Fewest(vec![1e-9; functions.len()]), ..asked(&setup, Count::Each(4), 15.0) };
    assert!(propose(&setup, &nothing).unwrap_err().to_string().contains("all"));
}
