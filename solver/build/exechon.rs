//! The parallel machine's closure equations and their exact derivatives, as Rust.

use proc_macro2::TokenStream;
use std::{error::Error, fs, path::Path};
use trunnion_codegen::{emit, exechon};

/// Writes `exechon.rs` into `out`.
pub fn write(out: &Path) -> Result<(), Box<dyn Error>> {
    // Printed against the room's own `float`, whose traits every scalar of the solver has.
    let traits = quote::quote!(super::float);
    let items: TokenStream = exechon::functions()?.iter().map(|f| emit::rust::item(f, &traits)).collect();
    let source = emit::header("//", "exechon") + &emit::rust::pretty(items);
    fs::write(out.join("exechon.rs"), source)?;
    println!("cargo::rerun-if-changed=build/exechon.rs");
    Ok(())
}
