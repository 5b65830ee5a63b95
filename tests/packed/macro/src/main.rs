//! A machine of one's own by macro: a fit finds what its readings were made from.

use std::error::Error;
use trunnion_solver::lstsq::Factor;
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
    pub c: f64,
}

const COLUMNS: usize = Table::NAMES.len();

fn main() -> Result<(), Box<dyn Error>> {
    let truth = SVector::<f64, COLUMNS>::from_fn(|i, _| 1e-6 * (i + 1) as f64);
    let mut fit = Factor::<f64, COLUMNS>::new();
    for i in 0..90 {
        let c = (4.0 * f64::from(i)).to_radians();
        let mut row = SVector::<f64, COLUMNS>::zeros();
        for (at, regressor) in Table::ALONG_X.into_iter().zip(Table::along_x(150.0, c)) {
            row[at] = regressor;
        }
        fit.push(&row, row.dot(&truth))?;
    }
    let found = fit.solve()?.coefficients;
    for ((name, found), truth) in Table::NAMES.iter().zip(&found).zip(&truth) {
        println!("{name} = {found:.3e}");
        assert!((found - truth).abs() < 1e-12, "{name} is {truth:.3e}");
    }
    Ok(())
}
