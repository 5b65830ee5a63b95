//! The words of each printed language: one table each.

use rustc_hash::FxHashSet;
use std::sync::LazyLock;

pub(crate) type Words = LazyLock<FxHashSet<&'static str>>;

/// C from C99 to C23 with its headers, GNU's dialects, and C++20, whose programs may include a printed header.
pub(crate) static C: Words = LazyLock::new(|| words(include_str!("c.txt")));

/// C in a realtime module of LinuxCNC: what halcompile, RTAPI and HAL give to its file, too.
pub(crate) static HAL: Words = LazyLock::new(|| words(include_str!("hal.txt")).union(&C).copied().collect());

/// Stems of the standard headers of C: a file beside them may not be called so.
pub(crate) static HEADERS: Words = LazyLock::new(|| words(include_str!("headers.txt")));

/// The realtime modules of LinuxCNC: a component may not be called so.
pub(crate) static MODULES: Words = LazyLock::new(|| words(include_str!("modules.txt")));

/// Python 3.
pub(crate) static PYTHON: Words = LazyLock::new(|| words(include_str!("python.txt")));

/// Rust.
pub(crate) static RUST: Words = LazyLock::new(|| words(include_str!("rust.txt")));

/// Words between blanks; a line with `#` first says what follows it.
fn words(table: &'static str) -> FxHashSet<&'static str> {
    table.lines().filter(|line| !line.starts_with('#')).flat_map(str::split_whitespace).collect()
}
