//! Bytes to a factor, to an estimate: refused, or finite and written again as they were read.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sha2::{Digest, Sha256};
use std::sync::LazyLock;
use trunnion::study::{Estimator, Factor, Observation, Sample, Setup, Variance};
use trunnion_fuzz::finite;

static SETUP: LazyLock<Setup> =
    LazyLock::new(|| Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).expect("in the catalogue"));

/// A whole factor of either estimator: what changes of it is the fuzzer's.
fn whole(two_steps: bool) -> Vec<u8> {
    let setup = &*SETUP;
    let estimator = if two_steps { Estimator::TwoStep } else { Estimator::Joint };
    let mut factor = Factor::new(setup, estimator).expect("the paper's runs");
    for (run, described) in setup.model.runs.iter_enumerated() {
        let known = setup.derivation.runs[run].known.len();
        let sample = |k: u32| Sample {
            sweep: f64::from(k) * 0.1,
            direction: 1.0,
            reading: 1e-3 * f64::from(k % 7),
            known: vec![0.0; known],
            known_std: Vec::new(),
        };
        let observation = Observation { run, weight: 1.0, samples: (0..60).map(sample).collect() };
        factor.push(setup, &observation).unwrap_or_else(|_| panic!("{}", described.name));
    }
    factor.to_bytes()
}

static WHOLE: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| [whole(false), whole(true)]);

fuzz_target!(|bytes: &[u8]| {
    // As they stand, then as changes of whole ones with the digest made right again.
    let [first, rest @ ..] = bytes else { return };
    let mut changed = WHOLE[usize::from(first & 1)].clone();
    for pair in rest.chunks_exact(3) {
        let at = usize::from(u16::from_le_bytes([pair[0], pair[1]])) % changed.len();
        changed[at] ^= pair[2];
    }
    if let Some((body, seal)) = changed.split_last_chunk_mut::<8>() {
        seal.copy_from_slice(&Sha256::digest(&*body)[..8]);
    }
    for bytes in [bytes, &changed] {
        let Ok(factor) = Factor::from_bytes(bytes) else { continue };
        assert_eq!(factor.to_bytes(), bytes);
        if let Ok((fit, observations)) = factor.solve(&SETUP, Variance::Residual) {
            finite(&fit.values);
            assert!(fit.rms.iter().all(|rms| rms.is_finite()));
            assert_eq!(fit.rms.len(), observations.len());
        }
    }
});
