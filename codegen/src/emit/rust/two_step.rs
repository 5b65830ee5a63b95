//! The estimator that takes two steps: the runs without an estimated function first, then the others with what those gave.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::function::docs;
use super::joint::{Estimator, constructor, merge, new, push};
use super::printed::Printed;
use super::{blank, ident};
use crate::identify::DerivedRun;
use crate::ids::BaseId;

/// Which base parameters a factor of each step has for its columns.
struct Steps {
    first: Vec<BaseId>,
    /// Only the second step sees these.
    own: Vec<BaseId>,
    /// The first step gives these to the second.
    given: Vec<BaseId>,
    /// Whether each run belongs to the second step.
    is_second: Vec<bool>,
}

impl Steps {
    /// `None` where a step has nothing to estimate.
    fn new(printed: &Printed) -> Option<Self> {
        let base = &printed.derivation.base;
        let runs = &printed.derivation.runs;
        let estimates = |run: &DerivedRun| run.regressors.iter().any(|(b, _)| base[*b].estimates.is_some());
        let is_second: Vec<bool> = runs.iter().map(estimates).collect();
        let seen = |second: bool| {
            let of = runs.iter().zip(&is_second).filter(|(_, is)| **is == second);
            let mut columns: Vec<BaseId> = of.flat_map(|(run, _)| run.regressors.iter().map(|(b, _)| *b)).collect();
            columns.sort_unstable();
            columns.dedup();
            columns
        };
        let first = seen(false);
        let (given, own): (Vec<BaseId>, Vec<BaseId>) = seen(true).into_iter().partition(|b| first.contains(b));
        (!first.is_empty() && !own.is_empty()).then_some(Self { first, own, given, is_second })
    }

    /// The columns of the second step's factor.
    fn second(&self) -> Vec<BaseId> {
        [self.own.as_slice(), &self.given].concat()
    }
}

fn literals(positions: &[BaseId]) -> TokenStream {
    let numbers = positions.iter().map(|&b| Literal::usize_unsuffixed(b.into()));
    quote!([#(#numbers),*])
}

/// `None` for a model without two steps.
pub(super) fn two_step(printed: &Printed) -> Option<Estimator> {
    let steps = Steps::new(printed)?;
    let (module, real, size, blank) =
        (&printed.support.module, &printed.support.real, printed.size(), blank(printed.support));
    let (name, estimate, lengths) =
        (printed.type_name("TwoStep"), printed.type_name("Estimate"), printed.lengths_type());
    let second = steps.second();
    let [width, second_width] = [&steps.first, &second].map(|columns| Literal::usize_unsuffixed(columns.len()));
    let [first, own, given] = [&steps.first, &steps.own, &steps.given].map(|columns| literals(columns));
    let order = printed.path(&ident("STEPS"));
    let new = new(printed, &quote!(first: #module::Factor::new(), second: #module::Factor::new()));
    let runs = printed.rows.iter().zip(&printed.derivation.runs).zip(&steps.is_second);
    let pushes = runs.filter(|((_, run), _)| !run.regressors.is_empty()).map(|((row, run), &is_second)| {
        let (factor, columns) = if is_second { (quote!(second), &second) } else { (quote!(first), &steps.first) };
        let place = |(b, _): &(BaseId, _)| columns.iter().position(|column| column == b);
        let places = run.regressors.iter().filter_map(place).map(Literal::usize_unsuffixed);
        let places = quote!([#(#places),*]);
        push(printed, row, run, &factor, &places)
    });
    let merge = merge(printed, &[quote!(first), quote!(second)]);
    let told = |is: bool| {
        let of = printed.derivation.runs.iter().zip(&steps.is_second).filter(|(_, second)| **second == is);
        of.map(|(run, _)| format!("`{}`", run.name)).collect::<Vec<_>>().join(", ")
    };
    let doc = format!(
        "In two steps, sample by sample: first {}, then {} with what the first step gave, its covariance carried along.",
        told(false),
        told(true)
    );
    let doc = docs(&[doc]);
    let constant = quote! {
        /// Positions in `NAMES`: what the first step estimates, what the second estimates, what the first gives the second.
        const STEPS: #module::Order<#size, #width, #second_width> = match #module::Order::new(&#first, &#own, &#given) {
            Ok(order) => order,
            Err(_) => panic!("each base parameter belongs to one step"),
        };
    };
    let items = quote! {
        #doc
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct #name<T> {
            lengths: #lengths,
            first: #module::Factor<T, #width>,
            second: #module::Factor<T, #second_width>,
        }
        #blank
        impl<T: #real> #name<T> {
            #new
            #(#blank #pushes)*
            #blank
            #merge
            #blank
            /// The estimate from all samples so far.
            ///
            /// # Errors
            /// The step, and what its samples do not determine, as positions in `NAMES`.
            pub fn solve(&self) -> Result<#estimate<T>, #module::TwoStepError<#size>> {
                Ok(#estimate { lengths: self.lengths, solution: #order.solve(&self.first, &self.second)? })
            }
            #blank
            /// How well the samples of the worse step separate what it estimates, columns scaled.
            ///
            /// # Errors
            /// As [`solve`](Self::solve).
            pub fn condition(&self) -> Result<#module::Condition<T, #size>, #module::TwoStepError<#size>> {
                #order.condition(&self.first, &self.second)
            }
        }
    };
    let constructor = constructor(printed, "two_step", &name, "A fit in two steps, without samples yet.");
    Some(Estimator { constant, items, constructor })
}
