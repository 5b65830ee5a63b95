//! `trunnion exechon fk`: from struts and axes to poses, one line at a time.

use super::ik::degrees;
use super::spool::{Spool, picture};
use super::{Failed, FrameName, TiltedName, Which};
use clap::Args;
use std::path::PathBuf;
use trunnion::exechon::{PointError, machine_picture, rows};
use trunnion_solver::exechon::Joints;

/// Arguments of `fk`.
#[derive(Debug, Args)]
pub struct Fk {
    /// Joints: CSV with the columns l1_mm,l2_mm,l3_mm,a_deg,c_deg; `-` reads standard input.
    file: PathBuf,
    /// Coordinates of points and directions.
    #[arg(long, value_enum, default_value_t = FrameName::Machine)]
    frame: FrameName,
    /// What drm_deg is counted from where the tool is tilted.
    #[arg(long, value_enum, default_value_t = TiltedName::Projected)]
    tilted: TiltedName,
    /// Draws the machine in the first pose (SVG).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    which: Which,
}

impl Fk {
    /// Solves and shows.
    pub fn run(self) -> Result<(), Failed> {
        let machine = self.which.read()?;
        let (frame, start) = (machine.frame(), machine.home().start());
        let mut lines = rows(&self.file, ["l1_mm", "l2_mm", "l3_mm", "a_deg", "c_deg"], [])?;
        let mut first = None;
        let mut spool = Spool::new()?;
        spool.line(format_args!("x_mm,y_mm,z_mm,i,j,k,drm_deg,iterations"))?;
        while let Some(row) = lines.next() {
            let row = row?;
            let [l1, l2, l3, a, c] = row.values;
            let joints = Joints { struts: [l1, l2, l3], a: a.to_radians(), c: c.to_radians() };
            let solved = machine
                .forward(&joints, &start)
                .map_err(PointError::from)
                .and_then(|pose| Ok((pose, machine.dependent_rotation(&pose, self.tilted.into())?)));
            let (pose, drm) = solved.map_err(|e| lines.refuse(row.line, e.to_string(), e.remedy()))?;
            let ([x, y, z], [i, j, k]) = match self.frame {
                FrameName::Base => (pose.point, *pose.direction()),
                FrameName::Machine => (frame.point_from_base(pose.point), frame.direction_from_base(*pose.direction())),
            };
            spool.line(format_args!("{x},{y},{z},{i},{j},{k},{},{}", degrees(drm), pose.iterations))?;
            first.get_or_insert(pose);
        }
        if let Some(pose) = first {
            picture(self.svg.as_deref(), || Ok(machine_picture(&machine, &pose, "The machine at the first pose")?))?;
        }
        spool.show()
    }
}
