//! For a user's own `build.rs`: a model file becomes a Rust module.
//!
//! ```no_run
//! fn main() -> Result<(), trunnion_codegen::build::Failed> {
//!     trunnion_codegen::build::model("machines/my-table.toml")
//! }
//! ```
//!
//! and in the crate, which needs `trunnion-solver`:
//! `mod my_table { include!(concat!(env!("OUT_DIR"), "/my-table.rs")); }`.

use crate::emit::rust::Support;
use crate::limits::FILE;
use crate::problems::{Colour, read_and_derive, render};
use crate::{catalogue, emit};
use core::fmt;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Why there is no module. Its `Debug` form, which cargo shows, is the message for people.
pub struct Failed(String);

impl fmt::Display for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Failed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Failed {}

/// Writes `$OUT_DIR/NAME.rs` from the model file at `path`, which is relative to the package; NAME is the file's.
///
/// # Errors
/// The file's problems with their lines, or what went wrong with reading or writing.
pub fn model(path: impl AsRef<Path>) -> Result<(), Failed> {
    let path = path.as_ref();
    println!("cargo::rerun-if-changed={}", path.display());
    // One byte beyond the limit is as good as all of them: the file is refused.
    let beyond = u64::try_from(FILE).map_or(u64::MAX, |most| most + 1);
    let mut source = String::new();
    let read = fs::File::open(path).and_then(|file| file.take(beyond).read_to_string(&mut source));
    read.map_err(|e| Failed(format!("{}: {e}", path.display())))?;
    write(&module(&path.display().to_string(), &source)?, path)
}

/// The same from a model of the catalogue.
///
/// # Errors
/// As [`model`]; or there is no such model.
pub fn from_catalogue(name: &str) -> Result<(), Failed> {
    println!("cargo::rerun-if-changed=build.rs");
    let source = catalogue::source(name).ok_or_else(|| Failed(format!("`{name}` is not in the catalogue")))?;
    write(&module(name, source)?, Path::new(name))
}

/// The Rust module of a model file whose text is `source` and which people know as `path`.
///
/// # Errors
/// The file's problems with their lines.
pub fn module(path: &str, source: &str) -> Result<String, Failed> {
    let derived = read_and_derive(source);
    let (model, derivation) = derived.map_err(|problems| Failed(render(path, source, &problems, Colour::Off)))?;
    emit::rust::model_source(&model, &derivation, &Support::of_solver()).map_err(|e| Failed(format!("{path}: {e}")))
}

fn write(module: &str, like: &Path) -> Result<(), Failed> {
    let out =
        env::var_os("OUT_DIR").ok_or_else(|| Failed("OUT_DIR is not set: this is for build scripts".to_owned()))?;
    let name = like.file_stem().ok_or_else(|| Failed(format!("{}: no file name", like.display())))?;
    let mut target = PathBuf::from(out).join(name);
    target.as_mut_os_string().push(".rs");
    fs::write(&target, module).map_err(|e| Failed(format!("{}: {e}", target.display())))
}
