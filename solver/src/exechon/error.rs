//! What can be wrong with a machine, a target, and a solution.

use crate::Real;
use core::{error, fmt};

/// A dimension of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Half the distance of the outer gimbals, xU.
    Xu,
    /// Place of the second strut's gimbal, yS2.
    Ys2,
    /// Half the distance of R4 and R6, xR.
    Xr,
    /// Place of R5, yR5.
    Yr5,
    /// Place of the C axis, yCp.
    Ycp,
    /// Height of the A axis, zC.
    Zc,
    /// Offset of the spindle, yt.
    Yt,
    /// Length of the tool, tz.
    Tz,
    /// Length of the struts at home.
    HomeStrut,
    /// Angle of the A axis at home.
    HomeA,
}

/// Why dimensions make no machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MachineError {
    /// NaN or infinite.
    NotFinite(Dimension),
    /// Zero or negative where a length must be positive.
    NotPositive(Dimension),
    /// So large that the lengths at home are no finite numbers.
    TooLarge(Dimension),
    /// The struts do not reach from gimbal to platform at home.
    HomeUnreachable,
    /// At home the tool points along the C axis: the A axis has no branch.
    HomeSingular,
    /// A range whose low end is not below its high end.
    EmptyRange(Limit),
}

/// Why a point and a direction are no target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TargetError<T> {
    /// NaN or infinite.
    NotFinite(Input),
    /// A direction of length zero.
    ZeroDirection,
    /// A direction that is not of length one.
    NotUnit {
        /// Its length.
        norm: T,
    },
}

/// A number given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// The tool point.
    Point,
    /// The tool's direction.
    Direction,
    /// A strut's length.
    Struts,
    /// The angle A.
    A,
    /// The angle C.
    C,
}

/// Where the equations have no single solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Singularity {
    /// The tool points along the C axis, A = 0 or a half turn: C is undetermined.
    ToolAlongC,
    /// The platform is on the line of the outer gimbals: its orientation is undetermined.
    PlatformOnGimbals,
    /// The derivatives of the equations are dependent.
    Jacobian,
}

/// Why a pose has no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum KinematicsError<T> {
    /// NaN or infinite.
    NotFinite(Input),
    /// Singular.
    Singular(Singularity),
    /// Newton's steps do not become small: no solution near the start on its branch.
    NoConvergence {
        /// Steps taken.
        iterations: u32,
        /// Length of the last step, mm.
        step: T,
    },
    /// The only solution found has the platform behind the base.
    BehindBase {
        /// Its place along the base's z axis, mm.
        z: T,
    },
    /// A strut or an axis would have to go beyond its range.
    OutOfRange {
        /// Which.
        limit: Limit,
        /// Where it would have to go, mm or rad.
        value: T,
        /// The end of its range that this passes, mm or rad.
        bound: T,
    },
}

/// Why the dependent rotation is undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RotationError {
    /// The tool points opposite to its direction at home: every way there is as short.
    Opposite,
    /// The tool points along home's x axis, whose projection is a point.
    AlongX,
}

impl Dimension {
    /// The name in files: `xu_mm`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Xu => "xu_mm",
            Self::Ys2 => "ys2_mm",
            Self::Xr => "xr_mm",
            Self::Yr5 => "yr5_mm",
            Self::Ycp => "ycp_mm",
            Self::Zc => "zc_mm",
            Self::Yt => "yt_mm",
            Self::Tz => "tz_mm",
            Self::HomeStrut => "strut_mm",
            Self::HomeA => "a_deg",
        }
    }
}

/// What a range is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The strut from U1 to R4.
    Strut1,
    /// The strut from S2 to R5.
    Strut2,
    /// The strut from U3 to R6.
    Strut3,
    /// The A axis.
    A,
    /// The C axis.
    C,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Strut1 => "strut 1",
            Self::Strut2 => "strut 2",
            Self::Strut3 => "strut 3",
            Self::A => "the A axis",
            Self::C => "the C axis",
        })
    }
}

impl fmt::Display for MachineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(d) => write!(f, "{} is not a finite number", d.name()),
            Self::NotPositive(d) => write!(f, "{} is not positive", d.name()),
            Self::TooLarge(d) => write!(f, "{} is so large that the machine's lengths are no finite numbers", d.name()),
            Self::HomeUnreachable => f.write_str("strut_mm at home is too short to reach from xu_mm to xr_mm"),
            Self::HomeSingular => {
                f.write_str("a_deg at home points the tool along the C axis, where the A axis has no branch")
            }
            Self::EmptyRange(limit) => {
                write!(f, "the range of {limit} is empty: its low end must be below its high end")
            }
        }
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Point => "the tool point",
            Self::Direction => "the tool's direction",
            Self::Struts => "a strut's length",
            Self::A => "the angle A",
            Self::C => "the angle C",
        })
    }
}

impl<T: Real> fmt::Display for TargetError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(input) => write!(f, "{input} is not a finite number"),
            Self::ZeroDirection => f.write_str("the tool's direction has length zero"),
            Self::NotUnit { norm } => write!(f, "the tool's direction has length {norm}, not 1"),
        }
    }
}

impl fmt::Display for Singularity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::ToolAlongC => "the tool points along the C axis (A = 0): C is undetermined",
            Self::PlatformOnGimbals => {
                "the platform is on the line of the outer gimbals: its orientation is undetermined"
            }
            Self::Jacobian => "the equations' derivatives are dependent",
        })
    }
}

impl<T: Real> fmt::Display for KinematicsError<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite(input) => write!(f, "{input} is not a finite number"),
            Self::Singular(singularity) => write!(f, "singular pose: {singularity}"),
            Self::NoConvergence { iterations, step } => {
                write!(f, "no solution on this branch: after {iterations} Newton steps the last is still {step:.6} mm")
            }
            Self::BehindBase { z } => {
                write!(f, "out of reach: the platform would be behind the base, at z = {z:.3} mm")
            }
            Self::OutOfRange { limit, value, bound } => {
                let excess = (*value - *bound).abs();
                let side = if value < bound { "below" } else { "above" };
                match limit {
                    Limit::Strut1 | Limit::Strut2 | Limit::Strut3 => {
                        write!(
                            f,
                            "{limit} would be {value:.3} mm long, {excess:.3} mm {side} its limit of {bound:.3} mm"
                        )
                    }
                    Limit::A | Limit::C => {
                        let degrees = |x: T| x.to_degrees();
                        let (value, bound, excess) = (degrees(*value), degrees(*bound), degrees(excess));
                        write!(f, "{limit} would be at {value:.3}°, {excess:.3}° {side} its limit of {bound:.3}°")
                    }
                }
            }
        }
    }
}

impl fmt::Display for RotationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Opposite => "the tool points opposite to its direction at home: the dependent rotation is undefined",
            Self::AlongX => "the tool points along the machine's x axis: the dependent rotation is undefined",
        })
    }
}

impl error::Error for MachineError {}
impl<T: Real> error::Error for TargetError<T> {}
impl<T: Real> error::Error for KinematicsError<T> {}
impl error::Error for RotationError {}
