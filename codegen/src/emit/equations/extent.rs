//! How far a function is determined, in words and as a list.

use super::document::Document;
use super::function::Written;
use super::printer::Style;
use crate::algebra::Fraction;
use crate::identify::{Derivation, Determination, Extent};
use crate::ids::{ParameterId, TermId};
use crate::model::Model;

/// What stands between a function and the sum it is seen in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remaining {
    /// The term of its basis that it looks like: `cos(2·c)`.
    pub term: String,
    /// The parameter that makes it as well, or the function's own coefficient where no run sees that.
    pub parameter: String,
    /// What it is multiplied with: `2/L`.
    pub factor: String,
}

/// What remains of other errors in the sum in which a function is seen, and its own coefficients that are not: nothing where it
/// is determined.
pub fn remaining(model: &Model, derivation: &Derivation, determination: &Determination) -> Vec<Remaining> {
    let words = Words::new(model, derivation, determination, Style::Pretty);
    let seen = determination.seen.iter().flat_map(|s| s.others.iter().map(|(j, f)| (s.term, *j, f)));
    let others = seen.map(|(term, j, factor)| Remaining {
        term: words.term(term),
        parameter: derivation.parameters[j].name.clone(),
        factor: words.document.printer.fraction(factor),
    });
    let missing = determination.missing.iter().map(|&term| Remaining {
        term: words.term(term),
        parameter: words.coefficient(term),
        factor: "1".to_owned(),
    });
    others.chain(missing).collect()
}

/// `determined`, `determined up to cos(c), which 2/L·EYC_cos2 makes as well`, or `not seen (EXX1, EXX2)`.
pub fn extent(model: &Model, derivation: &Derivation, determination: &Determination, style: Style) -> String {
    let words = Words::new(model, derivation, determination, style);
    let missing = || determination.missing.iter().map(|&t| words.coefficient(t)).collect::<Vec<_>>().join(", ");
    match determination.extent() {
        Extent::Determined => "determined".to_owned(),
        Extent::NotSeen => format!("not seen ({})", missing()),
        Extent::UpTo => {
            let shared = determination.seen.iter().filter(|s| !s.others.is_empty());
            let as_well =
                shared.map(|s| format!("{}, which {} makes as well", words.term(s.term), words.others(&s.others)));
            let unseen = determination.missing.iter();
            let unseen = unseen.map(|&t| format!("{} ({}), which is not seen", words.term(t), words.coefficient(t)));
            format!("determined up to {}", as_well.chain(unseen).collect::<Vec<_>>().join("; "))
        }
    }
}

/// The sum in which a function is seen: `ECC + cos(c)·(2/L·EYC_cos2)`; its name where it is determined, `None` where it is not
/// seen.
pub fn seen_sum(model: &Model, derivation: &Derivation, determination: &Determination) -> Option<String> {
    let words = Words::new(model, derivation, determination, Style::Pretty);
    let printer = words.document.printer;
    let name = words.document.error(model.functions[determination.function].error);
    if determination.seen.is_empty() {
        return None;
    }
    let less = determination.missing.iter().map(|&t| {
        let factors = [words.coefficient(t), words.term(t)];
        (true, printer.product(&factors))
    });
    let with = determination.seen.iter().filter(|s| !s.others.is_empty()).map(|s| {
        let others = words.others(&s.others);
        let sum = if s.others.len() > 1 { printer.parenthesised(&others) } else { others };
        (false, printer.product(&[words.term(s.term), sum]))
    });
    Some(printer.sum([(false, name)].into_iter().chain(less).chain(with)))
}

struct Words<'a> {
    document: Document<'a>,
    determination: &'a Determination,
    coordinate: String,
}

impl<'a> Words<'a> {
    fn new(model: &'a Model, derivation: &'a Derivation, determination: &'a Determination, style: Style) -> Self {
        let document = Document::new(model, derivation, style);
        let coordinate = document.coordinate(determination.function);
        Self { document, determination, coordinate }
    }

    /// A function of the basis, written out.
    fn term(&self, term: TermId) -> String {
        let basis = &self.document.model.functions[self.determination.function].basis;
        let mut written = Written { printer: &self.document.printer, x: &self.coordinate };
        basis.functions().get(term).map_or_else(String::new, |f| f.of(&mut written))
    }

    fn coefficient(&self, term: TermId) -> String {
        let function = &self.document.model.functions[self.determination.function];
        let name = self.document.model.alphabet.error_name(function.error);
        let suffix = function.basis.functions().get(term).map_or_else(String::new, |f| f.suffix(term));
        self.document.printer.name(&format!("{name}{suffix}"))
    }

    fn others(&self, others: &[(ParameterId, Fraction)]) -> String {
        self.document.definition(others)
    }
}
