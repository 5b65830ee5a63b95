//! What a drawn machine reads, by 4×4 products of dual numbers: each error in turn is the one with a derivative.

use super::dual::{Dual, Point, Transform, dot};
use super::machine::{Assumed, Axis, Ball, Machine, Reading, Run, SIDES, setup_names};
use super::wave::{LENGTHS, Ratio};
use nalgebra::{DMatrix, RowDVector};
use std::array::from_fn;
use std::collections::BTreeMap;

/// Derivatives below are zero, mm for 1 mm or 1 rad: what cancels leaves no more of lengths of some 100 mm.
const ROUNDING: f64 = 1e-11;

/// An error of the machine.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Error {
    /// The axis, the workpiece's side first, and the component.
    Location(usize, usize),
    Motion(usize, usize),
    /// The side, its set-up and the coordinate.
    Setup(usize, usize, usize),
}

/// A machine with all its parameters in a row: location and set-up errors, coefficients of motion errors.
pub struct Reference<'a> {
    pub machine: &'a Machine,
    errors: Vec<Error>,
    names: BTreeMap<String, usize>,
}

/// The linear reading at one value of the sweep: by parameters, and by known motion errors.
pub struct Linear {
    pub row: RowDVector<f64>,
    pub known: BTreeMap<String, f64>,
}

impl<'a> Reference<'a> {
    pub fn new(machine: &'a Machine) -> Self {
        let (mut errors, mut names) = (Vec::new(), Vec::new());
        for (i, axis) in machine.axes().enumerate() {
            for c in 0..6 {
                if axis.location[c] {
                    errors.push(Error::Location(i, c));
                    names.push(axis.location_name(c));
                }
                errors.push(Error::Motion(i, c));
                names.extend(axis.coefficients(c));
            }
        }
        for (side, prefix) in SIDES.into_iter().enumerate() {
            let mut setups: Vec<usize> = machine.runs.iter().filter_map(|r| r.balls[side].setup).collect();
            setups.sort_unstable();
            setups.dedup();
            for setup in setups {
                errors.extend((0..3).map(|c| Error::Setup(side, setup, c)));
                names.extend(setup_names(prefix, setup));
            }
        }
        let names = names.into_iter().enumerate().map(|(at, name)| (name, at)).collect();
        Self { machine, errors, names }
    }

    /// Number of parameters.
    pub fn width(&self) -> usize {
        self.names.len()
    }

    /// Where a parameter is.
    pub fn place(&self, name: &str) -> usize {
        self.names[name]
    }

    /// One parameter alone.
    pub fn unit(&self, name: &str) -> RowDVector<f64> {
        RowDVector::from_fn(self.width(), |_, j| if j == self.place(name) { 1.0 } else { 0.0 })
    }

    /// What the assumptions leave, a column for each parameter that stays: each gives its first, and none stands in two.
    pub fn within(&self) -> DMatrix<f64> {
        let mut all = DMatrix::identity(self.width(), self.width());
        let assumed = &self.machine.assumed;
        for Assumed { terms, .. } in assumed {
            let (first, own) = &terms[0];
            all[(self.place(first), self.place(first))] = 0.0;
            for (name, factor) in &terms[1..] {
                all[(self.place(first), self.place(name))] = -factor.value() / own.value();
            }
        }
        let gone: Vec<usize> = assumed.iter().map(|a| self.place(&a.terms[0].0)).collect();
        let kept: Vec<usize> = (0..self.width()).filter(|j| !gone.contains(j)).collect();
        all.select_columns(&kept)
    }

    /// The linear reading of a run, without the errors that are left out of it.
    pub fn linear(&self, run: &Run, sweep: f64, left_out: impl Fn(&str) -> bool) -> Linear {
        let mut linear = Linear { row: RowDVector::zeros(self.width()), known: BTreeMap::new() };
        for error in &self.errors {
            let axis = |i: usize| self.machine.axes().nth(i).expect("an axis of the machine");
            let derivative = |name: &str| {
                let derivative = if left_out(name) { 0.0 } else { self.reading(run, sweep, *error).derivative };
                rounded(derivative)
            };
            match *error {
                Error::Location(i, c) => {
                    let name = axis(i).location_name(c);
                    linear.row[self.place(&name)] = derivative(&name);
                }
                Error::Setup(side, setup, c) => {
                    let name = &setup_names(SIDES[side], setup)[c];
                    linear.row[self.place(name)] = derivative(name);
                }
                Error::Motion(i, c) => {
                    let (axis, name) = (axis(i), axis(i).motion_name(c));
                    let values = (axis.motion[c].at)(run.at[i].coordinate(sweep)).into_iter().map(rounded);
                    let values: Vec<f64> = values.collect();
                    if axis.motion[c].is_known() {
                        let factor = derivative(&name);
                        linear.known.insert(name, factor);
                    } else if !values.is_empty() {
                        let factor = derivative(&name);
                        for (coefficient, value) in axis.coefficients(c).zip(values) {
                            linear.row[self.place(&coefficient)] = factor * value;
                        }
                    }
                }
            }
        }
        linear
    }

    /// The reading with the derivative by one error, and what it is nominally checked.
    fn reading(&self, run: &Run, sweep: f64, error: Error) -> Dual {
        let machine = self.machine;
        let tool = machine.sides[0].len();
        let [there, here] = [(0, 0), (1, tool)].map(|(side, first)| {
            let mut point = ball(&run.balls[side], sweep, |c| {
                run.balls[side].setup.is_some_and(|setup| error == Error::Setup(side, setup, c))
            });
            for (k, axis) in machine.sides[side].iter().enumerate().rev() {
                let i = first + k;
                let seed =
                    |of: fn(usize, usize) -> Error| Transform::small(from_fn(|c| seeded(0.0, error == of(i, c))));
                let nominal = nominal(axis, run.at[i].coordinate(sweep));
                let (motion, location) = (seed(Error::Motion), seed(Error::Location));
                let moved = if axis.rotary { [&nominal, &motion] } else { [&motion, &nominal] };
                point = moved.into_iter().chain([&location]).fold(point, |p, transform| transform.apply(&p));
            }
            point
        });
        let apart: Point = from_fn(|i| here[i] - there[i]);
        match &run.reading {
            Reading::Bar => {
                let length = dot(&apart, &apart).sqrt();
                assert!((length.value - LENGTHS[0].1).abs() < 1e-9, "drawn off the bar: {}", length.value);
                length
            }
            Reading::Probe(direction) => {
                assert!(dot(&apart, &apart).value < 1e-18, "drawn apart");
                let along: Point = from_fn(|i| direction.get(i).map_or(0.0, |w| w.value(sweep)).into());
                dot(&along, &apart)
            }
        }
    }

    /// Base parameters or any other sums, named parameter by parameter, one a row.
    pub fn sums<'n>(&self, sums: impl Iterator<Item = Vec<(&'n str, f64)>>) -> DMatrix<f64> {
        let rows: Vec<RowDVector<f64>> = sums
            .map(|sum| {
                let mut row = RowDVector::zeros(self.width());
                sum.into_iter().for_each(|(name, factor)| row[self.place(name)] += factor);
                row
            })
            .collect();
        stacked(rows, self.width())
    }
}

pub fn stacked(rows: Vec<RowDVector<f64>>, width: usize) -> DMatrix<f64> {
    if rows.is_empty() { DMatrix::zeros(0, width) } else { DMatrix::from_rows(&rows) }
}

fn rounded(value: f64) -> f64 {
    if value.abs() < ROUNDING { 0.0 } else { value }
}

fn seeded(value: f64, seed: bool) -> Dual {
    Dual { value, derivative: if seed { 1.0 } else { 0.0 } }
}

fn ball(ball: &Ball, sweep: f64, seed: impl Fn(usize) -> bool) -> Point {
    from_fn(|c| ball.at.get(c).map_or(1.0.into(), |w| seeded(w.value(sweep), seed(c))))
}

fn nominal(axis: &Axis, coordinate: f64) -> Transform {
    let direction = axis.direction.map(Ratio::value);
    if axis.rotary { Transform::turn(direction, coordinate) } else { Transform::travel(direction, coordinate) }
}
