//! What is assumed, put in exactly: against ranks in numbers, and each form in which it is written.

use nalgebra::DMatrix;
use trunnion_codegen::algebra::at;
use trunnion_codegen::catalogue::source;
use trunnion_codegen::emit::equations;
use trunnion_codegen::identify::{Derivation, Extent, Origin, Parameter};
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::read_and_derive;

fn length(name: &str) -> f64 {
    if name == "R" { 1.0 } else { 0.83 }
}

/// The rotary table without the runs that have the ball on the other side: these leave its first harmonic open.
fn derived(assume: &str) -> (Model, Derivation) {
    let file = source("rotary-table-c").unwrap();
    let (runs, functions) = file.split_once("\n[function]").unwrap();
    let runs: Vec<&str> = runs.split("\n[run.").filter(|run| !run.contains("-opposite]")).collect();
    read_and_derive(&format!("{}\n[function]{functions}\n[assume]\n{assume}", runs.join("\n[run."))).unwrap()
}

/// A row of readings for many angles, and one for each condition, over the parameters without any assumption.
fn rows(model: &Model, free: &Derivation, conditions: &Model) -> DMatrix<f64> {
    let mut rows = Vec::new();
    for (i, run) in free.runs.iter_enumerated() {
        let linear = run.reading.by_errors();
        for k in 0..40 {
            let sweep = f64::from(k) * 0.157;
            let value = |p| at(p, &model.alphabet, sweep, length);
            let factor = |error| {
                let found = linear.iter().find(|(m, _)| m.errors().next() == Some(error));
                found.map_or(0.0, |(_, p)| value(p))
            };
            let column = |p: &Parameter| match p.origin {
                Origin::Constant(error) => factor(error),
                Origin::Coefficient(c) => {
                    let f = &model.functions[c.function];
                    let axis = model.axis_of(f.error).unwrap().0;
                    let x = model.runs[i].at[axis].poly().map(value);
                    x.map_or(0.0, |x| factor(f.error) * f.basis.values(x, &model.alphabet, &length)[c.term])
                }
            };
            rows.push(free.parameters.iter().map(column).collect::<Vec<_>>());
        }
    }
    for condition in &conditions.assumptions {
        let entry = |p: &Parameter| {
            let found = condition.terms.iter().find(|(origin, _)| *origin == p.origin);
            found.map_or(0.0, |(_, f)| at(f, &model.alphabet, 0.0, length))
        };
        rows.push(free.parameters.iter().map(entry).collect());
    }
    DMatrix::from_fn(rows.len(), free.parameters.len(), |i, j| rows[i][j])
}

fn rank(matrix: &DMatrix<f64>) -> usize {
    let values = matrix.singular_values();
    values.iter().filter(|v| **v > 1e-9 * values.max()).count()
}

#[test]
fn what_is_determined_under_assumptions_is_so_in_numbers() {
    let (plain, free) = derived("");
    let sets = [
        "EYC_cos2 = \"0\"",
        "ECC = \"0 at c = 0\"",
        "EXC = \"0\"\nEYC = \"0\"",
        "EXC_cos1 = \"EYC_sin1\"\nEYC_cos1 = \"-EXC_sin1\"",
        "EXC = \"EYC at c = pi/2\"\nEXC_cos1 = \"2*L*ECC_cos2 - EX0C\"",
        "EXC = \"0\"\nEYC = \"0\"\nEXX = \"0\"\nEYX = \"0\"\nEXY = \"0\"\nEYY = \"0\"\nECX = \"0\"\nEC0C = \"0\"\nEC0Y = \"0\"",
        "ECX1 = \"0\"\nEXX = \"0\"\nEYX = \"0\"\nEXY = \"0\"\nEYY = \"0\"\nEC0Y = \"0\"\nEXC = \"0\"\nEYC = \"0\"\nt_y1 = \"w_y1\"",
    ];
    let (mut seen, mut gained) = (0, 0);
    for set in sets {
        let (model, derivation) = derived(set);
        let matrix = rows(&plain, &free, &model);
        let conditions = model.assumptions.len();
        assert_eq!(rank(&matrix), derivation.base.len() + derivation.assumed.len(), "{set}");
        assert!(derivation.assumed.len() <= conditions, "{set}");
        for d in &derivation.functions {
            let own = |p: &Parameter| matches!(p.origin, Origin::Coefficient(c) if c.function == d.function);
            let determined = |j: usize| {
                let mut more = matrix.clone().insert_row(0, 0.0);
                more[(0, j)] = 1.0;
                rank(&more) == rank(&matrix)
            };
            let all = free.parameters.iter().enumerate().filter(|(_, p)| own(p)).all(|(j, _)| determined(j));
            assert_eq!(d.extent() == Extent::Determined, all, "{set}");
            seen += 1;
            gained += usize::from(all);
        }
    }
    assert!(gained > 0 && gained < seen, "{gained} of {seen}");
}

#[test]
fn every_form_is_read_and_told() {
    let told = |assume: &str| {
        let (model, derivation) = derived(assume);
        let text = equations::text(&model, &derivation);
        let json = equations::json(&model, &derivation);
        let lines = text.lines().filter_map(|l| l.strip_prefix("assumed: ").map(str::to_owned));
        let lines: Vec<String> = lines.collect();
        assert_eq!(json["assumptions"].as_array().unwrap().len(), lines.len());
        (lines, derivation.assumed.len())
    };
    assert_eq!(told(""), (vec![], 0));
    for (written, count) in [
        ("EYC_cos2 = \"0\"", 1),
        ("w_x1 = \"t_x1/2\"", 1),
        ("EXC = \"0 at c = 0\"", 1),
        ("EXX = \"EYX at x = L\"", 1),
        ("EXC = \"EYC at c = pi/2\"", 1),
        ("EXC_cos1 = \"2*L*ECC_cos2 - EX0C\"", 1),
        // What holds already changes nothing.
        ("EXX = \"0 at x = 0\"", 0),
    ] {
        assert_eq!(told(written), (vec![written.replace('"', "")], count));
    }
    assert_eq!(told("EXC = \"0\"").1, 4);
}

/// A constant called like a base parameter would be: the numbers go on where it is free.
#[test]
fn base_parameters_take_no_name_of_the_model() {
    let file = source("tilting-table-a").unwrap();
    let renamed = file.replace("\"R\"", "\"k2\"").replace("R_mm", "k2_mm").replace("R*", "k2*").replace("w_y2", "k5");
    let (_, derivation) = read_and_derive(&renamed).unwrap();
    let names: Vec<&str> = derivation.base.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names[2..], ["k1", "k3", "k4", "k6", "k7", "k8", "k9", "k10", "k11", "k12", "k13"]);
}

#[test]
fn what_the_order_names_may_be_assumed() {
    let file = source("tilting-table-a").unwrap();
    let (model, free) = read_and_derive(file).unwrap();
    for name in model.order.iter().map(|text| &text.value) {
        let (_, derived) = read_and_derive(&format!("{file}\n[assume]\n{name} = \"0\"\n")).unwrap();
        assert!(
            derived.parameters.iter().all(|p| p.name != *name) && derived.parameters.len() + 1 == free.parameters.len()
        );
    }
}
