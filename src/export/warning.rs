//! What fails on a control, or surprises there.

use super::digits::decimal;
use super::facts::{Ends, Facts};
use super::table::{TURN, Table};
use super::written::Kept;
use std::fmt;
use trunnion_codegen::quantity::Unit;

/// Digits of values behind the point, µm or µrad: what they do not show is none, as no control moves by less.
const DIGITS: usize = 3;
/// The smallest value that they show.
const NONE: f64 = 0.5e-3;

/// What to be wary of.
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// More rows than the control takes: rows, and how many it takes.
    Rows(usize, usize),
    /// The axis moves when the table becomes active: where it powers up, the values there in µm or µrad.
    NotZero {
        /// Where it powers up.
        at: f64,
        /// The error there forward and in reverse.
        values: [f64; 2],
        /// Degrees or mm, µm or µrad.
        units: [Unit; 2],
    },
    /// The axis can be commanded beyond the table.
    Ends {
        /// The table's first and last coordinate.
        table: [f64; 2],
        /// The axis' range in the model, where it has one.
        axis: Option<[f64; 2]>,
        /// What the control does there.
        does: Ends,
        /// Degrees or mm.
        unit: Unit,
    },
    /// More than a turn in a table.
    MoreThanATurn,
    /// A whole turn from here to there, where the control's is from 0 to 360°.
    AnotherTurn(f64, f64),
    /// A whole turn, whose ends differ by so much, in µm or µrad.
    Jump(f64, &'static str),
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rows(rows, most) => {
                write!(f, "{rows} rows, where the control takes {most} and drops the others: choose a larger step")
            }
            Self::NotZero { at, values, units: [along, unit] } => {
                let [more, less] = values.map(|value| decimal(value, DIGITS));
                let (along, unit) = (along.symbol(), unit.symbol());
                write!(
                    f,
                    "the axis moves when the table becomes active: at {at} {along}, where it powers up, the error is {more} {unit} \
                     forward and {less} {unit} in reverse, not 0"
                )
            }
            Self::Ends { table: [from, to], axis, does, unit } => {
                let does = does.words();
                write!(
                    f,
                    "beyond {from} to {to} {}, where the axis can be commanded, the control takes: {does}",
                    unit.symbol()
                )?;
                match axis {
                    Some([low, high]) => {
                        write!(f, "; the axis goes from {low} to {high} {} in the model", unit.symbol())
                    }
                    None => f.write_str("; command it within, or choose a larger range"),
                }
            }
            Self::MoreThanATurn => f.write_str(
                "the table goes over more than a turn: a control that counts modulo 360° reads a turn of it",
            ),
            Self::AnotherTurn(from, to) => write!(
                f,
                "the table is a whole turn from {from} to {to} °, where this control's manuals have one from 0 to 360 °, as an axis \
                 counts modulo 360°: choose --range-deg 0:360"
            ),
            Self::Jump(by, unit) => write!(f, "over a turn the table jumps by {by:.3} {unit} where it begins again"),
        }
    }
}

/// Everything to be wary of; `home` is where the axis powers up, `range` where it goes in the model, degrees or mm.
pub fn warnings(table: &Table, facts: &Facts, kept: &Kept, home: f64, range: Option<[f64; 2]>) -> Vec<Warning> {
    let grid = &table.grid;
    let (from, to) = (grid.from(), grid.to());
    let deviation = table.subject.quantity.deviation();
    let shown = |inner: f64| deviation.from_inner(inner);
    let mut warnings = Vec::new();
    if let Some(most) = facts.rows.filter(|most| grid.rows() > *most) {
        warnings.push(Warning::Rows(grid.rows(), most));
    }
    let last = grid.rows() - 1;
    let looked_up = if facts.ends.repeats() { table.within_its_turn(home) } else { home };
    let place = ((looked_up - from) / grid.step()).clamp(0.0, last as f64);
    let values = kept.each_ref().map(|kept| {
        let (row, share) = (place.floor() as usize, place.fract());
        let value = |row: usize| kept.get(row.min(last)).copied().unwrap_or(0.0);
        shown(value(row) + share * (value(row + 1) - value(row)))
    });
    if values.iter().any(|value| value.abs() >= NONE) {
        warnings.push(Warning::NotZero { at: home, values, units: [table.subject.along, deviation] });
    }
    let turns = table.subject.along == Unit::Deg;
    let slack = 1e-6 * grid.step();
    let beyond = range.is_none_or(|[low, high]| low < from - slack || high > to + slack);
    if turns && to - from > TURN + slack {
        warnings.push(Warning::MoreThanATurn);
    }
    if facts.ends == Ends::HeldOrRepeated && table.is_a_turn() && from != 0.0 {
        warnings.push(Warning::AnotherTurn(from, to));
    }
    let goes_on = match facts.ends {
        Ends::NoControl => false,
        ends => !(ends.repeats() && table.is_a_turn()),
    };
    if goes_on && beyond && (range.is_some() || turns) {
        let unit = table.subject.along;
        warnings.push(Warning::Ends { table: [from, to], axis: range, does: facts.ends, unit });
    }
    let jump = shown(kept.iter().map(|kept| (kept[last] - kept[0]).abs()).fold(0.0, f64::max));
    if table.is_a_turn() && jump >= NONE {
        warnings.push(Warning::Jump(jump, deviation.symbol()));
    }
    warnings
}
