//! What a run's axes do with the feed and not with the geometry.

use super::names::item;
use super::resolver::Resolver;
use crate::algebra::{NominalId, Order, Poly, Quantity, Rational, Sense, SweepId, integer};
use crate::basis::Coordinate;
use crate::ids::AxisId;
use crate::model::{Axis, AxisKind, DraftRun, Nuisance, NuisanceKind, ProblemKind};
use crate::source::Text;
use typed_index_collections::TiVec;

/// A run's axes and where they are along it.
pub(super) struct Path<'a> {
    pub axes: &'a [&'a Axis],
    pub at: &'a TiVec<AxisId, Coordinate>,
    pub sweep: SweepId,
}

/// A term before its parameter has a name: what it is called after, the axis, what it does.
struct Term {
    called: String,
    axis: AxisId,
    kind: NuisanceKind,
}

impl Resolver {
    /// The terms of a run, each with a parameter of its own.
    pub fn nuisances(&mut self, run: &DraftRun, path: &Path) -> Vec<Nuisance> {
        let mut found = Vec::new();
        for text in &run.nuisance {
            for term in self.written(text, path).unwrap_or_default() {
                found.extend(self.nuisance(text, run, term, path));
            }
        }
        found
    }

    /// What is written, as terms.
    fn written(&mut self, text: &Text, path: &Path) -> Option<Vec<Term>> {
        let (kind, of) = text.value.trim().rsplit_once(' ').unwrap_or((text.value.trim(), ""));
        let (kind, of) = (kind.trim_end(), of.to_owned());
        match kind {
            "backlash" | "lag" => {
                let Some(axis) = path.axes.iter().position(|axis| axis.name == of) else {
                    return self.problem(&text.span, ProblemKind::UnknownAxis(of));
                };
                let does = if kind == "lag" { NuisanceKind::Lag } else { NuisanceKind::Backlash };
                Some(vec![Term { called: format!("{kind}_{of}"), axis: axis.into(), kind: does }])
            }
            "lateral play" => {
                let motion = self.error(&of).and_then(|error| {
                    path.axes.iter().enumerate().find_map(|(i, axis)| {
                        let at = axis.motion.iter().position(|own| *own == error)?;
                        Some((AxisId::from(i), crate::iso::Component::ALL[at]))
                    })
                });
                let Some((axis, component)) = motion else {
                    return self.problem(&text.span, ProblemKind::UnknownError(of));
                };
                Some(vec![Term { called: format!("play_{of}"), axis, kind: NuisanceKind::LateralPlay(component) }])
            }
            "mismatch" if of.is_empty() => {
                let mut moving = Vec::new();
                for (axis, coordinate) in path.at.iter_enumerated() {
                    if self.sense(text, coordinate, path.sweep)?.is_some() {
                        moving.push(axis);
                    }
                }
                if moving.len() < 2 {
                    return self.problem(&text.span, ProblemKind::MovesAlone);
                }
                // A lag that all axes have moves them along the path, and nothing is seen of it.
                let term = |&axis: &AxisId| Term {
                    called: format!("mismatch_{}", path.axes[usize::from(axis)].name),
                    axis,
                    kind: NuisanceKind::Lag,
                };
                Some(moving.iter().skip(1).map(term).collect())
            }
            _ => self.problem(&text.span, ProblemKind::NotANuisance(text.value.clone())),
        }
    }

    fn sense(&mut self, text: &Text, coordinate: &Coordinate, sweep: SweepId) -> Option<Option<Sense>> {
        let Some(coordinate) = coordinate.poly() else { return Some(None) };
        let sense = Sense::along(coordinate, sweep, &self.alphabet);
        self.exact(&text.span, sense)
    }

    fn nuisance(&mut self, text: &Text, run: &DraftRun, term: Term, path: &Path) -> Option<Nuisance> {
        let axis = path.axes[usize::from(term.axis)];
        let coordinate = &path.at[term.axis];
        let Some(own) = self.sense(text, coordinate, path.sweep)? else {
            return self.problem(&text.span, ProblemKind::Standing(axis.name.clone()));
        };
        let sense = if term.kind == NuisanceKind::Lag { Sense::of_sweep(path.sweep) } else { own };
        let (sense, against) = self.direction_symbol(text, sense, &axis.name)?;
        let quantity = match (term.kind, axis.kind) {
            (NuisanceKind::Lag, _) | (NuisanceKind::Backlash, AxisKind::Rotary) => Quantity::Angle,
            (NuisanceKind::Backlash, AxisKind::Linear) => Quantity::Length,
            (NuisanceKind::LateralPlay(component), _) if component.is_rotation() => Quantity::Angle,
            (NuisanceKind::LateralPlay(_), _) => Quantity::Length,
        };
        let name = Text { value: format!("{}_{}", term.called, item(&run.name.value)), span: text.span.clone() };
        if !self.is_free(&name) {
            return None;
        }
        let made = self.alphabet.error(&name.value, quantity);
        let error = self.exact(&text.span, made)?;
        let factors = self.factors(axis, coordinate, path.sweep, term.kind, (sense, against));
        let factors = self.exact(&text.span, factors)?;
        Some(Nuisance { error, axis: term.axis, kind: term.kind, sense, against, factors })
    }

    /// The symbol of a sense, and whether it is the other way round; called after the first axis that has it.
    fn direction_symbol(&mut self, text: &Text, sense: Sense, axis: &str) -> Option<(NominalId, bool)> {
        if let Some(id) = self.alphabet.find_sense(&sense.reversed()) {
            return Some((id, true));
        }
        let own = sense == Sense::of_sweep(sense.sweep);
        let wanted = format!("dir_{}", if own { self.alphabet.sweep_name(sense.sweep) } else { axis });
        let name = self.alphabet.free(wanted);
        let made = self.alphabet.sense(sense, name);
        Some((self.exact(&text.span, made)?, false))
    }

    /// What the parameter does to the motion errors of its axis.
    fn factors(
        &self,
        axis: &Axis,
        coordinate: &Coordinate,
        sweep: SweepId,
        kind: NuisanceKind,
        (sense, against): (NominalId, bool),
    ) -> Result<[Poly; 6], crate::algebra::AlgebraError> {
        let mut sign = Poly::nominal(sense);
        if against {
            sign = sign.negated();
        }
        let by = match (kind, coordinate.poly()) {
            (NuisanceKind::Lag, Some(coordinate)) => {
                let velocity = coordinate.derivative(sweep, &self.alphabet)?;
                velocity.times(&sign, Order::NOMINAL)?.scaled(&integer(-1))?
            }
            _ => sign.scaled(&Rational::new(1, 2))?,
        };
        let mut factors: [Poly; 6] = Default::default();
        match kind {
            NuisanceKind::LateralPlay(component) => factors[component.index()] = by,
            NuisanceKind::Backlash | NuisanceKind::Lag => {
                let first = if axis.kind == AxisKind::Rotary { 3 } else { 0 };
                for (factor, direction) in factors.iter_mut().skip(first).zip(&axis.direction) {
                    *factor = by.times(direction, Order::NOMINAL)?;
                }
            }
        }
        Ok(factors)
    }
}
