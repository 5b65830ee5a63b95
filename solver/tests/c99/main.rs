//! The solver that is printed as C99, compiled without a warning, against the Rust one on the reference runs.

use std::{env, fs, path::Path, process::Command};
use trunnion_codegen::{catalogue, emit::c::Precision as Kind, emit::c99, identify};
use trunnion_solver::Real;
use trunnion_solver::tilting::{Joint, Lengths};

const RADIUS: f64 = 150.0;

/// Writes the model's files and compiles a program beside them; `None` where there is no compiler and CI asks for none.
fn compile(name: &str, kind: Kind, program: &str) -> Option<std::path::PathBuf> {
    let model = catalogue::model("tilting-table-a").unwrap().unwrap();
    let sources = c99::sources(&model, &identify::derive(&model).unwrap(), kind).unwrap();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    let source = folder.join(format!("{}.c", sources.prefix));
    fs::write(folder.join(format!("{}.h", sources.prefix)), &sources.header).unwrap();
    fs::write(&source, &sources.source).unwrap();
    let real = match kind {
        Kind::Double => ["-DREAL=double", "-DMAXIMUM=DBL_MAX"],
        Kind::Float => ["-DREAL=float", "-DMAXIMUM=FLT_MAX"],
    };
    let flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2"];
    let driver = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c99").join(program);
    let mut gcc = Command::new("gcc");
    gcc.args(flags)
        .args(real)
        .arg("-I")
        .arg(&folder)
        .arg(&source)
        .arg(driver)
        .arg("-o")
        .arg(folder.join("run"))
        .arg("-lm");
    match gcc.output() {
        Err(error) => {
            assert!(env::var_os("CI").is_none(), "CI must have gcc: {error}");
            println!("skipped: no gcc");
            None
        }
        Ok(compiled) => {
            assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
            Some(folder.join("run"))
        }
    }
}

/// Angle in degrees and the columns after it, µm.
fn columns(file: &str) -> Vec<Vec<f64>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/reference/tilting-table/full").join(file);
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// Both runs: angle in rad, ΔR₁, ΔR₂, δ_ya, δ_za in mm.
fn samples() -> Vec<[f64; 5]> {
    let (tilting, separation, table) = (columns("tilting.csv"), columns("separation.csv"), columns("table.csv"));
    let rows = tilting.iter().zip(&separation).zip(&table);
    rows.map(|((t, s), k)| [t[0].to_radians(), t[1] * 1e-3, s[1] * 1e-3, k[1] * 1e-3, k[2] * 1e-3]).collect()
}

/// What the driver prints, from Rust: coefficients, their standard deviations, residual, then ε_xa and its own.
fn expected<T: Real>() -> Vec<T> {
    let mut joint = Joint::new(Lengths { r: T::of(RADIUS) }).unwrap();
    for [a, tilting, separation, y, z] in samples().into_iter().map(|sample| sample.map(T::of)) {
        joint.push_tilting(a, tilting, y, z).unwrap();
        joint.push_separation(a, separation).unwrap();
    }
    let estimate = joint.solve().unwrap();
    let solution = &estimate.solution;
    let mut values: Vec<T> = solution.coefficients.iter().copied().collect();
    values.extend(solution.std().iter());
    values.push(solution.residual_std);
    for degree in (0..=360).step_by(30) {
        let (value, std) = estimate.e_xa(T::of(f64::from(degree).to_radians())).unwrap();
        values.extend([value, std]);
    }
    values
}

/// Largest difference of the C result: values in units of their standard deviation, deviations relative to themselves.
fn difference<T: Real>(kind: Kind, name: &str) -> Option<[f64; 2]> {
    let program = compile(name, kind, "driver.c")?;
    let input = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name).join("samples");
    let lines = samples().into_iter().map(|sample| sample.map(|v| format!("{v:e}")).join(" ") + "\n");
    fs::write(&input, lines.collect::<String>()).unwrap();
    let output = Command::new(program).arg(input).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed: Vec<f64> = String::from_utf8(output.stdout).unwrap().lines().map(|v| v.parse().unwrap()).collect();
    let expected: Vec<f64> = expected::<T>().iter().map(|v| v.to_f64().unwrap()).collect();
    // Once from all samples in order, once merged from two halves.
    assert_eq!(printed.len(), 2 * expected.len());
    let mut worst = [0.0_f64; 2];
    for printed in printed.chunks(expected.len()) {
        let mut compare = |at: usize, std: usize| {
            worst[0] = worst[0].max((printed[at] - expected[at]).abs() / expected[std].max(1e-30));
            worst[1] = worst[1].max((printed[std] / expected[std] - 1.0).abs());
        };
        (0..13).for_each(|i| compare(i, 13 + i));
        // Where the basis vanishes, at both ends of the turn, there is nothing to compare with.
        (1..12).for_each(|i| compare(27 + 2 * i, 28 + 2 * i));
        assert!((printed[26] / expected[26] - 1.0).abs() < 1e-3);
    }
    println!("{name}: {worst:?}");
    Some(worst)
}

#[test]
fn c_fits_as_rust_does() {
    if let Some([value, std]) = difference::<f64>(Kind::Double, "c99-double") {
        assert!(value < 5e-12 && std < 1e-12, "{value:e} {std:e}");
    }
    if let Some([value, std]) = difference::<f32>(Kind::Float, "c99-float") {
        assert!(value < 5e-3 && std < 1e-4, "{value:e} {std:e}");
    }
}

#[test]
fn c_answers_mistakes() {
    for (name, kind) in [("c99-mistakes-double", Kind::Double), ("c99-mistakes-float", Kind::Float)] {
        if let Some(program) = compile(name, kind, "mistakes.c") {
            let output = Command::new(program).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
        }
    }
}

#[test]
fn every_model_of_the_catalogue_compiles_in_one_file() {
    for (name, _) in catalogue::MODELS {
        let model = catalogue::model(name).unwrap().unwrap();
        let derivation = identify::derive(&model).unwrap();
        for (suffix, kind) in [("d", Kind::Double), ("f", Kind::Float)] {
            let sources = c99::sources(&model, &derivation, kind).unwrap();
            let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}_{suffix}.c", sources.prefix));
            fs::write(&file, sources.single()).unwrap();
            let flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-c", "-o", "/dev/null"];
            match Command::new("gcc").args(flags).arg(&file).output() {
                Ok(gcc) => assert!(gcc.status.success(), "{name}: {}", String::from_utf8_lossy(&gcc.stderr)),
                Err(error) => assert!(env::var_os("CI").is_none(), "CI must have gcc: {error}"),
            }
        }
    }
}
