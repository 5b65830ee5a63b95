//! Compensation tables: estimated functions as controls take them.
//!
//! An error is actual − commanded, positive in the positive direction of its component (ISO 230-1). What a control takes for it, its
//! unit, and what it does between rows, at the ends and over a turn, is in each format's [`Facts`].

mod digits;
mod facts;
mod fanuc;
mod format;
mod grid;
mod heidenhain;
mod iso;
mod linuxcnc;
mod pivots;
mod plain;
mod sinumerik;
mod table;
mod warning;
mod written;

pub use facts::{Between, Ends, Facts, Resolution, Verified};
pub use format::{AllFormat, Format, OneFormat};
pub use grid::{Grid, GridError};
pub use iso::Constant;
pub use pivots::{Added, Chained, Estimate, Located, NoPivots, Pin, Pins, chain, chain_text, named, pins};
pub use table::{NoAxis, Subject, Table, TakenOff};
pub use warning::{Warning, warnings};
pub use written::{Kept, Written, left};

use thiserror::Error;

/// What a control has to be told beside the table.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// Where the axis powers up, its reference position, degrees or mm.
    pub home: f64,
    /// Fanuc: the detection unit, degrees or mm.
    pub detection_unit: f64,
    /// CEC: what the control calls the axis that takes the error off, where it is not as the model does.
    pub output: Option<String>,
    /// Comments, where the format has them.
    pub notes: Vec<String>,
}

impl Default for Told {
    fn default() -> Self {
        Self { home: 0.0, detection_unit: 0.001, output: None, notes: Vec::new() }
    }
}

/// Why a format has no place for a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NoPlace {
    /// Its error is none of the axis' own position.
    #[error(
        "not the axis' own position\n  expected a positioning error, such as EAA, or another format: cec, heidenhain, volcomp"
    )]
    NotOwn,
    /// No axis moves along it everywhere.
    #[error(
        "what no single axis takes off\n  expected an error along a linear axis that no rotary one carries, or volcomp"
    )]
    NoAxis,
    /// The reference position is no row.
    #[error(
        "tabulated without a row at the reference position, where a list of increments begins\n  expected a range and a step with a row at \
         --home"
    )]
    NoReference,
    /// Increments larger than can be entered.
    #[error(
        "so steep that its increments are larger than can be entered\n  expected a smaller step, or a larger --detection-unit"
    )]
    TooSteep,
}

/// A table in a format.
///
/// # Errors
/// [`NoPlace`]
pub fn write(table: &Table, format: OneFormat, told: &Told) -> Result<Written, NoPlace> {
    let notes = &told.notes;
    match format {
        OneFormat::LinuxCnc => linuxcnc::write(table).ok_or(NoPlace::NotOwn),
        OneFormat::Sinumerik840d | OneFormat::Sinumerik808d => sinumerik::encoder(table, notes).ok_or(NoPlace::NotOwn),
        OneFormat::Cec => sinumerik::cross(table, told.output.as_deref(), notes).ok_or(NoPlace::NoAxis),
        OneFormat::Heidenhain => Ok(heidenhain::write(table)),
        OneFormat::Fanuc => fanuc::write(table, told.home, told.detection_unit, notes).map_err(|wrong| match wrong {
            fanuc::Wrong::NotOwn => NoPlace::NotOwn,
            fanuc::Wrong::Reference => NoPlace::NoReference,
            fanuc::Wrong::Increments => NoPlace::TooSteep,
        }),
        OneFormat::Csv => Ok(plain::csv(table, notes)),
        OneFormat::Json => Ok(plain::json(table, notes)),
    }
}

/// Every table and constant in a format, and what of each table is kept.
pub fn write_all(tables: &[Table], constants: &[Constant], format: AllFormat, notes: &[String]) -> (String, Vec<Kept>) {
    let text = match format {
        AllFormat::Volcomp => iso::volcomp(tables, constants, notes),
        AllFormat::Etalon => iso::etalon(tables, constants, notes),
    };
    (text, tables.iter().map(iso::kept).collect())
}
