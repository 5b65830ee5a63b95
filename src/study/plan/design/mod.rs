//! Tests that are designed: which runs to measure for a function.

mod budgets;
mod choices;
mod pool;
mod proposal;
mod recommended;
mod search;

pub use budgets::{Budgeted, budgets};
pub use choices::{Choices, with_runs};
pub use pool::{Measured, Pool};
pub use proposal::{Asked, Design, DesignError, Proposal, Reachable, design, estimated};
pub use recommended::{Recommended, recommended};
pub use search::{Enough, Next, Within, fewest, grade, share};
