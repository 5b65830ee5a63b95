//! SINUMERIK: `$AA_ENC_COMP` and `$AN_CEC`, value = measured − commanded.

use super::digits::{comments, decimal, read_back};
use super::table::{Table, TakenOff};
use super::written::Written;

/// Digits behind the point.
const DIGITS: usize = 9;
/// The axis' measuring system: 0 the first, 1 the second.
const ENCODER: usize = 0;

/// Encoder error compensation; `None` of a function that is not the axis' own position.
pub(super) fn encoder(table: &Table, notes: &[String]) -> Option<Written> {
    let (table, sense) = (table.mean(), table.own()?);
    let values = table.scaled(sense);
    let axis = &table.subject.axis;
    let mut text = format!("%_N_AX_EEC_INI\n{}CHANDATA(1)\n", comments(";", notes));
    for (row, value) in values[0].iter().enumerate() {
        text += &format!("$AA_ENC_COMP[{ENCODER},{row},{axis}]={}\n", decimal(*value, DIGITS));
    }
    for (what, value) in ends(&table) {
        text += &format!("$AA_ENC_COMP_{what}[{ENCODER},{axis}]={value}\n");
    }
    text += "M17\n";
    Some(Written { text, kept: table.kept(&read_back(&values, DIGITS), sense) })
}

/// Sag and angularity compensation, from the axis to itself or to the one along which the error is: one table, or one for each
/// direction. A value is the error as one of the output axis' position: an error that displaces the workpiece is the opposite one of an
/// axis that carries the tool. `None` of a function that no axis takes off.
pub(super) fn cross(table: &Table, output: Option<&str>, notes: &[String]) -> Option<Written> {
    let input = &table.subject.axis;
    let (axis, sense) = match &table.subject.taken_off {
        TakenOff::Own(sense) => (input, *sense),
        TakenOff::Other(axis, sense) => (axis, *sense),
        TakenOff::None => return None,
    };
    let output = output.unwrap_or(axis);
    let values = table.scaled(sense);
    let directions: &[i8] = if table.both { &[1, -1] } else { &[0] };
    let mut text = format!("%_N_NC_CEC_INI\n{}CHANDATA(1)\n", comments(";", notes));
    for ((t, direction), values) in directions.iter().enumerate().zip(&values) {
        for (row, value) in values.iter().enumerate() {
            text += &format!("$AN_CEC[{t},{row}]={}\n", decimal(*value, DIGITS));
        }
        text += &format!("$AN_CEC_INPUT_AXIS[{t}]=({input})\n$AN_CEC_OUTPUT_AXIS[{t}]=({output})\n");
        for (what, value) in ends(table) {
            text += &format!("$AN_CEC_{what}[{t}]={value}\n");
        }
        text += &format!("$AN_CEC_DIRECTION[{t}]={direction}\n$AN_CEC_MULT_BY_TABLE[{t}]=0\n");
    }
    text += "M17\n";
    Some(Written { text, kept: table.kept(&read_back(&values, DIGITS), sense) })
}

/// Where the rows are.
fn ends(table: &Table) -> [(&'static str, String); 4] {
    let grid = &table.grid;
    [
        ("STEP", decimal(grid.step(), DIGITS)),
        ("MIN", decimal(grid.from(), DIGITS)),
        ("MAX", decimal(grid.to(), DIGITS)),
        ("IS_MODULO", u8::from(table.is_a_turn()).to_string()),
    ]
}
