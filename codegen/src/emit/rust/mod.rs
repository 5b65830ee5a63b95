//! Rust, generic over the scalar, for `core` and `trunnion-solver`: no allocation, no index, no panic.

mod block;
mod estimate;
mod expression;
mod function;
mod joint;
mod model;
mod printed;
mod source;
mod two_step;

pub use model::model_items;
pub use printed::Owner;
pub use source::{model_source, source};

use super::names::{RUST, Rules};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// Where generated code finds what it speaks to, `trunnion_solver::generated`, and how it is laid out.
#[derive(Clone, Debug)]
pub struct Support {
    /// What a file uses at its head, if it is a file.
    path: Option<TokenStream>,
    /// How code names that module.
    module: TokenStream,
    /// How code names its trait `Real`.
    real: TokenStream,
    /// How code names its trait `Number`.
    number: TokenStream,
}

impl Support {
    /// For the tokens of a macro: `module` is named in full wherever it is meant.
    #[must_use]
    pub fn in_macro(module: &TokenStream) -> Self {
        Self { path: None, module: module.clone(), real: quote!(#module::Real), number: quote!(#module::Number) }
    }

    /// For a file, which uses `module` at its head and has blank lines.
    #[must_use]
    pub fn in_file(module: &TokenStream) -> Self {
        let name = module.clone().into_iter().last();
        Self { path: Some(module.clone()), module: quote!(#name), real: quote!(Real), number: quote!(Number) }
    }

    /// For a file of a crate that depends on `trunnion-solver`.
    #[must_use]
    pub fn of_solver() -> Self {
        Self::in_file(&quote!(trunnion_solver::generated))
    }
}

/// A blank line, where there are lines.
fn blank(support: &Support) -> TokenStream {
    if support.path.is_some() { quote!(blank_line!();) } else { TokenStream::new() }
}

fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

/// Names of functions, inputs and variables.
const LOCAL: Rules = Rules { lower_case: true, places: false, words: &RUST };

/// Names of constants.
const CONSTANT: Rules = Rules { lower_case: false, places: false, words: &RUST };
