//! From tool point and direction to struts and axes.

use super::vector::{cross, dot, norm, plus};
use super::{Joints, KinematicsError, Machine, Pose, Singularity, Start, Target, Vector, equations, newton};
use crate::Real;

/// Iterations that get nowhere with the tool this near to the C axis (sin A) are lost to that singularity.
const NEAR: f64 = 0.02;

impl<T: Real> Machine<T> {
    /// The pose whose tool is at `target`, found by Newton–Raphson on E(5) from `start`, on its branch.
    ///
    /// Deterministic: the same target and start give the same bits. From home 3 to 6 steps over the workspace with
    /// |A| > 5°, few from the previous pose of a path.
    ///
    /// # Errors
    /// [`KinematicsError`]: a singular pose, no convergence, the platform behind the base, or a strut or axis beyond
    /// its limit (the first in the order l1, l2, l3, A, C). The equations have one singularity within the workspace,
    /// A = 0, and converge to within half a degree of it.
    pub fn inverse(&self, target: &Target<T>, start: &Start<T>) -> Result<Pose<T>, KinematicsError<T>> {
        let d = self.dimensions();
        let (point, t) = (target.point(), target.direction());
        // The spindle axis' crossing with the A axis' plane.
        let s = plus(point, -d.tz, t);
        let yt = d.yt * start.branch.sign();
        let root = newton::solve(&start.platform, self.home().struts_mean(), |[x, y, z]| {
            equations::closure(d.ys2, d.ycp, d.zc, yt, s[0], s[1], s[2], t[0], t[1], t[2], *x, *y, *z)
        })
        .map_err(|lost| self.blame(&lost, t))?;
        let platform = root.at;
        if platform[2] <= T::zero() {
            return Err(KinematicsError::BehindBase { z: platform[2] });
        }
        let axes = self.orientation(&platform)?;
        let [x_axis, y_axis, z_axis] = &axes;
        let across = plus(z_axis, -dot(z_axis, t), t);
        let sine = norm(&across);
        // Where sin A is lost in rounding, so is the direction of the A axis.
        if sine <= T::epsilon().sqrt() {
            return Err(KinematicsError::Singular(Singularity::ToolAlongC));
        }
        let scale = start.branch.sign::<T>() / sine;
        let y_a = across.map(|v| v * scale);
        let x_a = cross(&y_a, t);
        let joints = Joints {
            struts: self.struts(&platform),
            a: dot(&y_a, z_axis).atan2(dot(t, z_axis)),
            c: dot(&x_a, y_axis).atan2(dot(&x_a, x_axis)),
        };
        self.limits().check(&joints)?;
        let spindle = [x_a, y_a, *t];
        Ok(Pose { point: *point, platform, axes, spindle, joints, iterations: root.iterations })
    }

    /// What an iteration was lost to.
    fn blame(&self, lost: &newton::Lost<T>, t: &Vector<T>) -> KinematicsError<T> {
        let Ok([_, _, z_axis]) = self.orientation(&lost.at) else {
            return lost.error;
        };
        let sine = norm(&cross(&z_axis, t));
        if sine <= T::of(NEAR) { KinematicsError::Singular(Singularity::ToolAlongC) } else { lost.error }
    }
}
