//! Components of LinuxCNC: built by `halcompile` where it is, and everywhere by a compiler that is given what it would declare.

use super::languages::{folder, ran};
use super::machines::{PLAIN, description, machines};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::hal::{Component, ComponentError, component};
use trunnion_codegen::identify::derive;
use trunnion_codegen::problems::read_and_derive;
use trunnion_solver::tilting::{Joint, Lengths};

/// HAL's longest name.
const LONGEST: usize = 47;
/// What halcompile compiles with, that a name can meet or a frame can exceed.
const AS_HALCOMPILE: [&str; 7] =
    ["-Os", "-DRTAPI", "-DUSPACE", "-DSIM", "-D__MODULE__", "-Drealtime", "-Wframe-larger-than=2560"];

fn of_catalogue() -> Vec<Component> {
    let one = |name: &str| {
        let model = catalogue::model(name).unwrap().unwrap();
        component(&model, &derive(&model).unwrap()).unwrap()
    };
    catalogue::MODELS.iter().map(|(name, _)| one(name)).collect()
}

fn of_machines() -> Vec<Component> {
    machines().iter().map(|machine| component(&machine.model, &machine.derivation).unwrap()).collect()
}

/// Models that are called like something in LinuxCNC, or longer than it has room for, and what their components are called.
const CALLED: [(&str, &str); 8] = [
    ("threads", "threads_2"),
    ("near", "near_2"),
    ("hal", "hal_2"),
    ("rtapi", "rtapi_2"),
    ("component", "component"),
    ("pin", "pin"),
    ("realtime", "realtime_2"),
    ("a_model_with_a_name_beyond_all_room", "a_mo_wi_a_na_be_al_r"),
];

fn of_names() -> Vec<Component> {
    let one = |(name, called): (&str, &str)| {
        let (model, derivation) = read_and_derive(&description(name, &PLAIN)).unwrap();
        let component = component(&model, &derivation).unwrap();
        assert_eq!(component.name, called);
        component
    };
    CALLED.into_iter().map(one).collect()
}

/// What is declared: whether a pin, its type, its name, its value.
fn declared(component: &Component) -> Vec<(bool, &str, &str, &str)> {
    let lines = component.source.lines().take_while(|line| *line != ";;");
    let items = lines.filter(|line| line.starts_with("pin ") || line.starts_with("param "));
    items
        .map(|line| {
            let mut words = line.split_whitespace();
            let is_pin = words.next() == Some("pin");
            let (kind, name) = (words.nth(1).unwrap(), words.next().unwrap());
            let value = if words.next() == Some("=") { words.next().unwrap() } else { "0" };
            (is_pin, kind, name, value)
        })
        .collect()
}

/// The component in C, with what halcompile would write before and behind it.
fn standing_alone(component: &Component) -> String {
    let mut fields = String::new();
    let mut values = String::new();
    for (is_pin, kind, name, value) in declared(component) {
        let (name, star) = (name.replace('-', "_"), if is_pin { "*" } else { "" });
        fields += &format!("    hal_{kind}_t {star}{name};\n");
        match is_pin {
            true => {
                values +=
                    &format!("    inst->{name} = calloc(1, sizeof *inst->{name});\n    *inst->{name} = {value};\n")
            }
            false => values += &format!("    inst->{name} = {value};\n"),
        }
    }
    let (head, body) = component.source.split_once("\n;;\n").unwrap();
    let data = head.split_once("option data ").unwrap().1.split_once(';').unwrap().0;
    format!(
        "#include <stdlib.h>\ntypedef volatile double hal_float_t;\ntypedef volatile unsigned char hal_bit_t;\n\
         typedef volatile int hal_s32_t;\ntypedef volatile unsigned hal_u32_t;\nstruct __comp_state {{\n    void *_data;\n{fields}}};\n\
         static void _(struct __comp_state *inst, long period);\nstatic void solve(struct __comp_state *inst, long period);\n{body}\n\
         static int __comp_get_data_size(void) {{ return sizeof({data}); }}\n\
         static void declare(struct __comp_state *inst)\n{{\n{values}}}\n"
    )
}

#[test]
fn hal_has_room_for_every_name_and_no_two_are_alike() {
    for component in of_catalogue().iter().chain(&of_names()).chain(&of_machines()) {
        let mut names = BTreeSet::new();
        for (_, _, name, _) in declared(component) {
            let whole = format!("{}.99.{name}", component.name.replace('_', "-"));
            assert!(whole.len() <= LONGEST, "{whole}");
            assert!(names.insert(name.to_owned()), "{whole} twice");
        }
    }
}

#[test]
fn every_component_compiles_without_a_warning() {
    let folder = folder("hal");
    let compiles = |component: &Component, how: &[&str]| {
        let file = folder.join(format!("{}-alone.c", component.name));
        std::fs::write(&file, standing_alone(component)).unwrap();
        let mut gcc = Command::new("gcc");
        gcc.args(AS_HALCOMPILE).args(["-std=gnu17", "-Wall", "-Wextra", "-Werror", "-Wno-unused-function"]).args(how);
        ran(gcc.arg(&file)).is_some()
    };
    // To the end, for the frames; what the machines add is names.
    let whole = of_catalogue().iter().all(|component| compiles(component, &["-c", "-o", "/dev/null"]));
    let _ = whole && of_machines().iter().all(|component| compiles(component, &["-fsyntax-only"]));
}

#[test]
fn halcompile_builds_components() {
    const EACH: usize = 30;
    if Command::new("halcompile").arg("--help").output().is_err() {
        println!("skipped: no halcompile");
        return;
    }
    let folder = folder("halcompile");
    for component in of_catalogue().iter().chain(&of_names()).chain(of_machines().iter().step_by(EACH)) {
        let file = format!("{}.comp", component.name);
        std::fs::write(folder.join(&file), &component.source).unwrap();
        let built = Command::new("halcompile").current_dir(&folder).args(["--compile", &file]).output().unwrap();
        let told = String::from_utf8_lossy(&built.stderr);
        assert!(built.status.success() && !told.contains("warning"), "{file}: {told}");
        assert!(folder.join(format!("{}.so", component.name)).exists());
    }
}

/// The reference runs: degrees and µm.
fn samples() -> Vec<[f64; 5]> {
    let columns = |file: &str| -> Vec<Vec<f64>> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/tilting-table/full").join(file);
        let text = std::fs::read_to_string(path).unwrap();
        text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
    };
    let (tilting, separation, table) = (columns("tilting.csv"), columns("separation.csv"), columns("table.csv"));
    let rows = tilting.iter().zip(&separation).zip(&table);
    rows.map(|((t, s), k)| [t[0], t[1], s[1], k[1], k[2]]).collect()
}

#[test]
fn a_component_fits_as_the_solver_does() {
    let folder = folder("hal-run");
    let model = catalogue::model("tilting-table-a").unwrap().unwrap();
    let component = component(&model, &derive(&model).unwrap()).unwrap();
    let driver = include_str!("component.c");
    let (file, program, input) = (folder.join("run.c"), folder.join("run"), folder.join("samples"));
    std::fs::write(&file, standing_alone(&component) + driver).unwrap();
    let samples = samples();
    let lines = samples.iter().map(|sample| sample.map(|v| format!("{v:?}")).join(" ") + "\n");
    std::fs::write(&input, lines.collect::<String>()).unwrap();
    let Some(_) =
        ran(Command::new("gcc").args(["-Wall", "-Wextra", "-Werror"]).arg(&file).arg("-o").arg(&program).arg("-lm"))
    else {
        return;
    };
    let printed = ran(Command::new(&program).arg(&input)).unwrap();
    let mut lines = printed.lines();

    // Never solved; of one sample of each run; not solved again; samples, one refused as not finite.
    let first: Vec<&str> = lines.by_ref().take(4).collect();
    assert_eq!(first, ["3 0", "7 1", "7 1", "720 1 5"]);
    let mut joint = Joint::new(Lengths { r: 150.0 }).unwrap();
    for [a, tilting, separation, y, z] in samples {
        joint.push_tilting(a.to_radians(), tilting * 1e-3, y * 1e-3, z * 1e-3).unwrap();
        joint.push_separation(a.to_radians(), separation * 1e-3).unwrap();
    }
    let estimate = joint.solve().unwrap();
    for degree in (15..360).step_by(15) {
        let line: Vec<f64> = lines.next().unwrap().split(' ').map(|v| v.parse().unwrap()).collect();
        let (value, std) = estimate.e_xa(f64::from(degree).to_radians()).unwrap();
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * (std * 1e6);
        assert!(line[0] == 0.0 && close(line[1], value * 1e6) && close(line[2], std * 1e6), "{degree}: {line:?}");
    }
    // After a reset there is nothing to solve for, and nothing is told.
    assert_eq!(lines.collect::<Vec<_>>(), ["0 0 0 7", "0 0"]);
}

#[test]
fn what_hal_has_no_memory_for_is_refused() {
    let plain = description("large", &PLAIN).replace("fourier = 1", "fourier = 8").replace("\"x\" }", "\"xyz\" }");
    let more =
        |text: String, axis| text.replace(&format!("EY{axis} = \"zero\""), &format!("EY{axis} = {{ fourier = 8 }}"));
    let large = PLAIN[3].into_iter().fold(plain.replace("\"known\"", "{ fourier = 8 }"), more);
    let (model, derivation) = read_and_derive(&large).unwrap();
    let refused = component(&model, &derivation).unwrap_err();
    let ComponentError::TooManyUnknowns { unknowns, most } = refused else { panic!("{refused}") };
    assert!(unknowns == derivation.base.len() && most == 73, "{refused}");
}
