//! Everything printed is compiled, run, and compared with the graph's own evaluation.

mod compare;
mod functions;
mod native;
mod python;
/// Printed by the test below and checked in, so that the compiler reads it.
mod generated {
    include!("generated.rs");
}
mod generic;
