//! Poses and joints of a file, solved one line at a time.

use super::PointError;
use super::input::{InputError, JOINTS, POSES, Rows};
use std::path::Path;
use trunnion_solver::exechon::{Joints, KinematicsError, Machine, Pose, Start, Target, Tilted};

/// Coordinates of points and directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Of the base: between the outer gimbals, z towards the platform.
    Base,
    /// Of the machine: the tool's at home.
    Machine,
}

/// A line of a file, solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolvedPose {
    /// The tool point in the coordinates asked for, mm.
    pub point: [f64; 3],
    /// The tool's direction in the same.
    pub direction: [f64; 3],
    /// Struts, axes and platform.
    pub pose: Pose<f64>,
    /// The dependent rotation, rad.
    pub rotation: f64,
}

/// Inverse kinematics of a file of poses (`x_mm,y_mm,z_mm,i,j,k`), each from the one before, else from home.
///
/// # Errors
/// [`InputError`] for the file, and then for each line that has no pose.
pub fn inverse(
    machine: &Machine<f64>,
    file: &Path,
    coordinates: Coordinates,
    tilted: Tilted,
) -> Result<impl Iterator<Item = Result<SolvedPose, InputError>>, InputError> {
    let to_base = machine.frame();
    let mut rows = Rows::open(file, POSES)?;
    let mut start = machine.home().start();
    Ok(std::iter::from_fn(move || {
        let row = rows.next()?;
        Some(row.map_err(InputError::from).and_then(|(line, [x, y, z, i, j, k])| {
            let (point, direction) = ([x, y, z], [i, j, k]);
            let target = match coordinates {
                Coordinates::Base => (point, direction),
                Coordinates::Machine => (to_base.point_to_base(point), to_base.direction_to_base(direction)),
            };
            let solved = near(machine, target, &start, tilted);
            let (pose, rotation) = solved.map_err(|problem| rows.refuse(line, problem))?;
            start = pose.start();
            Ok(SolvedPose { point, direction, pose, rotation })
        }))
    }))
}

fn near(
    machine: &Machine<f64>,
    (point, direction): ([f64; 3], [f64; 3]),
    start: &Start<f64>,
    tilted: Tilted,
) -> Result<(Pose<f64>, f64), PointError> {
    let target = Target::new(point, direction)?;
    let home = machine.home().start();
    let near = machine.inverse(&target, start).or_else(|_| machine.inverse(&target, &home));
    // Near A = 0 a pose may have all its solutions on the other branch.
    let pose = near.or_else(|problem| match problem {
        KinematicsError::NoConvergence { .. } => {
            machine.inverse(&target, &Start { branch: home.branch.other(), ..home }).map_err(|_| problem)
        }
        _ => Err(problem),
    })?;
    Ok((pose, machine.dependent_rotation(&pose, tilted)?))
}

/// Forward kinematics of a file of joints (`l1_mm,l2_mm,l3_mm,a_deg,c_deg`), each from home.
///
/// # Errors
/// As [`inverse`].
pub fn forward(
    machine: &Machine<f64>,
    file: &Path,
    coordinates: Coordinates,
    tilted: Tilted,
) -> Result<impl Iterator<Item = Result<SolvedPose, InputError>>, InputError> {
    let (frame, start) = (machine.frame(), machine.home().start());
    let mut rows = Rows::open(file, JOINTS)?;
    Ok(std::iter::from_fn(move || {
        let row = rows.next()?;
        Some(row.map_err(InputError::from).and_then(|(line, [l1, l2, l3, a, c])| {
            let solved = machine
                .forward(&Joints { struts: [l1, l2, l3], a, c }, &start)
                .map_err(PointError::from)
                .and_then(|pose| Ok((pose, machine.dependent_rotation(&pose, tilted)?)));
            let (pose, rotation) = solved.map_err(|problem| rows.refuse(line, problem))?;
            let (point, direction) = match coordinates {
                Coordinates::Base => (pose.point, *pose.direction()),
                Coordinates::Machine => {
                    (frame.point_from_base(pose.point), frame.direction_from_base(*pose.direction()))
                }
            };
            Ok(SolvedPose { point, direction, pose, rotation })
        }))
    }))
}
