//! `trunnion exechon fk`: from struts and axes to poses, one line at a time.

use super::ExechonRefused;
use super::arguments::{FrameName, TiltedName, Which, degrees};
use crate::commands::output::{Picture, Spool};
use clap::Args;
use std::path::PathBuf;
use trunnion::exechon::{forward, machine_picture};

/// Arguments of `fk`.
#[derive(Debug, Args)]
pub struct FkArguments {
    /// Joints: CSV with the columns l1_mm,l2_mm,l3_mm,a_deg,c_deg; `-` reads standard input.
    file: PathBuf,
    /// Coordinates of points and directions.
    #[arg(long, value_enum, default_value_t = FrameName::Machine)]
    frame: FrameName,
    /// What drm_deg is counted from where the tool is tilted.
    #[arg(long, value_enum, default_value_t = TiltedName::Projected)]
    tilted: TiltedName,
    /// The machine in the first pose.
    #[command(flatten)]
    picture: Picture,
    #[command(flatten)]
    which: Which,
}

impl FkArguments {
    /// Solves and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        let machine = self.which.read()?;
        let mut first = None;
        let mut spool = Spool::new();
        spool.line(format_args!("x_mm,y_mm,z_mm,i,j,k,drm_deg,iterations"))?;
        for solved in forward(&machine, &self.file, self.frame.into(), self.tilted.into())? {
            let solved = solved?;
            let ([x, y, z], [i, j, k], drm) = (solved.point, solved.direction, degrees(solved.rotation));
            spool.line(format_args!("{x},{y},{z},{i},{j},{k},{drm},{}", solved.pose.iterations))?;
            first.get_or_insert(solved.pose);
        }
        if let Some(pose) = first {
            let inputs = self.which.inputs().chain([self.file.as_path()]);
            self.picture.draw(inputs, || {
                Ok::<_, ExechonRefused>(machine_picture(&machine, &pose, "The machine at the first pose")?)
            })?;
        }
        Ok(spool.show()?)
    }
}
