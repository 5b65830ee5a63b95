//! Small printed examples; that printed functions compute right is tested in `tests/printed.rs`.

use insta::assert_snapshot;

use super::{Function, Output, c, latex, numpy, rust, text};
use crate::graph::{Graph, Id, Rational};

/// Expressions that need every rule of writing.
fn examples(g: &mut Graph) -> Vec<Id> {
    let [r, s, c, x, y] = ["R", "s", "c", "x", "y"].map(|name| g.symbol(name));
    let half = Rational::new(1, 2);
    let minus = -Rational::from_integer(1);
    let row = g.monomial(Rational::from_integer(1), &[(r, 2), (s, 3), (c, 1)]);
    let negative = g.monomial(-half, &[(r, 12), (s, 1)]);
    let sum = g.linear(&[(minus, x), (half, y), (Rational::new(-7, 3), Id::ONE), (minus, row)]);
    let all_negative = g.linear(&[(minus, x), (minus, y)]);
    let fraction = g.monomial(Rational::new(2, 3), &[(x, 1), (sum, -1), (y, -2)]);
    let reciprocal = g.power(x, -1);
    let power_of_sum = g.power(sum, 2);
    let difference = g.difference(x, y);
    let sine = g.sin(difference);
    let sine = g.power(sine, 2);
    let cosine = g.cos(x);
    let wave = g.product(&[sine, cosine, Id::PI, Id::SQRT_2]);
    let squares = g.power(x, 2);
    let squares = g.sum(&[squares, Id::ONE]);
    let root = g.sqrt(squares);
    let inverse_root = g.monomial(half, &[(root, -1), (all_negative, 1)]);
    let angle = g.atan2(difference, root);
    let big = g.integer(i128::MAX);
    let unfolded = g.monomial(Rational::new(2, 5), &[(big, 2), (x, 1)]);
    let constant = g.rational(Rational::new(-3, 4));
    vec![
        row,
        negative,
        sum,
        all_negative,
        fraction,
        reciprocal,
        power_of_sum,
        wave,
        root,
        inverse_root,
        angle,
        unfolded,
        constant,
        Id::ZERO,
        Id::PI,
    ]
}

fn lines(print: impl Fn(&Graph, Id) -> String) -> String {
    let mut g = Graph::new();
    let ids = examples(&mut g);
    ids.into_iter().map(|id| print(&g, id) + "\n").collect()
}

#[test]
fn plain_text() {
    assert_snapshot!(lines(text::plain));
}

#[test]
fn pretty_text() {
    assert_snapshot!(lines(|g, id| text::pretty(g, id, &|name| name.replace('x', "δ"))));
}

#[test]
fn latex_text() {
    assert_snapshot!(lines(|g, id| latex::latex(g, id, &|name| match name {
        "R" => "R_{b}".to_owned(),
        "y" => "y^{\\prime}".to_owned(),
        other => other.to_owned(),
    })));
}

/// Names that collide with each other, with keywords and with what printers use themselves.
fn awkward() -> Function {
    let mut g = Graph::new();
    let [upper, lower, keyword, np, empty, digit] = ["R", "r", "for", "np", "δ", "2nd"].map(|name| g.symbol(name));
    let sin = g.sin(upper);
    let product = g.monomial(Rational::new(1, 3), &[(sin, 2), (lower, 1), (keyword, -1)]);
    let sum = g.sum(&[np, empty, digit, Id::PI, product]);
    let negative = g.integer(-2);
    Function::new(
        &g,
        "sin",
        &["Tries names. */ \"\"\" \\"],
        &["R", "r", "for", "np", "δ", "2nd", "unused"],
        &[
            Output::scalar("t", sum),
            Output::array("out", &[("r", product), ("t", negative)]),
            Output::matrix("M", &[[sum, lower], [Id::ZERO, Id::ONE]]),
        ],
    )
    .unwrap()
}

#[test]
fn awkward_names() {
    let f = awkward();
    let rust = rust::source(std::slice::from_ref(&f), "a\ntest");
    assert_snapshot!([rust, c::function(&f, c::Real::Float), numpy::function(&f)].join("\n"));
}

#[test]
fn long_sums_are_cut_into_lines() {
    let mut g = Graph::new();
    let names: Vec<String> = (0..20_000).map(|i| format!("x{i}")).collect();
    let symbols: Vec<Id> = names.iter().map(|name| g.symbol(name)).collect();
    let sum = g.sum(&symbols);
    let inputs: Vec<&str> = names.iter().map(String::as_str).collect();
    let f = Function::new(&g, "long", &[], &inputs, &[Output::scalar("sum", sum)]).unwrap();
    let longest = c::function(&f, c::Real::Double).lines().skip(4).map(str::len).max();
    assert!(longest.is_some_and(|longest| longest < 300), "{longest:?}");
}
