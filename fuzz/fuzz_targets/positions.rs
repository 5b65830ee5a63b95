//! Files of positions, held to each model whose runs are probed; what is taken is written and read again.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use std::sync::OnceLock;
use trunnion::data::{Positions, positions_text};
use trunnion::study::{Measurement, Setup};
use trunnion_fuzz::{finite, repeated};

const MODELS: [&str; 3] = ["ac-trunnion-probe", "bc-trunnion-probe", "b-head-c-table-probe"];

fn setups() -> &'static [(Setup, Vec<Measurement>)] {
    static SETUPS: OnceLock<Vec<(Setup, Vec<Measurement>)>> = OnceLock::new();
    SETUPS.get_or_init(|| {
        let setup = |name: &&str| Setup::from_catalogue(name, &[]).expect("a model of the catalogue");
        MODELS.iter().map(setup).map(|setup| (setup.clone(), setup.measurements())).collect()
    })
}

fuzz_target!(|text: &str| -> Corpus {
    let Ok(positions) = repeated(|| Positions::read(text)) else { return Corpus::Reject };
    for (setup, measurements) in setups() {
        let Ok(sweeps) = repeated(|| positions.sweeps(setup, measurements)) else { continue };
        finite(&sweeps);
        let written = positions_text("", measurements, &sweeps);
        let again = Positions::read(&written).expect("what is written is read");
        // A position is written to 1e-9°: two that are nearer to each other become one.
        if let Ok(again) = again.sweeps(setup, measurements) {
            let pairs = again.iter().flatten().zip(sweeps.iter().flatten());
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9), "{written}");
        }
    }
    Corpus::Keep
});
