//! The tilting table measured with a ball-bar: the paper's two runs fitted sample by sample.
//!
//! All of it is printed by `trunnion-codegen` from the catalogue's `tilting-table-a`, as it would be for any other machine:
//! the rows of T(7) and T(9), the basis of ε_xa T(10), and the estimators. [`Joint`] takes both runs in one problem; [`TwoStep`]
//! goes the paper's way: the linear axes from run 2, then run 1 with what it gave. Angles in rad, lengths and readings in mm.
//!
//! ```
//! use trunnion_solver::tilting::{Joint, Lengths};
//!
//! let mut fit = Joint::new(Lengths { r: 150.0 })?;
//! for i in 0..360 {
//!     let a = f64::from(i).to_radians();
//!     fit.push_tilting(a, 0.002 * a.sin(), 0.0, 0.0)?;
//!     fit.push_separation(a, 0.001 * a.cos())?;
//! }
//! let (eps_xa, std) = fit.solve()?.e_xa(1.0)?;
//! assert!(eps_xa.abs() < 1e-12 && std < 1e-9);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

include!(concat!(env!("OUT_DIR"), "/tilting_table_a.rs"));
