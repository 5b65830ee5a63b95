//! A machine of one's own by a build script: a fit finds the function that its readings were made from.

use std::error::Error;

mod rotary_table {
    include!(concat!(env!("OUT_DIR"), "/rotary-table.rs"));
}

fn main() -> Result<(), Box<dyn Error>> {
    let truth = |c: f64| 1e-6 * rotary_table::exc(150.0, c).iter().sum::<f64>();
    let mut fit = rotary_table::Joint::new(rotary_table::Lengths { r: 150.0 })?;
    for i in 0..90 {
        let c = (4.0 * f64::from(i)).to_radians();
        fit.push_along_x(c, -truth(c) - 0.01 * c.cos())?;
    }
    let (exc, std) = fit.solve()?.exc(0.5)?;
    println!("EXC(0.5) = {exc:.3e} mm, standard deviation {std:.0e}");
    assert!((exc - truth(0.5)).abs() < 1e-12, "EXC(0.5) is {:e}", truth(0.5));
    Ok(())
}
