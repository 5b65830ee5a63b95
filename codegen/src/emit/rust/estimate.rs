//! What an estimator gives: the base parameters, and the estimated functions at a coordinate.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::function::docs;
use super::printed::{Estimated, Printed};
use super::{LOCAL, blank, ident};
use crate::emit::names::Scope;

pub(super) fn estimate(printed: &Printed) -> TokenStream {
    let (module, real, size, blank) =
        (&printed.support.module, &printed.support.real, printed.size(), blank(printed.support));
    let (name, lengths) = (printed.type_name("Estimate"), printed.lengths_type());
    let mut methods = Scope::new(LOCAL, &["lengths"]);
    let values = printed.functions.iter().map(|f| value(printed, f, &mut methods));
    quote! {
        /// What the samples give.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T> {
            lengths: #lengths,
            /// The base parameters in the order of `NAMES` with their covariance; lengths in mm, angles in rad.
            pub solution: #module::Solution<T, #size>,
        }
        #blank
        impl<T: #real> #name<T> {
            /// The lengths of the set-up, mm.
            pub fn lengths(&self) -> #lengths {
                self.lengths
            }
            #(#blank #values)*
        }
    }
}

/// A function's value and standard deviation, or those of the sum it is seen in.
fn value(printed: &Printed, estimated: &Estimated, methods: &mut Scope) -> TokenStream {
    let module = &printed.support.module;
    let (function, model) = (&estimated.function, printed.model);
    let places = function.base.iter().map(|b| Literal::usize_unsuffixed((*b).into()));
    let error = model.functions[function.function].error;
    let (name, unit) = (model.alphabet.error_name(error), model.alphabet.error_quantity(error).inner().suffix());
    let called = ident(&methods.claim(&function.basis.name));
    let basis = printed.path(&estimated.name);
    let lengths = printed.own_lengths();
    let input = function.coordinate();
    let x = input.map(|input| Scope::new(LOCAL, &[estimated.name.to_string()]).claim(&input.name));
    let (what, at, where_none) = match (input, &x) {
        (Some(input), Some(x)) => {
            ("function", format!(", at `{x}`, the {}", input.meaning), ", as at a coordinate that is none")
        }
        _ => ("location error", String::new(), ""),
    };
    let doc = docs(&[
        format!("The {what} `{name}` and its standard deviation, {unit}{at}."),
        String::new(),
        "# Errors".to_owned(),
        format!("The result is not a finite number{where_none}."),
    ]);
    let x = x.map(|x| ident(&x));
    let parameter = x.iter().map(|x| quote!(, #x: T));
    let call = if function.basis.inputs.is_empty() { quote!(#basis::<T>()) } else { quote!(#basis(#lengths #x)) };
    quote! {
        #doc
        pub fn #called(&self #(#parameter)*) -> Result<(T, T), #module::NotFinite> {
            #module::value(&self.solution, &[#(#places),*], &#call)
        }
    }
}
