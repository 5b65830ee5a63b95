//! `trunnion exechon ik`: from poses to struts and axes, one line at a time.

use super::spool::{Spool, picture};
use super::{Failed, FrameName, TiltedName, Which};
use clap::Args;
use std::path::PathBuf;
use trunnion::exechon::{PointError, machine_picture, rows};
use trunnion_solver::exechon::{Machine, Pose, Start, Target, Tilted};

/// Columns of a pose file.
pub const POSE: [&str; 6] = ["x_mm", "y_mm", "z_mm", "i", "j", "k"];

/// Arguments of `ik`.
#[derive(Debug, Args)]
pub struct Ik {
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
    /// Draws the machine in the first pose (SVG).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    which: Which,
}

impl Ik {
    /// Solves and shows.
    pub fn run(self) -> Result<(), Failed> {
        let machine = self.which.read()?;
        let mut first = None;
        let mut spool = Spool::new()?;
        spool.line(format_args!("x_mm,y_mm,z_mm,l1_mm,l2_mm,l3_mm,a_deg,c_deg,drm_deg,iterations"))?;
        each_pose(&machine, &self.file, self.frame, self.tilted.into(), |[x, y, z], pose, drm| {
            first.get_or_insert(*pose);
            let ([l1, l2, l3], [a, c, drm]) = (pose.joints.struts, [pose.joints.a, pose.joints.c, drm].map(degrees));
            spool.line(format_args!("{x},{y},{z},{l1},{l2},{l3},{a},{c},{drm},{}", pose.iterations))
        })?;
        if let Some(pose) = first {
            picture(self.svg.as_deref(), || Ok(machine_picture(&machine, &pose, "The machine at the first pose")?))?;
        }
        spool.show()
    }
}

/// Degrees, without a negative zero.
pub fn degrees(angle: f64) -> f64 {
    angle.to_degrees() + 0.0
}

/// Solves the poses of a file, each from the one before, else from home.
pub fn each_pose(
    machine: &Machine<f64>,
    file: &std::path::Path,
    frame: FrameName,
    tilted: Tilted,
    mut each: impl FnMut([f64; 3], &Pose<f64>, f64) -> Result<(), Failed>,
) -> Result<(), Failed> {
    let to_base = machine.frame();
    let mut lines = rows(file, POSE, [])?;
    let mut start = machine.home().start();
    while let Some(row) = lines.next() {
        let row = row?;
        let [x, y, z, i, j, k] = row.values;
        let (point, direction) = match frame {
            FrameName::Base => ([x, y, z], [i, j, k]),
            FrameName::Machine => (to_base.point_to_base([x, y, z]), to_base.direction_to_base([i, j, k])),
        };
        let solved = solve(machine, point, direction, &start, tilted);
        let (pose, drm) = solved.map_err(|e| lines.refuse(row.line, e.to_string(), e.remedy()))?;
        start = pose.start();
        each([x, y, z], &pose, drm)?;
    }
    Ok(())
}

fn solve(
    machine: &Machine<f64>,
    point: [f64; 3],
    direction: [f64; 3],
    start: &Start<f64>,
    tilted: Tilted,
) -> Result<(Pose<f64>, f64), PointError> {
    let target = Target::new(point, direction)?;
    let near = machine.inverse(&target, start);
    let pose = near.or_else(|_| machine.inverse(&target, &machine.home().start()))?;
    Ok((pose, machine.dependent_rotation(&pose, tilted)?))
}
