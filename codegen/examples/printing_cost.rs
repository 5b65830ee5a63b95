//! How long a row of 25 regressors takes from constructors to formatted Rust source, and to evaluate.

use std::hint::black_box;
use std::time::Instant;

use trunnion_codegen::emit::{Function, Output, rust};
use trunnion_codegen::graph::{Graph, Id, Rational, Tape};

fn row() -> (Graph, Vec<(String, Id)>) {
    let mut graph = Graph::new();
    let (radius, a) = (graph.symbol("R"), graph.symbol("a"));
    let (s, c) = (graph.sin(a), graph.cos(a));
    let mut elements = Vec::new();
    for n in 0..25 {
        let id = graph.monomial(Rational::from_integer(1), &[(radius, n % 4), (s, n / 4), (c, n % 3)]);
        elements.push((format!("k{}", n + 1), id));
    }
    (graph, elements)
}

fn function((graph, elements): &(Graph, Vec<(String, Id)>)) -> Function {
    match Function::new(graph, "row", &["A row."], &["R", "a"], &[Output::array("row", elements)]) {
        Ok(function) => function,
        Err(unbound) => panic!("{unbound}"),
    }
}

/// The mean of many runs after some that are not counted, in µs.
fn time<R>(what: &str, mut run: impl FnMut() -> R) {
    (0..200).for_each(|_| drop(black_box(run())));
    let start = Instant::now();
    (0..1000).for_each(|_| drop(black_box(run())));
    println!("{what:<32}{:9.3} µs", start.elapsed().as_secs_f64() * 1e3);
}

fn main() {
    let built = row();
    let lowered = function(&built);
    let tokens = rust::item(&lowered, &quote::quote!(num_traits));
    let tape = Tape::new(lowered.program());
    let (mut evaluator, mut outputs) = (tape.evaluator(), [0.0; 25]);
    println!("{:?}", lowered.program().operations());
    time("build the graph", row);
    time("lower and share", || function(&built));
    time("write tokens", || rust::item(&lowered, &quote::quote!(num_traits)));
    time("syn::parse2", || syn::parse2::<syn::File>(tokens.clone()));
    time("syn::parse2 and prettyplease", || rust::pretty(tokens.clone()));
    time("all", || rust::source(&[function(&row())], "a row"));
    time("evaluate the tape", || evaluator.evaluate(black_box(&[150.0, 0.3]), &mut outputs));
}
