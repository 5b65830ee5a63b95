//! The exact rank is the rank in numbers: every parameter's column at random angles, from values alone.

use super::numbers::{derived, read, uniform};
use nalgebra::DMatrix;
use trunnion_codegen::algebra::at;
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::identify::{Derivation, Origin};
use trunnion_codegen::model::Model;

/// Lengths near 1, so that powers of millimetres do not hide a small singular value.
fn length(name: &str) -> f64 {
    match name {
        "R" => 1.0,
        "L" => 0.83,
        _ => 0.617,
    }
}

#[test]
fn exact_ranks_are_the_numerical_ones() {
    for (name, _) in MODELS {
        let (model, derivation) = derived(name);
        check(name, &model, &derivation);
    }
}

/// Two machines on whose way to the base parameters coefficients pass 126 bits.
#[test]
fn ranks_of_large_coefficients() {
    for source in [include_str!("large-three-axes.toml"), include_str!("large-two-axes.toml")] {
        let (model, derivation) = read(source);
        check(&model.name, &model, &derivation);
    }
}

fn check(name: &str, model: &Model, derivation: &Derivation) {
    let alphabet = &model.alphabet;
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (i, run) in model.runs.iter_enumerated() {
        let linear = derivation.runs[i].reading.by_errors();
        for sweep in uniform(usize::from(i) as u64 + 1, -3.2, 3.2, 60) {
            let factor = |error| {
                let coefficient = linear.iter().find(|(m, _)| m.errors().next() == Some(error));
                coefficient.map_or(0.0, |(_, p)| at(p, alphabet, sweep, length))
            };
            let column = |origin: &Origin| match *origin {
                Origin::Constant(error) => factor(error),
                Origin::Coefficient(c) => {
                    let function = &model.functions[c.function];
                    // A location error that is to be found.
                    let Some((axis, _)) = model.axis_of(function.error) else { return factor(function.error) };
                    let Some(coordinate) = run.at[axis].poly() else { return 0.0 };
                    let x = at(coordinate, alphabet, sweep, length);
                    factor(function.error) * function.basis.values(x, alphabet, &length)[c.term]
                }
            };
            rows.push(derivation.parameters.iter().map(|p| column(&p.origin)).collect());
        }
    }
    let mut matrix = DMatrix::from_fn(rows.len(), derivation.parameters.len(), |i, j| rows[i][j]);
    for mut column in matrix.column_iter_mut() {
        let norm = column.norm();
        column /= norm;
    }
    let mut values: Vec<f64> = matrix.singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    let rank = derivation.base.len();
    let (kept, dropped) = (values[rank - 1] / values[0], values.get(rank).map_or(0.0, |v| v / values[0]));
    println!("{name}: rank {rank} of {}, {kept:.1e} kept, {dropped:.1e} dropped", values.len());
    assert!(kept > 1e-9 && dropped < 1e-13, "{name}: {kept:e} kept, {dropped:e} dropped");
    assert_eq!(derivation.kernel.len(), derivation.parameters.len() - rank, "{name}");
}
