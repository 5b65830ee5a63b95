//! From a draft to a model: every symbol resolved, every problem collected.

use super::description::{Axis, AxisKind, Ball, Component, Coordinate, Function, Model, ReadingKind, Reference, Run};
use super::draft::{Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftReading, DraftRun, Text};
use super::evaluate::{EvaluationError, Scope};
use super::expression::{Expr, Span, SyntaxError, parse};
use super::notation::location_error;
use super::{Notation, Problem, ProblemKind, conditions, iso_location, iso_motion, reference};
use crate::algebra::{AlgebraError, Alphabet, ErrorId, NominalId, Order, Poly, Quantity, SweepId, Vector, dot};
use crate::basis::{Basis, satisfying};
use crate::ids::{AxisId, FunctionId, RunId};
use typed_index_collections::TiVec;

pub(super) fn resolve(draft: &Draft) -> Result<Model, Vec<Problem>> {
    let mut resolver = Resolver { alphabet: Alphabet::default(), iso: Vec::new(), problems: Vec::new() };
    let model = resolver.model(draft);
    if resolver.problems.is_empty() { model.ok_or_else(Vec::new) } else { Err(resolver.problems) }
}

/// The symbols so far and the problems so far. A step that fails records its problem and answers `None`.
pub(super) struct Resolver {
    pub alphabet: Alphabet,
    /// ISO name of each error made, for look-up by either name.
    iso: Vec<(String, ErrorId)>,
    problems: Vec<Problem>,
}

impl Resolver {
    pub fn problem<T>(&mut self, span: &Span, kind: ProblemKind) -> Option<T> {
        self.problems.push(Problem { span: span.clone(), kind });
        None
    }

    pub fn exact<T>(&mut self, span: &Span, result: Result<T, AlgebraError>) -> Option<T> {
        result.map_or_else(|e| self.problem(span, ProblemKind::Meaning(super::Meaning::Algebra(e))), Some)
    }

    fn model(&mut self, draft: &Draft) -> Option<Model> {
        if draft.name.value.is_empty() {
            self.problem::<()>(&draft.name.span, ProblemKind::Missing("name"));
        } else {
            self.is_name(&draft.name);
        }
        let notation = match draft.notation.as_ref().map(|t| (t, t.value.as_str())) {
            None | Some((_, "iso230")) => Notation::Iso230,
            Some((_, "paper")) => Notation::Paper,
            Some((t, other)) => {
                self.problem::<()>(&t.span, ProblemKind::OneOf(other.to_owned(), &["paper", "iso230"]));
                Notation::Iso230
            }
        };
        for text in &draft.constants {
            if self.is_name(text) && self.is_free(text) {
                let made = self.alphabet.constant(&text.value);
                self.exact(&text.span, made);
            }
        }
        let mut names = draft.names.clone();
        let workpiece = self.side(draft, &draft.workpiece, notation, &mut names);
        let tool = self.side(draft, &draft.tool, notation, &mut names);
        let mut unplaced = Vec::new();
        for axis in &draft.axes {
            if !draft.workpiece.iter().chain(&draft.tool).any(|t| t.value == axis.name.value) {
                self.problem::<()>(&axis.name.span, ProblemKind::Unplaced(axis.name.value.clone()));
                unplaced.extend(self.axis(axis, notation, &mut names));
            }
        }
        for (iso, _) in names {
            self.problem::<()>(&iso.span, ProblemKind::UnknownError(iso.value));
        }
        let axes: Vec<&Axis> = workpiece.iter().chain(&tool).collect();
        let known: Vec<&Axis> = axes.iter().copied().chain(&unplaced).collect();
        let runs: TiVec<RunId, Run> =
            draft.runs.iter().filter_map(|run| self.run(run, &axes, draft)).flatten().collect();
        if draft.runs.is_empty() {
            self.problem::<()>(&draft.name.span, ProblemKind::NoRuns);
        }
        for (i, run) in runs.iter().enumerate() {
            // Generated source names constants and functions after runs, in either case.
            let same = |other: &str| item(other) == item(&run.name);
            let errors: Vec<&str> = self.alphabet.errors().map(|(_, name, _)| name).collect();
            if runs.iter().take(i).any(|r| same(&r.name)) || errors.into_iter().any(same) || same("names") {
                self.problem::<()>(&run.places[0], ProblemKind::Taken(run.name.clone()));
            }
        }
        let mut functions: TiVec<FunctionId, Function> =
            draft.functions.iter().filter_map(|f| self.function(f, &known)).collect();
        for (i, f) in draft.functions.iter().enumerate() {
            let same = |g: &DraftFunction| {
                self.error(&g.error.value).is_some() && self.error(&g.error.value) == self.error(&f.error.value)
            };
            if draft.functions[..i].iter().any(same) {
                self.problem::<()>(&f.error.span, ProblemKind::Taken(f.error.value.clone()));
            }
        }
        for text in &draft.estimate {
            let error = self.error(&text.value);
            match functions.iter_mut().find(|f| Some(f.error) == error) {
                Some(f) if !matches!(f.basis, Basis::Zero | Basis::Known) => f.estimate = true,
                None if error
                    .is_some_and(|e| draft.functions.iter().any(|f| self.error(&f.error.value) == Some(e))) => {}
                _ => self.problem(&text.span, ProblemKind::NothingToEstimate(text.value.clone())).unwrap_or(()),
            }
        }
        let model = Model {
            name: draft.name.value.clone(),
            title: draft.title.value.clone(),
            notation,
            alphabet: self.alphabet.clone(),
            workpiece,
            tool,
            runs,
            functions,
            order: draft.order.clone(),
        };
        self.problems.extend(reference::problems(&model));
        Some(model)
    }

    fn side(&mut self, draft: &Draft, side: &[Text], notation: Notation, names: &mut Vec<(Text, Text)>) -> Vec<Axis> {
        let mut axes: Vec<Axis> = Vec::new();
        for text in side {
            match draft.axes.iter().find(|a| a.name.value == text.value) {
                None => self.problem(&text.span, ProblemKind::UnknownAxis(text.value.clone())).unwrap_or(()),
                Some(_) if self.iso.iter().any(|(iso, _)| *iso == iso_motion(Component::ALL[0], &text.value)) => {
                    self.problem(&text.span, ProblemKind::Taken(text.value.clone())).unwrap_or(());
                }
                Some(axis) => axes.extend(self.axis(axis, notation, names)),
            }
        }
        axes
    }

    fn axis(&mut self, axis: &DraftAxis, notation: Notation, names: &mut Vec<(Text, Text)>) -> Option<Axis> {
        if !self.is_name(&axis.name) {
            return None;
        }
        let name = &axis.name.value;
        let mut location = [None; 6];
        let mut references = Vec::new();
        for text in &axis.location {
            let Some((c, reference)) = location_error(&text.value, name) else {
                self.problem::<()>(&text.span, ProblemKind::NotALocation(text.value.clone()));
                continue;
            };
            location[c.index()] =
                self.make_error(&text.span, iso_location(c, name), notation.location(c, name), c, names);
            let place = text.span.clone();
            references.extend(reference.map(|axis| Reference { component: c, axis: axis.to_owned(), place }));
        }
        let mut motion = Vec::with_capacity(6);
        for c in Component::ALL {
            motion.extend(self.make_error(&axis.name.span, iso_motion(c, name), notation.motion(c, name), c, names));
        }
        let direction = self.direction(&axis.direction, &axis.name.span, None);
        Some(Axis {
            name: name.clone(),
            kind: axis.kind,
            // A refused direction has no use: the description is refused with it.
            direction: direction.unwrap_or_default(),
            location,
            references,
            motion: motion.try_into().ok()?,
        })
    }

    /// Makes an error under the model's own name for it, if it has one.
    fn make_error(
        &mut self,
        span: &Span,
        iso: String,
        name: String,
        c: Component,
        names: &mut Vec<(Text, Text)>,
    ) -> Option<ErrorId> {
        let own = names.iter().position(|(i, _)| i.value == iso).map(|at| names.swap_remove(at).1);
        let (name, span) = own.map_or((name, span.clone()), |text| (text.value, text.span));
        let text = Text { value: name, span: span.clone() };
        if !self.is_name(&text) || !self.is_free(&text) {
            return None;
        }
        let made = self.alphabet.error(&text.value, if c.is_rotation() { Quantity::Angle } else { Quantity::Length });
        let id = self.exact(&span, made)?;
        self.iso.push((iso, id));
        Some(id)
    }

    fn error(&self, name: &str) -> Option<ErrorId> {
        let by_iso = self.iso.iter().find(|(iso, _)| iso == name).map(|(_, id)| *id);
        by_iso.or_else(|| self.alphabet.find_error(name))
    }

    /// An exact unit vector, along an axis of the machine's coordinates or of three components.
    fn direction(&mut self, written: &[Text], owner: &Span, sweep: Option<SweepId>) -> Option<Vector> {
        let direction = match written {
            [single] => {
                let unit =
                    |i: usize, sign: i128| core::array::from_fn(|j| Poly::integer(if i == j { sign } else { 0 }));
                let signed = [("x", 0, 1), ("y", 1, 1), ("z", 2, 1), ("-x", 0, -1), ("-y", 1, -1), ("-z", 2, -1)];
                match signed.iter().find(|(name, ..)| *name == single.value) {
                    Some((_, i, sign)) => unit(*i, *sign),
                    None => return self.problem(&single.span, ProblemKind::NotAUnitVector),
                }
            }
            three => self.vector(three, owner, sweep)?,
        };
        let square = dot(&direction, &direction, Order::NOMINAL).and_then(|p| p.normal(&self.alphabet));
        let span = written.first().map_or(owner.clone(), |t| t.span.clone());
        if self.exact(&span, square)? == Poly::one() {
            Some(direction)
        } else {
            self.problem(&span, ProblemKind::NotAUnitVector)
        }
    }

    /// Three expressions; an empty list is the origin.
    fn vector(&mut self, texts: &[Text], span: &Span, sweep: Option<SweepId>) -> Option<Vector> {
        if texts.is_empty() {
            return Some(Vector::default());
        }
        if texts.len() != 3 {
            let span = texts.first().map_or(span.clone(), |t| t.span.clone());
            return self.problem(&span, ProblemKind::NotThree(texts.len()));
        }
        let components: Vec<Poly> = texts.iter().filter_map(|t| self.poly(t, sweep)).collect();
        components.try_into().ok()
    }

    pub fn poly(&mut self, text: &Text, sweep: Option<SweepId>) -> Option<Poly> {
        let expr = self.parsed(text, parse(&text.value))?;
        let value = Scope { alphabet: &self.alphabet, sweep }.poly(&expr);
        self.meaning(text, value)
    }

    pub fn parsed<T>(&mut self, text: &Text, result: Result<T, SyntaxError>) -> Option<T> {
        result.map_or_else(|e| self.problem(&within(text, &e.span), ProblemKind::Syntax(e.expected)), Some)
    }

    pub fn meaning<T>(&mut self, text: &Text, result: Result<T, EvaluationError>) -> Option<T> {
        result.map_or_else(|(span, meaning)| self.problem(&within(text, &span), ProblemKind::Meaning(meaning)), Some)
    }

    /// One run, or one for each component that is read.
    fn run(&mut self, run: &DraftRun, axes: &[&Axis], draft: &Draft) -> Option<Vec<Run>> {
        let sweep = &run.sweep;
        if !self.is_name(sweep) || (self.alphabet.find_sweep(&sweep.value).is_none() && !self.is_free(sweep)) {
            return None;
        }
        let made = self.alphabet.sweep(&sweep.value);
        let sweep = self.exact(&run.sweep.span, made)?;
        for (i, (name, _)) in run.at.iter().enumerate() {
            if draft.axes.iter().all(|a| a.name.value != name.value) {
                self.problem::<()>(&name.span, ProblemKind::UnknownAxis(name.value.clone()));
            }
            if run.at[..i].iter().any(|(n, _)| n.value == name.value) {
                self.problem::<()>(&name.span, ProblemKind::Taken(name.value.clone()));
            }
        }
        let at: TiVec<AxisId, Coordinate> = axes.iter().filter_map(|axis| self.coordinate(run, axis, sweep)).collect();
        let workpiece_ball = self.ball(&run.workpiece_ball, run, sweep);
        let tool_ball = self.ball(&run.tool_ball, run, sweep);
        let readings = self.readings(run, sweep);
        let name = self.is_name(&run.name).then(|| run.name.value.clone());
        (at.len() == axes.len()).then_some(())?;
        let places = [run.name.span.clone(), run.reading.span()];
        let (workpiece_ball, tool_ball, name) = (workpiece_ball?, tool_ball?, name?);
        let complete = |(suffix, reading): (&str, ReadingKind)| Run {
            name: format!("{name}{suffix}"),
            sweep,
            at: at.clone(),
            workpiece_ball: workpiece_ball.clone(),
            tool_ball: tool_ball.clone(),
            reading,
            places: places.clone(),
        };
        Some(readings?.into_iter().map(complete).collect())
    }

    /// What is read, with what the name of its run is to end in.
    fn readings(&mut self, run: &DraftRun, sweep: SweepId) -> Option<Vec<(&'static str, ReadingKind)>> {
        match &run.reading {
            DraftReading::Bar(text) => Some(vec![("", ReadingKind::BarLength(self.constant(text)?))]),
            DraftReading::Displacement(direction) if matches!(direction.as_slice(), [t] if t.value == "xyz") => {
                let component = |(at, suffix)| {
                    let unit = core::array::from_fn(|i| Poly::integer(i128::from(i == at)));
                    (suffix, ReadingKind::Displacement(unit))
                };
                Some([(0, "-x"), (1, "-y"), (2, "-z")].map(component).into())
            }
            DraftReading::Displacement(direction) => {
                let direction = self.direction(direction, &run.name.span, Some(sweep))?;
                Some(vec![("", ReadingKind::Displacement(direction))])
            }
        }
    }

    fn coordinate(&mut self, run: &DraftRun, axis: &Axis, sweep: SweepId) -> Option<Coordinate> {
        let Some((_, text)) = run.at.iter().find(|(name, _)| name.value == axis.name) else {
            return self.problem(&run.name.span, ProblemKind::NoCoordinate(axis.name.clone()));
        };
        if text.value.trim() == "rest" {
            return Some(Coordinate::Rest);
        }
        let expr: Expr = self.parsed(text, parse(&text.value))?;
        let scope = Scope { alphabet: &self.alphabet, sweep: Some(sweep) };
        match axis.kind {
            AxisKind::Linear => {
                let value = scope.poly(&expr);
                self.meaning(text, value).map(Coordinate::Linear)
            }
            AxisKind::Rotary => {
                let value = scope.angle(&expr);
                self.meaning(text, value).map(Coordinate::Rotary)
            }
        }
    }

    fn ball(&mut self, ball: &DraftBall, run: &DraftRun, sweep: SweepId) -> Option<Ball> {
        let at = self.vector(&ball.at, &run.name.span, Some(sweep));
        let mut setup = Vec::new();
        for text in &ball.setup {
            let known = self.alphabet.find_error(&text.value).filter(|id| self.iso.iter().all(|(_, i)| i != id));
            if known.is_some() || (self.is_name(text) && self.is_free(text)) {
                let made = self.alphabet.error(&text.value, Quantity::Length);
                setup.extend(self.exact(&text.span, made));
            }
        }
        match ball.setup.len() {
            0 => Some(Ball { at: at?, setup: None }),
            3 => Some(Ball { at: at?, setup: Some(setup.try_into().ok()?) }),
            n => self.problem(&ball.setup[0].span, ProblemKind::NotThree(n)),
        }
    }

    fn constant(&mut self, text: &Text) -> Option<NominalId> {
        let found = self.alphabet.find_constant(&text.value);
        found.map_or_else(|| self.problem(&text.span, ProblemKind::NotAConstant(text.value.clone())), Some)
    }

    fn function(&mut self, f: &DraftFunction, axes: &[&Axis]) -> Option<Function> {
        let motion = |id: &ErrorId| axes.iter().find(|axis| axis.motion.contains(id));
        let error = self.error(&f.error.value);
        let Some((error, axis)) = error.and_then(|id| Some((id, motion(&id)?))) else {
            return self.problem(&f.error.span, ProblemKind::UnknownError(f.error.value.clone()));
        };
        let basis = match &f.basis {
            DraftBasis::Zero => Basis::Zero,
            DraftBasis::Known => Basis::Known,
            DraftBasis::Fourier(_) if axis.kind == AxisKind::Linear => {
                return self.problem(&f.error.span, ProblemKind::FourierOfLength);
            }
            DraftBasis::Fourier(n) => Basis::Fourier(*n),
            DraftBasis::Polynomial(degree, written) if written.is_empty() => Basis::polynomial(*degree),
            DraftBasis::Polynomial(degree, written) => {
                let conditions: Vec<_> = written.iter().filter_map(|text| conditions::condition(self, text)).collect();
                (conditions.len() == written.len()).then_some(())?;
                let functions = satisfying(*degree, &conditions, &self.alphabet);
                Basis::Polynomials(
                    functions.map_or_else(|e| self.problem(&f.error.span, ProblemKind::NoBasis(e)), Some)?,
                )
            }
        };
        Some(Function { error, basis, estimate: false, place: f.error.span.clone() })
    }

    fn is_name(&mut self, text: &Text) -> bool {
        let mut chars = text.value.chars();
        let first = chars.next().is_some_and(|c| c.is_ascii_alphabetic());
        let good = first && chars.all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
        if !good {
            self.problem::<()>(&text.span, ProblemKind::NotAName(text.value.clone()));
        }
        good
    }

    fn is_free(&mut self, text: &Text) -> bool {
        let name = text.value.as_str();
        let a = &self.alphabet;
        let taken = a.find_constant(name).is_some() || a.find_sweep(name).is_some() || a.find_error(name).is_some();
        let free = !taken && !["pi", "sin", "cos", "sqrt", "rest", "f"].contains(&name);
        if !free {
            self.problem::<()>(&text.span, ProblemKind::Taken(text.value.clone()));
        }
        free
    }
}

/// What a name becomes in generated source, whatever its case.
fn item(name: &str) -> String {
    name.to_lowercase().replace('-', "_")
}

/// A place inside a quoted text.
fn within(text: &Text, span: &Span) -> Span {
    if text.span.is_empty() { span.clone() } else { text.span.start + 1 + span.start..text.span.start + 1 + span.end }
}
