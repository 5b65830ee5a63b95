//! Where the rotary axes are, as a control takes it: from location errors that were estimated.

mod linuxcnc;
mod located;
mod named;
mod sinumerik;

pub use linuxcnc::{NoPivots, Pin, Pins, pins};
pub use located::{Estimate, Located};
pub use named::named;
pub use sinumerik::{Added, Chained, chain, text as chain_text};
