//! Fanuc: stored pitch error compensation, a list of increments for a person to enter.
//!
//! Point n belongs to the section behind which the axis is n − 3620 intervals from the reference position; what is added there in all
//! is the sum of the increments on the way from the reference position. So the error at the reference position stays.

use super::digits::{comments, decimal};
use super::table::Table;
use super::written::Written;

/// The largest increment of the basic function.
const LARGEST: f64 = 7.0;
/// The largest magnification.
const MAGNIFIED: f64 = 100.0;
/// By how much of an interval the reference position may be off a row.
const SLACK: f64 = 1e-6;

/// What keeps a table from being such a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    /// The function is not the axis' own position.
    NotOwn,
    /// The reference position is no row.
    Reference,
    /// Increments are larger than can be entered.
    Increments,
}

/// The points of one direction.
struct Direction {
    /// The number of the first section's point.
    first: usize,
    /// What is added at the end of each section in all, in units of the list; 0 at the reference position.
    sums: Vec<i64>,
    /// What is added at the reference position besides.
    offset: i64,
    words: &'static str,
}

/// The rows in the order of the points: of a turn from the reference position on.
fn order(table: &Table, reference: usize) -> Vec<usize> {
    let sections = table.grid.rows() - 1;
    let turned = |i| (reference + i) % sections;
    if table.is_a_turn() { (0..=sections).map(turned).collect() } else { (0..=sections).collect() }
}

/// The list; `home` is the reference position, `unit` the detection unit, degrees or mm.
pub(super) fn write(table: &Table, home: f64, unit: f64, notes: &[String]) -> Result<Written, Wrong> {
    let sense = table.own().ok_or(Wrong::NotOwn)?;
    let (grid, turn) = (&table.grid, table.is_a_turn());
    let place = (table.within_its_turn(home) - grid.from()) / grid.step();
    let row = place.round();
    if (place - row).abs() > SLACK || row < 0.0 || row >= grid.rows() as f64 {
        return Err(Wrong::Reference);
    }
    let order = order(table, row as usize);
    let reference = if turn { 0 } else { row as usize };
    let sections = order.len() - 1;
    // What is to be added, less what there is at the reference position moving forward.
    let added = table.scaled(-sense).map(|own| order.iter().map(|row| own[*row]).collect::<Vec<f64>>());
    let zero = added[0][reference];
    let steps = added.iter().flat_map(|own| own.windows(2)).map(|two| (two[1] - two[0]).abs() / unit);
    // One more than is needed leaves room for the rounding of both ends.
    let magnification = (steps.fold(0.0, f64::max) / (LARGEST - 1.0)).ceil().max(1.0);
    if magnification > MAGNIFIED {
        return Err(Wrong::Increments);
    }
    let one = unit * magnification;
    let direction = |own: &[f64], first, words| {
        let rounded: Vec<i64> = own.iter().map(|x| ((x - zero) / one).round() as i64).collect();
        let offset = rounded[reference];
        Direction { first, sums: rounded.iter().map(|x| x - offset).collect(), offset, words }
    };
    // A turn has a point before its first one, the same as its last.
    let first = 1 + usize::from(turn);
    let words = if table.both {
        ["moving in the positive direction", "moving in the negative direction"]
    } else {
        ["both directions", ""]
    };
    let forward = direction(&added[0], first, words[0]);
    let reverse = direction(&added[1], first + sections + usize::from(turn), words[1]);
    let lists = if table.both { vec![&forward, &reverse] } else { vec![&forward] };
    let mut text = comments("#", notes);
    for (what, value) in parameters(table, (reference, first, sections), magnification, &reverse) {
        text += &format!("{what:<64} {value}\n");
    }
    text += &format!("{:<64} {home}\n{:<64} {unit}\n", "reference position", "detection unit");
    for own in lists {
        text += &list(own, home - grid.step() * reference as f64, grid.step(), turn);
    }
    let taken = [(&forward, 0), (&reverse, reverse.offset)].map(|(own, offset)| {
        let mut taken = vec![0.0; order.len()];
        order.iter().zip(&own.sums).for_each(|(row, sum)| taken[*row] = (sum + offset) as f64 * one);
        // The row a turn further is the first.
        if turn {
            taken[sections] = taken[0];
        }
        taken
    });
    Ok(Written { text, kept: table.kept(&taken, -sense) })
}

/// What is set beside the points.
fn parameters(
    table: &Table,
    (reference, first, sections): (usize, usize, usize),
    magnification: f64,
    reverse: &Direction,
) -> Vec<(&'static str, String)> {
    let (turn, number) = (table.is_a_turn(), first + reference - 1);
    let mut parameters = vec![
        ("3605#0 both directions", u8::from(table.both).to_string()),
        ("3620 number of the reference position", number.to_string()),
        ("3621 number furthest in the negative direction", if turn { number } else { first }.to_string()),
        ("3622 number furthest in the positive direction", (first + sections - 1).to_string()),
        ("3623 magnification", decimal(magnification, 0)),
        ("3624 interval", decimal(table.grid.step(), 4)),
    ];
    if turn {
        parameters.push(("3625 movement of a turn", decimal(360.0, 1)));
    }
    if table.both {
        let furthest = reverse.first - usize::from(turn);
        parameters.push(("3626 number furthest in the negative direction, moving so", furthest.to_string()));
        parameters.push(("3627 amount at the reference position, moving so", reverse.offset.to_string()));
    }
    parameters
}

/// Each point with its section.
fn list(own: &Direction, from: f64, step: f64, turn: bool) -> String {
    let mut text = format!("\nnumber     from       to increment      sum   {}\n", own.words);
    let last = own.sums.len() - 1;
    if turn {
        let increment = own.sums[last] - own.sums[last - 1];
        text += &format!("{:>6} {:>8} {:>8} {increment:>9}   as {}\n", own.first - 1, "-", "-", own.first + last - 1);
    }
    for (section, two) in own.sums.windows(2).enumerate() {
        let ends = [section, section + 1].map(|row| decimal(from + step * row as f64, 3));
        let number = own.first + section;
        text += &format!("{number:>6} {:>8} {:>8} {:>9} {:>8}\n", ends[0], ends[1], two[1] - two[0], two[1]);
    }
    text
}
