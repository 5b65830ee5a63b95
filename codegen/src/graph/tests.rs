//! Identities, derivatives against finite differences, and every way of evaluating against every other.

use proptest::prelude::*;

use super::*;

const X: Symbol = Symbol::Input(0);
const Y: Symbol = Symbol::Input(1);
const Z: Symbol = Symbol::Input(2);

fn rational(numer: i128, denom: i128) -> Rational {
    Rational::new(numer, denom)
}

#[test]
fn sums_collect_like_terms() {
    let mut g = Graph::new();
    let [x, y] = g.inputs();
    let twice = g.sum(&[x, x]);
    assert_eq!(twice, g.linear(&[(rational(2, 1), x)]));
    assert_eq!(g.difference(x, x), Id::ZERO);
    let nested = g.sum(&[y, x]);
    let negated = g.negate(nested);
    assert_eq!(g.sum(&[nested, negated]), Id::ZERO);
    assert_eq!(g.sum(&[x, y]), nested);
    let half = g.rational(rational(1, 2));
    let one = g.linear(&[(rational(1, 2), Id::ONE), (rational(1, 1), half)]);
    assert_eq!(one, Id::ONE);
    let opened = g.monomial(rational(3, 1), &[(nested, 1)]);
    assert_eq!(opened, g.linear(&[(rational(3, 1), y), (rational(3, 1), x)]));
}

#[test]
fn products_collect_like_factors() {
    let mut g = Graph::new();
    let [x, y] = g.inputs();
    assert_eq!(g.product(&[x, x]), g.power(x, 2));
    assert_eq!(g.quotient(x, x), Id::ONE);
    assert_eq!(g.product(&[x, Id::ZERO]), Id::ZERO);
    let xy = g.product(&[x, y]);
    assert_eq!(g.product(&[y, x]), xy);
    assert_eq!(g.power(xy, -2), g.monomial(rational(1, 1), &[(x, -2), (y, -2)]));
    let sum = g.sum(&[x, y]);
    let square = g.power(sum, 2);
    assert_eq!(g.quotient(square, sum), sum);
}

#[test]
fn roots_are_one_form() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let root = g.sqrt(x);
    assert_eq!(g.power(root, 2), x);
    assert_eq!(g.quotient(x, root), root);
    assert_eq!(g.product(&[Id::SQRT_2, Id::SQRT_2]), g.integer(2));
    let (eight, half) = (g.integer(8), g.rational(rational(1, 2)));
    assert_eq!(g.sqrt(eight), g.linear(&[(rational(2, 1), Id::SQRT_2)]));
    assert_eq!(g.sqrt(half), g.power(Id::SQRT_2, -1));
    let ninth = g.rational(rational(4, 9));
    assert_eq!(g.sqrt(ninth), g.rational(rational(2, 3)));
    let cube = g.power(root, -3);
    assert_eq!(g.product(&[cube, x, x]), root);
    let minus_four = g.integer(-4);
    assert!(matches!(g.sqrt(minus_four), id if *g.node(id) == Node::Sqrt(minus_four)));
}

#[test]
fn angles_of_fixed_axes_are_exact() {
    let mut g = Graph::new();
    for eighth in -20..=20 {
        let angle = g.linear(&[(rational(eighth, 4), Id::PI)]);
        let (sin, cos) = (g.sin(angle), g.cos(angle));
        let value = eighth as f64 * std::f64::consts::FRAC_PI_4;
        assert!((g.evaluate(sin, &[]).unwrap() - value.sin()).abs() < 1e-14, "sin of {eighth}/8");
        assert!((g.evaluate(cos, &[]).unwrap() - value.cos()).abs() < 1e-14, "cos of {eighth}/8");
        let (ss, cc) = (g.power(sin, 2), g.power(cos, 2));
        assert_eq!(g.sum(&[ss, cc]), Id::ONE);
    }
    let [x, y] = g.inputs();
    let (forth, back) = (g.difference(x, y), g.difference(y, x));
    assert_eq!(g.cos(forth), g.cos(back));
    let (sin_forth, sin_back) = (g.sin(forth), g.sin(back));
    assert_eq!(g.sum(&[sin_forth, sin_back]), Id::ZERO);
}

#[test]
fn constants_are_exact_at_any_size() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let big = g.integer(i128::MAX);
    let close = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-12, "{value} {expected}");
    let max = i128::MAX as f64;
    let square = g.power(big, 2);
    close(g.evaluate(square, &[]).unwrap(), max * max);
    assert!(matches!(g.node(square), Node::Rational(_)));
    let unfolded = g.power(big, 9);
    assert!(matches!(g.node(unfolded), Node::Product(..)));
    let sum = g.sum(&[big, big, x]);
    close(g.evaluate(sum, &[(X, 0.0)]).unwrap(), 2.0 * max);
    let scaled_sum = g.product(&[sum, big]);
    close(g.evaluate(scaled_sum, &[(X, max)]).unwrap(), 3.0 * max * max);
    let min = g.integer(i128::MIN);
    close(g.evaluate(min, &[]).unwrap(), i128::MIN as f64);
    let mixed = g.rational(Rational::new(i128::MIN, 6));
    close(g.evaluate(mixed, &[]).unwrap(), i128::MIN as f64 / 6.0);
    let steep = g.power(x, i32::MAX);
    let steeper = g.product(&[steep, steep, x]);
    let nearly_one = 1.0 + 1.0 / f64::from(1 << 30);
    let expected = (f64::from(u32::MAX) * (nearly_one - 1.0).ln_1p()).exp();
    // Thirty squarings double the rounding error thirty times.
    assert!((g.evaluate(steeper, &[(X, nearly_one)]).unwrap() / expected - 1.0).abs() < 1e-5);
    let flat = g.power(steep, i32::MIN);
    assert_eq!(g.evaluate(flat, &[(X, 1.0)]), Ok(1.0));
    let five = g.integer(5);
    let undefined = g.quotient(five, Id::ZERO);
    assert_eq!(g.evaluate(undefined, &[]), Ok(f64::INFINITY));
    let slope = g.derivative(steeper, x);
    assert!(g.evaluate(slope, &[(X, 1.0)]).unwrap() > 4.2e9);
    for id in [square, scaled_sum, min, mixed, undefined, slope] {
        let program = g.lower(&[X], &[id]).unwrap();
        let mut output = [0.0];
        Tape::new(&program).evaluator().evaluate(&[1.0], &mut output).unwrap();
        let direct = g.evaluate(id, &[(X, 1.0)]).unwrap();
        assert!(output[0] == direct || (output[0] / direct - 1.0).abs() < 1e-12, "{} {direct}", output[0]);
    }
}

#[test]
fn an_unbound_symbol_is_told() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let unbound = Unbound { symbol: X };
    assert_eq!(g.evaluate(x, &[(Y, 1.0)]), Err(unbound));
    assert_eq!(g.lower(&[Y], &[x]), Err(unbound));
}

#[test]
fn wrong_lengths_are_refused() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    let tape = Tape::new(&g.lower(&[X], &[x]).unwrap());
    let mut evaluator = tape.evaluator();
    assert_eq!(evaluator.evaluate(&[], &mut [0.0]), Err(WrongLength::Inputs { expected: 1, given: 0 }));
    assert_eq!(evaluator.evaluate(&[1.0], &mut []), Err(WrongLength::Outputs { expected: 1, given: 0 }));
}

/// The regressors of the tilting table's first run, T(7).
pub(crate) fn tilting(g: &mut Graph) -> Vec<(&'static str, Id)> {
    let [radius, a] = g.inputs();
    let (s, c) = (g.sin(a), g.cos(a));
    let mut row = |r, m, n| g.monomial(rational(1, 1), &[(radius, r), (s, m), (c, n)]);
    vec![
        ("k1", row(2, 3, 0)),
        ("k2", row(3, 2, 2)),
        ("k3", row(2, 2, 1)),
        ("k4", row(1, 2, 0)),
        ("k5", row(1, 1, 1)),
        ("k6", row(0, 1, 0)),
        ("k7", row(0, 0, 1)),
        ("k8", row(1, 0, 0)),
    ]
}

#[test]
fn a_row_shares_its_factors() {
    let mut g = Graph::new();
    let row: Vec<Id> = tilting(&mut g).into_iter().map(|(_, id)| id).collect();
    let program = g.lower(&[X, Y], &row).unwrap();
    let expected = Operations { multiplications: 7, angles: 1, ..Operations::default() };
    assert_eq!(program.operations(), expected);
}

#[test]
fn powers_are_squared_repeatedly() {
    let mut g = Graph::new();
    let [x] = g.inputs();
    for (exponent, multiplications) in [(2, 1), (4, 2), (8, 3), (7, 4), (1 << 30, 30), (-4, 2)] {
        let power = g.power(x, exponent);
        let count = g.lower(&[X], &[power]).unwrap().operations();
        assert_eq!(count.multiplications, multiplications, "x^{exponent}");
        assert_eq!(count.divisions, usize::from(exponent < 0));
    }
}

#[test]
fn a_divisor_used_often_becomes_a_reciprocal() {
    let mut g = Graph::new();
    let [x, y, z] = g.inputs();
    let squares = [x, y, z].map(|u| g.power(u, 2));
    let sum = g.sum(&squares);
    let length = g.sqrt(sum);
    let unit = [x, y, z].map(|u| g.quotient(u, length));
    let count = g.lower(&[X, Y, Z], &unit).unwrap().operations();
    assert_eq!((count.divisions, count.roots, count.multiplications), (1, 1, 6));
    let count = g.lower(&[X, Y, Z], &unit[..1]).unwrap().operations();
    assert_eq!((count.divisions, count.multiplications), (1, 3));
}

/// One step of a random expression, over expressions made before (by number, modulo how many there are). Every step is
/// smooth, so that finite differences mean something.
#[derive(Clone, Debug)]
enum Make {
    Sum(usize, i8, usize),
    Product(usize, usize),
    Quotient(usize, usize),
    Power(usize, i32),
    Root(usize),
    Sin(usize),
    Cos(usize),
}

fn recipe() -> impl Strategy<Value = Vec<Make>> {
    let n = || 0..100_usize;
    let make = prop_oneof![
        (n(), -3..4_i8, n()).prop_map(|(a, k, b)| Make::Sum(a, k, b)),
        (n(), n()).prop_map(|(a, b)| Make::Product(a, b)),
        (n(), n()).prop_map(|(a, b)| Make::Quotient(a, b)),
        (n(), -3..4).prop_map(|(a, k)| Make::Power(a, k)),
        n().prop_map(Make::Root),
        n().prop_map(Make::Sin),
        n().prop_map(Make::Cos),
    ];
    prop::collection::vec(make, 1..12)
}

fn follow(g: &mut Graph, recipe: &[Make]) -> Vec<Id> {
    let mut made = vec![g.symbol(X), g.symbol(Y), g.rational(rational(2, 3)), Id::PI, Id::SQRT_2];
    for make in recipe {
        let at = |n: &usize| made[n % made.len()];
        let next = match make {
            Make::Sum(a, k, b) => g.linear(&[(rational(1, 1), at(a)), (rational((*k).into(), 2), at(b))]),
            Make::Product(a, b) => g.product(&[at(a), at(b)]),
            Make::Quotient(a, b) => {
                let square = g.power(at(b), 2);
                let below = g.sum(&[Id::ONE, square]);
                g.quotient(at(a), below)
            }
            Make::Power(a, k) => g.power(at(a), *k),
            Make::Root(a) => {
                let square = g.power(at(a), 2);
                let radicand = g.sum(&[square, Id::ONE]);
                g.sqrt(radicand)
            }
            Make::Sin(a) => g.sin(at(a)),
            Make::Cos(a) => g.cos(at(a)),
        };
        made.push(next);
    }
    made
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + a.abs().max(b.abs()))
}

proptest! {
    #[test]
    fn derivatives_are_limits_of_differences(recipe in recipe(), x in 0.5..1.5, y in 0.5..1.5) {
        let mut g = Graph::new();
        let made = follow(&mut g, &recipe);
        let symbol = g.symbol(X);
        let slopes = g.derivatives(&made, symbol);
        for (&f, &slope) in made.iter().zip(&slopes) {
            let at = |x: f64| g.evaluate(f, &[(X, x), (Y, y)]).unwrap();
            let difference = |h: f64| (at(x + h) - at(x - h)) / (2.0 * h);
            let (coarse, fine) = (difference(2e-4), difference(1e-4));
            // Where differences themselves have not converged they decide nothing.
            if close(coarse, fine, 1e-6) && at(x).abs() < 1e4 {
                let exact = g.evaluate(slope, &[(X, x), (Y, y)]).unwrap();
                prop_assert!(close(exact, fine, 1e-5), "{exact} against {fine}");
            }
        }
    }

    #[test]
    fn a_tape_gives_what_the_graph_gives(recipe in recipe(), x in 0.5..1.5, y in 0.5..1.5) {
        let mut g = Graph::new();
        let made = follow(&mut g, &recipe);
        let tape = Tape::new(&g.lower(&[Y, X], &made).unwrap());
        let mut outputs = vec![0.0; made.len()];
        tape.evaluator().evaluate(&[y, x], &mut outputs).unwrap();
        for (&id, &output) in made.iter().zip(&outputs) {
            let at = |x: f64| g.evaluate(id, &[(X, x), (Y, y)]).unwrap();
            let well_conditioned = close(at(x), at(x + 1e-12), 1e-9) && at(x).is_finite();
            prop_assert!(!well_conditioned || close(at(x), output, 1e-8), "{} against {output}", at(x));
        }
    }
}
