//! What is assumed of motion errors, and which of them are to be found.

use super::resolver::Resolver;
use crate::algebra::ErrorId;
use crate::basis::{Basis, LinearCondition, satisfying};
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
                Basis::polynomials(
                    functions.map_or_else(|e| self.problem(&f.error.span, ProblemKind::NoBasis(e)), Some)?,
                )
            }
        };
        Some(ErrorFunction { error, basis, estimate: false, place: f.error.span.clone() })
    }

    fn condition(&mut self, text: &Text) -> Option<LinearCondition> {
        let (left, right) = self.parsed(text, parse_equation(&text.value))?;
        let found = condition(&Scope { alphabet: &self.alphabet, sweep: None }, &left, &right);
        self.meaning(text, found)?.or_else(|| self.problem(&text.span, ProblemKind::NotACondition))
    }
}
