//! Arguments of the form `NAME=…`.

/// `NAME=…` as its two parts.
pub fn pair(given: &str) -> Option<(&str, &str)> {
    given.split_once('=')
}
