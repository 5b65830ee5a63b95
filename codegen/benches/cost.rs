//! Measures derivations: the paper's two runs step by step, then how the cost grows with axes and order.
//!
//! `cargo bench -p trunnion-codegen --bench cost`; with `-- row`, it prints the row that
//! `benches/peers/derive/symplex/src/bin/row.rs` times: the 14 coefficients of the tilting run's linear reading.

use std::hint::black_box;
use std::time::Instant;
use trunnion_codegen::algebra::Order;
use trunnion_codegen::emit::rust::Support;
use trunnion_codegen::emit::{Function, Output};
use trunnion_codegen::graph::Graph;
use trunnion_codegen::identify::derive;
use trunnion_codegen::measurement::reading;
use trunnion_codegen::model::{Draft, DraftAxis, DraftBall, DraftReading, DraftRun, Model};
use trunnion_codegen::{catalogue, emit};

/// Median, smallest and largest of at least 31 timings over at least half a second, ms.
fn timed<T>(mut work: impl FnMut() -> T) -> [f64; 3] {
    let started = Instant::now();
    let mut times = Vec::new();
    while times.len() < 31 || (started.elapsed().as_secs_f64() < 0.5 && times.len() < 10_000) {
        let start = Instant::now();
        black_box(work());
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    [times[times.len() / 2], times[0], times[times.len() - 1]]
}

fn show(what: &str, [median, low, high]: [f64; 3]) {
    println!("{what}: median {median:.3} ms (min {low:.3} max {high:.3})");
}

/// A bar held against a table under the first `count` axes of C, A, X, Y, Z, which all move.
fn machine(count: usize) -> Model {
    let axes = [("C", "c"), ("A", "c"), ("X", "R*cos(c)"), ("Y", "R*sin(c)"), ("Z", "R*cos(c)")];
    let mut draft = Draft::new("growth", "").constant("R");
    let mut run = DraftRun::new("path", "c", DraftReading::bar("R"));
    for (name, coordinate) in axes.into_iter().take(count) {
        let location = ["X", "Y", "Z", "A", "B", "C"].map(|c| format!("E{c}0{name}"));
        draft = match name {
            "C" | "A" => {
                draft.on_workpiece(DraftAxis::rotary(name, if name == "C" { "z" } else { "x" }).located(location))
            }
            other => draft.on_tool(DraftAxis::linear(other, other.to_lowercase()).located(location)),
        };
        run = run.at(name, coordinate);
    }
    let ball = |letter: &str| DraftBall::origin().setup(["x", "y", "z"].map(|d| format!("{letter}_{d}")));
    let mut run = run.workpiece_ball(ball("w")).tool_ball(ball("t"));
    // The tool's ball stays a bar's length away from the table's wherever the slides go.
    run.tool_ball.at = match count {
        0..=2 => ["0", "0", "R"],
        3 => ["-R*cos(c)", "0", "R"],
        4 => ["-R*cos(c)", "-R*sin(c)", "R"],
        _ => ["-R*cos(c)", "-R*sin(c)", "R - R*cos(c)"],
    }
    .map(Into::into)
    .into();
    draft.run(run).build().expect("the machine of this measurement")
}

/// The coefficients of the first run's linear reading, one for each error it sees.
fn row(model: &Model) -> String {
    let linear = reading(model, &model.runs.raw[0], Order::LINEAR).expect("a reading");
    let mut graph = Graph::new();
    let mut elements = Vec::new();
    for (errors, coefficient) in linear.by_errors() {
        let name = errors.errors().map(|e| model.alphabet.error_name(e)).collect::<String>();
        elements.push((name, emit::model::poly(&mut graph, &model.alphabet, &coefficient)));
    }
    let outputs = [Output::array("row", &elements)];
    let inputs = emit::model::run(model, &derive(model).expect("it derives"), 0.into()).expect("it lowers");
    let inputs = inputs.inputs().to_vec();
    let function = Function::new(&graph, "trunnion", &["The linear reading's row."], inputs, &outputs);
    emit::rust::source(&[function.expect("R and a are all")], "tilting-table-a", &Support::of_solver())
}

fn main() {
    if std::env::args().any(|argument| argument == "row") {
        return print!("{}", row(&catalogue::model("tilting-table-a").expect("the paper's model").expect("it reads")));
    }
    let source = catalogue::source("tilting-table-a").expect("the paper's model");
    let model = catalogue::model("tilting-table-a").expect("the paper's model").expect("it reads");
    let readings = || model.runs.iter().map(|r| reading(&model, r, Order::LINEAR)).collect::<Vec<_>>();
    let rust = || derive(&model).map(|d| emit::rust::model_source(&model, &d, &Support::of_solver()));
    show("file to model", timed(|| trunnion_codegen::model::read(source)));
    show("both runs, from matrices to linear normal form", timed(readings));
    show("  and base parameters", timed(|| derive(&model)));
    show("  and Rust source", timed(rust));
    for count in 1..=5 {
        let model = machine(count);
        for order in 1..=3 {
            let order = Order::new(order).expect("a small order");
            let terms = reading(&model, &model.runs.raw[0], order).expect("a reading").terms().len();
            let times = timed(|| reading(&model, &model.runs.raw[0], order));
            show(&format!("{count} axes, order {}, {terms} terms", order.get()), times);
        }
    }
}
