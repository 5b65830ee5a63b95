//! What is written is read, by readers that share no line with the writers.

use crate::readers::{self, Errors, Trim};
use trunnion::data::{Quantity, Unit};
use trunnion::export::{Constant, Format, Kept, OneFormat, Table, TakenOff, Told, write, write_all};

/// What a control adds by a table in a format, and what the writer says is kept of it; none where the format has no place for it.
pub fn read(format: Format, table: &Table, told: &Told) -> Option<(Trim, Kept)> {
    match format {
        Format::One(one) => {
            let written = write(table, one, told).ok()?;
            Some((readers::of(one)(&written.text).unwrap(), written.kept))
        }
        Format::All(all) => {
            let (text, mut kept) = write_all(std::slice::from_ref(table), &[], all, &told.notes);
            let errors = readers::of_all(all)(&text).unwrap();
            let in_degrees = table.subject.quantity == Quantity::Angle;
            Some((readers::iso_error(&errors, &table.subject.iso, in_degrees).unwrap(), kept.remove(0)))
        }
    }
}

/// 1, or −1 where what a control adds is of a position that does the opposite of the error.
pub fn sense(format: Format, table: &Table) -> f64 {
    match (format, &table.subject.taken_off) {
        // Errors, not positions of an axis, have no sense of it.
        (Format::All(_) | Format::One(OneFormat::Csv | OneFormat::Json), _) => 1.0,
        (_, TakenOff::Own(sense)) | (Format::One(OneFormat::Cec), TakenOff::Other(_, sense)) => *sense,
        _ => 1.0,
    }
}

/// The error that is taken off at a coordinate, mm or rad.
pub fn taken(format: Format, table: &Table, trim: &Trim, at: f64, ahead: bool) -> f64 {
    -sense(format, table) * table.subject.quantity.coordinate().to_inner(trim(at, ahead))
}

/// Holds every format that has a place for a table to what its writer says is kept; which those are.
pub fn every_format_is_read(table: &Table, told: &Told) -> Vec<Format> {
    let turn = table.subject.along == Unit::Deg && (table.grid.to() - table.grid.from() - 360.0).abs() < 1e-6;
    let mut placed = Vec::new();
    for format in Format::ALL {
        let Some((trim, kept)) = read(format, table, told) else { continue };
        // Where a turn begins again is one row, of a function that jumps there the first.
        for (row, at) in table.grid.points().enumerate().take(table.grid.rows() - usize::from(turn)) {
            for (ahead, kept) in [(true, &kept[0]), (false, &kept[1])] {
                let (read, own) = (taken(format, table, &trim, at, ahead), kept[row]);
                assert!((read - own).abs() < 2e-12, "{} at {at}: {read} {own}", format.name());
            }
        }
        placed.push(format);
    }
    placed
}

/// Holds the files of all errors to their tables and constants: each is there under its name, with its sign, and nothing else.
pub fn all_errors_are_read(tables: &[Table], constants: &[Constant], notes: &[String]) {
    for format in Format::ALL {
        let Format::All(all) = format else { continue };
        let (text, kept) = write_all(tables, constants, all, notes);
        let errors: Errors = readers::of_all(all)(&text).unwrap();
        assert_eq!(errors.len(), tables.len() + constants.len(), "{}\n{text}", format.name());
        for (name, value) in constants {
            let [(_, read)] = errors[name][..] else { panic!("{name}\n{text}") };
            assert!((read - value).abs() <= 0.51e-12, "{name}: {read} {value}");
        }
        for (table, kept) in tables.iter().zip(&kept) {
            let rows = &errors[&table.subject.iso];
            assert_eq!(rows.len(), table.grid.rows());
            for (row, (at, (read_at, read))) in table.grid.points().zip(rows).enumerate() {
                let mean = (table.errors[0][row] + table.errors[1][row]) / 2.0;
                assert!((at - read_at).abs() < 1e-6 && (read - mean).abs() <= 0.51e-12, "{at}: {read} {mean}");
                assert!(*read == kept[0][row] && *read == kept[1][row], "{at}: {read}");
            }
        }
    }
}
