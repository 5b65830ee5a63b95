//! Numbers as people write them: with a decimal point or a decimal comma.

use super::error::FieldProblem;

/// What stands before a number's decimals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DecimalSign {
    Point,
    Comma,
}

/// A finite number, and its decimal sign if it has one.
pub(super) fn numeral(text: &str) -> Option<(f64, Option<DecimalSign>)> {
    let (number, sign) = parsed(text)?;
    number.is_finite().then_some((number, sign))
}

fn parsed(text: &str) -> Option<(f64, Option<DecimalSign>)> {
    match (text.contains('.'), text.contains(',')) {
        (false, true) => Some((text.replacen(',', ".", 1).parse().ok()?, Some(DecimalSign::Comma))),
        (point, false) => Some((text.parse().ok()?, point.then_some(DecimalSign::Point))),
        (true, true) => None,
    }
}

/// The numbers of a file, all with the same decimal sign: `1.234` and `0,5` in one file might be a thousand times another number.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numerals(Option<DecimalSign>);

impl Numerals {
    /// The number in a field of a column.
    pub fn number(&mut self, column: &str, text: &str) -> Result<f64, FieldProblem> {
        let (name, quoted) = (|| column.to_owned(), || shown(text));
        let Some((number, sign)) = parsed(text) else {
            return Err(match text {
                "" => FieldProblem::Blank { column: name() },
                _ => FieldProblem::Text { column: name(), text: quoted() },
            });
        };
        if !number.is_finite() {
            return Err(FieldProblem::NotFinite { column: name(), text: quoted() });
        }
        match sign {
            Some(sign) if *self.0.get_or_insert(sign) != sign => {
                Err(FieldProblem::MixedDecimals { column: name(), text: quoted() })
            }
            _ => Ok(number),
        }
    }
}

/// A field, or its beginning.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(24).collect()
}
