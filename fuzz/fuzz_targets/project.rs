//! Project files: what they say of files, and what they state over their model; mutations know the words of descriptions.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target};
use std::path::Path;
use trunnion::data::Project;
use trunnion::study::Setup;
use trunnion_codegen::catalogue;
use trunnion_codegen::problems::{Colour, Described, Named};
use trunnion_fuzz::{finite, repeated, tokens::mutate};

/// Small, with a known function, an axis with a range and assumptions to be put over its own.
const MODEL: &str = "tilting-table-a";

fuzz_target!(|text: &str| -> Corpus {
    if !repeated(|| Project::is_one(text)) {
        return Corpus::Reject;
    }
    if let Ok(project) = repeated(|| Project::read(text, Path::new("folder"))) {
        finite(&project.runs.iter().map(|run| run.weight).collect::<Vec<_>>());
    }
    let model = catalogue::source(MODEL).expect("a model of the catalogue").to_owned();
    let named = |name: &str, text: String| Named { name: name.to_owned(), text };
    let described = Described { model: named(MODEL, model), stated: Some(named("trunnion.toml", text.to_owned())) };
    repeated(|| match described.derive() {
        Ok((model, _)) => {
            let setup = Setup::new(model, &[]).map_err(|why| why.to_string());
            setup.map(|setup| setup.model.runs.keys().map(|run| setup.sweep_range(run, (0.0, 6.3))).collect::<Vec<_>>())
        }
        Err(problems) => {
            assert!(!problems.is_empty(), "refused without a word");
            let places: Vec<_> = problems.iter().map(|problem| described.place(problem)).collect();
            Err(format!("{places:?}\n{}", described.render(&problems, Colour::Off)))
        }
    })
    .iter()
    .for_each(finite);
    Corpus::Keep
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| { mutate(data, size, max_size, seed) });
