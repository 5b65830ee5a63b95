//! The catalogue's runs determine what they are for, and runs that are searched for do.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;
use trunnion::study::plan::design::{Asked, Choices, Design, Measured, Pool, budgets, design, share, with_runs};
use trunnion::study::plan::{Intended, predict, uniform_std};
use trunnion::study::{Draws, ErrorLimits, Estimator, Instrument, Setup, noise_alone};
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::identify::Extent;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Draft, Model, read_draft};
use trunnion_codegen::quantity::Unit;

const SAMPLES: usize = 360;
const NOISE: f64 = 1e-4;

fn measured() -> Measured {
    let range = (0.0, TAU);
    let (sigma, limits, instrument) = (uniform_std(NOISE), ErrorLimits::PAPER, Instrument::default());
    Measured { lengths: Vec::new(), samples: SAMPLES, range, sigma, limits, instrument }
}

fn read(name: &str) -> (Draft, Model) {
    let source = MODELS.iter().find(|(n, _)| *n == name).unwrap().1;
    let draft = read_draft(source).unwrap();
    let model = draft.build().unwrap();
    (draft, model)
}

fn searched(name: &str, functions: &[(&str, Option<f64>)]) -> Design {
    let (draft, model) = read(name);
    let functions = functions.iter().map(|(name, within)| ((*name).to_owned(), *within)).collect();
    design(&draft, &model, &Asked { functions, measured: measured() }, &|_| {}).unwrap()
}

/// 5 µrad or 1 µm, with the usual lengths, over the ranges of the axes.
#[test]
fn the_catalogue_s_runs_determine_what_they_are_for() {
    for (name, source) in MODELS {
        let model = read_draft(source).unwrap().build().unwrap();
        let setup = Setup::new(model, &[]).unwrap();
        let intended = Intended { samples: SAMPLES, range: (0.0, TAU), sigma: uniform_std(NOISE) };
        let prediction = predict(&setup, intended, Estimator::Joint).unwrap();
        println!("{name}: condition {:.0}", prediction.condition);
        assert!(prediction.condition < 1000.0, "{name}: {}", prediction.condition);
        for f in &prediction.functions {
            let unit = setup.quantity(f.function).deviation();
            let u95 = unit.from_inner(f.largest.unwrap().u95);
            println!("  {} ± {u95:.3} {unit}", setup.function_name(f.function));
            assert_eq!(f.told.extent, Extent::Determined, "{name}: {}", f.told.words);
            assert!(u95 <= if unit == Unit::Um { 1.0 } else { 5.0 }, "{name}: {u95} {unit}");
        }
    }
}

/// What the catalogue's issue says of the rotary table, among tangential and radial runs at L, 2·L and −L: exact ranks.
#[test]
fn five_runs_determine_all_of_the_rotary_table_s_angle() {
    let found = searched("rotary-table-c", &[("ECC", Some(2e-6))]);
    let sizes: Vec<usize> = found.proposals.iter().map(|p| p.draft.runs.len()).collect();
    assert_eq!(sizes, [5, 5, 5]);
    // The ball is set up where its set-up errors have other names, wherever those are written.
    assert_eq!(found.proposals[0].placings, 3);
    for proposal in &found.proposals {
        let function = proposal.setup.estimated().next().unwrap();
        let all: Vec<_> = proposal.setup.derivation.base.keys().collect();
        let determined = proposal.setup.derivation.determined_by(&proposal.setup.model, &all).unwrap();
        assert_eq!(determined[0].extent(), Extent::Determined);
        // One run fewer does not.
        for left_out in 0..proposal.draft.runs.len() {
            let mut runs = proposal.draft.runs.clone();
            runs.remove(left_out);
            let fewer = Setup::new(with_runs(&proposal.draft, &runs).build().unwrap(), &[]).unwrap();
            let all: Vec<_> = fewer.derivation.base.keys().collect();
            let determined = fewer.derivation.determined_by(&fewer.model, &all).unwrap();
            let own = determined.iter().find(|d| d.function == function).unwrap();
            assert_ne!(own.extent(), Extent::Determined, "{}", runs.len());
        }
    }
}

/// Adding matrices says the same as deriving the set by itself and predicting.
#[test]
fn a_set_is_weighed_as_its_own_model_predicts() {
    let (draft, model) = read("tilting-table-b");
    let functions: Vec<FunctionId> =
        model.functions.iter_enumerated().filter(|(_, f)| f.estimate).map(|(f, _)| f).collect();
    let choices = Choices::all(&draft, &model, &functions).unwrap();
    let pool = Pool::new(&choices, &functions, &measured(), 100.0).unwrap();
    let within: BTreeMap<FunctionId, f64> = functions.iter().map(|f| (*f, 1e-6)).collect();
    let mut compared = 0;
    for set in [vec![0, 1, 2, 3], vec![0, 1, 4, 5], vec![4, 5, 7, 8], vec![4, 5, 10, 11], vec![0, 1, 4, 5, 7, 8]] {
        let runs: Vec<_> = set.iter().map(|&i| choices.runs[i].clone()).collect();
        let setup = Setup::new(with_runs(&draft, &runs).build().unwrap(), &[]).unwrap();
        let intended = Intended { samples: SAMPLES, range: (0.0, TAU), sigma: uniform_std(NOISE) };
        let prediction = predict(&setup, intended, Estimator::Joint).unwrap();
        let own = &prediction.functions[0];
        if own.told.extent == Extent::Determined {
            // A function is looked at over the range of the pool, which may be more than that of the set.
            let weighed = share(&pool, &within, &pool.known(set.iter().copied())) * 1e-6;
            let predicted = own.largest.unwrap().std;
            println!("{set:?}: {weighed:.3e}, predicted {predicted:.3e}");
            assert!((weighed / predicted - 1.0).abs() < 0.02, "{set:?}: {weighed:e}, {predicted:e}");
            compared += 1;
        }
    }
    assert!(compared >= 3);
}

/// For every estimated function of every model: what is found is confirmed by drawn machines, and stands in the docs. With
/// `UPDATE_DOCS` set the page is written anew.
#[test]
fn runs_are_found_for_every_function_and_drawn_machines_confirm_them() {
    let draws = |range| Draws { trials: 60, samples: 120, range, limits: small(), noise: NOISE, seed: 5 };
    let mut rows = String::new();
    for (name, source) in MODELS {
        let model = read_draft(source).unwrap().build().unwrap();
        let whole = Setup::new(model.clone(), &[]).unwrap();
        for (f, described) in model.functions.iter_enumerated().filter(|(_, f)| f.estimate) {
            let called = model.alphabet.error_name(described.error);
            let unit = whole.quantity(f).deviation();
            let asked = unit.to_inner(if unit == Unit::Um { 1.0 } else { 5.0 });
            let found = searched(name, &[(called, Some(asked))]);
            let first = found.proposals.first().unwrap_or_else(|| panic!("{name}: {called}"));
            let own = first.prediction.functions.iter().find(|p| p.function == f).unwrap();
            assert_eq!(own.told.extent, Extent::Determined, "{name}: {called}");
            let largest = own.largest.unwrap();
            assert!(largest.u95 <= 1.02 * found.functions[0].within, "{name}: {called}: {largest:?}");
            // The largest error over the range is some two to four standard deviations where it is largest.
            let of = [(Estimator::Joint, f)];
            let (_, trials) = noise_alone(&first.setup, draws((0.0, TAU)), &of, &|| {}).unwrap().remove(0);
            let mean = trials.iter().sum::<f64>() / trials.len() as f64;
            let ratio = mean / (largest.std * (SAMPLES as f64 / 120.0).sqrt());
            println!("{name}: {called}: {} runs, ± {:.3e}, ratio {ratio:.2}", first.draft.runs.len(), largest.u95);
            assert!((0.6..2.6).contains(&ratio), "{name}: {called}: {ratio}");

            let default = budgets(&whole, &[f], &measured()).unwrap()[0].measured;
            let budget = first.budgets[0].measured;
            assert!(budget <= asked && budget >= 0.95 * largest.u95, "{name}: {called}: {budget}");
            let runs: Vec<&str> = first.draft.runs.iter().map(|run| run.name.value.as_str()).collect();
            let shown = [default, budget, found.functions[0].best].map(|x| digits(unit.from_inner(x)));
            let [default, u95, best] = shown;
            let (count, unit) = (model.runs.len(), if unit == Unit::Um { "µm" } else { "µrad" });
            writeln!(
                rows,
                "| `{name}` | {called} | {count} runs: ±{default} {unit} | {} | {} | ±{u95} {unit} | ±{best} {unit} |",
                first.placings,
                runs.join(", ")
            )
            .unwrap();
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/which-test.md");
    let page = std::fs::read_to_string(path).unwrap();
    let (before, table) = page.split_once("|---|---|---|---|---|---|---|\n").unwrap();
    let after = table.split_once("\n\n").map_or("", |(_, after)| after);
    let page_now = format!("{before}|---|---|---|---|---|---|---|\n{rows}\n{after}");
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::write(path, page_now).unwrap();
    } else {
        assert_eq!(page, page_now, "set UPDATE_DOCS to write docs/which-test.md anew");
    }
}

/// Two digits.
fn digits(x: f64) -> String {
    let decimals = (1.0 - x.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{x:.decimals$}")
}

/// Errors so small that nothing is left of linearisation.
fn small() -> ErrorLimits {
    ErrorLimits { length: ErrorLimits::PAPER.length * 1e-3, angle: ErrorLimits::PAPER.angle * 1e-3 }
}
