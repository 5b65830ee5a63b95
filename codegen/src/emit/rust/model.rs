//! A model in Rust: names, what each run sees, rows, and the types that hold its fit.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::estimate::estimate;
use super::function::{docs, item};
use super::joint::{Estimator, joint};
use super::printed::{Owner, Printed};
use super::two_step::two_step;
use super::{Support, blank, block};
use crate::graph::Unbound;
use crate::identify::Derivation;
use crate::model::Model;

/// Names, positions, rows, bases and estimators of a model.
///
/// # Errors
/// As [`run`](crate::emit::model::run) and [`estimated`](crate::emit::model::estimated).
pub fn model_items(
    model: &Model,
    derivation: &Derivation,
    owner: &Owner,
    support: &Support,
) -> Result<TokenStream, Unbound> {
    let printed = Printed::new(model, derivation, owner, support)?;
    let blank = blank(support);
    let estimators: Vec<Estimator> = [Some(joint(&printed)), two_step(&printed)].into_iter().flatten().collect();
    let constants = estimators.iter().map(|e| &e.constant).filter(|constant| !constant.is_empty());
    let constructors = estimators.iter().map(|e| &e.constructor).filter(|_| matches!(owner, Owner::Type(_)));
    let names = derivation.base.iter().map(|b| b.name.as_str());
    let count = printed.size();
    let positions = printed.rows.iter().zip(&derivation.runs).map(|(row, run)| {
        let constant = &row.positions;
        let doc = format!(" Positions in `NAMES` of the base parameters that run `{}` sees.", run.name);
        let seen = run.regressors.iter().map(|(b, _)| Literal::usize_unsuffixed((*b).into()));
        let n = Literal::usize_unsuffixed(run.regressors.len());
        quote!(#blank #[doc = #doc] pub const #constant: [usize; #n] = [#(#seen),*];)
    });
    let rows = printed.rows.iter().map(|row| (&row.function, &row.name));
    let bases = printed.functions.iter().map(|f| (&f.function.basis, &f.name));
    let functions = rows.chain(bases).map(|(f, name)| {
        let item = item(f, &name.to_string(), support);
        quote!(#blank #item)
    });
    let seeing = printed.rows.iter().filter(|row| !derivation.runs[row.run].regressors.is_empty());
    let blocks = seeing.map(|row| block::rows(&printed, row));
    let own = quote! {
        /// Names of the base parameters, the estimated functions' coefficients first.
        pub const NAMES: [&str; #count] = [#(#names),*];
        #(#positions)*
        #(#blank #constants)*
        #(#functions)*
        #(#blank #blocks)*
        #(#constructors)*
    };
    let own = match owner {
        Owner::Module => quote!(#blank #own),
        Owner::Type(name) => quote!(impl #name { #own }),
    };
    let estimators = estimators.into_iter().map(|e| e.items);
    let types = [lengths(&printed)].into_iter().chain(estimators).chain([estimate(&printed)]);
    Ok(quote!(#own #(#blank #types)*))
}

/// The lengths of the set-up.
fn lengths(printed: &Printed) -> TokenStream {
    let name = printed.type_name("Lengths");
    let inputs = printed.rows.first().map_or(&[][..], |row| &row.function.inputs);
    let fields = printed.lengths.iter().zip(inputs).map(|((field, _), input)| {
        let doc = docs(&[capitalised(&input.meaning) + "."]);
        quote!(#doc pub #field: T,)
    });
    let body = if printed.lengths.is_empty() { quote!(;) } else { quote!(<T> { #(#fields)* }) };
    quote! {
        /// The lengths of the set-up.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name #body
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
