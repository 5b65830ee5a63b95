//! The estimator that takes all runs at once, and what it has in common with the one that takes two steps.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::function::docs;
use super::printed::{Printed, Row};
use super::{LOCAL, blank, ident};
use crate::emit::model::motion;
use crate::emit::names::Scope;
use crate::identify::DerivedRun;

/// An estimator: its type, and how a user's own type makes one.
pub(super) struct Estimator {
    /// A constant that stands with the model's.
    pub constant: TokenStream,
    pub items: TokenStream,
    pub constructor: TokenStream,
}

pub(super) fn joint(printed: &Printed) -> Estimator {
    let (module, real, size, blank) =
        (&printed.support.module, &printed.support.real, printed.size(), blank(printed.support));
    let (name, estimate, lengths) = (printed.type_name("Joint"), printed.type_name("Estimate"), printed.lengths_type());
    let new = new(printed, &quote!(factor: #module::Factor::new()));
    let pushes = printed.rows.iter().zip(&printed.derivation.runs).filter(|(_, run)| !run.regressors.is_empty());
    let pushes = pushes.map(|(row, run)| {
        let positions = printed.path(&row.positions);
        push(printed, row, run, &quote!(factor), &positions)
    });
    let merge = merge(printed, &[quote!(factor)]);
    let items = quote! {
        /// All runs in one least-squares problem, sample by sample: every base parameter from all the data.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T> {
            lengths: #lengths,
            factor: #module::Factor<T, #size>,
        }
        #blank
        impl<T: #real> #name<T> {
            #new
            #(#blank #pushes)*
            #blank
            /// Takes a row of all base parameters' regressors (mm per unit of each), its reading (mm) and its weight (one over
            /// the reading's variance, up to a common factor).
            ///
            /// # Errors
            /// Why the sample is not taken; nothing has changed then.
            pub fn push(&mut self, row: &[T; #size], reading: T, weight: T) -> Result<(), #module::Rejected> {
                self.factor.push_weighted(&(*row).into(), reading, weight)
            }
            #blank
            #merge
            #blank
            /// The estimate from all samples so far.
            ///
            /// # Errors
            /// What the samples do not determine, as positions in `NAMES`.
            pub fn solve(&self) -> Result<#estimate<T>, #module::SolveError<#size>> {
                Ok(#estimate { lengths: self.lengths, solution: self.factor.solve()? })
            }
            #blank
            /// How well the samples separate the base parameters, columns scaled.
            ///
            /// # Errors
            /// As [`solve`](Self::solve).
            pub fn condition(&self) -> Result<#module::Condition<T, #size>, #module::SolveError<#size>> {
                self.factor.condition()
            }
        }
    };
    Estimator {
        constant: TokenStream::new(),
        items,
        constructor: constructor(printed, "fit", &name, "A fit of all runs at once, without samples yet."),
    }
}

/// `new`, which checks the lengths; `rest` are the other fields.
pub(super) fn new(printed: &Printed, rest: &TokenStream) -> TokenStream {
    let (module, lengths, blank) = (&printed.support.module, printed.lengths_type(), blank(printed.support));
    let checks = printed.lengths.iter().map(|(field, name)| quote!(#module::length(#name, lengths.#field)?;));
    quote! {
        /// No samples yet.
        ///
        /// # Errors
        /// The length that is not a positive number.
        pub fn new(lengths: #lengths) -> Result<Self, #module::ImpossibleLength> {
            #(#checks)*
            Ok(Self { lengths, #rest })
        }
        #blank
        /// The lengths of the set-up, mm.
        pub fn lengths(&self) -> #lengths {
            self.lengths
        }
    }
}

/// `Table::fit(lengths)`, of a user's own type.
pub(super) fn constructor(printed: &Printed, called: &str, estimator: &Ident, doc: &str) -> TokenStream {
    let (module, real, lengths) = (&printed.support.module, &printed.support.real, printed.lengths_type());
    let called = ident(called);
    let doc = docs(&[doc, "", "# Errors", "The length that is not a positive number."]);
    quote! {
        #doc
        pub fn #called<T: #real>(lengths: #lengths) -> Result<#estimator<T>, #module::ImpossibleLength> {
            #estimator::new(lengths)
        }
    }
}

/// `push_along_x(c, reading, …)`: what is known is subtracted, then `factor` takes the row, which has `positions` among its
/// columns, and the reading.
pub(super) fn push(
    printed: &Printed,
    row: &Row,
    run: &DerivedRun,
    factor: &TokenStream,
    positions: &TokenStream,
) -> TokenStream {
    let module = &printed.support.module;
    let called = ident(&format!("push_{}", row.name));
    let function = printed.path(&row.name);
    let lengths = printed.own_lengths();
    let mut scope = Scope::new(LOCAL, &[row.name.to_string()]);
    let [reading, values, factors] = ["reading", "row", "factors"].map(|name| ident(&scope.claim(name)));
    let model = printed.model;
    let sweep = scope.claim(model.alphabet.sweep_name(model.runs[row.run].sweep));
    let motion: Vec<String> =
        motion(model, row.run).into_iter().map(|sense| scope.claim(&model.alphabet.nominal_name(sense))).collect();
    let known: Vec<(String, &str)> = run
        .known
        .iter()
        .map(|(f, _)| model.functions[*f].error)
        .map(|e| (scope.claim(model.alphabet.error_name(e)), model.alphabet.error_quantity(e).inner().suffix()))
        .collect();
    let told: Vec<String> = known.iter().map(|(name, unit)| format!("`{name}` ({unit})")).collect();
    let ways: String = motion.iter().map(|sense| format!(", `{sense}`")).collect();
    let also = if told.is_empty() { String::new() } else { format!(" and the known {} there", told.join(", ")) };
    let doc = docs(&[format!(
        "Takes a sample of run `{}`: the sweep `{sweep}` (rad){ways}, the reading (mm){also}.",
        run.name
    )]);
    let place: Vec<Ident> = [&sweep].into_iter().chain(&motion).map(|name| ident(name)).collect();
    let known: Vec<Ident> = known.iter().map(|(name, _)| ident(name)).collect();
    let body = match known.is_empty() {
        true => quote!(let #values = #function(#lengths #(#place),*);),
        false => quote! {
            let (#values, #factors) = #function(#lengths #(#place),*);
            let #reading = #module::without(#reading, &#factors, &[#(#known),*]);
        },
    };
    let many = (place.len() + known.len() > 5).then(|| quote!(#[allow(clippy::too_many_arguments)]));
    quote! {
        #doc
        ///
        /// # Errors
        /// Why the sample is not taken; nothing has changed then.
        #many
        pub fn #called(&mut self, #(#place: T,)* #reading: T, #(#known: T),*) -> Result<(), #module::Rejected> {
            #body
            self.#factor.push(&#module::scattered(&#positions, &#values), #reading)
        }
    }
}

/// `merge`, of all `factors` or none.
pub(super) fn merge(printed: &Printed, factors: &[TokenStream]) -> TokenStream {
    let module = &printed.support.module;
    quote! {
        /// Adds the samples of another fit of the same set-up.
        ///
        /// # Errors
        /// Why they are not taken; nothing has changed then.
        pub fn merge(&mut self, other: &Self) -> Result<(), #module::MergeError> {
            if self.lengths != other.lengths {
                return Err(#module::MergeError::OtherLengths);
            }
            let mut merged = *self;
            #(merged.#factors.merge(&other.#factors)?;)*
            *self = merged;
            Ok(())
        }
    }
}
