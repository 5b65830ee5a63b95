//! What a solve gives, and ε_xa from it.

use crate::state::check;
use crate::{TrunnionStatus, TrunnionStatus as Status};
use core::ptr;
use nalgebra::{SMatrix, SVector};
use trunnion_solver::Real;
use trunnion_solver::lstsq::{Solution, SolveError, student_t_95};
use trunnion_solver::tilting::{Estimate, NAMES, e_xa};

/// Number of coefficients.
pub const TRUNNION_COEFFICIENTS: usize = 13;
const _: () = assert!(TRUNNION_COEFFICIENTS == NAMES.len());

/// Says that an estimate holds one.
const VALID: u32 = 0x7452_6531;

/// Coefficients with standard deviations in C's layout. The first two are those of ε_xa.
///
/// In order: e_xa1, e_xa2, k1 … k11.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEstimate<T> {
    /// Set by a solve that succeeded.
    pub valid: u32,
    /// How many coefficients there are.
    pub count: u32,
    /// Samples less coefficients; of the two steps, those of the second.
    pub degrees_of_freedom: u32,
    /// If the answer was `Confounded`: bit i is set if coefficient i is one of those that the samples do not separate.
    pub confounded: u32,
    /// The bar's nominal length, mm.
    pub radius: T,
    /// Standard deviation of the residuals, mm.
    pub residual_std: T,
    /// The coefficients; lengths in mm, angles in rad.
    pub coefficients: [T; TRUNNION_COEFFICIENTS],
    /// Their standard deviations.
    pub std: [T; TRUNNION_COEFFICIENTS],
    /// Covariance of the first two coefficients: (0, 0), (0, 1), (1, 1).
    pub covariance: [T; 3],
}

/// ε_xa at one angle, rad.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TrunnionEpsXa<T> {
    /// ε_xa.
    pub value: T,
    /// Its standard deviation.
    pub std: T,
    /// Half the width of its 95 % band.
    pub band: T,
}

/// ε_xa at the angle `a`, rad.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_eps_xa_f32(
    estimate: *const TrunnionEstimate<f32>,
    a: f32,
    result: *mut TrunnionEpsXa<f32>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { at(estimate, a, result) }
}

/// ε_xa at the angle `a`, rad.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn trunnion_eps_xa_f64(
    estimate: *const TrunnionEstimate<f64>,
    a: f64,
    result: *mut TrunnionEpsXa<f64>,
) -> TrunnionStatus {
    // SAFETY: as required here.
    unsafe { at(estimate, a, result) }
}

impl<T: Real> TrunnionEstimate<T> {
    fn invalid(confounded: u32) -> Self {
        let none = [T::zero(); TRUNNION_COEFFICIENTS];
        Self {
            valid: 0,
            count: 0,
            degrees_of_freedom: 0,
            confounded,
            radius: T::zero(),
            residual_std: T::zero(),
            coefficients: none,
            std: none,
            covariance: [T::zero(); 3],
        }
    }

    fn of(estimate: &Estimate<T>) -> Self {
        let solution = &estimate.solution;
        let ([coefficients], [std]) = (solution.coefficients.data.0, solution.std().data.0);
        let [[c11, c12, ..], [_, c22, ..], ..] = solution.covariance.data.0;
        Self {
            valid: VALID,
            count: TRUNNION_COEFFICIENTS as u32,
            degrees_of_freedom: solution.degrees_of_freedom,
            confounded: 0,
            radius: estimate.lengths().r,
            residual_std: solution.residual_std,
            coefficients,
            std,
            covariance: [c11, c12, c22],
        }
    }

    fn eps_xa(&self, a: T) -> Result<TrunnionEpsXa<T>, Status> {
        if self.valid != VALID {
            return Err(Status::NotInitialised);
        }
        let [e1, e2, ..] = self.coefficients;
        let [c11, c12, c22] = self.covariance;
        let of_eps_xa = Solution {
            coefficients: SVector::from([e1, e2]),
            covariance: SMatrix::from([[c11, c12], [c12, c22]]),
            residual_std: self.residual_std,
            degrees_of_freedom: self.degrees_of_freedom,
        };
        let basis = SVector::from(e_xa(self.radius, a));
        let value = of_eps_xa.value_of(&basis).ok_or(Status::NotFinite)?;
        let std = of_eps_xa.variance_of(&basis).ok_or(Status::NotFinite)?.sqrt();
        let band = student_t_95::<T>(self.degrees_of_freedom) * std;
        if band.is_finite() { Ok(TrunnionEpsXa { value, std, band }) } else { Err(Status::NotFinite) }
    }
}

/// Evaluates an estimate in the caller's memory.
///
/// # Safety
/// `estimate` is null or readable, `result` null or writable.
unsafe fn at<T: Real>(estimate: *const TrunnionEstimate<T>, a: T, result: *mut TrunnionEpsXa<T>) -> Status {
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
pub(crate) unsafe fn give<T: Real>(
    estimate: Result<Estimate<T>, (Status, u32)>,
    result: *mut TrunnionEstimate<T>,
) -> Status {
    if let Err(status) = check(result) {
        return status;
    }
    let (status, value) = match estimate {
        Ok(estimate) => (Status::Ok, TrunnionEstimate::of(&estimate)),
        Err((status, confounded)) => (status, TrunnionEstimate::invalid(confounded)),
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
