//! A derivation as functions to compile or to evaluate: one per run, one per estimated function.

use super::function::{Function, Output};
use super::{header, numpy, rust};
use crate::algebra::{Alphabet, Fraction, Nominal, Poly, SweepId};
use crate::basis::Basis;
use crate::graph::{Graph, Id, Unbound};
use crate::identify::{Derivation, DerivedRun};
use crate::ids::{FunctionId, RunId};
use crate::model::Model;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

/// What one run's samples become: inputs are the constants and the sweep, outputs the regressors in the order of
/// [`crate::identify::DerivedRun::regressors`], then the coefficients of the known functions.
pub fn run(model: &Model, derivation: &Derivation, run: RunId) -> Result<Function, Unbound> {
    let derived = &derivation.runs[run];
    let sweep = model.runs[run].sweep;
    let mut graph = Graph::new();
    let inputs = inputs(model, model.alphabet.sweep_name(sweep));
    let names: Vec<&str> = derived.regressors.iter().map(|(b, _)| derivation.base[*b].name.as_str()).collect();
    let lowered = derived.regressors.iter().map(|(_, r)| fraction(&mut graph, &model.alphabet, r)).collect::<Vec<_>>();
    let mut outputs = vec![Output::array("regressors", &names.into_iter().zip(lowered).collect::<Vec<_>>())];
    let known: Vec<(String, Id)> =
        derived.known.iter().map(|(f, p)| (known_name(model, *f), poly(&mut graph, &model.alphabet, p))).collect();
    if !known.is_empty() {
        outputs.push(Output::array("known", &known));
    }
    let end = if known.is_empty() { "." } else { ";\nthen the factors of the known functions, mm per mm or rad." };
    let doc = format!(
        "Regressors of the base parameters that run `{}` sees, mm per unit of the parameter{end}",
        derived.name
    );
    Function::new(&graph, &derived.name, &[&doc], &borrowed(&inputs), &outputs)
}

/// The basis of an estimated function at a coordinate (mm or rad); `None` if it has none.
pub fn basis(model: &Model, function: FunctionId) -> Option<Result<Function, Unbound>> {
    let f = &model.functions[function];
    let name = model.alphabet.error_name(f.error);
    let (axis, _) = model.axis_of(f.error)?;
    let coordinate = model.axis(axis)?.name.to_lowercase();
    let mut graph = Graph::new();
    let x = graph.symbol(&coordinate);
    let values: Vec<Id> = match &f.basis {
        Basis::Zero | Basis::Known => return None,
        Basis::Polynomials(functions) => functions
            .iter()
            .map(|u| {
                let terms =
                    u.0.iter()
                        .enumerate()
                        .map(|(n, c)| (poly(&mut graph, &model.alphabet, c), n as i32))
                        .collect::<Vec<_>>();
                let terms = terms.into_iter().map(|(c, n)| (c, graph.power(x, n))).collect::<Vec<_>>();
                let products: Vec<Id> = terms.into_iter().map(|(c, p)| graph.product(&[c, p])).collect();
                graph.sum(&products)
            })
            .collect(),
        Basis::Fourier(n) => (1..=i128::from(*n))
            .flat_map(|k| {
                let k = graph.integer(k);
                let angle = graph.product(&[k, x]);
                [graph.cos(angle), graph.sin(angle)]
            })
            .collect(),
    };
    let names: Vec<String> = f.basis.suffixes().into_iter().map(|s| format!("{name}{s}")).collect();
    let doc = format!("Basis of the function `{name}`: its value is the sum of these times their coefficients.");
    let outputs = [Output::array("basis", &names.iter().zip(values).collect::<Vec<_>>())];
    let inputs = inputs(model, &coordinate);
    Some(Function::new(&graph, name, &[&doc], &borrowed(&inputs), &outputs))
}

/// All functions of a model: the runs', then the estimated functions' bases.
pub fn functions(model: &Model, derivation: &Derivation) -> Result<Vec<Function>, Unbound> {
    let runs = derivation.runs.keys().map(|id| run(model, derivation, id));
    let estimated = model.functions.keys().filter(|id| model.functions[*id].estimate).filter_map(|id| basis(model, id));
    runs.chain(estimated).collect()
}

/// The model as a Rust module for `core` and `num-traits`: names, what each run sees, the functions.
pub fn rust_source(model: &Model, derivation: &Derivation) -> Result<String, Unbound> {
    Ok(header("//", &model.name) + &rust::pretty(rust_items(model, derivation, &quote!(num_traits))?))
}

/// The same as tokens, for a macro.
pub fn rust_items(model: &Model, derivation: &Derivation, num_traits: &TokenStream) -> Result<TokenStream, Unbound> {
    let names = derivation.base.iter().map(|b| b.name.as_str());
    let count = Literal::usize_unsuffixed(derivation.base.len());
    let runs = derivation.runs.iter().map(|r| {
        let constant = Ident::new(&positions_name(&r.name), Span::call_site());
        let doc = format!(" Positions in `NAMES` of the base parameters that run `{}` sees.", r.name);
        let seen = r.regressors.iter().map(|(b, _)| Literal::usize_unsuffixed((*b).into()));
        let n = Literal::usize_unsuffixed(r.regressors.len());
        quote!(#[doc = #doc] pub const #constant: [usize; #n] = [#(#seen),*];)
    });
    let functions = functions(model, derivation)?;
    let functions = functions.iter().map(|f| rust::item(f, num_traits));
    Ok(quote! {
        /// Names of the base parameters, the estimated functions' coefficients first.
        pub const NAMES: [&str; #count] = [#(#names),*];
        #(#runs)*
        #(#functions)*
    })
}

/// The model as a Python module on NumPy: names, what each run sees, the functions.
///
/// # Errors
/// As [`functions`].
pub fn numpy_source(model: &Model, derivation: &Derivation) -> Result<String, Unbound> {
    let quoted: Vec<String> = derivation.base.iter().map(|b| format!("\"{}\"", b.name)).collect();
    let mut text = header("#", &model.name) + numpy::IMPORTS;
    text += "\n# Names of the base parameters, the estimated functions' coefficients first.\n";
    text += &format!("NAMES = [{}]\n", quoted.join(", "));
    for run in &derivation.runs {
        text += &format!("\n# Positions in NAMES of the base parameters that run `{}` sees.\n", run.name);
        text += &format!("{} = [{}]\n", positions_name(&run.name), seen(run));
    }
    for function in functions(model, derivation)? {
        text += "\n\n";
        text += &numpy::function(&function);
    }
    Ok(text)
}

/// The constant that says what a run sees: `TILTING`.
fn positions_name(run: &str) -> String {
    run.to_uppercase().replace('-', "_")
}

fn seen(run: &DerivedRun) -> String {
    run.regressors.iter().map(|(b, _)| b.to_string()).collect::<Vec<_>>().join(", ")
}

/// The name a known function has in a table: `dya` for `d_ya`, `EYA` for `EYA`.
pub fn known_name(model: &Model, function: FunctionId) -> String {
    model.alphabet.error_name(model.functions[function].error).replace('_', "")
}

fn inputs(model: &Model, last: &str) -> Vec<String> {
    model.alphabet.constants().chain([last]).map(str::to_owned).collect()
}

fn borrowed(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

fn fraction(graph: &mut Graph, alphabet: &Alphabet, f: &Fraction) -> Id {
    let numerator = poly(graph, alphabet, f.numerator());
    match f.denominator() {
        None => numerator,
        Some(d) => {
            let denominator = poly(graph, alphabet, d);
            graph.quotient(numerator, denominator)
        }
    }
}

/// A polynomial without errors as an expression of the constants and the sweeps.
pub fn poly(graph: &mut Graph, alphabet: &Alphabet, p: &Poly) -> Id {
    let mut terms = Vec::with_capacity(p.terms().len());
    for (m, c) in p.terms() {
        let mut factors = Vec::new();
        for (id, nominal) in alphabet.nominals() {
            if m.exponent(id) != 0 {
                factors.push((symbol(graph, alphabet, nominal), i32::from(m.exponent(id))));
            }
        }
        terms.push(graph.monomial(*c, &factors));
    }
    graph.sum(&terms)
}

fn symbol(graph: &mut Graph, alphabet: &Alphabet, nominal: &Nominal) -> Id {
    let sweep = |graph: &mut Graph, id: &SweepId| graph.symbol(alphabet.sweep_name(*id));
    match nominal {
        Nominal::Pi => Id::PI,
        Nominal::Root2 => Id::SQRT_2,
        Nominal::Constant(name) => graph.symbol(name),
        Nominal::Sweep(id) => sweep(graph, id),
        Nominal::Sin(id) => {
            let a = sweep(graph, id);
            graph.sin(a)
        }
        Nominal::Cos(id) => {
            let a = sweep(graph, id);
            graph.cos(a)
        }
    }
}
