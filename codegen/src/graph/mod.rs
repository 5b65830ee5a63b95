//! Hash-consed expressions: equal expressions are one node, so sharing and equality cost nothing.
//!
//! Polynomials lower to a [`Graph`] through its plain constructors; from there expressions are differentiated
//! ([`Graph::derivative`]), evaluated ([`Graph::evaluate`], [`Tape`]) or lowered
//! together to straight-line code ([`Program`]), which the printers of [`crate::emit`] write in a language.
//!
//! Constructors simplify as algebra does: `0·x` is 0 and `(√u)²` is `u`, whatever values `x` and `u` may take.
//! Constants are exact; the power of one that would have more digits than numbers of `f64` reach is left unfolded.
//!
//! ```
//! use trunnion_codegen::graph::Graph;
//!
//! let mut graph = Graph::new();
//! let [x, y] = graph.inputs();
//! let three = graph.sum(&[x, y, x]);
//! let two = graph.integer(2);
//! let rest = graph.difference(three, y);
//! assert_eq!(rest, graph.product(&[two, x]));
//! ```

mod blocks;
mod build;
mod derivative;
mod evaluate;
mod factor;
mod function;
mod lower;
mod node;
mod program;
mod tape;
#[cfg(test)]
mod tests;

use crate::algebra::whole_turns;
pub use crate::algebra::{Rational, to_f64};
pub use crate::lanes::{LANES, Lanes, in_blocks};
pub use blocks::BlockEvaluator;
pub use build::Graph;
pub use evaluate::Unbound;
pub use node::{Addend, Id, Node, Power, Symbol};
pub use program::{Constant, Operations, Program, Step, Value};
pub use tape::{Evaluator, Tape, WrongLength};
