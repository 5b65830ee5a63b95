//! From the two balls to what the instrument reads, as a polynomial in the errors: T(4) and T(5).

mod bar;
mod displacement;
mod error;
mod exact;
mod reading;

pub use error::{Length, ReadingError};
pub use exact::ExactReading;
pub use reading::reading;
