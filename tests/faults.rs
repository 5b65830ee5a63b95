//! Inputs that once came out wrong, each the smallest of its kind, with the values of an independent exact model.

use trunnion::data::{observations, write_simulation};
use trunnion::study::{Drawn, ErrorLimits, Simulation, fit, studies};
use trunnion::{Estimator, Setup};
use trunnion_codegen::emit;
use trunnion_codegen::identify::{Derivation, Extent};
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::model::{Model, ProblemKind};
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Two runs of the second step, of which one does not see what the first step gives: the standard deviation was 8.319e-7. That
/// any such runs are right is held to brute force in the solver's `tests/two_step.rs`.
#[test]
fn a_second_step_run_that_does_not_see_a_given_coefficient() {
    let model = include_str!("faults/two-step-gain/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0)]).unwrap();
    let simulation =
        Simulation { seed: 3, samples: 72, noise_um: 0.2, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) };
    let observations = simulation.measure(&setup).observations.raw;
    let fitted = fit(&setup, &observations, Estimator::TwoStep).unwrap();
    let place = fitted.base.iter().position(|&b| setup.derivation.base[b].name == "EAA_cos1").unwrap();
    let std = fitted.covariance[(place, place)].sqrt();
    assert!((std / 5.534e-7 - 1.0).abs() < 2e-4, "{std:e}");
}

fn simulation(seed: u64, samples: usize, noise_um: f64) -> Simulation {
    Simulation { seed, samples, noise_um, limits: ErrorLimits::PAPER, range_deg: (0.0, 360.0) }
}

/// A coefficient lumped with one that another run finds was printed as the sum of both: EXX(−170) = 8.046 µm for 5.554.
#[test]
fn a_later_runs_base_parameters_are_put_in() {
    let model = include_str!("faults/estimate-lumped/exx1.toml");
    let setup = Setup::from_description(model, &[("R", 150.0), ("L", 80.0)]).unwrap();
    let simulated = simulation(1, 90, 0.0).measure(&setup);
    let fitted = fit(&setup, &simulated.observations.raw, Estimator::Joint).unwrap();
    let function = setup.estimated().next().unwrap();
    assert_eq!(fitted.seen(function).unwrap().extent(), Extent::Determined);
    let error = setup.model.functions[function].error;
    for x in [-170.0, -50.0, 120.0] {
        let (value, truth) = (fitted.function(&setup, function, x).0, simulated.machine.value(error, x));
        assert!((value - truth).abs() < 2e-5, "{x}: {value} {truth}");
    }
}

/// Two coaxial tables turned together: of each nothing is determined, and 0.000 ± 0.000 was printed of the second.
#[test]
fn coaxial_tables_are_told_as_a_sum() {
    let model = include_str!("faults/unseen-zero/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0)]).unwrap();
    let simulated = simulation(1, 90, 0.0).measure(&setup);
    let fitted = fit(&setup, &simulated.observations.raw, Estimator::Joint).unwrap();
    let base = simulated.machine.base(&setup);
    assert_eq!(fitted.functions().len(), 2);
    for seen in fitted.functions() {
        let told = seen.told(&setup);
        assert_eq!(told.extent, Extent::UpTo);
        assert!(told.up_to.len() >= 4 && told.sum.unwrap().contains("EC"), "{}", told.words);
        for x in [0.3, 2.0, 5.0] {
            let (value, sum) = (fitted.function(&setup, seen.function(), x).0, seen.truth(&setup, &base, x));
            assert!(sum.abs() > 1e-6 && (value - sum).abs() < 2e-6, "{value} {sum}");
        }
    }
}

/// A table at rest that shares its location with runs in which it moves: EAA was 88.6 µrad off.
#[test]
fn a_resting_axis_that_shares_its_location_keeps_it() {
    let truth = |name: &str, a: f64| match name {
        "ECC" => 40e-6 * a.cos() - 25e-6 * (2.0 * a).sin(),
        _ => 10e-6 * a - 1e-6 * a * a,
    };
    for model in
        [include_str!("faults/rest-shared-location/model.toml"), include_str!("faults/rest-shared-location/zero.toml")]
    {
        let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0), ("H", 80.0)]).unwrap();
        let runs = ["c-axial", "cone-z", "cone-x", "cone-y"];
        let file =
            |run: &str| format!("{}/tests/faults/rest-shared-location/data/{run}.csv", env!("CARGO_MANIFEST_DIR"));
        let files = runs.map(|run| (run, file(run)));
        let observations = observations(&setup, &files.each_ref().map(|(run, file)| (*run, file)), None).unwrap();
        let fitted = fit(&setup, &observations, Estimator::Joint).unwrap();
        for function in setup.estimated() {
            let name = setup.function_name(function);
            for a in [0.5, 2.0, 4.0, 6.0] {
                let off = fitted.function(&setup, function, a).0 - truth(&name, a);
                assert!(off.abs() < 0.3e-6, "{name} at {a}: {off:e}");
            }
        }
    }
}

/// A geared axis' function was compared with the truth at the sweep: the noise had a mean of 391.9 µrad for 14.3.
#[test]
fn a_function_is_compared_where_its_axis_goes() {
    let model = include_str!("faults/monte-carlo-coordinate/model.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("G", 50.0)]).unwrap();
    let draws = simulation(1, 90, 0.1).draws(400);
    let studies = studies(&setup, draws, Drawn::NoiseAlone, &[Estimator::Joint], &|| ()).unwrap();
    let noise = studies[0].errors.unwrap().noise.mean;
    assert!((noise / 14.3 - 1.0).abs() < 0.1, "{noise}");
}

/// The files of a simulation: a linear axis over mm, a geared one over its own angle, all known functions, no run overwritten.
#[test]
fn simulated_files_say_what_they_hold() {
    let written = |model: &str, lengths: &[(&str, f64)]| {
        let setup = Setup::from_description(model, lengths).unwrap();
        let simulation = simulation(1, 36, 0.1);
        let directory = tempfile::tempdir().unwrap();
        let result = write_simulation(&setup, &simulation, directory.path());
        (result, directory)
    };
    let truth = |directory: &tempfile::TempDir| -> serde_json::Value {
        serde_json::from_str(&std::fs::read_to_string(directory.path().join("truth.json")).unwrap()).unwrap()
    };
    let (_, linear) = written(include_str!("faults/truth-linear/exx1.toml"), &[("R", 150.0), ("L", 80.0)]);
    let points = truth(&linear)["EXX"].as_array().unwrap().clone();
    assert!(points.len() == 21 && (points[0]["x_mm"].as_f64().unwrap() + 170.0).abs() < 0.2);
    let (_, geared) = written(include_str!("faults/truth-coordinate/model.toml"), &[("L", 150.0)]);
    let truth = truth(&geared);
    assert!(truth["EXX"][0]["x_mm"].is_f64());
    assert_eq!(truth["ECC"][0]["c_deg"].as_f64().unwrap(), -360.0);
    let (_, two) = written(include_str!("faults/two-known/model.toml"), &[("R", 100.0), ("L", 150.0)]);
    let table = std::fs::read_to_string(two.path().join("table.csv")).unwrap();
    assert!(["EYA_um", "EZA_um", "EXC_um", "EYC_um"].iter().all(|c| table.lines().next().unwrap().contains(c)));
    let (result, kept) = written(include_str!("faults/run-named-table/table.toml"), &[("R", 100.0), ("L", 150.0)]);
    assert!(result.unwrap_err().to_string().contains("holds the known functions"));
    assert!(!kept.path().join("table.csv").exists());
}

fn derived(source: &str) -> (Model, Derivation) {
    read_and_derive(source).unwrap_or_else(|p| panic!("{}", render("", source, &p, Colour::Off)))
}

fn c99(source: &str) -> String {
    let (model, derivation) = derived(source);
    emit::c99::sources(&model, &derivation, emit::c::Precision::Double).unwrap().single()
}

/// A length called like an axis' coordinate: the basis was evaluated at the length.
#[test]
fn a_coordinate_is_not_called_like_a_constant() {
    let source = include_str!("faults/coord-constant/coord.toml");
    let c = c99(source);
    assert!(c.contains("double R, double b, double b_axis") && c.contains("out[0] = b_axis;"), "{c}");
    let (model, derivation) = derived(source);
    let function = &emit::equations::json(&model, &derivation)["functions"][0];
    assert_eq!(function["coordinate"], "b_axis");
    assert_eq!(function["expression"], "EBB1*b_axis + EBB2*b_axis**2");
}

/// Names that were given twice: a list over a function, sine and cosine over lengths, base parameters over a length and errors.
#[test]
fn every_printed_name_is_given_once() {
    let (model, derivation) = derived(include_str!("faults/numpy-upper-run/model.toml"));
    let numpy = emit::numpy::model_source(&model, &derivation).unwrap();
    assert!(numpy.contains("\nBK1_2 = [") && numpy.contains("\ndef BK1(") && !numpy.contains("\nBK1 ="), "{numpy}");
    let (model, derivation) = derived(include_str!("faults/sin-cos-names/sc.toml"));
    let regressors = &emit::equations::json(&model, &derivation)["runs"][1]["regressors"];
    assert!(regressors.as_object().unwrap().values().any(|r| r == "s**2*s_t**3"), "{regressors:#}");
    for source in [include_str!("faults/base-name-clash/4.toml"), include_str!("faults/base-name-clash/k.toml")] {
        let (model, derivation) = derived(source);
        for base in derivation.base.iter().filter(|base| base.estimates.is_none()) {
            assert!(!model.alphabet.has_name(&base.name), "{}", base.name);
        }
    }
    let (model, derivation) = derived(include_str!("faults/rust-case-functions/case.toml"));
    let rust = emit::rust::model_source(&model, &derivation, &emit::rust::Support::of_solver()).unwrap();
    for once in ["pub fn err<", "pub fn err_2<", "pub fn err(", "pub fn err_2("] {
        assert_eq!(rust.matches(once).count(), 1, "{once}");
    }
}

/// Macros and keywords as lengths did not compile; that nothing so called does is held in `tests/names/`.
#[test]
fn a_length_is_not_called_like_a_macro() {
    for (source, name) in [
        (include_str!("faults/c-macro-names/L__N.toml"), "N"),
        (include_str!("faults/c-macro-names/L__NULL.toml"), "NULL_2"),
        (include_str!("faults/c-macro-names/L__DBL_EPSILON.toml"), "DBL_EPSILON_2"),
        (include_str!("faults/c-macro-names/L__class.toml"), "class_2"),
    ] {
        let c = c99(source);
        assert!(c.contains(&format!("m_fit *fit, double R, double {name}, double b, double reading")), "{name}: {c}");
        assert!(!c.contains("#define N ") && !c.contains("static void row_of"), "{name}");
    }
}

/// `e_b` and `eb` had one column.
#[test]
fn two_known_functions_have_two_columns() {
    let model = include_str!("faults/known-underscore/kn.toml");
    let setup = Setup::from_description(model, &[("R", 100.0), ("L", 150.0)]).unwrap();
    let simulation = simulation(1, 36, 0.1);
    let directory = tempfile::tempdir().unwrap();
    write_simulation(&setup, &simulation, directory.path()).unwrap();
    let table = directory.path().join("table.csv");
    let text = std::fs::read_to_string(&table).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert!(header.contains(&"e_b_um") && header.contains(&"eb_um"), "{header:?}");
    let files = ["BK1", "BK2"].map(|run| (run, directory.path().join(format!("{run}.csv"))));
    assert!(observations(&setup, &files.each_ref().map(|(run, file)| (*run, file)), Some(&table)).is_ok());
}

/// A run's underscores were subscripts of subscripts, and a title's second line was no comment.
#[test]
fn latex_has_nothing_of_the_model_but_names() {
    let latex = |source: &str| {
        let (model, derivation) = derived(source);
        emit::equations::latex(&model, &derivation)
    };
    let run = latex(include_str!("faults/latex-run-name/runus.toml"));
    assert!(run.contains("_{\\mathrm{bk\\_1\\_radial}}"), "{run}");
    let title = latex(include_str!("faults/latex-run-name/title-newline.toml"));
    assert!(title.starts_with("% dividing-head: 50 % table \\n\\end{document} #&_ µ\n% lengths"), "{title}");
}

/// A set-up error called `t-x` was a difference in equations.
#[test]
fn an_error_is_called_by_an_identifier() {
    let source = include_str!("faults/hyphen-error-name/hyph.toml");
    let problems = read_and_derive(source).unwrap_err();
    assert!(problems.iter().any(|p| p.kind == ProblemKind::NotAName("t-x".to_owned())), "{problems:?}");
}
