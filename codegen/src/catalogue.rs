//! The catalogue: the model files of `machines/`, built in.

use crate::model::{Model, Problem, read};

/// Name and source of every model, in alphabetical order.
pub const MODELS: &[(&str, &str)] = &[("tilting-table-a", include_str!("../../machines/tilting-table-a.toml"))];

/// The source of a model, if the catalogue has it.
pub fn source(name: &str) -> Option<&'static str> {
    MODELS.iter().find(|(n, _)| *n == name).map(|(_, source)| *source)
}

/// A model of the catalogue; `None` if it is not there.
pub fn model(name: &str) -> Option<Result<Model, Vec<Problem>>> {
    source(name).map(read)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_reads_and_carries_its_file_name() {
        for (name, source) in MODELS {
            let model = read(source).unwrap_or_else(|problems| panic!("{name}: {problems:?}"));
            assert_eq!(model.name, *name);
        }
    }
}
