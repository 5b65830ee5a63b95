//! The tilting-table paper beside what is derived: every printed equation, and where the print is wrong.

use std::collections::BTreeMap;
use std::fmt::Write;
use trunnion_codegen::algebra::{Alphabet, Fraction, Order, Poly};
use trunnion_codegen::basis::Coordinate;
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::equations::{self, Printer, Style};
use trunnion_codegen::identify::{Derivation, derive};
use trunnion_codegen::ids::{ParameterId, RunId};
use trunnion_codegen::measurement;
use trunnion_codegen::model::{Expr, ExprKind, Model, Scope, parse, read};

/// Printed right-hand sides, as they stand in the paper, in plain infix.
const PRINTED_5: &str = "sin(a)*(-d_ya + d_zc + d_yy - R*sin(a)*(e_xy + s_xz) - o_ya + t_y1)
    + cos(a)*(d_za - d_zz - d_zy + o_za - t_z1) + R*e_xa + w_z1";
const PRINTED_7: &str =
    "-d_ya*sin(a) + d_za*cos(a) + R*e_xa + w_z1 + k1*R**2*sin(a)**3*cos(a) + k2*R**3*sin(a)**2*cos(a)**2
    + k3*R**2*sin(a)**2*cos(a) + k4*R*sin(a)**2 + k5*R*sin(a)*cos(a) + k6*sin(a) + k7*cos(a) + k8*R";
const PRINTED_9: &str =
    "k1*R**2*sin(a)**2*cos(a) + k2*R**3*sin(a)*cos(a)**3 + k3*R**2*sin(a)*cos(a)**2 + k4*R*sin(a)*cos(a)
    + k5*R*cos(a)**2 + k6*cos(a) + k10*sin(a) + k11*R";
const PRINTED_10: &str = "e_zc1*(c**4 - 2*pi*c**3 - 2*pi**2*c**2 + 4*pi**3*c) + e_zc2*(c**3 - 3*pi*c**2 + 2*pi**2*c)";
const PRINTED_DEFINITIONS: [(&str, &str); 11] = [
    ("k1", "-d_yy2 + d_yz2"),
    ("k2", "-e_xy2"),
    ("k3", "-e_xy1 - d_zz2 + d_zy2"),
    ("k4", "d_yz1 + d_zy1 - s_xz"),
    ("k5", "d_yy1 - d_zz1"),
    ("k6", "d_yy2*R**2 - o_ya + t_y1"),
    ("k7", "-d_zy2*R**2 + o_za - t_z1"),
    ("k8", "-d_zy1"),
    ("k9", "d_yy2*R**2 - w_y2 + t_y1"),
    ("k10", "d_zz2*R**2 - w_z2 + t_z1"),
    ("k11", "d_zz1"),
];

type Linear = BTreeMap<String, Poly>;

fn paper() -> (Model, Derivation) {
    let model = catalogue::model("tilting-table-a").unwrap().unwrap();
    let derivation = derive(&model).unwrap();
    (model, derivation)
}

/// Names that stand for quantities a printed equation is linear in.
fn unknowns(e: &Expr, known: &[&str], out: &mut Vec<String>) {
    match &e.node {
        ExprKind::Name(name) if !known.contains(&name.as_str()) && !out.contains(name) => out.push(name.clone()),
        ExprKind::Negative(x) | ExprKind::Call(_, _, x) => unknowns(x, known, out),
        ExprKind::Binary(_, x, y) => {
            unknowns(x, known, out);
            unknowns(y, known, out);
        }
        _ => {}
    }
}

/// The expression with one unknown set to 1 and the others to 0: its coefficient.
fn pick(e: &Expr, unknowns: &[String], one: &str) -> Expr {
    let inner = |x: &Expr| Box::new(pick(x, unknowns, one));
    let node = match &e.node {
        ExprKind::Name(name) if unknowns.contains(name) => ExprKind::Number(i128::from(name == one), 1),
        ExprKind::Negative(x) => ExprKind::Negative(inner(x)),
        ExprKind::Call(name, primes, x) => ExprKind::Call(name.clone(), *primes, inner(x)),
        ExprKind::Binary(operator, x, y) => ExprKind::Binary(*operator, inner(x), inner(y)),
        other => other.clone(),
    };
    Expr { node, span: e.span.clone() }
}

/// A printed right-hand side as coefficients of its unknowns, in normal form.
fn printed(text: &str, model: &Model, sweep: &str) -> Linear {
    let alphabet = &model.alphabet;
    let expression = parse(text).unwrap();
    let mut names = Vec::new();
    unknowns(&expression, &["R", "pi", sweep], &mut names);
    let scope = Scope { alphabet, sweep: alphabet.find_sweep(sweep), defined: &[] };
    let coefficient = |name: &String| scope.poly(&pick(&expression, &names, name)).unwrap().normal(alphabet).unwrap();
    names.iter().map(|name| (name.clone(), coefficient(name))).collect()
}

fn whole(f: &Fraction, alphabet: &Alphabet) -> Poly {
    f.as_poly().unwrap().normal(alphabet).unwrap()
}

/// What is printed and not derived, and the other way round.
fn differences(printed: &Linear, derived: &Linear, alphabet: &Alphabet) -> String {
    let printer = Printer { alphabet, style: Style::Pretty };
    let mut out = String::new();
    let names: std::collections::BTreeSet<&String> = printed.keys().chain(derived.keys()).collect();
    for name in names {
        let term = |p: Option<&Poly>| p.map_or("absent".to_owned(), |p| printer.poly(p));
        if printed.get(name) != derived.get(name) {
            let _ = writeln!(
                out,
                "  MISPRINT  factor of {name}: printed {}, derived {}",
                term(printed.get(name)),
                term(derived.get(name))
            );
        }
    }
    if out.is_empty() { "  as printed\n".to_owned() } else { out }
}

fn by_name(model: &Model, reading: &Poly) -> Linear {
    let name = |(m, p): (trunnion_codegen::algebra::Monomial, Poly)| {
        let error = m.errors().next().unwrap();
        (model.alphabet.error_name(error).to_owned(), p)
    };
    reading.by_errors().into_iter().map(name).collect()
}

fn reading(model: &Model, derivation: &Derivation, run: RunId) -> Linear {
    by_name(model, &derivation.runs[run].reading)
}

/// A run's model equation: base parameters, known functions, and the estimated function itself.
fn equation(model: &Model, derivation: &Derivation, run: RunId) -> Linear {
    let derived = &derivation.runs[run];
    let lumped = derived.regressors.iter().filter(|(b, _)| derivation.base[*b].estimates.is_none());
    let mut out: Linear = lumped.map(|(b, r)| (derivation.base[*b].name.clone(), whole(r, &model.alphabet))).collect();
    for (f, p) in &derived.known {
        out.insert(model.alphabet.error_name(model.functions[*f].error).to_owned(), p.clone());
    }
    if let Some(p) = reading(model, derivation, run).remove("e_xa") {
        out.insert("e_xa".to_owned(), p);
    }
    out
}

/// An equation over several lines where it is long, cut between the terms that stand in no parentheses.
fn one_term_a_line(equation: &str) -> String {
    let words: Vec<&str> = equation.split_whitespace().collect();
    let long = words.join(" ").chars().count() > 100;
    let mut open = 0_i32;
    let mut out = String::new();
    for word in words {
        let cut = long && open == 0 && ["+", "-", "−"].contains(&word) && !out.is_empty();
        out += if cut {
            "\n            "
        } else if out.is_empty() {
            ""
        } else {
            " "
        };
        out += word;
        open += word.matches('(').count() as i32 - word.matches(')').count() as i32;
    }
    out
}

/// JSON with its long texts over several lines, for reading.
fn readable(json: &str) -> String {
    let line = |line: &str| match line.chars().count() > 100 {
        true => line.replace(" + ", "\n          + "),
        false => line.to_owned(),
    };
    json.lines().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_printed_equation_beside_the_derived_one() {
    let (model, derivation) = paper();
    let [tilting, separation] = [0, 1].map(RunId::from);
    let alphabet = &model.alphabet;
    let mut out = String::from(
        "K. I. Lee, D. M. Lee, S. H. Yang: Measurement of Angular Positioning Error for a Tilting Table\n",
    );
    let mut section = |number: &str, printed_text: &str, derived_text: &str, verdict: &str| {
        let [printed, derived] = [printed_text, derived_text].map(one_term_a_line);
        let _ = write!(out, "\n({number})\n  printed   {printed}\n  derived   {derived}\n{verdict}");
    };
    let document: Vec<String> = equations::text(&model, &derivation).lines().map(str::to_owned).collect();
    let shown = |after: &str, nth: usize| -> String {
        let at = document.iter().position(|l| l.starts_with(after)).unwrap();
        let (start, _) = document[at..].iter().enumerate().filter(|(_, l)| l.starts_with("  ΔR")).nth(nth).unwrap();
        let rest = document[at + start + 1..].iter().take_while(|l| l.starts_with("    "));
        let parts: Vec<&str> = [&document[at + start]].into_iter().chain(rest).map(|l| l.trim()).collect();
        parts.join(" ")
    };

    let verdict = differences(&printed(PRINTED_5, &model, "a"), &reading(&model, &derivation, tilting), alphabet);
    section("5", PRINTED_5, &shown("Run tilting", 0), &verdict);

    // The paper's k8·R and w_z1 have one regressor and are one base parameter: compared as `w_z1 + R·(−d_zy1)`.
    let mut seven = printed(PRINTED_7, &model, "a");
    let (w_z1, k8) = (seven.remove("w_z1").unwrap(), seven.remove("k8").unwrap());
    let of = |name: &str| derivation.base.iter().find(|b| b.name == name).unwrap();
    let definition = |name: &str| -> Linear {
        let parameter = |(j, f): &(ParameterId, Fraction)| (derivation.parameters[*j].name.clone(), whole(f, alphabet));
        of(name).definition.iter().map(parameter).collect()
    };
    let pair: Linear = [("w_z1".to_owned(), w_z1), ("d_zy1".to_owned(), k8.negated())].into();
    assert_eq!(definition("k8"), pair);
    let mut derived = equation(&model, &derivation, tilting);
    assert_eq!(derived.remove("k8"), Some(Poly::one()));
    let mut verdict = differences(&seven, &derived, alphabet);
    verdict += "  NOTE      w_z1 + k8·R is one base parameter: derived k8 = w_z1 − R·d_zy1 with the factor 1\n";
    section("7", PRINTED_7, &shown("Run tilting", 1), &verdict);

    let moving = catalogue::source("tilting-table-a").unwrap().replace("A = \"rest\"", "A = \"a\"");
    let moving = read(&moving).unwrap();
    let with_table = measurement::reading(&moving, &moving.runs[separation], Order::LINEAR).unwrap();
    let with_table = by_name(&moving, &with_table);
    let at_rest = reading(&model, &derivation, separation);
    let printer = Printer { alphabet, style: Style::Pretty };
    let extra = with_table.iter().filter(|(name, _)| !at_rest.contains_key(*name));
    let extra: Vec<String> = extra.map(|(name, p)| format!("({})·{name}", printer.poly(p))).collect();
    let verdict = format!("  MISPRINT  with P_A the reading (9) would also hold {}\n", extra.join(" + "));
    assert_eq!(extra.len(), 4, "δ_ya, δ_za, o_ya, o_za");
    section("8", "WB2 = P_A [w_x2, w_y2, w_z2, 1]", "WB2 = [w_x2, w_y2, w_z2, 1], the table at rest", &verdict);

    let verdict = differences(&printed(PRINTED_9, &model, "a"), &equation(&model, &derivation, separation), alphabet);
    section("9", PRINTED_9, &shown("Run separation", 1), &verdict);

    let function = document.iter().find(|l| l.trim_start().starts_with("e_xa(a)")).unwrap().trim();
    let mut other = Model { alphabet: Alphabet::default(), ..model.clone() };
    other.alphabet.sweep("c").unwrap();
    let as_printed: Vec<Poly> = printed(PRINTED_10, &other, "c").into_values().collect();
    let basis = &model.functions.iter().find(|f| f.estimate).unwrap().basis;
    let c = other.alphabet.find_sweep("c").map(|s| Poly::nominal(other.alphabet.sweep_symbols(s)[0])).unwrap();
    let as_derived = basis.along(&Coordinate::Linear(c), alphabet).unwrap().raw;
    assert_eq!(as_printed, as_derived, "(10) is right but for its names");
    section(
        "10",
        PRINTED_10,
        function,
        "  MISPRINT  the function is ε_xa of a, not ε_zc of c; its polynomials are as printed\n",
    );

    for (name, text) in PRINTED_DEFINITIONS {
        let right = printed(text, &model, "a");
        let verdict = match name {
            "k8" => "  NOTE      see (7)\n".to_owned(),
            _ => differences(&right, &definition(name), alphabet),
        };
        let combination =
            printer.combination(of(name).definition.iter().map(|(j, f)| (f, derivation.parameters[*j].name.clone())));
        section(name, text, &combination, &verdict);
    }
    let misprinted = out
        .split(
            "
(",
        )
        .filter(|section| section.contains("  MISPRINT"))
        .count();
    assert_eq!(misprinted, 5);
    insta::with_settings!({ snapshot_path => "../snapshots", prepend_module_to_snapshot => false }, {
        insta::assert_snapshot!("paper-tilting-table", out);
    });
}

#[test]
fn the_derivation_for_a_program() {
    let (model, derivation) = paper();
    assert_eq!(derivation.rank(), 11);
    insta::with_settings!({ snapshot_path => "../snapshots", prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!("tilting-table-a.json", readable(&format!("{:#}", equations::json(&model, &derivation))));
    });
}
