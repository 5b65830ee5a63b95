//! A touch probe's offset from the spindle axis, measured in a ring of known or unknown size.
//!
//! Positions are the spindle axis' at the instant of touch, mm, in machine coordinates across the tool. The *offset* o is
//! the stylus ball's centre less the spindle axis, with the spindle at zero and the tool oriented as at home: with the
//! spindle at s and a dependent rotation φ the ball is at p + Rot(s − φ)·o. (The paper's o has the opposite sign.)
//!
//! ```
//! use trunnion_solver::probe::Reversal;
//!
//! // The ball (Ø6) centred in a ring Ø40, the spindle reversed, then touches towards +x and +y.
//! let touches = Reversal { centre: [0.0, 0.0], x: [17.416_988, 0.0], y: [0.0, 17.314_811], radius: 17.0_f64 };
//! let [ox, oy] = touches.exact()?;
//! assert!((ox - 0.21).abs() < 1e-6 && (oy - 0.16).abs() < 1e-6);
//! let [nearly, _] = touches.small_angle();
//! assert!((nearly - ox).abs() > 1e-3);
//! # Ok::<(), trunnion_solver::probe::ProbeError>(())
//! ```

mod ball;
mod error;
mod reversal;
mod touches;

pub use ball::ball;
pub use error::ProbeError;
pub use reversal::Reversal;
pub use touches::{OffsetFit, Touch, offset};
