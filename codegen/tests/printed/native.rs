//! The C99 that is printed, compiled without a warning and run.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use trunnion_codegen::emit::{c, header};

use super::compare::{STRUT, STRUT_SCALE, TILTING, assert_close, points, tilting_scale};
use super::functions::{Case, ROW, strut, tilting};

/// What the compiled function gives at each point, or `None` where there is no compiler and CI does not ask for one.
fn run(
    name: &str,
    case: &Case,
    real: c::Precision,
    points: &[Vec<f64>],
    call: &str,
    outputs: usize,
) -> Option<Vec<Vec<f64>>> {
    let kind = if real == c::Precision::Double { "double" } else { "float" };
    let mut source = header("//", "a test") + "#include <math.h>\n#include <stdio.h>\n\n";
    let function = c::function(&case.function, real);
    source += &(c::support(&function, real) + &function);
    let width = case.inputs.len();
    writeln!(source, "static const {kind} points[][{width}] = {{").unwrap();
    for point in points {
        let values = point.iter().map(|value| match real {
            c::Precision::Double => format!("{value:?}"),
            c::Precision::Float => format!("{:?}f", *value as f32),
        });
        writeln!(source, "{{{}}},", values.collect::<Vec<_>>().join(", ")).unwrap();
    }
    writeln!(source, "}};\nint main(void)\n{{\n    int i;\n    int j;\n    {kind} o[{outputs}];").unwrap();
    writeln!(source, "    for (i = 0; i < {}; i++) {{\n        const {kind} *p = points[i];", points.len()).unwrap();
    writeln!(source, "        {call}").unwrap();
    writeln!(source, "        for (j = 0; j < {outputs}; j++) printf(\"%.17g \", (double)o[j]);").unwrap();
    source += "        printf(\"\\n\");\n    }\n    return 0;\n}\n";

    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (file, program) = (folder.join(format!("{name}.c")), folder.join(name));
    std::fs::write(&file, source).unwrap();
    let flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2"];
    let compiled = match Command::new("gcc").args(flags).arg(&file).arg("-o").arg(&program).arg("-lm").output() {
        Ok(compiled) => compiled,
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "CI must have gcc: {error}");
            println!("skipped: no gcc");
            return None;
        }
    };
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let printed = String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
    let rows = printed.lines().map(|line| line.split_whitespace().map(|value| value.parse().unwrap()).collect());
    Some(rows.collect())
}

#[test]
fn c_computes_the_row() {
    let case = tilting();
    for (name, real, epsilon) in
        [("row_double", c::Precision::Double, f64::EPSILON), ("row_float", c::Precision::Float, f32::EPSILON.into())]
    {
        let mut points = points(&TILTING, 200);
        if real == c::Precision::Float {
            points.iter_mut().flatten().for_each(|value| *value = f64::from(*value as f32));
        }
        let Some(rows) = run(name, &case, real, &points, "tilting(p[0], p[1], o);", ROW) else {
            return;
        };
        assert_eq!(rows.len(), points.len());
        for (row, point) in rows.iter().zip(&points) {
            for (index, (&actual, expected)) in row.iter().zip(case.expected(point)).enumerate() {
                assert_close(actual, expected, tilting_scale(index, point), epsilon, &format!("{name} {index}"));
            }
        }
    }
}

#[test]
fn c_computes_residual_and_jacobian() {
    let case = strut();
    let points = points(&STRUT, 200);
    let call = "double J[3][3]; strut(p[0], p[1], p[2], p[3], p[4], o, J, &o[12]);
        for (j = 0; j < 9; j++) o[3 + j] = J[j / 3][j % 3];";
    let Some(rows) = run("strut", &case, c::Precision::Double, &points, call, 13) else {
        return;
    };
    assert_eq!(rows.len(), points.len());
    for (row, point) in rows.iter().zip(&points) {
        for (index, (&actual, expected)) in row.iter().zip(case.expected(point)).enumerate() {
            assert_close(actual, expected, STRUT_SCALE, f64::EPSILON, &format!("output {index}"));
        }
    }
}
