//! A machine of known dimensions.

use super::vector::finite;
use super::{
    Dimension, Frame, Joints, KinematicsError, Limit, Limits, MachineError, Pose, Singularity, Vector, equations,
};
use crate::Real;

/// Dimensions in mm; joint coordinates are signed. Base: U1 = (−xu, 0, 0), U3 = (xu, 0, 0), S2 = (0, ys2, 0); platform:
/// R4 = (−xr, 0, 0), R6 = (xr, 0, 0), R5 = (0, yr5, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions<T> {
    /// Half the distance of the outer gimbals U1 and U3.
    pub xu: T,
    /// Place of the second strut's gimbal S2 along y.
    pub ys2: T,
    /// Half the distance of R4 and R6.
    pub xr: T,
    /// Place of R5 along the platform's y.
    pub yr5: T,
    /// Place of the C axis along the platform's y.
    pub ycp: T,
    /// Height of the A axis above the platform's origin, along the C axis.
    pub zc: T,
    /// Offset of the spindle's axis from the A axis, along the A axis' y.
    pub yt: T,
    /// Tool length: from the A axis to the tool point, along the tool.
    pub tz: T,
}

/// The home pose: struts 1 and 3 alike, C at zero, the platform parallel to the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Home<T> {
    /// l1 = l3, mm.
    pub strut: T,
    /// The A axis, rad.
    pub a: T,
}

/// A machine: dimensions that make sense, its home pose and its limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine<T> {
    dimensions: Dimensions<T>,
    limits: Limits<T>,
    home: Pose<T>,
}

impl<T: Real> Machine<T> {
    /// A machine. Its home need not be within the limits.
    ///
    /// # Errors
    /// [`MachineError`], naming the dimension or range.
    pub fn new(dimensions: Dimensions<T>, home: Home<T>, limits: Limits<T>) -> Result<Self, MachineError> {
        check(&dimensions, &home, &limits)?;
        let aside = dimensions.xu - dimensions.xr;
        let height = home.strut * home.strut - aside * aside;
        if !height.is_finite() {
            return Err(MachineError::TooLarge(largest(&dimensions, &home)));
        }
        if height <= T::zero() {
            return Err(MachineError::HomeUnreachable);
        }
        if home.a.sin().abs() <= T::epsilon().sqrt() {
            return Err(MachineError::HomeSingular);
        }
        let platform = [T::zero(), T::zero(), height.sqrt()];
        let nowhere = [T::zero(); 3];
        let unset = Joints { struts: nowhere, a: home.a, c: T::zero() };
        let blank =
            Pose { point: nowhere, platform, axes: [nowhere; 3], spindle: [nowhere; 3], joints: unset, iterations: 0 };
        let mut machine = Self { dimensions, limits, home: blank };
        let joints = Joints { struts: machine.struts(&platform), ..unset };
        if !finite(&joints.struts) {
            return Err(MachineError::TooLarge(largest(&dimensions, &home)));
        }
        machine.home = machine.assemble(&platform, &joints).map_err(|_| MachineError::HomeUnreachable)?;
        Ok(machine)
    }

    /// The dimensions.
    pub fn dimensions(&self) -> &Dimensions<T> {
        &self.dimensions
    }

    /// The limits.
    pub fn limits(&self) -> &Limits<T> {
        &self.limits
    }

    /// The home pose.
    pub fn home(&self) -> &Pose<T> {
        &self.home
    }

    /// Machine coordinates.
    pub fn frame(&self) -> Frame<T> {
        Frame::of(&self.home)
    }

    /// The platform's x, y and z axes at a place, E(4).
    pub(super) fn orientation(&self, platform: &Vector<T>) -> Result<[Vector<T>; 3], KinematicsError<T>> {
        let [x, y, z] = *platform;
        let axes = equations::orientation(self.dimensions.ys2, x, y, z);
        let finite = axes.iter().flatten().all(|v| v.is_finite());
        if finite { Ok(axes) } else { Err(KinematicsError::Singular(Singularity::PlatformOnGimbals)) }
    }

    /// Strut lengths E(1)–E(3) with the platform at a place.
    pub(super) fn struts(&self, platform: &Vector<T>) -> [T; 3] {
        let Dimensions { xu, ys2, xr, yr5, .. } = self.dimensions;
        let [x, y, z] = *platform;
        equations::struts(xu, ys2, xr, yr5, x, y, z).0
    }
}

impl<T: Real> Pose<T> {
    /// The machine's own length, mm.
    pub(super) fn struts_mean(&self) -> T {
        let [a, b, c] = self.joints.struts;
        (a + b + c) / T::of(3.0)
    }
}

fn named<T: Real>(d: &Dimensions<T>, home: &Home<T>) -> [(T, Dimension); 10] {
    [
        (d.xu, Dimension::Xu),
        (d.ys2, Dimension::Ys2),
        (d.xr, Dimension::Xr),
        (d.yr5, Dimension::Yr5),
        (d.ycp, Dimension::Ycp),
        (d.zc, Dimension::Zc),
        (d.yt, Dimension::Yt),
        (d.tz, Dimension::Tz),
        (home.strut, Dimension::HomeStrut),
        (home.a, Dimension::HomeA),
    ]
}

fn largest<T: Real>(d: &Dimensions<T>, home: &Home<T>) -> Dimension {
    let start = (T::zero(), Dimension::HomeStrut);
    named(d, home)
        .into_iter()
        .fold(start, |most, next| if next.0.abs() > most.0 { (next.0.abs(), next.1) } else { most })
        .1
}

fn check<T: Real>(d: &Dimensions<T>, home: &Home<T>, limits: &Limits<T>) -> Result<(), MachineError> {
    let all = named(d, home);
    for (value, dimension) in all {
        if !value.is_finite() {
            return Err(MachineError::NotFinite(dimension));
        }
    }
    for (value, dimension) in [all[0], all[2], all[8]] {
        if value <= T::zero() {
            return Err(MachineError::NotPositive(dimension));
        }
    }
    for (range, limit) in [(&limits.struts, Limit::Strut1), (&limits.a, Limit::A), (&limits.c, Limit::C)] {
        if !range.is_proper() {
            return Err(MachineError::EmptyRange(limit));
        }
    }
    Ok(())
}
