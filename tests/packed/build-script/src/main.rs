//! A machine of one's own by a build script: a fit finds what its readings were made from.

use std::error::Error;
use trunnion_solver::{lstsq::Factor, nalgebra::SVector};

mod rotary_table {
    include!(concat!(env!("OUT_DIR"), "/rotary-table.rs"));
}

const COLUMNS: usize = rotary_table::NAMES.len();

fn main() -> Result<(), Box<dyn Error>> {
    let truth = SVector::<f64, COLUMNS>::from_fn(|i, _| 1e-6 * (i + 1) as f64);
    let mut fit = Factor::<f64, COLUMNS>::new();
    for i in 0..90 {
        let c = (4.0 * f64::from(i)).to_radians();
        let mut row = SVector::<f64, COLUMNS>::zeros();
        for (at, regressor) in rotary_table::ALONG_X.into_iter().zip(rotary_table::along_x(150.0, c)) {
            row[at] = regressor;
        }
        fit.push(&row, row.dot(&truth))?;
    }
    let found = fit.solve()?.coefficients;
    for ((name, found), truth) in rotary_table::NAMES.iter().zip(&found).zip(&truth) {
        println!("{name} = {found:.3e}");
        assert!((found - truth).abs() < 1e-12, "{name} is {truth:.3e}");
    }
    Ok(())
}
