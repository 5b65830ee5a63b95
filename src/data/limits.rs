//! How large a measurement may be: far more than anybody measures, and little enough for the memory of a small computer.

/// Bytes of a line, or of a field in quotes that goes over several.
pub const LINE: usize = 1 << 16;
/// Lines of a file, comments and empty ones counted.
pub const LINES: u64 = 20_000_000;
/// Samples of a file that `fit` keeps, 16 bytes each: a file of more is read again each time, where it can be.
pub const KEPT: usize = 1_000_000;
/// Samples of all runs together that are kept with all that belongs to them: simulated ones; nodes of a table.
pub const SAMPLES: usize = 300_000;
/// Touches of a ring: the search for its minimum zone takes their number's third power.
pub const TOUCHES: usize = 1_000;
/// Bytes of a file that may be an earlier result.
pub const RESULT: u64 = 1 << 26;
/// Bytes of a text that is read as a whole: a model file, a machine file.
pub const TEXT: usize = trunnion_codegen::limits::FILE;
