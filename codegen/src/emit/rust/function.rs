//! One function in Rust, generic over the scalar.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::expression::Expressions;
use super::{LOCAL, Support, blank, ident};
use crate::emit::function::{Form, Function};
use crate::emit::layout::{WIDTH, wrapped};
use crate::emit::names::{Names, Scope};

/// `pub fn name<T: Number>(r: T, a: T) -> [T; 10]` under the name it has in the scope around it. Several results are
/// returned as a tuple.
pub(super) fn item(function: &Function, called: &str, support: &Support) -> TokenStream {
    let names = Names::new(function, called, &Scope::new::<&str>(LOCAL, &[]));
    let expressions = Expressions::new(&function.program, &names);
    let (name, number) = (ident(&names.function), &support.number);
    let docs = docs(&function.documentation(&names.inputs));
    let kinds = function.filled().map(|(_, form)| kind(*form));
    let elements: Vec<Ident> = names.outputs.iter().map(|name| ident(name)).collect();
    let mut rest = elements.as_slice();
    let results = function.filled().map(|&(_, form)| {
        let (own, others) = rest.split_at(form.len());
        rest = others;
        match form {
            Form::Array(_) => quote!([#(#own),*]),
            Form::Matrix(_, columns) => {
                let rows = own.chunks(columns.max(1)).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
        }
    });
    let (kind, result) = (tuple(kinds.collect()), tuple(results.collect()));
    let used = function.used();
    // Functions of one model take the same inputs, whether they use them or not.
    let parameter = |(name, used): (&Ident, bool)| if used { name.clone() } else { format_ident!("_{name}") };
    let parameters = expressions.inputs.iter().zip(used).map(parameter);
    let many = (function.inputs.len() > 7).then(|| quote!(#[allow(clippy::too_many_arguments)]));
    let lines = elements.iter().zip(function.program.outputs()).map(|(name, &value)| {
        let value = expressions.value(value);
        quote!(let #name = #value;)
    });
    // Inline: compiled wherever it is called from, since a loop over a block's rows has no vector instructions with a call in it.
    let groups = [expressions.constants(), expressions.temporaries(), lines.collect()];
    let groups = groups.into_iter().filter(|group| !group.is_empty()).flat_map(|group| [group, blank(support)]);
    quote! {
        #docs
        #[must_use]
        #[inline]
        #many
        pub fn #name<T: #number>(#(#parameters: T),*) -> #kind {
            #(#groups)*
            #result
        }
    }
}

/// Lines of documentation.
pub(super) fn docs<S: AsRef<str>>(lines: &[S]) -> TokenStream {
    let lines = lines.iter().flat_map(|line| wrapped(line.as_ref(), WIDTH));
    let lines = lines.map(|line| if line.is_empty() { line } else { format!(" {line}") });
    quote!(#(#[doc = #lines])*)
}

fn kind(form: Form) -> TokenStream {
    match form {
        Form::Array(n) => {
            let n = Literal::usize_unsuffixed(n);
            quote!([T; #n])
        }
        Form::Matrix(rows, columns) => {
            let (rows, columns) = (Literal::usize_unsuffixed(rows), Literal::usize_unsuffixed(columns));
            quote!([[T; #columns]; #rows])
        }
    }
}

fn tuple(parts: Vec<TokenStream>) -> TokenStream {
    match parts.as_slice() {
        [only] => only.clone(),
        _ => quote!((#(#parts),*)),
    }
}
