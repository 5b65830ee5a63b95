//! Which positions of each run to measure.

mod candidates;
mod exchange;
mod proposal;

pub use candidates::unread;
pub use proposal::{Asked, Chosen, Count, PositionsError, Proposed, propose};
