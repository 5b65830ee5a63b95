//! From a draft to a model: every symbol resolved, every problem collected.

mod assumptions;
mod axes;
mod build;
mod functions;
mod names;
mod prior;
mod resolver;
mod runs;
mod turns;
