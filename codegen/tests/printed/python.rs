//! The NumPy that is printed, run over arrays.

use std::path::Path;
use std::process::Command;

use trunnion_codegen::emit::{header, numpy};

use super::compare::{STRUT, STRUT_SCALE, TILTING, assert_close, points, tilting_scale};
use super::functions::{Case, ROW, strut, tilting};

/// A row of outputs for each point, or `None` where Python has no NumPy and CI does not ask for it. `PYTHON` names
/// another interpreter than `python3`.
fn run(name: &str, case: &Case, points: &[Vec<f64>], result: &str) -> Option<Vec<Vec<f64>>> {
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    if !Command::new(&python).args(["-c", "import numpy"]).output().is_ok_and(|run| run.status.success()) {
        assert!(std::env::var_os("CI").is_none(), "CI must have NumPy");
        println!("skipped: no NumPy");
        return None;
    }
    let mut source = header("#", "a test") + numpy::IMPORTS;
    let function = numpy::function(&case.function);
    source += &(numpy::support(&function).to_owned() + "\n\n" + &function);
    source += &format!("\n\np = np.array({points:?}).T\nresult = {name}(*p)\nrows = np.vstack({result})\n");
    source += "for row in rows.T:\n    print(*[repr(float(value)) for value in row])\n";
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.py"));
    std::fs::write(&file, source).unwrap();
    let run = Command::new(python).arg(&file).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let printed = String::from_utf8(run.stdout).unwrap();
    let rows = printed.lines().map(|line| line.split_whitespace().map(|value| value.parse().unwrap()).collect());
    Some(rows.collect())
}

#[test]
fn numpy_computes_the_row() {
    let (case, points) = (tilting(), points(&TILTING, 200));
    let Some(rows) = run("tilting", &case, &points, "result") else {
        return;
    };
    assert_eq!(rows.len(), points.len());
    for (row, point) in rows.iter().zip(&points) {
        assert_eq!(row.len(), ROW);
        for (index, (&actual, expected)) in row.iter().zip(case.expected(point)).enumerate() {
            assert_close(actual, expected, tilting_scale(index, point), f64::EPSILON, &format!("output {index}"));
        }
    }
}

#[test]
fn numpy_computes_residual_and_jacobian() {
    let (case, points) = (strut(), points(&STRUT, 200));
    let result = "[result[0], result[1].reshape(9, -1), result[2]]";
    let Some(rows) = run("strut", &case, &points, result) else {
        return;
    };
    assert_eq!(rows.len(), points.len());
    for (row, point) in rows.iter().zip(&points) {
        assert_eq!(row.len(), 13);
        for (index, (&actual, expected)) in row.iter().zip(case.expected(point)).enumerate() {
            assert_close(actual, expected, STRUT_SCALE, f64::EPSILON, &format!("output {index}"));
        }
    }
}
