//! The worked example of `docs/model-file.md` is a model: its blocks, put together as the page says.

use trunnion_codegen::problems::{Colour, read_and_derive, render};

#[test]
fn the_worked_example_derives() {
    let page = include_str!("../../docs/model-file.md");
    let example = page.split("\n## ").nth(1).unwrap();
    let blocks = || example.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    // Top-level keys stand before the first table.
    let (top, tables): (Vec<&str>, Vec<&str>) = blocks().partition(|block| !block.starts_with('['));
    let source = top.concat() + &tables.concat();
    let derived = read_and_derive(&source);
    let (model, derivation) = derived.unwrap_or_else(|p| panic!("{}", render("page", &source, &p, Colour::Off)));
    assert_eq!(model.name, "dividing-head");
    let estimated = derivation.base.iter().filter(|b| b.estimates.is_some()).count();
    assert_eq!(estimated, 4, "all of EBB's harmonics are found");
}
