//! What is printed of the machines, in each language: compiled, run, compared.

use super::machines::{Machine, Printed, machines};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use trunnion_codegen::emit::{c::Precision, c99, numpy, rust};

pub fn folder(of: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("names").join(of);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// What a command prints, or `None` where there is no such command and CI does not ask for it.
pub fn ran(command: &mut Command) -> Option<String> {
    let Output { status, stdout, stderr } = match command.output() {
        Ok(output) => output,
        Err(error) => {
            assert!(std::env::var_os("CI").is_none(), "CI must have {command:?}: {error}");
            println!("skipped: no {command:?}");
            return None;
        }
    };
    assert!(status.success(), "{command:?}\n{}", String::from_utf8_lossy(&stderr));
    Some(String::from_utf8(stdout).unwrap())
}

/// Compares a line for each function at each of its inputs.
fn compare(machines: &[Machine], printed: &str, language: &str) {
    let mut lines = printed.lines();
    for (machine, function) in machines.iter().flat_map(|m| m.functions.iter().map(move |f| (m, f))) {
        for outputs in &function.outputs {
            let row: Vec<f64> = lines.next().unwrap().split_whitespace().map(|v| v.parse().unwrap()).collect();
            assert_eq!(row.len(), outputs.len(), "{language} {:?}", machine.called);
            for (value, expected) in row.iter().zip(outputs) {
                let close = (value - expected).abs() <= 1e-13 * expected.abs().max(1.0);
                assert!(close, "{language}: {value} is not {expected}, {:?}", machine.called);
            }
        }
    }
    assert_eq!(lines.next(), None);
}

/// The words after `before`, up to `end`.
fn after<'a>(source: &'a str, before: &str, end: char) -> Vec<&'a str> {
    source.split(before).skip(1).filter_map(|rest| Some(rest.split_once(end)?.0)).collect()
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ")
}

/// The calls of a machine's functions by their printed names.
fn calls<'a>(machine: &'a Machine, names: Vec<&'a str>) -> impl Iterator<Item = (&'a str, &'a Printed, &'a Vec<f64>)> {
    assert_eq!(names.len(), machine.functions.len(), "{names:?} {:?}", machine.called);
    let each = names.into_iter().zip(&machine.functions);
    each.flat_map(|(name, f)| f.inputs.iter().map(move |inputs| (name, f, inputs)))
}

#[test]
fn c_and_cpp() {
    let (machines, folder) = (machines(), folder("c"));
    let mut all = String::from("#include <stdio.h>\n#include <complex.h>\n");
    let mut headers = String::from("#include <cmath>\n#include <cfloat>\n#include <cstdint>\n#include <cstdio>\n");
    let (mut main, mut main_cpp) = (String::new(), String::new());
    for machine in &machines {
        let sources = c99::sources(&machine.model, &machine.derivation, Precision::Double).unwrap();
        let (prefix, source) = (&sources.prefix, sources.single());
        let internal = after(&source, "static void ", '(');
        let names = internal.into_iter().filter(|n| n.contains("_row_of_") || n.contains("_basis_of_")).collect();
        for (name, function, inputs) in calls(machine, names) {
            let known = if function.sizes[1] > 0 { ", o + n" } else { "" };
            let [n, k] = function.sizes;
            writeln!(main, "    {{ const int n = {n}; {name}({}, o{known}); show(o, n + {k}); }}", numbers(inputs))
                .unwrap();
        }
        let start = format!("{prefix}_push_");
        let pushes = after(&sources.header, &format!("{prefix}_status {start}"), '(');
        assert_eq!(pushes.len(), 3, "{:?}", machine.called);
        // Lengths, sweep, reading, then the known functions there.
        for (push, function) in pushes.iter().zip(&machine.functions) {
            let arguments = numbers(&vec![1.5; function.inputs[0].len() + 1 + function.sizes[1]]);
            writeln!(
                main_cpp,
                "    if ({start}{push}(&fit_{prefix}, {arguments}) != {}_OK) return 1;",
                prefix.to_uppercase()
            )
            .unwrap();
        }
        main_cpp = main_cpp.replacen(
            &format!("    if ({start}"),
            &format!("    {prefix}_fit fit_{prefix};\n    {prefix}_init(&fit_{prefix});\n    if ({start}"),
            1,
        );
        all += &source;
        headers += &sources.header;
    }
    let show = "static void show(const double *o, int n)\n{\n    int i;\n    for (i = 0; i < n; i++) printf(\"%.17g \", o[i]);\n    printf(\"\\n\");\n}\n";
    let library = folder.join("library.c");
    std::fs::write(&library, &all).unwrap();
    let program = folder.join("program.c");
    std::fs::write(
        &program,
        format!("{all}{show}int main(void)\n{{\n    static double o[100];\n{main}    return 0;\n}}\n"),
    )
    .unwrap();
    for standard in ["c99", "gnu17", "gnu2x"] {
        let binary = folder.join(standard);
        let mut gcc = Command::new("gcc");
        gcc.args([&format!("-std={standard}"), "-pedantic", "-Wall", "-Wextra", "-Wshadow", "-Werror"]);
        let Some(_) = ran(gcc.arg(&program).arg("-o").arg(&binary).arg("-lm")) else { return };
        compare(&machines, &ran(&mut Command::new(binary)).unwrap(), standard);
    }
    let (object, cpp, binary) = (folder.join("library.o"), folder.join("program.cpp"), folder.join("cpp"));
    ran(Command::new("gcc").args(["-std=c99", "-c"]).arg(&library).arg("-o").arg(&object)).unwrap();
    std::fs::write(&cpp, format!("{headers}int main()\n{{\n{main_cpp}    return 0;\n}}\n")).unwrap();
    for standard in ["c++20", "gnu++20"] {
        let mut gpp = Command::new("g++");
        gpp.args([&format!("-std={standard}"), "-pedantic", "-Wall", "-Wextra", "-Werror"]);
        if ran(gpp.arg(&cpp).arg(&object).arg("-o").arg(&binary).arg("-lm")).is_some() {
            ran(&mut Command::new(&binary));
        }
    }
}

#[test]
fn python() {
    let (machines, folder) = (machines(), folder("python"));
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
    if !Command::new(&python).args(["-c", "import numpy"]).output().is_ok_and(|run| run.status.success()) {
        assert!(std::env::var_os("CI").is_none(), "CI must have NumPy");
        println!("skipped: no NumPy");
        return;
    }
    let mut main = String::from("import numpy as np\n\n\ndef show(module, name, inputs, is_run, seen):\n");
    main += "    function = getattr(module, name)\n    assert callable(function)\n    results = function(*inputs)\n";
    main += "    assert isinstance(results, tuple) == is_run\n    results = results if is_run else (results,)\n";
    main += "    print(*[repr(float(value)) for result in results for value in result])\n";
    main += "    narrow = function(*inputs[:-1], np.full(3, inputs[-1], np.float32))\n";
    main += "    for result in narrow if is_run else (narrow,):\n        assert result.dtype == np.float32 and result.shape[1:] == (3,)\n";
    main += "    assert not is_run or seen in [getattr(module, own) for own in dir(module)]\n\n\n";
    for machine in &machines {
        let source = numpy::model_source(&machine.model, &machine.derivation).unwrap();
        let name = &machine.model.name;
        std::fs::write(folder.join(format!("{name}.py")), &source).unwrap();
        writeln!(main, "import {name}").unwrap();
        let names = after(&source, "\ndef ", '(');
        let seen = machine.derivation.runs.iter().map(|run| run.regressors.iter().map(|(b, _)| b.to_string()));
        let seen: Vec<String> = seen.map(|run| format!("[{}]", run.collect::<Vec<_>>().join(", "))).collect();
        for (at, (function, printed, inputs)) in calls(machine, names).enumerate() {
            let run = seen.get(at / printed.inputs.len());
            let (is_run, seen) = (if run.is_some() { "True" } else { "False" }, run.map_or("None", String::as_str));
            writeln!(main, "show({name}, \"{function}\", [{}], {is_run}, {seen})", numbers(inputs)).unwrap();
        }
    }
    let program = folder.join("main.py");
    std::fs::write(&program, main).unwrap();
    let mut command = Command::new(python);
    compare(&machines, &ran(command.args(["-W", "error"]).arg(&program)).unwrap(), "NumPy");
}

/// The libraries of the solver that were built beside this test, the newest first.
fn solvers(built: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(built).unwrap().map(|file| file.unwrap());
    let is = |name: &str| name.starts_with("libtrunnion_solver-") && name.ends_with(".rlib");
    let mut files: Vec<_> = files.filter(|file| is(&file.file_name().to_string_lossy())).collect();
    files.sort_by_key(|file| std::cmp::Reverse(file.metadata().unwrap().modified().unwrap()));
    files.into_iter().map(|file| file.path()).collect()
}

#[test]
fn rust() {
    let (machines, folder) = (machines(), folder("rust"));
    let mut all = String::from("#![deny(warnings)]\n#![allow(dead_code)]\n");
    let mut main = String::new();
    for machine in &machines {
        let source = rust::model_source(&machine.model, &machine.derivation, &rust::Support::of_solver()).unwrap();
        let module = &machine.model.name;
        // Of one value; those of a block are over another kind of number.
        let of_one =
            |item: &&str| item.split_once('<').is_some_and(|(_, rest)| rest.trim_start().starts_with("T: Number"));
        let items = source.split("\npub fn ").skip(1).filter(of_one);
        for (name, function, inputs) in calls(machine, items.filter_map(|item| Some(item.split_once('<')?.0)).collect())
        {
            let results = if function.sizes[1] > 0 { "[&o.0[..], &o.1].concat()" } else { "o.to_vec()" };
            writeln!(main, "    let o = {module}::{name}::<f64>({});\n    show({results});", numbers(inputs)).unwrap();
        }
        writeln!(all, "mod {module} {{\n{source}}}").unwrap();
    }
    all += "fn show(row: Vec<f64>) {\n    println!(\"{}\", row.iter().map(|v| format!(\"{v:?}\")).collect::<Vec<_>>().join(\" \"));\n}\n";
    let (program, binary) = (folder.join("main.rs"), folder.join("main"));
    std::fs::write(&program, format!("{all}fn main() {{\n{main}}}\n")).unwrap();
    let built = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    let compiled = solvers(&built).into_iter().map(|solver| {
        let solver = format!("trunnion_solver={}", solver.display());
        let mut rustc = Command::new("rustc");
        rustc.args(["--edition", "2024", "--extern", &solver, "-L"]).arg(format!("dependency={}", built.display()));
        rustc.arg(&program).arg("-o").arg(&binary).output().unwrap()
    });
    // One of them was built by an older compiler, or with other dependencies.
    let found = |output: &Output| {
        ["E0460", "E0463", "E0464", "E0514"].iter().all(|e| !String::from_utf8_lossy(&output.stderr).contains(e))
    };
    let compiled = compiled.into_iter().find(found).expect("the solver was built beside this test");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    compare(&machines, &ran(&mut Command::new(binary)).unwrap(), "Rust");
}
