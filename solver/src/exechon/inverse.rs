//! From tool point and direction to struts and axes.

use super::pole::Around;
use super::vector::{cross, dot, norm, plus};
use super::{Joints, KinematicsError, Machine, Pose, Singularity, Start, Target, Vector, equations, newton};
use crate::Real;

impl<T: Real> Machine<T> {
    /// The pose whose tool is at `target`, found by Newton–Raphson on E(5) from `start`, on its branch.
    ///
    /// Deterministic: the same target and start give the same bits. From home 3 to 6 steps over the workspace with
    /// |A| > 5°, few from the previous pose of a path.
    ///
    /// # Errors
    /// [`KinematicsError`]: a singular pose, no convergence, the platform behind the base, or a strut or axis beyond
    /// its limit (the first in the order l1, l2, l3, A, C). The equations have one singularity within the workspace,
    /// A = 0. Where Newton–Raphson is lost near it, all directions of the A axis are searched, some 1000 steps more, and
    /// a pose is found down to |sin A| = √ε: 10⁻⁶ degrees in `f64`, 0.02 in `f32`.
    pub fn inverse(&self, target: &Target<T>, start: &Start<T>) -> Result<Pose<T>, KinematicsError<T>> {
        let d = self.dimensions();
        let (point, t) = (target.point(), target.direction());
        // The spindle axis' crossing with the A axis' plane.
        let s = plus(point, -d.tz, t);
        let yt = d.yt * start.branch.sign();
        let solve = |from: &Vector<T>| {
            newton::solve(from, self.home().struts_mean(), |[x, y, z]| {
                equations::closure(d.ys2, d.ycp, d.zc, yt, s[0], s[1], s[2], t[0], t[1], t[2], *x, *y, *z)
            })
        };
        let root = match solve(&start.platform) {
            Ok(root) => root,
            Err(lost) => match self.around(&s, t, start) {
                Around { platform: Some(platform), .. } => solve(&platform)?,
                Around { along_c: true, .. } => return Err(KinematicsError::Singular(Singularity::ToolAlongC)),
                Around { .. } => return Err(lost),
            },
        };
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
}
