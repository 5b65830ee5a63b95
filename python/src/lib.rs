//! The extension module of the Python package: arguments in, the library called, arrays and dicts out. It does no mathematics.

mod arguments;
mod compared;
mod errors;
mod exechon;
mod factor;
mod files;
mod fit;
mod model;
mod object;
mod positions;
mod project;
mod setup;
mod simulated;
mod table;

use pyo3::prelude::*;

/// What `trunnion` is made of.
#[pymodule]
mod _trunnion {
    #[pymodule_export]
    use super::exechon::Exechon;
    #[pymodule_export]
    use super::factor::Factor;
    #[pymodule_export]
    use super::fit::Fit;
    #[pymodule_export]
    use super::model::{Derivation, Model, models};
    #[pymodule_export]
    use super::project::Project;
    #[pymodule_export]
    use super::setup::Setup;
    #[pymodule_export]
    use super::simulated::Simulated;
}
