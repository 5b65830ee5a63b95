//! What a solve gives, and ε_xa from it.

use crate::state::check;
use crate::{TrunnionStatus, TrunnionStatus as Status};
use core::ptr;
use nalgebra::{SMatrix, SVector};
use num_traits::{AsPrimitive, FloatConst};
use trunnion_solver::Real;
use trunnion_solver::lstsq::{Solution, SolveError, student_t_95};
use trunnion_solver::tilting::{Estimate, FUNCTION, regressors};

/// Room for the coefficients of any estimator here: those of the joint one.
pub const TRUNNION_COEFFICIENTS: usize = 13;
const _: () = assert!(TRUNNION_COEFFICIENTS == regressors::NAMES.len());

/// Says that an estimate holds one.
const VALID: u32 = 0x7452_6531;

/// Coefficients with standard deviations in C's layout. The first two are those of ε_xa.
///
/// Joint: e_xa1, e_xa2, k1 … k11. Two-step: e_xa1, e_xa2, k6, k7, k8.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEstimateF32 {
    /// Set by a solve that succeeded.
    pub valid: u32,
    /// How many coefficients there are.
    pub count: u32,
    /// Samples less coefficients.
    pub degrees_of_freedom: u32,
    /// If the answer was `Confounded`: bit i is set if coefficient i is one of those that the samples do not separate.
    pub confounded: u32,
    /// The bar's nominal length, mm.
    pub radius: f32,
    /// Standard deviation of the residuals, mm.
    pub residual_std: f32,
    /// The coefficients; lengths in mm, angles in rad.
    pub coefficients: [f32; TRUNNION_COEFFICIENTS],
    /// Their standard deviations.
    pub std: [f32; TRUNNION_COEFFICIENTS],
    /// Covariance of the first two coefficients: (0, 0), (0, 1), (1, 1).
    pub covariance: [f32; 3],
}

/// ε_xa at one angle, rad.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEpsXaF32 {
    /// ε_xa.
    pub value: f32,
    /// Its standard deviation.
    pub std: f32,
    /// Half the width of its 95 % band.
    pub band: f32,
}

impl Layout<f32> for TrunnionEstimateF32 {
    type EpsXa = TrunnionEpsXaF32;

    fn invalid(confounded: u32) -> Self {
        let none = [0.0; TRUNNION_COEFFICIENTS];
        Self {
            valid: 0,
            count: 0,
            degrees_of_freedom: 0,
            confounded,
            radius: 0.0,
            residual_std: 0.0,
            coefficients: none,
            std: none,
            covariance: [0.0; 3],
        }
    }

    fn of<const P: usize>(estimate: &Estimate<f32, P>) -> Self {
        let solution = &estimate.solution;
        let mut this = Self::invalid(0);
        let [coefficients] = &solution.coefficients.data.0;
        let [std] = &solution.std().data.0;
        this.coefficients.iter_mut().zip(coefficients).for_each(|(to, &from)| *to = from);
        this.std.iter_mut().zip(std).for_each(|(to, &from)| *to = from);
        this.covariance = leading(&solution.covariance.data.0).unwrap_or_default();
        this.count = u32::try_from(P).unwrap_or(0);
        this.degrees_of_freedom = solution.degrees_of_freedom;
        this.residual_std = solution.residual_std;
        this.radius = estimate.radius();
        this.valid = VALID;
        this
    }

    fn eps_xa(&self, a: f32) -> Result<TrunnionEpsXaF32, Status> {
        if self.valid != VALID {
            return Err(Status::NotInitialised);
        }
        let [e1, e2, ..] = self.coefficients;
        let [c11, c12, c22] = self.covariance;
        let [value, std, band] = eps_xa(self.radius, a, [e1, e2], [[c11, c12], [c12, c22]], self.degrees_of_freedom)?;
        Ok(TrunnionEpsXaF32 { value, std, band })
    }
}

/// ε_xa at the angle `a`, rad.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_eps_xa_f32(
    estimate: *const TrunnionEstimateF32,
    a: f32,
    result: *mut TrunnionEpsXaF32,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { at(estimate, a, result) }
}

/// Coefficients with standard deviations in C's layout. The first two are those of ε_xa.
///
/// Joint: e_xa1, e_xa2, k1 … k11. Two-step: e_xa1, e_xa2, k6, k7, k8.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEstimateF64 {
    /// Set by a solve that succeeded.
    pub valid: u32,
    /// How many coefficients there are.
    pub count: u32,
    /// Samples less coefficients.
    pub degrees_of_freedom: u32,
    /// If the answer was `Confounded`: bit i is set if coefficient i is one of those that the samples do not separate.
    pub confounded: u32,
    /// The bar's nominal length, mm.
    pub radius: f64,
    /// Standard deviation of the residuals, mm.
    pub residual_std: f64,
    /// The coefficients; lengths in mm, angles in rad.
    pub coefficients: [f64; TRUNNION_COEFFICIENTS],
    /// Their standard deviations.
    pub std: [f64; TRUNNION_COEFFICIENTS],
    /// Covariance of the first two coefficients: (0, 0), (0, 1), (1, 1).
    pub covariance: [f64; 3],
}

/// ε_xa at one angle, rad.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEpsXaF64 {
    /// ε_xa.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
    /// Half the width of its 95 % band.
    pub band: f64,
}

impl Layout<f64> for TrunnionEstimateF64 {
    type EpsXa = TrunnionEpsXaF64;

    fn invalid(confounded: u32) -> Self {
        let none = [0.0; TRUNNION_COEFFICIENTS];
        Self {
            valid: 0,
            count: 0,
            degrees_of_freedom: 0,
            confounded,
            radius: 0.0,
            residual_std: 0.0,
            coefficients: none,
            std: none,
            covariance: [0.0; 3],
        }
    }

    fn of<const P: usize>(estimate: &Estimate<f64, P>) -> Self {
        let solution = &estimate.solution;
        let mut this = Self::invalid(0);
        let [coefficients] = &solution.coefficients.data.0;
        let [std] = &solution.std().data.0;
        this.coefficients.iter_mut().zip(coefficients).for_each(|(to, &from)| *to = from);
        this.std.iter_mut().zip(std).for_each(|(to, &from)| *to = from);
        this.covariance = leading(&solution.covariance.data.0).unwrap_or_default();
        this.count = u32::try_from(P).unwrap_or(0);
        this.degrees_of_freedom = solution.degrees_of_freedom;
        this.residual_std = solution.residual_std;
        this.radius = estimate.radius();
        this.valid = VALID;
        this
    }

    fn eps_xa(&self, a: f64) -> Result<TrunnionEpsXaF64, Status> {
        if self.valid != VALID {
            return Err(Status::NotInitialised);
        }
        let [e1, e2, ..] = self.coefficients;
        let [c11, c12, c22] = self.covariance;
        let [value, std, band] = eps_xa(self.radius, a, [e1, e2], [[c11, c12], [c12, c22]], self.degrees_of_freedom)?;
        Ok(TrunnionEpsXaF64 { value, std, band })
    }
}

/// ε_xa at the angle `a`, rad.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_eps_xa_f64(
    estimate: *const TrunnionEstimateF64,
    a: f64,
    result: *mut TrunnionEpsXaF64,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { at(estimate, a, result) }
}

/// What the two precisions have in common.
pub(crate) trait Layout<T>: Copy {
    type EpsXa;
    fn invalid(confounded: u32) -> Self;
    fn of<const P: usize>(estimate: &Estimate<T, P>) -> Self;
    fn eps_xa(&self, a: T) -> Result<Self::EpsXa, Status>;
}

/// Elements (0, 0), (0, 1), (1, 1) of a covariance.
fn leading<T: Copy, const P: usize>(covariance: &[[T; P]; P]) -> Option<[T; 3]> {
    let [first, second] = [covariance.first()?, covariance.get(1)?];
    Some([*first.first()?, *first.get(1)?, *second.get(1)?])
}

/// Value, standard deviation and half width of the band.
fn eps_xa<T: Real + FloatConst>(
    radius: T,
    a: T,
    coefficients: [T; FUNCTION],
    covariance: [[T; FUNCTION]; FUNCTION],
    degrees_of_freedom: u32,
) -> Result<[T; 3], Status>
where
    f64: AsPrimitive<T>,
{
    let solution = Solution {
        coefficients: SVector::from(coefficients),
        covariance: SMatrix::from(covariance),
        residual_std: T::zero(),
        degrees_of_freedom,
    };
    let basis = SVector::from(regressors::e_xa(radius, a));
    let value = solution.value_of(&basis).ok_or(Status::NotFinite)?;
    let std = solution.variance_of(&basis).ok_or(Status::NotFinite)?.sqrt();
    let band = student_t_95::<T>(degrees_of_freedom) * std;
    if band.is_finite() { Ok([value, std, band]) } else { Err(Status::NotFinite) }
}

/// Evaluates an estimate in the caller's memory.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
unsafe fn at<T, L: Layout<T>>(estimate: *const L, a: T, result: *mut L::EpsXa) -> Status {
    if let Err(status) = check(estimate).and(check(result)) {
        return status;
    }
    // SAFETY: neither is null or misaligned; any words are numbers.
    match unsafe { ptr::read_volatile(estimate) }.eps_xa(a) {
        Err(status) => status,
        Ok(value) => {
            // SAFETY: as above.
            unsafe { ptr::write(result, value) };
            Status::Ok
        }
    }
}

/// Writes what a solve gave, or that it gave nothing.
///
/// # Safety
/// `result` is null or writable.
pub(crate) unsafe fn give<T, L: Layout<T>, const P: usize>(
    estimate: Result<Estimate<T, P>, (Status, u32)>,
    result: *mut L,
) -> Status {
    if let Err(status) = check(result) {
        return status;
    }
    let (status, value) = match estimate {
        Ok(estimate) => (Status::Ok, L::of(&estimate)),
        Err((status, confounded)) => (status, L::invalid(confounded)),
    };
    // SAFETY: not null and aligned, of the caller's word writable.
    unsafe { ptr::write(result, value) };
    status
}

/// The status of a failed solve, and its confounded coefficients as bits.
pub(crate) fn failure<const P: usize>(why: SolveError<P>) -> (Status, u32) {
    let confounded = match why {
        SolveError::RankDeficient(c) => {
            c.involved.iter().filter_map(|i| 1_u32.checked_shl(u32::try_from(i).ok()?)).fold(0, |all, bit| all | bit)
        }
        _ => 0,
    };
    (why.into(), confounded)
}
