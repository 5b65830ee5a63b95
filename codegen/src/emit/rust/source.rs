//! A file of generated Rust, laid out as a person would.

use proc_macro2::TokenStream;
use quote::quote;

use super::function::item;
use super::{LOCAL, Owner, Support, blank, model_items};
use crate::emit::function::Function;
use crate::emit::header::header;
use crate::emit::names::Scope;
use crate::graph::Unbound;
use crate::identify::Derivation;
use crate::model::Model;

/// Functions that come from no model as a file, under its header; `made_from` says what it was made from.
#[must_use]
pub fn source(functions: &[Function], made_from: &str, support: &Support) -> String {
    let (path, blank) = (&support.path, blank(support));
    let mut scope = Scope::new::<&str>(LOCAL, &[]);
    let items = functions.iter().map(|f| {
        let item = item(f, &scope.claim(&f.name), support);
        quote!(#blank #item)
    });
    let items: TokenStream = items.collect();
    header("//", made_from) + &laid_out(quote!(#blank use #path::Number; #items))
}

/// A model as a Rust module: names, what each run sees, the functions, the estimators.
///
/// # Errors
/// An expression depends on a symbol that is neither a length, the run's sweep nor the function's coordinate.
pub fn model_source(model: &Model, derivation: &Derivation, support: &Support) -> Result<String, Unbound> {
    let items = model_items(model, derivation, &Owner::Module, support)?;
    let (path, blank) = (&support.path, blank(support));
    Ok(header("//", &model.name) + &laid_out(quote!(#blank use #path::{self, Number, Real}; #items)))
}

/// Formats items and puts the blank lines in; tokens that are no items are left as they are.
fn laid_out(items: TokenStream) -> String {
    let formatted = match syn::parse2(items.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        Err(_) => items.to_string(),
    };
    let lines = formatted.lines().map(|line| if line.trim() == "blank_line!();" { "" } else { line });
    lines.fold(String::new(), |text, line| text + line + "\n")
}
