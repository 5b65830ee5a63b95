//! From a draft to a model: every symbol resolved, every problem collected.

mod assumptions;
mod axes;
mod build;
mod defined;
mod functions;
mod names;
mod nuisance;
mod prior;
mod resolver;
mod runs;
mod turns;
