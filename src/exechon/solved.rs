//! Poses and joints, solved one at a time: of a program, or of a file.

use super::PointError;
use super::input::{InputError, JOINTS, POSES, Rows};
use trunnion_solver::exechon::{Frame, Joints, KinematicsError, Machine, Pose, Start, Target, Tilted};

/// Coordinates of points and directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinates {
    /// Of the base: between the outer gimbals, z towards the platform.
    Base,
    /// Of the machine: the tool's at home.
    Machine,
}

/// A tool point and direction with the pose that has them.
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

/// A machine that goes from pose to pose.
#[derive(Clone, Debug)]
pub struct Path<'a> {
    machine: &'a Machine<f64>,
    frame: Frame<f64>,
    coordinates: Coordinates,
    tilted: Tilted,
    start: Start<f64>,
}

impl<'a> Path<'a> {
    /// At home.
    pub fn new(machine: &'a Machine<f64>, coordinates: Coordinates, tilted: Tilted) -> Self {
        Self { machine, frame: machine.frame(), coordinates, tilted, start: machine.home().start() }
    }

    /// Coordinates of its points and directions.
    pub fn coordinates(&self) -> Coordinates {
        self.coordinates
    }

    /// The pose of a tool point (mm) and direction: from the pose before, else from home. Of one that is refused nothing stays.
    ///
    /// # Errors
    /// [`PointError`]
    pub fn inverse(&mut self, point: [f64; 3], direction: [f64; 3]) -> Result<SolvedPose, PointError> {
        let target = match self.coordinates {
            Coordinates::Base => Target::new(point, direction)?,
            Coordinates::Machine => {
                Target::new(self.frame.point_to_base(point), self.frame.direction_to_base(direction))?
            }
        };
        let (machine, home) = (self.machine, self.machine.home().start());
        let near = machine.inverse(&target, &self.start).or_else(|_| machine.inverse(&target, &home));
        // Near A = 0 a pose may have all its solutions on the other branch.
        let pose = near.or_else(|problem| match problem {
            KinematicsError::NoConvergence { .. } => {
                machine.inverse(&target, &Start { branch: home.branch.other(), ..home }).map_err(|_| problem)
            }
            _ => Err(problem),
        })?;
        let rotation = machine.dependent_rotation(&pose, self.tilted)?;
        self.start = pose.start();
        Ok(SolvedPose { point, direction, pose, rotation })
    }

    /// The pose of struts (mm) and axes (rad), from home.
    ///
    /// # Errors
    /// [`PointError`]
    pub fn forward(&self, joints: &Joints<f64>) -> Result<SolvedPose, PointError> {
        let pose = self.machine.forward(joints, &self.machine.home().start())?;
        let rotation = self.machine.dependent_rotation(&pose, self.tilted)?;
        let (point, direction) = match self.coordinates {
            Coordinates::Base => (pose.point, *pose.direction()),
            Coordinates::Machine => {
                (self.frame.point_from_base(pose.point), self.frame.direction_from_base(*pose.direction()))
            }
        };
        Ok(SolvedPose { point, direction, pose, rotation })
    }
}

/// Inverse kinematics of a file of poses (`x_mm,y_mm,z_mm,i,j,k`), each from the one before, else from home.
///
/// # Errors
/// [`InputError`] for the file, and then for each line that has no pose.
pub fn inverse(
    machine: &Machine<f64>,
    file: &std::path::Path,
    coordinates: Coordinates,
    tilted: Tilted,
) -> Result<impl Iterator<Item = Result<SolvedPose, InputError>>, InputError> {
    let mut rows = Rows::open(file, POSES)?;
    let mut path = Path::new(machine, coordinates, tilted);
    Ok(std::iter::from_fn(move || {
        let row = rows.next()?;
        Some(row.map_err(InputError::from).and_then(|(line, [x, y, z, i, j, k])| {
            path.inverse([x, y, z], [i, j, k]).map_err(|problem| rows.refuse(line, problem))
        }))
    }))
}

/// Forward kinematics of a file of joints (`l1_mm,l2_mm,l3_mm,a_deg,c_deg`), each from home.
///
/// # Errors
/// As [`inverse`].
pub fn forward(
    machine: &Machine<f64>,
    file: &std::path::Path,
    coordinates: Coordinates,
    tilted: Tilted,
) -> Result<impl Iterator<Item = Result<SolvedPose, InputError>>, InputError> {
    let mut rows = Rows::open(file, JOINTS)?;
    let path = Path::new(machine, coordinates, tilted);
    Ok(std::iter::from_fn(move || {
        let row = rows.next()?;
        Some(row.map_err(InputError::from).and_then(|(line, [l1, l2, l3, a, c])| {
            path.forward(&Joints { struts: [l1, l2, l3], a, c }).map_err(|problem| rows.refuse(line, problem))
        }))
    }))
}
