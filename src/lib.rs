//! Trunnion derives, fits and embeds the measurement models of multi-axis machine tools.
//!
//! From the files of an instrument to a report: the model says what each run reads, the fit finds the machine's errors in the
//! readings, the report gives them with their uncertainty and what to be wary of.
//!
//! ```
//! use trunnion::{Estimator, Setup, data, study};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # std::env::set_current_dir("tests/reference/tilting-table/full")?;
//! let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)])?;
//! let runs = [("tilting", "tilting.csv"), ("separation", "separation.csv")];
//! let observations = data::observations(&setup, &runs, Some("table.csv".as_ref()))?;
//! let fit = study::fit(&setup, &observations, Estimator::Joint)?;
//! let report = study::report(&setup, &observations, &fit, study::ErrorLimits::PAPER, &study::Instrument::default(), false)?;
//! println!("{report}");
//!
//! let eps_xa = &report.functions[0];
//! assert_eq!((eps_xa.name.as_str(), eps_xa.unit, eps_xa.points.len()), ("eps_xa", data::Unit::Urad, 73));
//! # Ok(())
//! # }
//! ```
//!
//! A model of one's own is read by [`Setup::from_description`]; [`trunnion_codegen`] describes, derives and prints models, and
//! [`trunnion_solver`] fits them in a controller, without heap and without `std`.
//!
//! | to | see |
//! |---|---|
//! | read and write measurement files | [`data`] |
//! | read the files of instruments | [`import`] |
//! | fit, report, simulate, study | [`study`] |
//! | say what intended runs would tell, and which others would tell more | [`study::plan`] |
//! | evaluate a circular test as ISO 230-4 does | [`circular`] |
//! | begin a measurement: project file and measuring plan | [`project`] |
//! | write the NC program of a run | [`program`] |
//! | write compensation tables for controls | [`export`] |
//! | say what has changed between reports | [`history`] |
//! | draw readings, estimates, rings as SVG | [`plot`] |
//! | hand results to a program as JSON | [`document`] |
//! | make a page of a fit that one hands over | [`report`] |
//! | measure on a parallel machine of Exechon type | [`exechon`] |
//!
//! Lengths are in mm and angles in rad wherever a name or a [`data::Unit`] does not say otherwise.

pub mod circular;
pub mod data;
pub mod document;
pub mod exechon;
pub mod export;
pub mod history;
pub mod import;
pub mod plot;
pub mod program;
pub mod project;
pub mod report;
mod roundness;
pub mod study;

pub use study::{Estimator, Setup};
