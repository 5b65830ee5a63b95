//! The catalogue: the model files of `machines/`, built in.

use crate::model::{Model, Problem, read};

/// Name and source of every model, in alphabetical order.
pub const MODELS: &[(&str, &str)] = &[
    ("ab-head", include_str!("../machines/ab-head.toml")),
    ("ac-head", include_str!("../machines/ac-head.toml")),
    ("ac-trunnion", include_str!("../machines/ac-trunnion.toml")),
    ("ac-trunnion-cone", include_str!("../machines/ac-trunnion-cone.toml")),
    ("ac-trunnion-probe", include_str!("../machines/ac-trunnion-probe.toml")),
    ("b-head-c-table", include_str!("../machines/b-head-c-table.toml")),
    ("b-head-c-table-probe", include_str!("../machines/b-head-c-table-probe.toml")),
    ("bc-trunnion", include_str!("../machines/bc-trunnion.toml")),
    ("bc-trunnion-probe", include_str!("../machines/bc-trunnion-probe.toml")),
    ("mill-turn", include_str!("../machines/mill-turn.toml")),
    ("nutating-head-b", include_str!("../machines/nutating-head-b.toml")),
    ("nutating-table", include_str!("../machines/nutating-table.toml")),
    ("rotary-table-c", include_str!("../machines/rotary-table-c.toml")),
    ("rotary-table-c-rtest", include_str!("../machines/rotary-table-c-rtest.toml")),
    ("tilting-table-a", include_str!("../machines/tilting-table-a.toml")),
    ("tilting-table-a-dyz", include_str!("../machines/tilting-table-a-dyz.toml")),
    ("tilting-table-b", include_str!("../machines/tilting-table-b.toml")),
];

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
