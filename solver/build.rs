//! Derives the catalogue's paper model and writes its regressors as Rust.

use std::{env, error::Error, fs, path::Path};
use trunnion_codegen::{catalogue, emit, identify};

#[path = "build/exechon.rs"]
mod exechon;

fn main() -> Result<(), Box<dyn Error>> {
    let name = "tilting-table-a";
    let model = catalogue::model(name).ok_or("not in the catalogue")?.map_err(|p| format!("{name}: {p:?}"))?;
    let derivation = identify::derive(&model).map_err(|e| format!("{name}: {e:?}"))?;
    let source = emit::model::rust_source(&model, &derivation)?;
    let out = env::var_os("OUT_DIR").ok_or("no OUT_DIR")?;
    fs::write(Path::new(&out).join("tilting_table_a.rs"), source)?;
    exechon::write(Path::new(&out))?;
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
