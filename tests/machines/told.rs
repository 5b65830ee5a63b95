//! Readings, rank, and what is said of each function.

use super::space::independent;
use super::{Case, together};
use nalgebra::DMatrix;
use trunnion_codegen::ids::{FunctionId, RunId};

/// Regressors times base parameters, and factors of known functions, are the derivatives of the reading.
pub fn readings(case: &Case) {
    let setup = &case.setup;
    let definitions = definitions(case);
    for (n, sweeps) in case.sweeps.iter().enumerate() {
        let run = RunId::from(n);
        let derived = &setup.derivation.runs[run];
        let mut row = setup.row(run);
        for (i, &sweep) in sweeps.iter().enumerate() {
            let (regressors, factors) = row.at(sweep, 1.0);
            let mut read = nalgebra::RowDVector::zeros(case.reference.width());
            let mut size = 1e-3;
            for ((base, _), regressor) in derived.regressors.iter().zip(regressors) {
                let share = definitions.row(usize::from(*base)) * *regressor;
                size += (share.abs() * case.within.abs()).norm();
                read += share;
            }
            let expected = case.folded[n].row(i);
            let off = ((read - expected) * &case.within).norm();
            assert!(off <= 1e-10 * size, "run {n} at {sweep}: {off:e} of {size:e}");
            let known = &case.known[n][i].known;
            for ((function, _), factor) in derived.known.iter().zip(factors) {
                let expected = known[&setup.function_name(*function)];
                assert!((factor - expected).abs() < 1e-9, "run {n} at {sweep}: {factor} {expected}");
            }
            let listed = |name: &String| derived.known.iter().any(|(f, _)| setup.function_name(*f) == *name);
            let forgotten = known.iter().find(|(name, factor)| factor.abs() > 1e-9 && !listed(name));
            assert_eq!(forgotten, None, "run {n} at {sweep}");
        }
    }
}

/// There are as many base parameters as singular values, and the rest of the parameters is the kernel.
pub fn rank(case: &Case) {
    let derivation = &case.setup.derivation;
    assert_eq!(derivation.base.len(), case.space.rank);
    assert_eq!(derivation.base.len(), case.folded_space.rank);
    assert_eq!(derivation.kernel.len(), derivation.parameters.len() - case.space.rank);
}

/// A coefficient is told by itself where nothing that the runs do not see changes it; else with what is named.
pub fn functions(case: &Case) {
    let (setup, reference) = (&case.setup, &case.reference);
    let all = together(&case.folded, reference.width());
    let definitions = definitions(case);
    for told in &setup.derivation.functions {
        let names = coefficients(case, told.function);
        for (term, name) in names.iter().enumerate() {
            let seen = told.seen.iter().find(|s| usize::from(s.term) == term);
            assert_ne!(seen.is_some(), told.missing.iter().any(|t| usize::from(*t) == term), "{name}");
            let alone = seen.is_some_and(|s| s.others.is_empty());
            assert_eq!(alone, case.space.tells(&reference.unit(name)), "{name} is determined");
            let Some(seen) = seen else { continue };
            let mut sum = reference.unit(name);
            seen.others.iter().for_each(|(j, f)| sum += reference.unit(case.name(*j)) * setup.number(f));
            assert!(case.folded_space.tells(&sum), "{name} with what is added to it");
            seen.base.iter().for_each(|(b, f)| sum -= definitions.row(usize::from(*b)) * setup.number(f));
            assert!((sum * &case.within).norm() < 1e-9, "{name} as base parameters");
        }
        let assumed = |name: &String| reference.machine.assumed.iter().any(|a| a.terms.iter().any(|(n, _)| n == name));
        if !names.iter().any(assumed) {
            let own = all.select_columns(&names.iter().map(|n| reference.place(n)).collect::<Vec<_>>());
            let seen: Vec<usize> = told.seen.iter().map(|s| s.term.into()).collect();
            assert_eq!(seen, independent(&own), "{names:?}");
        }
    }
}

/// Base parameters as sums of the reference's parameters.
pub fn definitions(case: &Case) -> DMatrix<f64> {
    let definitions = case.setup.definitions();
    case.reference.sums(definitions.iter().map(|d| d.iter().map(|(j, f)| (case.name(*j), *f)).collect()))
}

/// The names of a function's coefficients.
pub fn coefficients(case: &Case, function: FunctionId) -> Vec<String> {
    let function = &case.setup.model.functions[function];
    let error = case.setup.model.alphabet.error_name(function.error);
    function.basis.suffixes().map(|suffix| format!("{error}{suffix}")).collect()
}
