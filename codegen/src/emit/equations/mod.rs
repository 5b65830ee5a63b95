//! A derivation as a document: text and LaTeX for a reviewer, MathML for a page, JSON for a program.

mod document;
mod extent;
mod function;
mod json;
mod latex;
mod mathml;
mod printer;
mod text;

pub use document::{definition, group};
pub use extent::{Remaining, extent, remaining, seen_sum};
pub use json::json;
pub use latex::{latex, latex_equations};
pub use mathml::{Equation, Section, mathml};
pub use printer::{Printer, Style};
pub use text::{symbols, text};
