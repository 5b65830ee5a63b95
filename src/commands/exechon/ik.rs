//! `trunnion exechon ik`: from poses to struts and axes, one line at a time.

use super::ExechonRefused;
use super::arguments::{FrameName, TiltedName, Which, degrees};
use crate::commands::output::{Picture, Spool};
use clap::Args;
use std::path::PathBuf;
use trunnion::exechon::{inverse, machine_picture};

/// Arguments of `ik`.
#[derive(Debug, Args)]
pub struct IkArguments {
    /// Poses: CSV with the columns x_mm,y_mm,z_mm,i,j,k (tool point, tool direction); `-` reads standard input.
    ///
    /// Lines are read one at a time, in constant memory, and shown once all of them are solved: after a bad line there is
    /// nothing on standard output and the exit code is 2.
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

impl IkArguments {
    /// Solves and shows.
    pub fn run(self) -> Result<(), ExechonRefused> {
        let machine = self.which.read()?;
        let mut first = None;
        let mut spool = Spool::new();
        spool.line(format_args!("x_mm,y_mm,z_mm,l1_mm,l2_mm,l3_mm,a_deg,c_deg,drm_deg,iterations"))?;
        for solved in inverse(&machine, &self.file, self.frame.into(), self.tilted.into())? {
            let solved = solved?;
            let ([x, y, z], joints) = (solved.point, solved.pose.joints);
            let ([l1, l2, l3], [a, c, drm]) = (joints.struts, [joints.a, joints.c, solved.rotation].map(degrees));
            spool.line(format_args!("{x},{y},{z},{l1},{l2},{l3},{a},{c},{drm},{}", solved.pose.iterations))?;
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
