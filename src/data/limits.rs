//! How large a measurement may be: far more than anybody measures, and little enough for the memory of a small computer.

/// Bytes of a line, or of a field in quotes that goes over several.
pub const LINE: usize = 1 << 16;
/// Lines of a file, comments and empty ones counted.
pub const LINES: u64 = 25_000_000;
/// Samples of a file that `fit` keeps, 16 bytes each: a file of more is read again each time, where it can be.
pub const KEPT: usize = 1_000_000;
/// Samples of all runs together that are kept with all that belongs to them; nodes of a table.
pub const SAMPLES: usize = 300_000;
/// Samples of a run that are simulated into a file: there and back they are fewer than [`LINES`].
pub const SIMULATED: usize = 10_000_000;
/// Touches of a ring or an offset.
pub const TOUCHES: usize = 10_000;
/// Bytes of a file that may be an earlier result.
pub const RESULT: u64 = 1 << 26;
/// Bytes of a text that is read as a whole: a model file, a machine file.
pub const TEXT: usize = trunnion_codegen::limits::FILE;
/// Lines that say something before the header of a table.
pub const PREAMBLE: usize = 200;
/// Bytes of an instrument's own file, which is read as a whole.
pub const INSTRUMENT: usize = 1 << 24;
/// Elements, texts and comments of an instrument's own file in XML.
pub const NODES: u32 = 20_000;
/// Bytes of a tag in it.
pub const TAG: usize = 1 << 12;
/// Declarations of namespaces in it.
pub const NAMESPACES: usize = 64;
/// Positions at which a run stops.
pub const POSITIONS: usize = 1_000;
