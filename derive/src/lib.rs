//! Macros that turn a user's own machine into a generated, `no_std` measurement model.
//!
//! ```
//! use trunnion_solver::Machine;
//!
//! /// A rotary table under two slides: the tool stays R ahead of a ball at the distance L from the axis.
//! #[derive(Machine)]
//! #[machine(constants(R, L), estimate(ECC))]
//! #[run(
//!     tangential,
//!     sweep = "c",
//!     at(C = "c", X = "L*cos(c) - R*sin(c)", Y = "L*sin(c) + R*cos(c)"),
//!     workpiece_ball(at("L", "0", "0"), setup(w_x, w_y, w_z)),
//!     tool_ball(setup(t_x, t_y, t_z)),
//!     bar = "R"
//! )]
//! #[function(EXC = known, EYC = known, ECC = fourier(2))]
//! #[function(EXX = polynomial(2), EYX = polynomial(1), ECX = zero, EXY = zero, EYY = polynomial(2))]
//! pub struct Table {
//!     #[workpiece(rotary = "z", location(EX0C, EY0C, EC0C))]
//!     pub c: f64,
//!     #[tool(linear = "x")]
//!     pub x: f64,
//!     #[tool(linear = "y", location("EC(0X)Y"))]
//!     pub y: f64,
//! }
//!
//! assert_eq!(Table::NAMES[..4], ["ECC_cos1", "ECC_sin1", "ECC_cos2", "ECC_sin2"]);
//! ```
//!
//! The crate that uses [`Machine`] needs `trunnion-solver` and nothing else; enable its feature `derive`.
//!
//! | attribute | on | says |
//! |---|---|---|
//! | `#[machine(…)]` | the struct | `constants`, `estimate`, `order`, `title`, `notation`, `names` of the model |
//! | `#[run(NAME, …)]` | the struct, one a run | `sweep`, `at`, `workpiece_ball`, `tool_ball`, and `bar` or `displacement`; `define`, `nuisance` |
//! | `#[function(ERROR = …)]` | the struct | what is assumed of motion errors: `polynomial`, `fourier`, `known`, `zero` |
//! | `#[assume(EXC_cos1 = "0")]` | the struct | what is taken as exact between parameters, or functions at a point |
//! | `#[workpiece(…)]`, `#[tool(…)]` | a field | an axis on that side: `rotary` or `linear`, `location`, `name` |
//!
//! Each means what the key of the same name means in a
//! [model file](https://github.com/trunnion-metrology/trunnion/blob/main/docs/model-file.md). What cannot be derived is a compiler error
//! at the text that is to blame, in the words a model file's mistake has. What a model file says of limits, the instrument and
//! the axes' ranges is for studies and reports; a generated model has no use for it.

mod machine;
mod parse;
mod places;

use proc_macro2::TokenStream;
use quote::quote;
use syn::{DeriveInput, parse_macro_input};
use trunnion_codegen::emit::rust::{Owner, Support, model_items};
use trunnion_codegen::problems;

/// Derives the measurement model of a machine whose axes are the struct's fields.
///
/// Fields stand from the machine's base outwards, on the workpiece's side or the tool's; an axis is called after its
/// field, in capitals. What the attributes say is what a model file says (`docs/model-file.md`), expressions as texts.
///
/// ```
/// use trunnion_solver::Machine;
///
/// /// A rotary table and the bar that is held against it.
/// #[derive(Machine)]
/// #[machine(constants(R), estimate(EXC))]
/// #[run(
///     along_x,
///     sweep = "c",
///     at(C = "c"),
///     workpiece_ball(setup(w_x, w_y, w_z)),
///     tool_ball(at("R", "0", "0"), setup(t_x, t_y, t_z)),
///     bar = "R"
/// )]
/// #[function(EXC = polynomial(4, "f(0) = 0", "f(2*pi) = f(0)"))]
/// pub struct Table {
///     /// Angle of the table, rad.
///     #[workpiece(rotary = "z", location(EX0C, EY0C))]
///     pub c: f64,
/// }
///
/// let mut fit = Table::fit(TableLengths { r: 150.0 })?;
/// for i in 0..60 {
///     let c = f64::from(i) * 0.1;
///     fit.push_along_x(c, 0.001 * c.sin())?;
/// }
/// let (exc, std) = fit.solve()?.exc(0.5)?;
/// assert!(exc.abs() < 1e-3 && std < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Beside the type `Table` there are
///
/// - `TableLengths`, the lengths of the set-up by name;
/// - `TableJoint`, made by `Table::fit`: the estimator of all runs at once, with a `push_…` for every run (known functions are
///   subtracted inside), `merge`, `solve` and `condition`;
/// - `TableTwoStep`, made by `Table::two_step`, where the model has runs without an estimated function and runs with one: those
///   first, then the others with what they gave;
/// - `TableEstimate`, which both give: the base parameters with their covariance, and every estimated function at a
///   coordinate with its standard deviation (`estimate.exc(c)`).
///
/// The type itself has
///
/// - `NAMES`: the base parameters, the estimated functions' coefficients first;
/// - for every run a constant (`ALONG_X`), the positions in `NAMES` of what it sees, and a function
///   (`Table::along_x(r, c)`) that gives their regressors at one value of the sweep, mm, and, where the model has known
///   functions, those functions' factors;
/// - for every estimated function its basis (`Table::exc(r, c)`).
///
/// All of it is generic over the float and needs neither `std` nor a heap.
#[proc_macro_derive(Machine, attributes(machine, run, function, assume, workpiece, tool))]
pub fn machine(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    expand(&input).unwrap_or_else(syn::Error::into_compile_error).into()
}

fn expand(input: &DeriveInput) -> syn::Result<TokenStream> {
    let (draft, places) = machine::Reader::read(input)?;
    let told = |problems: Vec<trunnion_codegen::model::Problem>| {
        let errors = problems.iter().map(|p| places.error(p));
        let all = errors.reduce(|mut all, e| {
            all.combine(e);
            all
        });
        all.unwrap_or_else(|| syn::Error::new(input.ident.span(), "this machine is refused"))
    };
    let model = draft.build().map_err(told)?;
    let derivation = problems::derivation(&model).map_err(told)?;
    let (owner, support) = (Owner::Type(input.ident.clone()), Support::in_macro(&quote!(::trunnion_solver::generated)));
    model_items(&model, &derivation, &owner, &support).map_err(|e| syn::Error::new(input.ident.span(), e))
}

#[cfg(test)]
mod same;
