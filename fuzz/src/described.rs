//! From a model file's text to everything that is printed of it.

use crate::repeated;
use trunnion_codegen::emit::{c::Precision, c99, equations, numpy, rust};
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::{Model, ProblemKind};
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Reads, derives and prints in all forms, or tells the problems. Whether it was at least a description to look at, not only
/// broken TOML.
pub fn described(text: &str) -> bool {
    let (is_toml, _) = repeated(|| match read_and_derive(text) {
        Ok((model, derivation)) => (true, printed(&model, &derivation)),
        Err(problems) => {
            assert!(!problems.is_empty(), "refused without a word");
            let is_toml = !matches!(problems[0].kind, ProblemKind::Toml(_));
            (is_toml, vec![render("model.toml", text, &problems, Colour::Off)])
        }
    });
    is_toml
}

fn printed(model: &Model, derivation: &Derivation) -> Vec<String> {
    let defect = "what was derived can be printed";
    let mut all = vec![
        equations::text(model, derivation),
        equations::latex(model, derivation),
        equations::json(model, derivation).to_string(),
        rust::model_source(model, derivation, &rust::Support::of_solver()).expect(defect),
        numpy::model_source(model, derivation).expect(defect),
    ];
    for precision in [Precision::Float, Precision::Double] {
        all.push(c99::sources(model, derivation, precision).expect(defect).single());
    }
    all
}
