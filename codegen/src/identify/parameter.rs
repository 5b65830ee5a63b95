//! Physical parameters.

use crate::algebra::Poly;
use crate::ids::RunId;
use crate::model::{Coefficient, Model, Origin};
use typed_index_collections::TiVec;

/// A physical parameter: what a person could measure or align, if it could be told apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// `o_ya`, `d_yy1`, `w_z1`.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
}

impl Parameter {
    pub(super) fn new(model: &Model, origin: Origin) -> Self {
        Self { name: name(model, origin), origin }
    }
}

/// What a parameter is called: `o_ya`, `EYY1`, `EAA_cos1`.
pub fn name(model: &Model, origin: Origin) -> String {
    match origin {
        Origin::Constant(error) => model.alphabet.error_name(error).to_owned(),
        Origin::Coefficient(Coefficient { function, term }) => {
            let function = &model.functions[function];
            let suffix = function.basis.functions().get(term).map_or_else(String::new, |f| f.suffix(term));
            format!("{}{suffix}", model.alphabet.error_name(function.error))
        }
    }
}

/// A parameter's coefficient in the reading of every run, products left as they stand.
pub(super) struct Column {
    pub origin: Origin,
    pub by_run: TiVec<RunId, Poly>,
}

/// A parameter that assumptions make up of others, and that was put in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assumed {
    /// Which it is.
    pub origin: Origin,
    /// What it is taken as: nothing for 0.
    pub is: Vec<(Origin, Poly)>,
    /// Its own coefficient in every run's reading: what a deviation from that does.
    pub by_run: TiVec<RunId, Poly>,
    /// The assumptions behind it, as they were written.
    pub texts: Vec<String>,
}
