//! A derivation as functions to compile or to evaluate: one per run, one per estimated function.

use super::function::{Function, Input, Output};
use crate::algebra::{Alphabet, Fraction, Nominal, NominalId, Poly};
use crate::basis::{Arithmetic, Univariate};
use crate::graph::{Graph, Id, Symbol, Unbound};
use crate::identify::{Coefficient, Derivation};
use crate::ids::{BaseId, FunctionId, RunId, TermId};
use crate::model::{AxisKind, Model, ReadingKind};

/// What one run's samples become: inputs are the lengths of the set-up and the sweep, outputs the regressors in the order of
/// [`crate::identify::DerivedRun::regressors`], then the coefficients of the known functions.
///
/// # Errors
/// A regressor depends on anything else: a defect of the derivation.
pub fn run(model: &Model, derivation: &Derivation, run: RunId) -> Result<Function, Unbound> {
    let derived = &derivation.runs[run];
    let alphabet = &model.alphabet;
    let mut graph = Graph::new();
    let sweep = model.runs[run].sweep;
    let mut inputs = lengths(model);
    let symbol = Symbol::Nominal(alphabet.sweep_symbols(sweep)[0]);
    inputs.push(Input::new(symbol, alphabet.sweep_name(sweep), "the sweep, rad"));
    let names = derived.regressors.iter().map(|(b, _)| derivation.base[*b].name.as_str());
    let lowered = derived.regressors.iter().map(|(_, r)| fraction(&mut graph, alphabet, r)).collect::<Vec<_>>();
    let mut outputs = vec![Output::array("regressors", &names.zip(lowered).collect::<Vec<_>>())];
    let known: Vec<(&str, Id)> = derived
        .known
        .iter()
        .map(|(f, p)| (alphabet.error_name(model.functions[*f].error), poly(&mut graph, alphabet, p)))
        .collect();
    if !known.is_empty() {
        outputs.push(Output::array("known", &known));
    }
    let end = if known.is_empty() { "." } else { ";\nthen the factors of the known functions, mm per mm or rad." };
    let doc = format!(
        "Regressors of the base parameters that run `{}` sees, mm per unit of the parameter{end}",
        derived.name
    );
    Function::new(&graph, &derived.name, &[&doc], inputs, &outputs)
}

/// An estimated function, to be evaluated from an estimate.
#[derive(Clone, Debug)]
pub struct EstimatedFunction {
    /// Which it is.
    pub function: FunctionId,
    /// Its basis at a coordinate: inputs are the lengths of the set-up and the coordinate, mm or rad.
    pub basis: Function,
    /// The base parameters that are the coefficients, in the order of the basis; `None` where a coefficient is not among
    /// them, so that what is estimated gives no value.
    pub coefficients: Option<Vec<BaseId>>,
}

/// The estimated functions of a model.
///
/// # Errors
/// A basis depends on a symbol other than a length or the coordinate: a defect of the description.
pub fn estimated(model: &Model, derivation: &Derivation) -> Result<Vec<EstimatedFunction>, Unbound> {
    let functions = model.functions.keys().filter(|id| model.functions[*id].estimate);
    let one = |function: FunctionId| {
        let carries = |term: TermId| {
            let own = Some(Coefficient { function, term });
            derivation.base.position(|b| b.estimates == own)
        };
        Some(basis(model, function)?.map(|basis| {
            let coefficients = (0..basis.elements.len()).map(|k| carries(TermId::from(k))).collect();
            EstimatedFunction { function, basis, coefficients }
        }))
    };
    functions.filter_map(one).collect()
}

/// The basis of an estimated function at a coordinate; `None` if it has none.
fn basis(model: &Model, function: FunctionId) -> Option<Result<Function, Unbound>> {
    let f = &model.functions[function];
    let name = model.alphabet.error_name(f.error);
    let (axis, _) = model.axis_of(f.error)?;
    let axis = model.axis(axis)?;
    let mut graph = Graph::new();
    let x = graph.symbol(Symbol::Coordinate);
    let mut lowering = Lowering { graph: &mut graph, alphabet: &model.alphabet, x };
    let values: Vec<Id> = f.basis.functions().iter().map(|f| f.of(&mut lowering)).collect();
    if values.is_empty() {
        return None;
    }
    let unit = if axis.kind == AxisKind::Rotary { "rad" } else { "mm" };
    let mut inputs = lengths(model);
    let meaning = format!("coordinate of axis {}, {unit}", axis.name);
    inputs.push(Input::new(Symbol::Coordinate, &axis.name.to_lowercase(), &meaning));
    let names = f.basis.suffixes().map(|s| format!("{name}{s}"));
    let outputs = [Output::array("basis", &names.zip(values).collect::<Vec<_>>())];
    let doc = format!("Basis of the function `{name}`: its value is the sum of these times their coefficients.");
    Some(Function::new(&graph, name, &[&doc], inputs, &outputs))
}

/// Functions of the coordinate `x` as nodes of a graph.
struct Lowering<'a> {
    graph: &'a mut Graph,
    alphabet: &'a Alphabet,
    x: Id,
}

impl Lowering<'_> {
    fn multiple(&mut self, k: u8) -> Id {
        let k = self.graph.integer(k.into());
        self.graph.product(&[k, self.x])
    }
}

impl Arithmetic for Lowering<'_> {
    type Value = Id;

    fn polynomial(&mut self, f: &Univariate) -> Id {
        let coefficients: Vec<Id> = f.0.iter().map(|c| poly(self.graph, self.alphabet, c)).collect();
        let powers: Vec<Id> = (0..).take(f.0.len()).map(|n| self.graph.power(self.x, n)).collect();
        let products = coefficients.into_iter().zip(powers).map(|(c, p)| self.graph.product(&[c, p]));
        let products: Vec<Id> = products.collect();
        self.graph.sum(&products)
    }

    fn cosine(&mut self, multiple: u8) -> Id {
        let angle = self.multiple(multiple);
        self.graph.cos(angle)
    }

    fn sine(&mut self, multiple: u8) -> Id {
        let angle = self.multiple(multiple);
        self.graph.sin(angle)
    }
}

/// All functions of a model: the runs', then the estimated functions' bases.
///
/// # Errors
/// As [`run`] and [`estimated`].
pub fn functions(model: &Model, derivation: &Derivation) -> Result<Vec<Function>, Unbound> {
    let runs = derivation.runs.keys().map(|id| run(model, derivation, id));
    let mut functions = runs.collect::<Result<Vec<_>, _>>()?;
    functions.extend(estimated(model, derivation)?.into_iter().map(|f| f.basis));
    Ok(functions)
}

/// The lengths of the set-up as inputs.
fn lengths(model: &Model) -> Vec<Input> {
    let is_bar = |id: NominalId| model.runs.iter().any(|r| r.reading == ReadingKind::BarLength(id));
    let input = |(id, nominal): (NominalId, &Nominal)| match nominal {
        Nominal::Constant(name) if is_bar(id) => {
            Some(Input::new(Symbol::Nominal(id), name, "nominal length of the bar, mm"))
        }
        Nominal::Constant(name) => Some(Input::new(Symbol::Nominal(id), name, "length of the set-up, mm")),
        _ => None,
    };
    model.alphabet.nominals().filter_map(input).collect()
}

/// The name a known function has in a table: `dya` for `d_ya`, `EYA` for `EYA`.
pub fn known_name(model: &Model, function: FunctionId) -> String {
    model.alphabet.error_name(model.functions[function].error).replace('_', "")
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
        for (id, _) in alphabet.nominals() {
            if m.exponent(id) != 0 {
                factors.push((nominal(graph, alphabet, id), i32::from(m.exponent(id))));
            }
        }
        terms.push(graph.monomial(*c, &factors));
    }
    graph.sum(&terms)
}

fn nominal(graph: &mut Graph, alphabet: &Alphabet, id: NominalId) -> Id {
    let mut sweep = |id| graph.symbol(Symbol::Nominal(alphabet.sweep_symbols(id)[0]));
    match alphabet.nominal(id) {
        Nominal::Pi => Id::PI,
        Nominal::Root2 => Id::SQRT_2,
        Nominal::Constant(_) | Nominal::Sweep(_) => graph.symbol(Symbol::Nominal(id)),
        Nominal::Sin(of) => {
            let angle = sweep(*of);
            graph.sin(angle)
        }
        Nominal::Cos(of) => {
            let angle = sweep(*of);
            graph.cos(angle)
        }
    }
}
