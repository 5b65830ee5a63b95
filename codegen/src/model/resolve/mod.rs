//! From a draft to a model: every symbol resolved, every problem collected.

mod axes;
mod build;
mod functions;
mod names;
mod resolver;
mod runs;
