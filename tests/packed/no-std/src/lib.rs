//! A machine of one's own in a library without the standard library: the state of a fit in memory of the caller's.
#![no_std]

use trunnion_solver::lstsq::{Factor, Rejected, SolveError};
use trunnion_solver::{Machine, nalgebra::SVector};

/// A rotary table and the bar that is held against it.
#[derive(Machine)]
#[machine(constants(R), estimate(EXC))]
#[run(
    along_x,
    sweep = "c",
    at(C = "c"),
    workpiece_ball(setup(w_x, w_y, w_z)),
    tool_ball(at("R", "0", "0"), setup(t_x, t_y, t_z)),
    bar = "R"
)]
#[function(EXC = polynomial(4, "f(0) = 0", "f(2*pi) = f(0)"))]
pub struct Table {
    /// Angle of the table, rad.
    #[workpiece(rotary = "z", location(EX0C, EY0C))]
    pub c: f32,
}

const COLUMNS: usize = Table::NAMES.len();

/// What is known after some samples.
pub type Fit = Factor<f32, COLUMNS>;

/// Takes a reading, mm, at an angle, rad.
///
/// # Errors
/// A number is not finite.
pub fn push(fit: &mut Fit, c: f32, reading: f32) -> Result<(), Rejected> {
    let mut row = SVector::<f32, COLUMNS>::zeros();
    for (at, regressor) in Table::ALONG_X.into_iter().zip(Table::along_x(150.0, c)) {
        if let Some(place) = row.get_mut(at) {
            *place = regressor;
        }
    }
    fit.push(&row, reading)
}

/// EXC at an angle, rad: mm.
///
/// # Errors
/// The samples do not determine it.
pub fn exc(fit: &Fit, c: f32) -> Result<f32, SolveError<COLUMNS>> {
    let solution = fit.solve()?;
    Ok(Table::exc(150.0, c).iter().zip(&solution.coefficients).map(|(basis, factor)| basis * factor).sum())
}

/// Stops.
#[cfg(feature = "standalone")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_finds_the_function() {
        let function = |c: f32| 1e-6 * Table::exc(150.0, c)[1];
        let mut fit = Fit::new();
        for i in 0..90_u8 {
            let c = (4.0 * f32::from(i)).to_radians();
            push(&mut fit, c, -function(c) + 0.001 * c.cos()).unwrap();
        }
        let found = exc(&fit, 1.0).unwrap();
        assert!((found - function(1.0)).abs() < 1e-6, "{found:e} is {:e}", function(1.0));
    }
}
