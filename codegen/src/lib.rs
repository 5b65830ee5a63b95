//! Exact derivation of machine-tool measurement models, and printers for them.
//!
//! ```
//! use trunnion_codegen::{emit, problems};
//!
//! let file = r#"
//!     name = "rotary-table"
//!     constants = ["R"]               # the bar
//!     workpiece = ["C"]
//!     estimate = ["EXC"]
//!
//!     [axis.C]
//!     rotary = "z"
//!     location = ["EX0C", "EY0C"]
//!
//!     [run.along-x]
//!     sweep = "c"
//!     at = { C = "c" }
//!     workpiece_ball = { setup = ["w_x", "w_y", "w_z"] }
//!     tool_ball = { at = ["R", "0", "0"], setup = ["t_x", "t_y", "t_z"] }
//!     reading = "R"
//!
//!     [function]
//!     EXC = { fourier = 2 }
//! "#;
//! let told = |wrong: Vec<_>| problems::render("rotary-table.toml", file, &wrong, problems::Colour::Off);
//! let (model, derivation) = problems::read_and_derive(file).map_err(told)?;
//!
//! let equations = emit::equations::text(&model, &derivation);
//! assert!(equations.contains("ΔR = s_c·w_y − c_c·w_x + (−EX0C − EXC + t_x)"));
//! // The table's eccentricity and the ball's place on it are one.
//! assert!(equations.contains("EXC_cos1 and w_x only appear"));
//!
//! let source = emit::rust::model_source(&model, &derivation, &emit::rust::Support::of_solver())?;
//! assert!(source.contains("pub fn push_along_x("));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A description comes from a model file ([`model::read`]), from the builder ([`model::Draft`]), from the macro of
//! `trunnion-solver`, or from the [`catalogue`]; in a `build.rs`, [`build::model`] does all of it. How to write one is told in
//! [docs/model-file.md](https://github.com/trunnion-metrology/trunnion/blob/main/docs/model-file.md).
//!
//! | room | gives |
//! |---|---|
//! | [`model`] | a consistent description of the machine, every symbol resolved |
//! | [`kinematics`] | both balls in machine coordinates |
//! | [`measurement`] | what the instrument reads, to any order in the errors |
//! | [`basis`] | motion errors as functions of their axis' coordinate |
//! | [`identify`] | base parameters, regressors, and what no fit can tell apart |
//! | [`emit::equations`] | text, LaTeX and JSON for people, from the exact polynomials |
//! | [`graph`] | shared subexpressions, derivatives, a straight line of operations |
//! | [`emit`] | Rust, C99 and NumPy for compilers, from the graph |
//! | [`problems`] | what is wrong with a description, with its place and in words |
//! | [`algebra`] | exact polynomials, truncated in the errors; under all of it |
//!
//! Each room's output is a value that can be printed and tested by itself; nothing points back. All is exact up to the graph:
//! a result is right, or it is an error.

pub mod algebra;
pub mod basis;
pub mod build;
pub mod catalogue;
pub mod emit;
pub mod exechon;
mod expression;
pub mod graph;
pub mod identify;
pub mod ids;
mod iso;
pub mod kinematics;
mod lanes;
#[doc(hidden)]
pub use lanes::SINE;
pub mod limits;
pub mod measurement;
pub mod model;
pub mod problems;
pub mod quantity;
mod source;
