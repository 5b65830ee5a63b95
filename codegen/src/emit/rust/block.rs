//! A run's rows many at a time.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::function::docs;
use super::printed::{Printed, Row};
use super::{LOCAL, ident};
use crate::emit::names::{Names, Scope};

/// `pub fn rows_of_along_x<T: Real>(r: T, c: &Column<T>, columns: &mut [Column<T>; 8])`
pub(super) fn rows(printed: &Printed, row: &Row) -> TokenStream {
    let (module, real) = (&printed.support.module, &printed.support.real);
    let taken = ["columns".to_owned(), row.name.to_string()];
    let names = Names::new(&row.function, &row.block.to_string(), &Scope::new(LOCAL, &taken));
    let inputs: Vec<Ident> = names.inputs.iter().map(|name| ident(name)).collect();
    let (lengths, places) = inputs.split_at(printed.lengths.len().min(inputs.len()));
    let run = &printed.derivation.runs[row.run];
    let (name, function) = (&row.block, printed.path(&row.name));
    let count = Literal::usize_unsuffixed(run.regressors.len() + run.known.len());
    let known = if run.known.is_empty() { "" } else { ", the known functions' factors last" };
    let doc = docs(&[
        format!("The rows of a block of samples: a column for each result of `{}`{known}.", row.name),
        String::new(),
        "Compiled for vector instructions where it is called from code that is.".to_owned(),
    ]);
    let of = |lengths: TokenStream| {
        let row = quote!(#function(#lengths #(#places),*));
        if run.known.is_empty() { row } else { quote!(#module::joined(#row)) }
    };
    let (near, exact) = (of(quote!(#(#module::Near(#lengths),)*)), of(quote!(#(#lengths,)*)));
    let many = (inputs.len() > 6).then(|| quote!(#[allow(clippy::too_many_arguments)]));
    quote! {
        #doc
        #many
        #[inline(always)]
        pub fn #name<T: #real>(
            #(#lengths: T,)*
            #(#places: &#module::Column<T>,)*
            columns: &mut [#module::Column<T>; #count],
        ) {
            #module::rows([#(#places),*], columns, |[#(#places),*]| #near, |[#(#places),*]| #exact);
        }
    }
}
