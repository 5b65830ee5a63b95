//! A machine of one's own by macro: a fit finds the function that its readings were made from.

use std::error::Error;
use trunnion_solver::Machine;

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
    pub c: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let truth = |c: f64| 1e-6 * Table::exc(150.0, c).iter().sum::<f64>();
    let mut fit = Table::fit(TableLengths { r: 150.0 })?;
    for i in 0..90 {
        let c = (4.0 * f64::from(i)).to_radians();
        // The bar shortens where the table's centre comes nearer; w_x turns along.
        fit.push_along_x(c, -truth(c) - 0.01 * c.cos())?;
    }
    let (exc, std) = fit.solve()?.exc(0.5)?;
    println!("EXC(0.5) = {exc:.3e} mm, standard deviation {std:.0e}");
    assert!((exc - truth(0.5)).abs() < 1e-12, "EXC(0.5) is {:e}", truth(0.5));
    Ok(())
}
