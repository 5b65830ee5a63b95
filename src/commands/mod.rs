//! One module per command, and what they share.

pub mod circular;
pub mod compare;
pub mod demo;
pub mod derive;
pub mod exechon;
pub mod export;
pub mod fit;
pub mod import;
pub mod models;
pub mod monte_carlo;
pub mod new;
pub mod pivots;
pub mod plan;
pub mod simulate;

mod exported;
mod measured;
mod model;
mod number;
pub mod output;
mod pair;
mod predicted;
mod refused;
mod reported;
mod seen;
pub mod shell;
mod simulated;
mod stated;
mod tabled;
mod trimmed;

pub use refused::Refused;
pub use seen::seen;
