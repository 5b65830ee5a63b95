//! What an instrument reads exactly, against the product of all 4×4 matrices, T(1) to T(3), at one sample after another.

use super::numbers::{derived, millimetres, uniform};
use nalgebra::{Matrix4, Point3, Rotation3, Unit, Vector3};
use trunnion_codegen::algebra::{ErrorId, Poly, at};
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::ids::AxisId;
use trunnion_codegen::kinematics::ErrorValues;
use trunnion_codegen::measurement::ExactReading;
use trunnion_codegen::model::{AxisKind, Ball, Model, ReadingKind, Run};

/// A machine as bad as none is, so that products of many errors count.
struct Bad;

impl ErrorValues for Bad {
    fn value(&self, error: ErrorId, coordinate: f64) -> f64 {
        let phase = error.index() as f64;
        1e-2 * (0.02 * coordinate + phase).sin()
    }
}

fn number(p: &Poly, model: &Model, sweep: f64) -> f64 {
    at(p, &model.alphabet, sweep, millimetres)
}

fn vector(of: &[Poly; 3], model: &Model, sweep: f64) -> Vector3<f64> {
    Vector3::from_fn(|i, _| number(&of[i], model, sweep))
}

/// The matrix of six small errors X Y Z A B C, of which some are left out.
fn small(errors: [Option<ErrorId>; 6], coordinate: f64, run: &Run) -> Matrix4<f64> {
    let [x, y, z, a, b, c] = errors
        .map(|error| error.filter(|e| !run.left_out.contains(e)).map_or(0.0, |error| Bad.value(error, coordinate)));
    Matrix4::new(1.0, -c, b, x, c, 1.0, -a, y, -b, a, 1.0, z, 0.0, 0.0, 0.0, 1.0)
}

fn ball(model: &Model, run: &Run, tool: bool, of: &Ball, sweep: f64) -> Point3<f64> {
    let mut product = Matrix4::identity();
    for (i, axis) in model.axes().enumerate().filter(|(i, _)| (*i >= model.workpiece.len()) == tool) {
        let Some(coordinate) = run.at[AxisId::from(i)].poly().map(|p| number(p, model, sweep)) else { continue };
        let direction = vector(&axis.direction, model, 0.0);
        let location = small(axis.location, 0.0, run);
        let motion = small(axis.motion.map(Some), coordinate, run);
        product *= match axis.kind {
            AxisKind::Rotary => {
                let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(direction), coordinate);
                location * motion * turn.to_homogeneous()
            }
            AxisKind::Linear => location * Matrix4::new_translation(&(coordinate * direction)) * motion,
        };
    }
    let setup = of.setup.map_or(Vector3::zeros(), |s| Vector3::from_fn(|i, _| Bad.value(s[i], 0.0)));
    product.transform_point(&Point3::from(vector(&of.at, model, sweep) + setup))
}

#[test]
fn readings_are_those_of_full_products_of_matrices() {
    for (name, _) in MODELS {
        let (model, _) = derived(name);
        for (i, run) in model.runs.iter_enumerated().filter(|(_, run)| run.nuisance.is_empty()) {
            // More than two blocks, the last one not full.
            let sweeps = uniform(usize::from(i) as u64 + 7, -3.2, 6.4, 150);
            let exact: Vec<f64> = ExactReading::new(&model, run, &sweeps, &millimetres).values(&Bad).collect();
            assert_eq!(exact.len(), sweeps.len());
            for (&sweep, reading) in sweeps.iter().zip(exact) {
                let tool = ball(&model, run, true, &run.tool_ball, sweep);
                let v = tool - ball(&model, run, false, &run.workpiece_ball, sweep);
                let expected = match &run.reading {
                    ReadingKind::BarLength(radius) => v.norm() - millimetres(&model.alphabet.nominal_name(*radius)),
                    ReadingKind::Displacement(direction) => vector(direction, &model, sweep).dot(&v),
                };
                // The balls are some hundred millimetres from the machine's origin.
                assert!((reading - expected).abs() < 1e-12 * 300.0, "{name}, {}: {reading} {expected}", run.name);
            }
        }
    }
}
