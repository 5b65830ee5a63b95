//! Derives the catalogue's paper model and writes its regressors as Rust.

use quote::quote;
use std::{env, error::Error, fs, path::Path};
use trunnion_codegen::problems::{Colour, read_and_derive, render};
use trunnion_codegen::{catalogue, emit};

#[path = "build/exechon.rs"]
mod exechon;

fn main() -> Result<(), Box<dyn Error>> {
    let name = "tilting-table-a";
    let source = catalogue::source(name).ok_or("not in the catalogue")?;
    let (model, derivation) = read_and_derive(source).map_err(|p| render(name, source, &p, Colour::Off))?;
    // `trig` stands in for `num_traits`: a sine of `f32` that takes no `f64`.
    let items = emit::model::rust_items(&model, &derivation, &quote!(crate::trig))?;
    let source = emit::header("//", &model.name) + &emit::rust::pretty(items);
    let out = env::var_os("OUT_DIR").ok_or("no OUT_DIR")?;
    fs::write(Path::new(&out).join("tilting_table_a.rs"), source)?;
    exechon::write(Path::new(&out))?;
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
