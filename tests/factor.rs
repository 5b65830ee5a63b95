//! The part of a fit that is a sum: merged, written and read, it is that of all samples.

use trunnion::study::{
    BytesError, ErrorLimits, Estimator, Factor, FactorError, Failed, Fit, Observation, Simulation, Variance, fit,
};
use trunnion::{Setup, study};

const SIMULATION: Simulation =
    Simulation { seed: 5, samples: 1000, noise_um: 0.1, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) };

fn measured(mm: f64) -> (Setup, Vec<Observation>) {
    let setup = Setup::from_catalogue("tilting-table-a", &[("R", mm)]).unwrap();
    let observations = SIMULATION.measure(&setup).observations.raw;
    (setup, observations)
}

/// Every run in so many pieces.
fn pieces(observations: &[Observation], count: usize) -> Vec<Observation> {
    let of = |o: &Observation| {
        let size = o.samples.len().div_ceil(count);
        o.samples.chunks(size).map(|samples| Observation { samples: samples.to_vec(), ..o.clone() }).collect::<Vec<_>>()
    };
    observations.iter().flat_map(of).collect()
}

fn factor(setup: &Setup, estimator: Estimator, observations: &[Observation]) -> Factor {
    let mut factor = Factor::new(setup, estimator).unwrap();
    observations.iter().for_each(|o| factor.push(setup, o).unwrap());
    factor
}

/// By how much two estimates differ, in standard deviations and as a share of the covariance.
fn apart(a: &Fit, b: &Fit) -> f64 {
    assert_eq!(a.base, b.base);
    assert_eq!(a.degrees_of_freedom, b.degrees_of_freedom);
    let std = b.covariance.diagonal().map(f64::sqrt);
    let values = (&a.values - &b.values).component_div(&std).amax();
    let scaled =
        |fit: &Fit| nalgebra::DMatrix::from_fn(std.len(), std.len(), |i, j| fit.covariance[(i, j)] / (std[i] * std[j]));
    values.max((scaled(a) - scaled(b)).amax())
}

#[test]
fn parts_merged_in_any_order_are_the_whole() {
    let (setup, observations) = measured(150.0);
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let whole = fit(&setup, &observations, estimator).unwrap();
        let one = factor(&setup, estimator, &observations);
        assert_eq!(one.samples(), 2000);
        let (alone, _) = one.solve(&setup, Variance::Residual).unwrap();
        assert_eq!((&alone.values, &alone.covariance), (&whole.values, &whole.covariance), "not a bit differs");
        let mut parts: Vec<Factor> =
            pieces(&observations, 7).into_iter().map(|piece| factor(&setup, estimator, &[piece])).collect();
        for turn in 0..4 {
            let mut merged = Factor::new(&setup, estimator).unwrap();
            parts.iter().for_each(|part| merged.merge(part).unwrap());
            assert_eq!(merged.samples(), 2000);
            let off = apart(&merged.solve(&setup, Variance::Residual).unwrap().0, &whole);
            assert!(off < 1e-8, "{estimator}, turn {turn}: {off:e}");
            parts.rotate_left(5);
        }
    }
}

#[test]
fn bytes_give_the_same_factor() {
    let (setup, observations) = measured(150.0);
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let mut one = factor(&setup, estimator, &observations[..1]);
        let mut other = Factor::from_bytes(&one.to_bytes()).unwrap();
        assert_eq!(one.to_bytes(), other.to_bytes());
        assert_eq!(one.clone().to_bytes(), other.to_bytes());
        // They go on alike.
        one.push(&setup, &observations[1]).unwrap();
        other.push(&setup, &observations[1]).unwrap();
        let off = apart(
            &one.solve(&setup, Variance::Residual).unwrap().0,
            &other.solve(&setup, Variance::Residual).unwrap().0,
        );
        assert!(off < 1e-8, "{off:e}");
    }
}

#[test]
fn any_other_bytes_are_refused() {
    let (setup, observations) = measured(150.0);
    let bytes = factor(&setup, Estimator::TwoStep, &observations).to_bytes();
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 1 << (at % 8);
        let refused = Factor::from_bytes(&changed).unwrap_err();
        let expected = match at {
            0..8 => matches!(refused, BytesError::NoFactor),
            8..10 => matches!(refused, BytesError::Version(_)),
            _ => refused == BytesError::Damaged,
        };
        assert!(expected, "byte {at}: {refused}");
        assert!(Factor::from_bytes(&bytes[..at]).is_err(), "cut at {at}");
    }
    assert_eq!(Factor::from_bytes(&[bytes.as_slice(), &[0]].concat()).unwrap_err(), BytesError::Damaged);
}

#[test]
fn bytes_that_add_up_but_are_no_factor_are_refused() {
    use sha2::{Digest, Sha256};
    let (setup, observations) = measured(150.0);
    let bytes = factor(&setup, Estimator::Joint, &observations).to_bytes();
    let columns = study::fit(&setup, &observations, Estimator::Joint).unwrap().base.len();
    // The numbers stand before the check, the residual sum of squares last.
    let first = bytes.len() - 8 - 8 * (columns * (columns + 2) + 1);
    let with = |at: usize, value: f64| {
        let mut changed = bytes[..bytes.len() - 8].to_vec();
        changed[at..at + 8].copy_from_slice(&value.to_le_bytes());
        let check = Sha256::digest(&changed);
        changed.extend(&check[..8]);
        Factor::from_bytes(&changed)
    };
    let kept = f64::from_le_bytes(bytes[first..first + 8].try_into().unwrap());
    assert!(with(first, kept).is_ok());
    for at in (first..bytes.len() - 8).step_by(8) {
        for value in [f64::NAN, f64::INFINITY, -f64::MAX, f64::MAX] {
            // Merged and solved, whatever it is, it gives a status or a finite result.
            assert!(matches!(with(at, value), Err(BytesError::Impossible(_))), "{value} at {at}");
        }
    }
    assert!(matches!(with(first, -1.0), Err(BytesError::Impossible(_))), "a negative square");
    // What is kept of each run stands between the columns and the numbers: whatever is there, it is refused or adds up.
    let lists = 46 + [columns, 0, 0].iter().map(|n| 1 + n).sum::<usize>();
    for at in (lists..first - 4).step_by(11) {
        for change in [0x01_u8, 0x80, 0xff] {
            let mut changed = bytes[..bytes.len() - 8].to_vec();
            changed[at] ^= change;
            let check = Sha256::digest(&changed);
            changed.extend(&check[..8]);
            let Ok(other) = Factor::from_bytes(&changed) else { continue };
            match other.solve(&setup, Variance::Residual) {
                Ok((fit, standing)) => {
                    assert!(fit.rms.iter().all(|rms| rms.is_finite()), "byte {at}");
                    assert!(standing.iter().all(|o| o.samples.iter().all(|s| s.reading.is_finite())), "byte {at}");
                }
                Err(refused) => assert_eq!(refused, FactorError::Other, "byte {at}"),
            }
        }
    }
    // Another run than the model has, another order of the columns.
    for (at, value) in [(44, 200), (44, 1), (45, 0)].into_iter().chain((46..62).map(|at| (at, 3))) {
        let mut changed = bytes[..bytes.len() - 8].to_vec();
        changed[at] = value;
        let check = Sha256::digest(&changed);
        changed.extend(&check[..8]);
        let Ok(mut other) = Factor::from_bytes(&changed) else { continue };
        if other.to_bytes() != bytes {
            let (solved, pushed) = (other.solve(&setup, Variance::Residual), other.push(&setup, &observations[0]));
            assert!(matches!(solved, Err(FactorError::Other)), "byte {at}");
            assert!(matches!(pushed, Err(Failed::Estimate(FactorError::Other))), "byte {at}");
        }
    }
}

#[test]
fn factors_of_other_set_ups_are_refused() {
    let (setup, observations) = measured(150.0);
    let (longer, _) = measured(100.0);
    let mut own = factor(&setup, Estimator::Joint, &observations);
    let before = own.to_bytes();
    for other in [factor(&longer, Estimator::Joint, &observations), factor(&setup, Estimator::TwoStep, &observations)] {
        assert_eq!(own.merge(&other), Err(FactorError::Other));
        assert_eq!(own.to_bytes(), before);
    }
    assert!(matches!(own.solve(&longer, Variance::Residual), Err(FactorError::Other)));
    assert!(matches!(own.push(&longer, &observations[0]), Err(Failed::Estimate(FactorError::Other))));
    let nothing = Factor::new(&setup, Estimator::Joint).unwrap().solve(&setup, Variance::Residual).unwrap_err();
    assert!(nothing.to_string().starts_with("tilting, separation: 0 samples"), "{nothing}");
}
