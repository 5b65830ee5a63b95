//! Readings of a run: a file to samples, samples to a fit and its report.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use trunnion::{Estimator, Setup, data, study};
use trunnion_fuzz::{file, finite, repeated};

/// As little as has a run, an estimate and something that a table would give.
const MODEL: &str = r#"
name = "table"
constants = ["R"]
workpiece = ["C"]
estimate = ["EXC"]
[axis.C]
rotary = "z"
location = ["EX0C", "EY0C"]
[run.along]
sweep = "a"
at = { C = "a" }
workpiece_ball = { setup = ["w_x", "w_y", "w_z"] }
tool_ball = { at = ["R", "0", "0"], setup = ["t_x", "t_y", "t_z"] }
reading = "R"
nuisance = ["lateral play EXC"]
[function]
EXC = { fourier = 2 }
"#;

static SETUP: LazyLock<Setup> =
    LazyLock::new(|| Setup::from_description(MODEL, &[("R", 150.0)]).expect("a machine that can be measured"));

fuzz_target!(|bytes: &[u8]| {
    let file = file(bytes);
    let radius = data::Radius::new(150.0).expect("a length");
    if let Ok(sweep) = repeated(|| data::Sweep::read(&file, "a", radius, 1)) {
        finite(&sweep);
    }
    let Ok(observations) = repeated(|| data::observations(&SETUP, &[("along", &file)], None)) else {
        return;
    };
    for estimator in [Estimator::Joint, Estimator::TwoStep] {
        let told = repeated(|| {
            let fit = study::fit(&SETUP, &observations, estimator).ok()?;
            let (limits, instrument) = (study::ErrorLimits::PAPER, study::Instrument::default());
            study::report(&SETUP, &observations, &fit, limits, &instrument, true).ok()
        });
        if let Some(report) = told {
            finite(&report);
        }
    }
});
