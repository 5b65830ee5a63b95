//! What is asked for.

use crate::commands::predicted::{Measuring, range};
use clap::Args;

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct PlanArguments {
    /// A name from the catalogue, or a model file.
    pub model: String,
    /// Nominal lengths of the ball-bar to compare, mm; 100, 150 and 300 if none is given.
    #[arg(long, value_name = "MM", value_delimiter = ',', num_args = 1.., allow_negative_numbers = true)]
    pub radius: Vec<f64>,
    /// Another length of the set-up, mm.
    #[arg(long = "set", value_name = "NAME=MM")]
    pub lengths: Vec<String>,
    /// Ranges of the sweeps to compare, degrees; the full turn, -20:200 and -90:90 if none is given.
    #[arg(long, value_name = "A:B", num_args = 1.., value_parser = range, allow_hyphen_values = true)]
    pub range_deg: Vec<(f64, f64)>,
    /// A run to leave out, several joined by commas to leave them out together; each run in turn if none is given.
    #[arg(long, value_name = "RUN", num_args = 1..)]
    pub without: Vec<String>,
    #[command(flatten)]
    pub measuring: Measuring,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}
