//! Where the stylus ball is.

use crate::Real;

/// Centre of the stylus ball when the spindle axis is at `position`, mm: p + Rot(turned)·o, `turned` = s − φ, rad.
pub fn ball<T: Real>(position: [T; 2], turned: T, offset: [T; 2]) -> [T; 2] {
    let ((s, c), [x, y]) = (turned.sin_cos(), offset);
    [position[0] + c * x - s * y, position[1] + s * x + c * y]
}
