//! Both runs of the paper in two steps: rows built from the angles, everything fitted.

use crate::blocked::{self, Model};
use crate::dense::{self, RADIUS};
use crate::{heap, time};
use nalgebra::DVector;
use std::fs;
use trunnion::Setup;
use trunnion::study::{self, Estimator, Observation, Sample};
use trunnion_solver::tilting::{Joint, Lengths, TwoStep};

/// The largest error of a coefficient, as a share of it.
fn error(values: &[f64], exact: &[f64]) -> f64 {
    let errors = values.iter().zip(exact).map(|(v, e)| ((v - e) / e).abs());
    errors.fold(0.0, |largest: f64, error| if error.is_nan() { error } else { largest.max(error) })
}

pub fn run(samples: usize, exact: &str) {
    let exact: Vec<f64> =
        fs::read_to_string(exact).expect("a file").split_whitespace().map(|v| v.parse().expect("a number")).collect();
    let (angles, readings) = dense::data(samples);
    // `held` are bytes that are not on the heap.
    let show = |name: &str, error: f64, held: usize, fit: &dyn Fn()| {
        let ns = time(fit) / samples as f64;
        println!("{name};{ns:.1};{error:.1e};{:.1}", (heap(fit) + held) as f64 / 1e3);
    };

    let qr = || dense::two_steps(&angles, &readings);
    show("nalgebra, QR", error(&qr(), &exact), 0, &|| {
        std::hint::black_box(qr());
    });

    let blocked = || blocked::fit(RADIUS, &angles, &readings);
    show("Trunnion, blocked, f64", error(&blocked(), &exact), 0, &|| drop(blocked()));
    let whole = || blocked::solve(RADIUS, &angles, &readings);
    let off = error(whole().coefficients.as_slice(), &exact);
    show("Trunnion, blocked, f64, with covariance and condition", off, 0, &|| drop(whole()));
    let model = Model::new();
    let read = || model.fit(RADIUS, &angles, &readings);
    show("Trunnion, blocked, f64, a model read at run time", error(&read(), &exact), 0, &|| drop(read()));

    let setup = Setup::from_catalogue("tilting-table-a", &[("R", RADIUS)]).expect("a set-up");
    let known = setup.derivation.runs.raw[0].known.len();
    let sample = |(&sweep, &reading): (&f64, &f64), known: usize| Sample {
        sweep,
        direction: 1.0,
        reading,
        known: vec![0.0; known],
        known_std: Vec::new(),
    };
    let observations: Vec<Observation> = ["tilting", "separation"]
        .iter()
        .zip(&readings)
        .zip([known, 0])
        .map(|((name, y), known)| Observation {
            run: setup.run(name).expect("a run"),
            weight: 1.0,
            samples: angles.iter().zip(y).map(|pair| sample(pair, known)).collect(),
        })
        .collect();
    let fit = || study::fit(&setup, &observations, Estimator::TwoStep).expect("a whole turn").values;
    let off = error(fit().as_slice(), &exact);
    show("Trunnion, `study::fit`: blocked, and a look at the residuals", off, 0, &|| drop(fit()));

    macro_rules! stream {
        ($name:literal, $estimator:ident, $t:ty, $compared:expr) => {{
            let angles: Vec<$t> = angles.iter().map(|&a| a as $t).collect();
            let readings = readings.each_ref().map(|y| y.iter().map(|&y| y as $t).collect::<Vec<_>>());
            let fit = || {
                let mut fit = $estimator::new(Lengths { r: RADIUS as $t }).expect("a radius");
                for (&a, (&y1, &y2)) in angles.iter().zip(readings[0].iter().zip(&readings[1])) {
                    fit.push_tilting(a, y1, 0.0, 0.0).expect("a sample");
                    fit.push_separation(a, y2).expect("a sample");
                }
                let estimate = fit.solve().expect("a whole turn");
                DVector::from_iterator(13, estimate.solution.coefficients.iter().map(|&c| f64::from(c)))
            };
            let compared: bool = $compared;
            let off = if compared { error(fit().as_slice(), &exact) } else { f64::NAN };
            show($name, off, size_of::<$estimator<$t>>(), &|| drop(fit()));
        }};
    }
    stream!("Trunnion, streamed, f64", TwoStep, f64, true);
    stream!("Trunnion, streamed, f32", TwoStep, f32, true);
    stream!("Trunnion, joint, streamed, f64", Joint, f64, false);
}
