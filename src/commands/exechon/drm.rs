//! `trunnion exechon drm`: the dependent rotation of poses, over the workspace, around a ring.

use super::ExechonRefused;
use super::arguments::{FrameName, TiltedName, Which, degrees};
use crate::commands::number;
use crate::commands::output::{Picture, Spool, print};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use trunnion::exechon::{Compensation, drm_map, inverse, quintic_picture};

/// Arguments of `drm`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("what").required(true).args(["file", "map", "ring"]))]
pub struct DrmArguments {
    /// Poses: CSV with the columns x_mm,y_mm,z_mm,i,j,k; `-` reads standard input.
    #[arg(conflicts_with = "svg")]
    file: Option<PathBuf>,
    /// Coordinates of points and directions.
    #[arg(long, value_enum, default_value_t = FrameName::Machine, conflicts_with_all = ["map", "ring"])]
    frame: FrameName,
    /// What drm_deg is counted from where the tool is tilted.
    #[arg(long, value_enum, default_value_t = TiltedName::Projected, conflicts_with_all = ["map", "ring"])]
    tilted: TiltedName,
    /// Draws φ over x and y, in machine coordinates with the tool as at home, at this z (SVG to --svg).
    #[arg(long, value_name = "Z_MM", allow_hyphen_values = true, requires = "svg", value_parser = number::position)]
    map: Option<f64>,
    /// Half the side of the map, mm.
    #[arg(long, value_name = "MM", default_value_t = 500.0, conflicts_with_all = ["file", "ring"], value_parser = number::length, allow_negative_numbers = true)]
    reach: f64,
    /// Fits the quintic E(10) around a ring: its centre in machine coordinates.
    #[arg(long, value_name = "X,Y,Z", value_parser = number::positions::<3>, allow_hyphen_values = true)]
    ring: Option<[f64; 3]>,
    /// The ring's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 40.001, conflicts_with_all = ["file", "map"], value_parser = number::length, allow_negative_numbers = true)]
    diameter: f64,
    /// The stylus ball's diameter, mm.
    #[arg(long, value_name = "MM", default_value_t = 6.0, conflicts_with_all = ["file", "map"], value_parser = number::size, allow_negative_numbers = true)]
    stylus: f64,
    /// Touches that the quintic is fitted to.
    #[arg(long, default_value_t = 36, conflicts_with_all = ["file", "map"], value_parser = number::count::<7, 10_000>, allow_negative_numbers = true)]
    touches: u32,
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    which: Which,
}

impl DrmArguments {
    /// Computes and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        let machine = self.which.read()?;
        if let Some(file) = &self.file {
            let mut spool = Spool::new();
            spool.line(format_args!("x_mm,y_mm,z_mm,drm_deg"))?;
            for solved in inverse(&machine, file, self.frame.into(), self.tilted.into())? {
                let solved = solved?;
                let [x, y, z] = solved.point;
                spool.line(format_args!("{x},{y},{z},{}", degrees(solved.rotation)))?;
            }
            return Ok(spool.show()?);
        }
        if let Some(z) = self.map {
            let range = (-self.reach, self.reach);
            return self.picture.draw(self.which.inputs(), || Ok(drm_map(&machine, z, range, range, &[])?));
        }
        let Some(centre) = self.ring else {
            return Ok(());
        };
        let radius = (self.diameter - self.stylus) / 2.0;
        if radius <= 0.0 {
            return Err(ExechonRefused::Option(
                "stylus",
                "as large as the ring\n  expected a ball smaller than --diameter",
            ));
        }
        let quintic = Compensation::fit(&machine, centre, radius, self.touches)?;
        self.picture.draw(self.which.inputs(), || Ok::<_, ExechonRefused>(quintic_picture(&machine, &quintic)?))?;
        let report = json!({
            "centre_mm": quintic.centre,
            "path_radius_mm": quintic.radius,
            "coefficients_deg_per_rad_to_n": quintic.coefficients.map(f64::to_degrees),
            "largest_deviation_at_touches_deg": quintic.at_touches.to_degrees(),
            "largest_deviation_anywhere_deg": quintic.anywhere.to_degrees(),
        });
        Ok(print(&format!("{report:#}\n"))?)
    }
}
