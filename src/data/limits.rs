//! How large a measurement may be: far more than anybody measures, and little enough for the memory of a small computer.

/// Bytes of a line, or of a field in quotes that goes over several.
pub const LINE: usize = 1 << 16;
/// Lines of a file, comments and empty ones counted.
pub const LINES: u64 = 10_000_000;
/// Samples of all runs together that are fitted or simulated at once: each is kept until the report is made.
pub const SAMPLES: usize = 1_000_000;
/// Nodes of a table, touches of a ring.
pub const NODES: usize = 100_000;
/// Bytes of a text that is read as a whole: a model file, a machine file.
pub const TEXT: usize = trunnion_codegen::limits::FILE;
