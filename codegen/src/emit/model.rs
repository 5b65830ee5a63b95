//! A derivation as functions to compile or to evaluate: one per run, one per estimated function.

use super::equations::{Style, extent};
use super::function::{Function, Input, Output};
use crate::algebra::{Alphabet, Fraction, Harmonic, Harmonics, Nominal, NominalId, Poly};
use crate::basis::{Arithmetic, Basis, BasisFunction, Coordinate, Univariate};
use crate::graph::{Graph, Id, Rational, Symbol, Unbound};
use crate::identify::{Derivation, Determination};
use crate::ids::{BaseId, FunctionId, RunId, TermId};
use crate::model::{Axis, AxisKind, ErrorFunction, Model, NuisanceKind, ReadingKind, Run};
use typed_index_collections::TiVec;

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
    inputs.extend(
        motion(model, run)
            .into_iter()
            .map(|sense| Input::new(Symbol::Nominal(sense), &alphabet.nominal_name(sense), &moves(model, sense))),
    );
    let names = derived.regressors.iter().map(|(b, _)| derivation.base[*b].name.as_str());
    let lowered = derived.regressors.iter().map(|(_, r)| fraction(&mut graph, alphabet, r)).collect::<Vec<_>>();
    let mut outputs = vec![Output::array("regressors", &names.zip(lowered).collect::<Vec<_>>())];
    let known: Vec<(&str, Id)> = derived
        .known
        .iter()
        .map(|(f, p)| (alphabet.error_name(model.functions[*f].error), poly(&mut graph, alphabet, p)))
        .collect();
    outputs.push(Output::array("known", &known));
    let end = if known.is_empty() { "." } else { ";\nthen the factors of the known functions, mm per mm or rad." };
    let doc = format!(
        "Regressors of the base parameters that run `{}` sees, mm per unit of the parameter{end}",
        derived.name
    );
    Function::new(&graph, &derived.name, &[&doc], inputs, &outputs)
}

/// What a run's row takes behind its sweep, ascending: angles that are given by their sine and cosine and that a polynomial is a
/// function of, and senses.
pub fn motion(model: &Model, run: RunId) -> Vec<NominalId> {
    let run = &model.runs[run];
    let has_polynomial = |axis: &Axis| {
        let own = model.functions.iter().filter(|f| axis.motion.contains(&f.error));
        own.flat_map(|f| f.basis.functions()).any(|f| matches!(f, BasisFunction::Polynomial(_)))
    };
    let is_angle = |id: &NominalId| {
        let given = matches!(model.alphabet.nominal(*id), Nominal::Arctangent { .. });
        let own = |(axis, c): (&Axis, &Coordinate)| c.poly() == Some(&Poly::nominal(*id)) && has_polynomial(axis);
        given && model.axes().zip(&run.at).any(own)
    };
    let angles = model.alphabet.nominals().map(|(id, _)| id).filter(is_angle);
    let mut motion: Vec<NominalId> = angles.chain(run.nuisance.iter().map(|n| n.sense)).collect();
    motion.sort_unstable();
    motion.dedup();
    motion
}

/// What an angle or a sense is.
pub(super) fn moves(model: &Model, sense: NominalId) -> String {
    if let Nominal::Arctangent { .. } = model.alphabet.nominal(sense) {
        let of = |run: &Run| run.at.iter().position(|c| c.poly() == Some(&Poly::nominal(sense)));
        let axis = model.runs.iter().find_map(of).and_then(|at| model.axis(at.into()));
        return format!("the angle of axis {}, rad", axis.map_or("", |axis| &axis.name));
    }
    let mut terms = model.runs.iter().flat_map(|run| &run.nuisance).filter(|n| n.sense == sense && !n.against);
    let of = terms.find(|n| n.kind != NuisanceKind::Lag).and_then(|n| model.axis(n.axis));
    let of = of.map_or("the sweep".to_owned(), |axis| format!("the coordinate of axis {}", axis.name));
    format!("1 where {of} increases, -1 where it decreases, 0 at a reversal")
}

/// An estimated function, to be evaluated from an estimate.
#[derive(Clone, Debug)]
pub struct EstimatedFunction {
    /// Which it is.
    pub function: FunctionId,
    /// What the base parameters are multiplied with at a coordinate: inputs are the lengths of the set-up and the coordinate,
    /// mm or rad; of a location error the lengths alone.
    pub basis: Function,
    /// The base parameters that its value, or the sum it is seen in, consists of, in the order of the basis: none where it is
    /// not seen.
    pub base: Vec<BaseId>,
}

impl EstimatedFunction {
    /// Where it is evaluated, the last of its inputs; none of a location error.
    pub fn coordinate(&self) -> Option<&Input> {
        self.basis.inputs.last().filter(|input| input.symbol == Symbol::Coordinate)
    }
}

/// The estimated functions of a model.
///
/// # Errors
/// A basis depends on a symbol other than a length or the coordinate: a defect of the description.
pub fn estimated(model: &Model, derivation: &Derivation) -> Result<Vec<EstimatedFunction>, Unbound> {
    let one = |determination: &Determination| {
        let mut base: Vec<BaseId> = determination.seen.iter().flat_map(|s| s.base.iter().map(|(b, _)| *b)).collect();
        base.sort_unstable();
        base.dedup();
        let basis = basis(model, derivation, determination, &base)?;
        Some(basis.map(|basis| EstimatedFunction { function: determination.function, basis, base }))
    };
    derivation.functions.iter().filter_map(one).collect()
}

/// What each of `base` is multiplied with at a coordinate: `Σ factor · function of the basis`; `None` if none is.
fn basis(
    model: &Model,
    derivation: &Derivation,
    determination: &Determination,
    base: &[BaseId],
) -> Option<Result<Function, Unbound>> {
    let f = &model.functions[determination.function];
    let name = model.alphabet.error_name(f.error);
    let (_, axis) = model.axis_of_function(determination.function)?;
    let mut graph = Graph::new();
    let x = graph.symbol(Symbol::Coordinate);
    let x = f.basis.turn_from().map_or(x, |start| graph.wrapped(x, start));
    let mut lowering = Lowering { graph: &mut graph, alphabet: &model.alphabet, x };
    let values: TiVec<TermId, Id> = f.basis.functions().iter().map(|f| f.of(&mut lowering)).collect();
    let of = |graph: &mut Graph, b: &BaseId| {
        let factors = determination.seen.iter().filter_map(|s| {
            let (_, factor) = s.base.iter().find(|(id, _)| id == b)?;
            Some((s.term, factor))
        });
        let products = factors.map(|(term, factor)| {
            let factor = fraction(graph, &model.alphabet, factor);
            graph.product(&[factor, values[term]])
        });
        let products: Vec<Id> = products.collect();
        graph.sum(&products)
    };
    let values: Vec<Id> = base.iter().map(|b| of(&mut graph, b)).collect();
    if values.is_empty() {
        return None;
    }
    let unit = if axis.kind == AxisKind::Rotary { "rad" } else { "mm" };
    let mut inputs = lengths(model);
    let meaning = format!("coordinate of axis {}, {unit}", axis.name);
    if !f.is_location() {
        inputs.push(Input::new(Symbol::Coordinate, &axis.coordinate, &meaning));
    }
    let names = base.iter().map(|b| derivation.base[*b].name.as_str());
    let outputs = [Output::array("basis", &names.zip(values).collect::<Vec<_>>())];
    let what = if f.is_location() { "location error" } else { "function" };
    let doc = format!("Basis of the {what} `{name}`: the sum of these times their base parameters.");
    let told = extent(model, derivation, determination, Style::Plain);
    let told = format!("`{name}` is {told}.");
    Some(Function::new(&graph, name, &[&doc, &told], inputs, &outputs))
}

/// Sine or cosine of a multiple of the angle `x`.
fn multiple(graph: &mut Graph, harmonic: Harmonic, x: Id) -> Id {
    let (Harmonic::Cosine(k) | Harmonic::Sine(k)) = harmonic;
    let angle = graph.linear(&[(Rational::from(i128::from(k)), x)]);
    match harmonic {
        Harmonic::Cosine(_) => graph.cos(angle),
        Harmonic::Sine(_) => graph.sin(angle),
    }
}

/// Functions of the coordinate `x` as nodes of a graph.
struct Lowering<'a> {
    graph: &'a mut Graph,
    alphabet: &'a Alphabet,
    x: Id,
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
        self::multiple(self.graph, Harmonic::Cosine(multiple), self.x)
    }

    fn sine(&mut self, multiple: u8) -> Id {
        self::multiple(self.graph, Harmonic::Sine(multiple), self.x)
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

/// The name a known function has in a table: `dya` for `d_ya`, `EYA` for `EYA`; in full where two would have the same.
pub fn known_name(model: &Model, function: FunctionId) -> String {
    let full = |f: &ErrorFunction| model.alphabet.error_name(f.error);
    let name = full(&model.functions[function]);
    let short = name.replace('_', "");
    let known = model.functions.iter().filter(|f| f.basis == Basis::Known);
    let same = known.filter(|f| full(f).replace('_', "") == short).count();
    if same > 1 { name.to_owned() } else { short }
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
    if let Some(harmonics) = Harmonics::of(p, alphabet) {
        let sweep = graph.symbol(Symbol::Nominal(alphabet.sweep_symbols(harmonics.sweep)[0]));
        let product = |(harmonic, factor): &(Harmonic, Poly)| {
            let factor = poly(graph, alphabet, factor);
            let harmonic = multiple(graph, *harmonic, sweep);
            graph.product(&[harmonic, factor])
        };
        let products: Vec<Id> = harmonics.terms.iter().map(product).collect();
        return graph.sum(&products);
    }
    let mut terms = Vec::with_capacity(p.terms().len());
    for (m, c) in p.terms() {
        let mut factors = Vec::new();
        for (id, _) in alphabet.nominals() {
            if m.exponent(id) != 0 {
                factors.push((nominal(graph, alphabet, id), i32::from(m.exponent(id))));
            }
        }
        terms.push(graph.monomial(c.clone(), &factors));
    }
    graph.sum(&terms)
}

fn nominal(graph: &mut Graph, alphabet: &Alphabet, id: NominalId) -> Id {
    let mut sweep = |id| graph.symbol(Symbol::Nominal(alphabet.sweep_symbols(id)[0]));
    match alphabet.nominal(id) {
        Nominal::Pi => Id::PI,
        Nominal::Root2 => Id::SQRT_2,
        Nominal::Constant(_) | Nominal::Sweep(_) | Nominal::Sense { .. } | Nominal::Arctangent { .. } => {
            graph.symbol(Symbol::Nominal(id))
        }
        Nominal::Root { root, .. } => {
            let of = Poly::from_terms(root.of.clone()).map_or(Id::ZERO, |of| poly(graph, alphabet, &of));
            graph.sqrt(of)
        }
        Nominal::Wrapped { angle, .. } => {
            let sweep = sweep(angle.sweep);
            let turned = graph.monomial(Rational::from(i128::from(angle.multiple)), &[(sweep, 1)]);
            graph.wrapped(turned, angle.start)
        }
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
