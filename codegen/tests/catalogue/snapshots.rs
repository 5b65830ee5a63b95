//! What models derive to, as people and compilers read it; the files are in the repository's `snapshots/`.

use super::numbers::{derived, read};
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::emit::rust::{self, Support};
use trunnion_codegen::emit::{c, c99, equations, hal, numpy};

fn bind(check: impl FnOnce()) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(check);
}

/// A snapshot whose lines a person can read.
fn snapshot(name: String, text: &str) {
    let long = text.lines().find(|line| line.chars().count() > 120);
    assert_eq!(long, None, "{name}: a line of over 120 characters");
    insta::assert_snapshot!(name, text);
}

/// A component without its solver, which is C99's.
fn around_the_solver(component: &str) -> String {
    let (declared, rest) = component.split_once("\n;;\n").unwrap();
    let (_, own) = rest.split_once("#define FUNCTION").unwrap();
    format!("{declared}\n;;\n[…]\n#define FUNCTION{own}")
}

#[test]
fn equations_of_every_model() {
    bind(|| {
        for (name, _) in MODELS {
            let (model, derivation) = derived(name);
            snapshot(format!("{name}.text"), &equations::text(&model, &derivation));
        }
    });
}

/// The paper's model and a small one: between them they use everything that a printer has.
#[test]
fn every_form_of_two_models() {
    bind(|| {
        for (name, (model, derivation)) in
            [("tilting-table-a", derived("tilting-table-a")), ("everything", read(include_str!("everything.toml")))]
        {
            snapshot(format!("{name}.latex"), &equations::latex(&model, &derivation));
            let rust = rust::model_source(&model, &derivation, &Support::of_solver());
            snapshot(format!("{name}.rust"), &rust.unwrap());
            let c = c99::sources(&model, &derivation, c::Precision::Double).unwrap();
            snapshot(format!("{name}.h"), &c.header);
            snapshot(format!("{name}.c"), &c.source);
            snapshot(format!("{name}.hal"), &around_the_solver(&hal::component(&model, &derivation).unwrap().source));
            snapshot(format!("{name}.numpy"), &numpy::model_source(&model, &derivation).unwrap());
        }
        let (model, derivation) = read(include_str!("everything.toml"));
        snapshot("everything.text".to_owned(), &equations::text(&model, &derivation));
    });
}
