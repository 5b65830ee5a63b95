//! The tool's turn about its own axis that comes with every move.

use super::vector::{cross, dot, plus};
use super::{Machine, Pose, RotationError, Vector};
use crate::Real;

impl<T: Real> Machine<T> {
    /// The dependent rotation φ of a pose (6), (7), rad in (−π, π]: the spindle angle that turns the tool back to its
    /// orientation at home. The tool itself has turned by −φ about its direction.
    ///
    /// With φ₀ = `atan2(a21, a11)` of ᴬR_H; the paper prints the arguments the other way round. Where the tool points
    /// otherwise than at home, ᴬR_H of (6) is no rotation about one axis: its home orientation is first carried to the
    /// new direction by the smallest rotation that does so (about the cross product of the two directions), and φ is
    /// counted from there.
    ///
    /// # Errors
    /// [`RotationError`] where the tool points opposite to home.
    pub fn dependent_rotation(&self, pose: &Pose<T>) -> Result<T, RotationError> {
        let [x_home, _, t_home] = &self.home().spindle;
        let [x_a, y_a, t] = &pose.spindle;
        let x = carried(x_home, t_home, t).ok_or(RotationError::Opposite)?;
        Ok(dot(y_a, &x).atan2(dot(x_a, &x)))
    }
}

/// `v` under the smallest rotation that takes `from` to `to`: v + w × v + w × (w × v)/(1 + from·to), w = from × to.
fn carried<T: Real>(v: &Vector<T>, from: &Vector<T>, to: &Vector<T>) -> Option<Vector<T>> {
    let w = cross(from, to);
    let share = T::one() + dot(from, to);
    let once = cross(&w, v);
    let twice = cross(&w, &once);
    (share > T::epsilon()).then(|| plus(&plus(v, T::one(), &once), share.recip(), &twice))
}
