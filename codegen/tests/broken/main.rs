//! Model files with one mistake each (and one with several): what a person is told.

use std::path::Path;
use trunnion_codegen::problems::{Colour, read_and_derive, render};

#[test]
fn every_mistake_is_pointed_at_and_explained() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    assert!(files.len() >= 30);
    let mut settings = insta::Settings::clone_current();
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for path in files {
            let source = std::fs::read_to_string(&path).unwrap();
            let name = path.file_stem().unwrap().to_string_lossy();
            let Err(problems) = read_and_derive(&source) else { panic!("{name} is accepted") };
            assert!(!problems.is_empty(), "{name}");
            insta::assert_snapshot!(name.to_string(), render(&format!("{name}.toml"), &source, &problems, Colour::Off));
        }
    });
}

#[test]
fn rendering_survives_any_place() {
    use trunnion_codegen::model::{Problem, ProblemKind};
    let source = "name = \"δ\"\n";
    for start in 0..source.len() + 3 {
        for end in 0..source.len() + 3 {
            let problem = Problem { span: start..end, kind: ProblemKind::NoRuns };
            assert!(render("m.toml", source, core::slice::from_ref(&problem), Colour::Off).contains("no run"));
            assert!(render("m.toml", "", &[problem], Colour::On).contains("no run"));
        }
    }
}
