//! The tool's turn about its own axis that comes with every move.

use super::vector::{cross, dot, plus};
use super::{Machine, Pose, RotationError, Vector};
use crate::Real;

/// What φ is counted from where the tool does not point as at home: there ᴬR_H of E(6) is no rotation about the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Tilted {
    /// E(7) as it stands: from home's x axis seen along the tool, its projection on the plane across the tool.
    #[default]
    Projected,
    /// From home's orientation carried to the tool's direction by the smallest rotation that does so (about the cross
    /// product of the two directions).
    Carried,
}

impl<T: Real> Machine<T> {
    /// The dependent rotation φ of a pose, E(6), E(7), rad in [−π, π]: the spindle angle that turns the tool back to its
    /// orientation at home. The tool itself has turned by −φ about its direction.
    ///
    /// `atan2(a21, a11)` of ᴬR_H; the paper prints the arguments the other way round. As long as the tool points as at
    /// home both ways of `tilted` are one.
    ///
    /// # Errors
    /// [`RotationError`] where there is nothing to count from: [`Tilted::Projected`] with the tool along home's x axis,
    /// [`Tilted::Carried`] with the tool opposite to home.
    pub fn dependent_rotation(&self, pose: &Pose<T>, tilted: Tilted) -> Result<T, RotationError> {
        let [x_home, _, t_home] = &self.home().spindle;
        let [x_a, y_a, t] = &pose.spindle;
        let x = match tilted {
            Tilted::Projected => *x_home,
            Tilted::Carried => carried(x_home, t_home, t).ok_or(RotationError::Opposite)?,
        };
        let (a11, a21) = (dot(x_a, &x), dot(y_a, &x));
        if a11 * a11 + a21 * a21 <= T::epsilon() {
            return Err(RotationError::AlongX);
        }
        Ok(a21.atan2(a11))
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
