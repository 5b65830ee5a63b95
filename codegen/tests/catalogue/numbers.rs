//! Models at numbers: derivations, repeatable angles, constants.

use trunnion_codegen::catalogue;
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// A model of the catalogue, derived.
pub fn derived(name: &str) -> (Model, Derivation) {
    read(catalogue::source(name).unwrap())
}

/// A model file, derived.
pub fn read(source: &str) -> (Model, Derivation) {
    read_and_derive(source).unwrap_or_else(|p| panic!("{}", render("", source, &p, Colour::Off)))
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
