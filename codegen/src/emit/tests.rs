//! Small printed examples; that printed functions compute right is tested in `tests/printed.rs`.

use insta::assert_snapshot;

use super::{Function, Input, Output, c, numpy, rust};
use crate::graph::{Graph, Id, Rational, Symbol};

/// Names that collide with each other, with keywords and with what printers use themselves.
fn awkward() -> Function {
    let mut g = Graph::new();
    let [upper, lower, keyword, np, empty, digit] = g.inputs();
    let sin = g.sin(upper);
    let product = g.monomial(Rational::new(1, 3), &[(sin, 2), (lower, 1), (keyword, -1)]);
    let sum = g.sum(&[np, empty, digit, Id::PI, product]);
    let negative = g.integer(-2);
    Function::new(
        &g,
        "sin",
        &["Tries names. */ \"\"\" \\"],
        Input::all(&["R", "r", "for", "np", "δ", "2nd", "unused"]),
        &[
            Output::array("t", &[("t", sum)]),
            Output::array("out", &[("r", product), ("t", negative)]),
            Output::matrix("M", &[[sum, lower], [Id::ZERO, Id::ONE]]),
        ],
    )
    .unwrap()
}

#[test]
fn awkward_names() {
    let f = awkward();
    let rust = rust::source(std::slice::from_ref(&f), "a\ntest", &rust::Support::of_solver());
    assert_snapshot!([rust, c::function(&f, c::Precision::Float), numpy::function(&f)].join("\n"));
}

/// A literal beyond the range would not compile, or end the printing.
#[test]
fn constants_beyond_the_range_of_numbers_are_infinite() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let large = Rational::from(i128::MAX);
    let huge = (0..8).fold(large.clone(), |power, _| &power * &large);
    let out = [g.monomial(large, &[(x, 1)]), g.monomial(huge, &[(x, 1)])].map(|id| ("y", id));
    let f = Function::new(&g, "f", &[], Input::all(&["x"]), &[Output::array("y", &out)]).unwrap();
    let rust = rust::source(std::slice::from_ref(&f), "a test", &rust::Support::of_solver());
    assert!(rust.contains("let n_2 = T::of(f64::INFINITY)"), "{rust}");
    assert!(c::function(&f, c::Precision::Double).contains("HUGE_VAL * x"));
    let float = c::function(&f, c::Precision::Float);
    assert!(float.contains("HUGE_VALF * x") && float.contains("1.7014118346046923e38f"), "{float}");
    assert!(numpy::function(&f).contains("np.inf * x"));
}

#[test]
fn long_sums_are_cut_into_lines() {
    let mut g = Graph::new();
    let names: Vec<String> = (0..20_000).map(|i| format!("x{i}")).collect();
    let symbols: Vec<Id> = (0..20_000).map(|at| g.symbol(Symbol::Input(at))).collect();
    let sum = g.sum(&symbols);
    let inputs: Vec<&str> = names.iter().map(String::as_str).collect();
    let f = Function::new(&g, "long", &[], Input::all(&inputs), &[Output::array("sum", &[("sum", sum)])]).unwrap();
    let longest = c::function(&f, c::Precision::Double).lines().skip(4).map(str::len).max();
    assert!(longest.is_some_and(|longest| longest < 300), "{longest:?}");
}
