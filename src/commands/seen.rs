//! Messages that quote what a person gave.

use trunnion_codegen::problems::visible;

/// Lines for a terminal, which obeys no character of theirs.
pub fn seen(text: &str) -> String {
    text.split('\n').map(visible).collect::<Vec<_>>().join("\n")
}
