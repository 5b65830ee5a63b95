//! `trunnion exechon plan`: where to touch a feature, with which spindle angle.

use super::ExechonRefused;
use super::arguments::{Which, numbers};
use super::spool::{Spool, print};
use clap::{Args, ValueEnum};
use trunnion::exechon::{Feature, plan, ring_program};

/// Arguments of `plan`.
#[derive(Debug, Args)]
pub struct TouchPlanArguments {
    /// What is measured.
    #[arg(value_enum)]
    feature: FeatureName,
    /// Its centre in machine coordinates, mm.
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    centre: [f64; 3],
    /// Diameter of a ring or sphere, side of a plane's grid, mm.
    #[arg(long, value_name = "MM")]
    size: f64,
    /// The stylus ball's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 6.0)]
    stylus: f64,
    /// Distance before the surface at which the measuring feed begins, mm.
    #[arg(long, value_name = "MM", default_value_t = 2.0)]
    clearance: f64,
    /// Touches around a circle or along a side: 36 for a ring, else 4.
    #[arg(long)]
    touches: Option<u32>,
    /// Rings of a sphere.
    #[arg(long, default_value_t = 3)]
    rings: u32,
    /// Repeats in the NC program.
    #[arg(long, default_value_t = 5)]
    repeats: u32,
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
        let machine = self.which.read()?;
        let (centre, radius) = (self.centre, self.size / 2.0);
        let touches = self.touches.unwrap_or(if self.feature == FeatureName::Ring { 36 } else { 4 });
        let feature = match self.feature {
            FeatureName::Ring => Feature::Ring { centre, radius, touches },
            FeatureName::Plane => Feature::Plane { centre, side: self.size, touches },
            FeatureName::Sphere => Feature::Sphere { centre, radius, touches, rings: self.rings },
        };
        let ball = self.stylus / 2.0;
        let touched = plan(&machine, &feature, ball, self.clearance)?;
        match self.format {
            Format::Csv => {
                let mut spool = Spool::new()?;
                spool.line(format_args!("from_x_mm,from_y_mm,from_z_mm,x_mm,y_mm,z_mm,spindle_deg"))?;
                for touch in &touched {
                    let ([a, b, c], [x, y, z]) = (touch.from, touch.at);
                    spool.line(format_args!("{a},{b},{c},{x},{y},{z},{}", turn(touch.spindle)))?;
                }
                spool.show()
            }
            Format::Json => {
                let touches = touched.iter().map(|touch| {
                    serde_json::json!({
                        "from_mm": touch.from, "at_mm": touch.at, "spindle_deg": turn(touch.spindle),
                    })
                });
                print(&format!("{:#}\n", serde_json::Value::from_iter(touches)))
            }
            Format::Sinumerik if self.feature == FeatureName::Ring => {
                print(&ring_program(&machine, centre, radius, ball, touches, self.repeats, self.clearance)?)
            }
            Format::Sinumerik => {
                Err(ExechonRefused::Option("format", "NC programs are written for rings only: use csv or json"))
            }
        }
    }
}

/// A spindle angle as a control takes it, 0° to 360°.
fn turn(angle: f64) -> f64 {
    angle.to_degrees().rem_euclid(360.0)
}
