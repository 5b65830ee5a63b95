//! Compensation tables: an estimated function as a control takes it.
//!
//! An error is actual − commanded, positive in the positive direction of its component (ISO 230-1). What a control takes for it, its
//! unit, and what it does between rows, at the ends and over a turn, is in each format's [`Facts`].

mod format;
mod grid;
mod linuxcnc;
mod table;
mod warning;
mod written;

pub use format::{Between, Facts, Format, Verified};
pub use grid::{Grid, GridError};
pub use table::{NoAxis, Subject, Table};
pub use warning::{Warning, warnings};
pub use written::Written;

/// A table as a format has it; `None` where the format has no place for the function: it is not the axis' own position.
pub fn write(table: &Table, format: Format) -> Option<Written> {
    match format {
        Format::LinuxCnc => linuxcnc::write(table),
    }
}
