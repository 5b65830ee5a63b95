//! How large a description may be. Each limit is many times what any machine needs, and small enough that whatever keeps to all
//! of them is answered within seconds and a gigabyte; beyond one, a problem names it.

/// Bytes of a model file.
pub const FILE: usize = 1 << 16;
/// Characters of a name.
pub const NAME: usize = 128;
/// Axes of a machine, on both sides together.
pub const AXES: usize = 12;
/// Runs of a model, as they are written.
pub const RUNS: usize = 64;
/// Entries of any other list or table: lengths, names, functions, assumptions, definitions, conditions, ….
pub const LIST: usize = 200;
/// Operators of an expression.
pub const OPERATORS: usize = 500;
/// How deep parentheses, functions and signs of an expression may be nested.
pub const NESTING: usize = 100;
/// Terms of an expression's value, multiplied out, of each of its parts' and of each step of a power.
pub const TERMS: usize = 200;
/// Products of two terms in one product of an expression.
pub const PRODUCTS: usize = 10_000;
/// Decimal digits above or below the line of a number on the way to a part's value: as many as `f64` can be large.
pub const DIGITS: u64 = 300;
/// Pairs of terms in one product of a derivation: more than 250,000 stand in the second order of the catalogue's largest machines.
pub const PAIRS: usize = 2_000_000;
/// Terms of all parameters' coefficients in all runs together, before they are reduced: the catalogue's models have up to 635.
pub const COEFFICIENTS: usize = 20_000;
/// Pairs of terms that an elimination multiplies: some times what the catalogue's largest searches need, and some seconds.
pub const ELIMINATION: usize = 4_000_000;
/// Problems that are told one by one; the others are counted.
pub const PROBLEMS: usize = 20;
/// Characters of a quoted text or line that a message shows.
pub const SHOWN: usize = 200;
