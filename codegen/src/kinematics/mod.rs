//! From a description to the two balls: the chains of T(1)–T(3).
//!
//! After this room there are points in space, exact to the chosen order in the errors.

mod carried;
mod chain;
mod direction;
mod exact;

pub use carried::{At, ErrorValues, Places};
pub use chain::ball_positions;
pub use direction::{Heading, Headings, directions};
pub use exact::ExactRun;
