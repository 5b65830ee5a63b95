//! What is assumed of motion errors, and which of them are to be found.

use super::resolver::Resolver;
use crate::algebra::ErrorId;
use crate::algebra::{AlgebraError, Alphabet, Monomial, Poly, Rational};
use crate::basis::{Basis, BasisFunction, Functions, LinearCondition, Univariate, satisfying};
use crate::expression::{Scope, parse_equation};
use crate::ids::FunctionId;
use crate::model::conditions::condition;
use crate::model::{Axis, AxisKind, Draft, DraftBasis, DraftFunction, ErrorFunction, ProblemKind};
use crate::source::Text;
use typed_index_collections::TiVec;

impl Resolver {
    /// All of them, of the errors of `axes`.
    pub fn functions(&mut self, draft: &Draft, axes: &[&Axis]) -> TiVec<FunctionId, ErrorFunction> {
        let mut functions: TiVec<FunctionId, ErrorFunction> =
            draft.functions.iter().filter_map(|f| self.function(f, axes)).collect();
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
            if let Some(error) = error.filter(|e| axes.iter().any(|axis| axis.location.contains(&Some(*e)))) {
                if functions.iter().all(|f| f.error != error) {
                    let place = text.span.clone();
                    functions.push(ErrorFunction { error, basis: Basis::one(), estimate: true, place });
                }
                continue;
            }
            match functions.iter_mut().find(|f| Some(f.error) == error) {
                Some(f) if !f.basis.functions().is_empty() => f.estimate = true,
                None if error
                    .is_some_and(|e| draft.functions.iter().any(|f| self.error(&f.error.value) == Some(e))) => {}
                _ => self.problem(&text.span, ProblemKind::NothingToEstimate(text.value.clone())).unwrap_or(()),
            }
        }
        functions
    }

    fn function(&mut self, f: &DraftFunction, axes: &[&Axis]) -> Option<ErrorFunction> {
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
            DraftBasis::Fourier(n) => Basis::fourier(*n),
            DraftBasis::Polynomial(degree, written) if written.is_empty() => Basis::polynomial(*degree),
            DraftBasis::Polynomial(degree, written) => {
                let conditions: Vec<_> = written.iter().filter_map(|text| self.condition(text)).collect();
                (conditions.len() == written.len()).then_some(())?;
                let functions = satisfying(*degree, &conditions, &self.alphabet);
                let functions =
                    functions.map_or_else(|e| self.problem(&f.error.span, ProblemKind::NoBasis(e)), Some)?;
                let points: Vec<Poly> =
                    conditions.iter().flat_map(|c| &c.terms).map(|(_, point, _)| point.clone()).collect();
                let turn = match axis.kind {
                    AxisKind::Rotary => turn_from(&functions, &points, &self.alphabet),
                    AxisKind::Linear => Ok(None),
                };
                let turn_from = self.exact(&f.error.span, turn)?;
                let terms = functions.into_iter().map(BasisFunction::Polynomial).collect();
                Basis::Functions(Functions { terms, turn_from, points })
            }
        };
        Some(ErrorFunction { error, basis, estimate: false, place: f.error.span.clone() })
    }

    fn condition(&mut self, text: &Text) -> Option<LinearCondition> {
        let (left, right) = self.parsed(text, parse_equation(&text.value))?;
        let found = condition(&Scope { alphabet: &self.alphabet, sweep: None, defined: &[] }, &left, &right);
        self.meaning(text, found)?.or_else(|| self.problem(&text.span, ProblemKind::NotACondition))
    }
}

/// Steps of 15° in a turn.
const TURN: i32 = 24;

/// An angle in steps of 15°, where it is some, within ten turns.
fn steps(angle: &Poly) -> Result<Option<i32>, AlgebraError> {
    let scaled = angle.scaled(&Rational::from(12))?;
    let whole = match scaled.terms() {
        [] => Some(0),
        [(m, c)] if *m == Monomial::nominal(Alphabet::PI, 1) => c.to_integer(),
        _ => None,
    };
    let within = whole.and_then(|steps| i32::try_from(steps).ok());
    Ok(within.filter(|steps| steps.abs() <= 10 * TURN))
}

/// Where a turn begins over which the functions are periodic: a point of their conditions, in steps of 15°, a turn after which
/// they all have the same value.
fn turn_from(functions: &[Univariate], points: &[Poly], alphabet: &Alphabet) -> Result<Option<i32>, AlgebraError> {
    let at = |steps: i32| Poly::nominal(Alphabet::PI).scaled(&Rational::new(steps.into(), 12));
    let mut starts = Vec::new();
    for point in points {
        starts.extend(steps(&point.normal(alphabet)?)?);
    }
    starts.sort_unstable();
    starts.dedup();
    'starts: for &start in starts.iter().filter(|start| starts.contains(&(*start + TURN))) {
        for f in functions {
            if f.at(&at(start)?)?.normal(alphabet)? != f.at(&at(start + TURN)?)?.normal(alphabet)? {
                continue 'starts;
            }
        }
        return Ok(Some(start));
    }
    Ok(None)
}
