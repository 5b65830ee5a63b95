//! A machine of one's own in a library without the standard library: the state of a fit in memory of the caller's.
#![no_std]

use trunnion_solver::Machine;
use trunnion_solver::lstsq::Rejected;
use trunnion_solver::model::ImpossibleLength;

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

/// What is known after some samples.
pub type Fit = TableJoint<f32>;

/// No samples yet, of a bar of 150 mm.
///
/// # Errors
/// None for this bar.
pub fn start() -> Result<Fit, ImpossibleLength> {
    Table::fit(TableLengths { r: 150.0 })
}

/// Takes a reading, mm, at an angle, rad.
///
/// # Errors
/// A number is not finite.
pub fn push(fit: &mut Fit, c: f32, reading: f32) -> Result<(), Rejected> {
    fit.push_along_x(c, reading)
}

/// EXC at an angle, rad: mm; `None` if the samples do not determine it.
pub fn exc(fit: &Fit, c: f32) -> Option<f32> {
    let (value, _) = fit.solve().ok()?.exc(c).ok()?;
    Some(value)
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
        let mut fit = start().unwrap();
        for i in 0..90_u8 {
            let c = (4.0 * f32::from(i)).to_radians();
            push(&mut fit, c, -function(c) + 0.001 * c.cos()).unwrap();
        }
        let found = exc(&fit, 1.0).unwrap();
        assert!((found - function(1.0)).abs() < 1e-6, "{found:e} is {:e}", function(1.0));
    }
}
