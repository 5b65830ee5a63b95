//! Models at numbers: derivations, repeatable angles, constants.

use trunnion_codegen::algebra::{Nominal, NominalId, nominal_value};
use trunnion_codegen::catalogue;
use trunnion_codegen::identify::{Derivation, derive};
use trunnion_codegen::model::{DraftRun, Model, Text, read_draft};
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// A model of the catalogue, derived.
pub fn derived(name: &str) -> (Model, Derivation) {
    read(catalogue::source(name).unwrap())
}

/// A model file, derived.
pub fn read(source: &str) -> (Model, Derivation) {
    read_and_derive(source).unwrap_or_else(|p| panic!("{}", render("", source, &p, Colour::Off)))
}

/// A model of the catalogue with every term that moves with the feed in its first runs, as many as there are symbols for.
pub fn moving_with_the_feed(name: &str) -> (Model, Derivation) {
    let draft = read_draft(catalogue::source(name).unwrap()).unwrap();
    let with = |runs: usize| {
        let mut draft = draft.clone();
        draft.runs.iter_mut().take(runs).for_each(|run| run.nuisance = terms(run));
        draft.build().ok()
    };
    let model = (1..=draft.runs.len()).rev().find_map(with).unwrap();
    let derivation = derive(&model).unwrap();
    (model, derivation)
}

/// Every nuisance term that a run may have.
fn terms(run: &DraftRun) -> Vec<Text> {
    let moves = |at: &str| at.contains(&run.sweep.value) && at != "rest";
    let moving: Vec<&str> = run.at.iter().filter(|(_, at)| moves(&at.value)).map(|(a, _)| a.value.as_str()).collect();
    let each = moving.iter().flat_map(|axis| [format!("backlash {axis}"), format!("lateral play EX{axis}")]);
    let mismatch = (moving.len() > 1).then(|| "mismatch".to_owned());
    let lag = moving.first().map(|axis| format!("lag {axis}"));
    each.chain(mismatch).chain(lag).map(Text::from).collect()
}

/// Value of a symbol along a path.
pub fn value_at(model: &Model, id: NominalId, sweep: f64, direction: f64) -> f64 {
    let value = nominal_value(id, &model.alphabet, sweep, &millimetres);
    if matches!(model.alphabet.nominal(id), Nominal::Sense { .. }) { direction * value } else { value }
}

/// Repeatable values, uniform between `low` and `high`, by a linear congruential generator (Knuth, MMIX).
pub fn uniform(seed: u64, low: f64, high: f64, count: usize) -> Vec<f64> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    next();
    (0..count).map(|_| next()).collect()
}

/// Lengths of the set-up, no two in a simple ratio.
pub fn millimetres(name: &str) -> f64 {
    match name {
        "R" => 150.0,
        "L" => 83.0,
        "H" => 61.7,
        other => panic!("no length for {other}"),
    }
}
