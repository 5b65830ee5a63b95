//! From struts and axes to tool point and direction.

use super::vector::{combine, finite, plus};
use super::{Input, Joints, KinematicsError, Machine, Pose, Start, Vector, equations, newton};
use crate::Real;

impl<T: Real> Machine<T> {
    /// The pose of given struts and axes, the platform found by Newton–Raphson on E(1)–E(3) from `start`.
    ///
    /// Three lengths leave the platform several places; this is the one in front of the base that `start` leads to. From
    /// home that is the place on home's side of the singular poses (100,000 places of the workspace, none failed).
    ///
    /// # Errors
    /// [`KinematicsError`]: an input that is not finite, a strut or axis beyond its limit, lengths that do not close
    /// (no convergence), or the platform behind the base.
    pub fn forward(&self, joints: &Joints<T>, start: &Start<T>) -> Result<Pose<T>, KinematicsError<T>> {
        if !finite(&joints.struts) {
            return Err(KinematicsError::NotFinite(Input::Struts));
        }
        for (angle, input) in [(joints.a, Input::A), (joints.c, Input::C)] {
            if !angle.is_finite() {
                return Err(KinematicsError::NotFinite(input));
            }
        }
        self.limits().check(joints)?;
        let d = self.dimensions();
        let root = newton::solve(&start.platform, self.home().struts_mean(), |[x, y, z]| {
            let (lengths, jacobian) = equations::struts(d.xu, d.ys2, d.xr, d.yr5, *x, *y, *z);
            (plus(&lengths, -T::one(), &joints.struts), jacobian)
        })?;
        if root.at[2] <= T::zero() {
            return Err(KinematicsError::BehindBase { z: root.at[2] });
        }
        let pose = self.assemble(&root.at, joints)?;
        Ok(Pose { iterations: root.iterations, ..pose })
    }

    /// The tool with the platform at a place and given axes.
    pub(super) fn assemble(&self, platform: &Vector<T>, joints: &Joints<T>) -> Result<Pose<T>, KinematicsError<T>> {
        let d = self.dimensions();
        let axes = self.orientation(platform)?;
        let ((sa, ca), (sc, cc)) = (joints.a.sin_cos(), joints.c.sin_cos());
        let zero = T::zero();
        // Columns of Rz(C) Rx(A).
        let turned = [[cc, sc, zero], [-sc * ca, cc * ca, sa], [sc * sa, -cc * sa, ca]];
        let spindle = turned.map(|column| combine(&axes, &column));
        let [_, y_a, t] = &spindle;
        let arm = combine(&axes, &[zero, d.ycp, d.zc]);
        let on_axis = plus(&plus(platform, T::one(), &arm), d.yt, y_a);
        Ok(Pose { point: plus(&on_axis, d.tz, t), platform: *platform, axes, spindle, joints: *joints, iterations: 0 })
    }
}
