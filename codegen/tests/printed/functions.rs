//! The functions that are printed: a row of regressors, and a residual with its Jacobian.

use trunnion_codegen::emit::{Function, Input, Output};
use trunnion_codegen::graph::{Graph, Id, Rational, Symbol};

/// A function and the expressions of its outputs, in order.
pub struct Case {
    pub graph: Graph,
    pub function: Function,
    pub inputs: Vec<&'static str>,
    pub outputs: Vec<Id>,
}

impl Case {
    /// The graph's own evaluation.
    pub fn expected(&self, point: &[f64]) -> Vec<f64> {
        let values: Vec<_> = (0..).map(Symbol::Input).zip(point.iter().copied()).collect();
        self.outputs.iter().map(|&id| self.graph.evaluate(id, &values).unwrap()).collect()
    }
}

/// Outputs of the row below.
pub const ROW: usize = 13;

/// The regressors of the tilting table, T(7) and T(9), the quartics of (10) with π in them, angles less whole turns and a high
/// harmonic.
pub fn tilting() -> Case {
    let mut g = Graph::new();
    let [radius, a] = g.inputs();
    let (s, c) = (g.sin(a), g.cos(a));
    let mut row = |r, m, n| g.monomial(Rational::from(1), &[(radius, r), (s, m), (c, n)]);
    let mut elements = vec![
        ("k1", row(2, 3, 0)),
        ("k2", row(3, 2, 2)),
        ("k3", row(2, 2, 1)),
        ("k4", row(1, 2, 0)),
        ("k5", row(1, 1, 1)),
        ("k6", row(0, 1, 0)),
        ("k7", row(0, 0, 1)),
        ("k8", row(1, 0, 0)),
    ];
    let term = |g: &mut Graph, k: i128, pi: i32, n: i32| g.monomial(Rational::from(k), &[(Id::PI, pi), (a, n)]);
    let quartic = [term(&mut g, 1, 0, 4), term(&mut g, -2, 1, 3), term(&mut g, -2, 2, 2), term(&mut g, 4, 3, 1)];
    let cubic = [term(&mut g, 1, 0, 3), term(&mut g, -3, 1, 2), term(&mut g, 2, 2, 1)];
    for (name, terms) in [("e_xa1", quartic.as_slice()), ("e_xa2", cubic.as_slice())] {
        let sum = g.sum(terms);
        elements.push((name, g.product(&[radius, sum])));
    }
    let thrice = g.linear(&[(Rational::from(-3), a)]);
    let wave = g.linear(&[(Rational::from(64), a)]);
    elements.push(("turn", g.wrapped(a, 0)));
    elements.push(("third", g.wrapped(thrice, -12)));
    elements.push(("wave", g.sin(wave)));
    let outputs = elements.iter().map(|(_, id)| *id).collect();
    let docs = ["Regressors of the tilting run at angle `a` in rad for bar length `R` in mm."];
    let inputs = vec!["R", "a"];
    let function =
        Function::new(&g, "tilting", &docs, Input::all(&inputs), &[Output::array("row", &elements)]).unwrap();
    Case { graph: g, function, inputs, outputs }
}

/// A residual of roots, quotients, sines and cosines with its Jacobian and a single value, for several outputs of each form.
pub fn strut() -> Case {
    let mut g = Graph::new();
    let [x, y, z, base] = g.inputs();
    let squares = [x, y, z].map(|u| g.power(u, 2));
    let sum = g.sum(&squares);
    let length = g.sqrt(sum);
    let lean = g.linear(&[(Rational::from(2), y), (Rational::from(-1), z)]);
    let (sin, cos) = (g.sin(lean), g.cos(lean));
    let third = Rational::new(1, 3);
    let along = g.quotient(x, length);
    let first = g.linear(&[(Rational::from(1), length), (Rational::from(-1), base)]);
    let turned = g.product(&[sin, along, Id::SQRT_2]);
    let second = g.linear(&[(third.clone(), turned), (Rational::from(1), cos)]);
    let third = g.monomial(-&third, &[(y, 1), (z, 1), (sum, -1)]);
    let residual = [first, second, third];
    let columns = [x, y, z].map(|u| g.derivatives(&residual, u));
    let jacobian: [[Id; 3]; 3] = std::array::from_fn(|r| std::array::from_fn(|c| columns[c][r]));
    let outputs = residual.into_iter().chain(jacobian.into_iter().flatten()).chain([lean]).collect();
    let inputs = vec!["x", "y", "z", "B", "unused"];
    let named = [("length", first), ("turn", second), ("twist", third)];
    let function = Function::new(
        &g,
        "strut",
        &["A residual and its exact Jacobian."],
        Input::all(&inputs),
        &[
            Output::array("residual", &named),
            Output::matrix("jacobian", &jacobian),
            Output::array("lean", &[("lean", lean)]),
        ],
    )
    .unwrap();
    Case { graph: g, function, inputs, outputs }
}
