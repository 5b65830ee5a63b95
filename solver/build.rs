//! Writes as Rust what this crate takes from the generator: the paper's tilting table, the parallel machine's equations, and a sine
//! that both work with.

use quote::quote;
use std::{env, error::Error, fs, path::Path};
use trunnion_codegen::emit::rust::{Support, model_source, source};
use trunnion_codegen::problems::{Colour, read_and_derive, render};
use trunnion_codegen::{SINE, catalogue, exechon};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    let out = env::var_os("OUT_DIR").ok_or("no OUT_DIR")?;
    let out = Path::new(&out);
    let support = Support::in_file(&quote!(crate::generated));

    fs::write(out.join("sine.rs"), SINE)?;
    let name = "tilting-table-a";
    let file = catalogue::source(name).ok_or("not in the catalogue")?;
    let (model, derivation) = read_and_derive(file).map_err(|p| render(name, file, &p, Colour::Off))?;
    fs::write(out.join("tilting_table_a.rs"), model_source(&model, &derivation, &support)?)?;
    if env::var_os("CARGO_FEATURE_EXECHON").is_some() {
        fs::write(out.join("exechon.rs"), source(&exechon::functions()?, "exechon", &support))?;
    }
    Ok(())
}
