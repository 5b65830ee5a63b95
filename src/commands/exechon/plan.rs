//! `trunnion exechon plan`: where to touch a feature, with which spindle angle.

use super::ExechonRefused;
use super::arguments::Which;
use crate::commands::number;
use crate::commands::output::{Spool, print};
use clap::{Args, ValueEnum};
use trunnion::exechon::{Feature, plan, ring_program};

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct TouchPlanArguments {
    /// What is measured.
    #[arg(value_enum)]
    feature: FeatureName,
    /// Its centre in machine coordinates, mm.
    #[arg(long, value_name = "X,Y,Z", value_parser = number::positions::<3>, allow_hyphen_values = true)]
    centre: [f64; 3],
    /// Diameter of a ring or sphere, side of a plane's grid, mm.
    #[arg(long, value_name = "MM", value_parser = number::length, allow_negative_numbers = true)]
    size: f64,
    /// The stylus ball's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 6.0, value_parser = number::length, allow_negative_numbers = true)]
    stylus: f64,
    /// Distance before the surface at which the measuring feed begins, mm.
    #[arg(long, value_name = "MM", default_value_t = 2.0, value_parser = number::length, allow_negative_numbers = true)]
    clearance: f64,
    /// Touches around a circle or along a side: 36 for a ring, else 4.
    #[arg(long, value_parser = number::count::<2, 1000>, allow_negative_numbers = true)]
    touches: Option<u32>,
    /// Rings of a sphere: 3 without it.
    #[arg(long, value_parser = number::count::<1, 1000>, allow_negative_numbers = true)]
    rings: Option<u32>,
    /// Repeats in the NC program: 5 without it.
    #[arg(long, value_parser = number::count::<1, 1000>, allow_negative_numbers = true)]
    repeats: Option<u32>,
    /// CSV, JSON, or an NC program (of a ring).
    #[arg(long, value_enum, default_value_t = Format::Csv)]
    format: Format,
    #[command(flatten)]
    which: Which,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum FeatureName {
    /// A bore or ring, from inside.
    Ring,
    /// A plane across the tool.
    Plane,
    /// The half of a ball that looks at the spindle.
    Sphere,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Csv,
    Json,
    /// SINUMERIK 840D sl, a template to edit.
    Sinumerik,
}

impl TouchPlanArguments {
    /// Plans and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        if self.rings.is_some() && self.feature != FeatureName::Sphere {
            return Err(ExechonRefused::Option("rings", "of no use here\n  expected it with a sphere, or not at all"));
        }
        if self.repeats.is_some() && self.format != Format::Sinumerik {
            let told = "of no use here\n  expected it with --format sinumerik, or not at all";
            return Err(ExechonRefused::Option("repeats", told));
        }
        let machine = self.which.read()?;
        let (centre, radius) = (self.centre, self.size / 2.0);
        let touches = self.touches.unwrap_or(if self.feature == FeatureName::Ring { 36 } else { 4 });
        let feature = match self.feature {
            FeatureName::Ring => Feature::Ring { centre, radius, touches },
            FeatureName::Plane => Feature::Plane { centre, side: self.size, touches },
            FeatureName::Sphere => Feature::Sphere { centre, radius, touches, rings: self.rings.unwrap_or(3) },
        };
        let ball = self.stylus / 2.0;
        let touched = plan(&machine, &feature, ball, self.clearance)?;
        match self.format {
            Format::Csv => {
                let mut spool = Spool::new();
                spool.line(format_args!("from_x_mm,from_y_mm,from_z_mm,x_mm,y_mm,z_mm,spindle_deg"))?;
                for touch in &touched {
                    let ([a, b, c], [x, y, z]) = (touch.from, touch.at);
                    spool.line(format_args!("{a},{b},{c},{x},{y},{z},{}", turn(touch.spindle)))?;
                }
                Ok(spool.show()?)
            }
            Format::Json => {
                let touches = touched.iter().map(|touch| {
                    serde_json::json!({
                        "from_mm": touch.from, "at_mm": touch.at, "spindle_deg": turn(touch.spindle),
                    })
                });
                Ok(print(&format!("{:#}\n", serde_json::Value::from_iter(touches)))?)
            }
            Format::Sinumerik if self.feature == FeatureName::Ring => Ok(print(&ring_program(
                &machine,
                centre,
                radius,
                ball,
                touches,
                self.repeats.unwrap_or(5),
                self.clearance,
            )?)?),
            Format::Sinumerik => {
                Err(ExechonRefused::Option("format", "NC programs are written for rings only\n  expected csv or json"))
            }
        }
    }
}

/// A spindle angle as a control takes it, 0° to 360°.
fn turn(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}
