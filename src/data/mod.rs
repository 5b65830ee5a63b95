//! Reading and writing of measurement files.
//!
//! A file is CSV: a header line whose column names carry their units (`a_deg,dr_um`), then one line a sample. Names are
//! case-sensitive, blanks around a field are dropped; CRLF, empty lines and lines that begin with `#` are allowed. Angles need no
//! order. Fields are separated by commas, semicolons, tabs or vertical bars, decimals by points or commas; texts may stand above the
//! header, more columns beside those needed, and [`Columns`] gives them other names. UTF-8, UTF-16 and Latin-1 are read. Inside,
//! lengths are in mm and angles in rad. [`import`] reads the files of instruments.
//!
//! [`Sweep`] is one run of the ball-bar, [`Table`] the functions known beforehand. Whatever is wrong with a file comes
//! back as one [`FileError`] with every bad line in it. What cannot be seen: a file cut exactly at the end of a line.

mod called;
mod columns;
mod curves;
mod date;
mod decoded;
mod dialect;
mod error;
mod imported;
mod known;
pub mod limits;
mod lines;
mod made;
mod native;
mod numeral;
mod output;
mod positions;
mod project;
mod radius;
mod recorded;
mod records;
mod refused;
mod runs;
mod separator;
mod simulated;
mod source;
mod stamp;
mod sweep;
mod table;
mod text;
mod truth;
mod written;

pub use called::{Columns, ColumnsError};
pub(crate) use columns::Wanted;
pub use curves::curve_files;
pub(crate) use date::day;
pub use error::{BadLines, FieldProblem, FileError, FileProblem, HeaderProblem, LineProblem, Need};
pub use imported::{Form, ImportedFile, import};
pub(crate) use lines::{Line, Lines};
pub use made::{is_of, made};
pub use native::{NativeError, native_files};
pub use output::{
    Files, Guard, WriteError, WriteProblem, discard_staged, remedy, write_atomically, write_picture, write_report,
    write_table,
};
pub use positions::{Positions, PositionsProblem, degrees, positions_text};
pub use project::{MachineAtHand, PROJECT, Project, ProjectError, ProjectRun};
pub use radius::{Radius, RadiusError};
pub use recorded::Recorded;
pub use refused::ObservationsError;
pub use runs::{RunFiles, observations};
pub use separator::Separator;
pub use simulated::{simulation_files, write_simulation};
pub use source::{Source, SourceError};
pub use stamp::Stamp;
pub use sweep::{Sweep, SweepSample};
pub use table::{Known, KnownAtSamples, Table, TableValues};
pub use text::{Encoding, TextError, read_document, read_text};
pub use trunnion_codegen::quantity::{Quantity, Unit};
pub use truth::{Truth, TruthFunction};
