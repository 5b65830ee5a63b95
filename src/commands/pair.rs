//! Arguments of the form `NAME=…`.

/// The two parts.
pub fn pair(given: &str) -> Option<(&str, &str)> {
    given.split_once('=')
}
