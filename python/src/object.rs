//! Results of the library's `document` room as Python's dicts.

use pyo3::prelude::*;

/// A result as a dict: the one of the commands' `--json`.
pub fn object<'py>(py: Python<'py>, value: &serde_json::Value) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (value.to_string(),))
}
