//! Functions known beforehand, given as a table over the swept angle.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::columns::{SWEEP, Wanted, deviation};
use super::error::{BadLines, FieldProblem, FileError, FileProblem, LineProblem, Need};
use super::limits::SAMPLES;
use super::lines::Lines;
use super::output::{WriteError, WriteProblem, write_atomically};
use super::stamp::Stamp;
use super::sweep::Sweep;
use super::written::written;
use trunnion_codegen::quantity::Quantity;

/// Fewest steps of a table taken as going round.
const STEPS_OF_A_TURN: usize = 12;

/// Steps that differ by less than this share of a step count as equal: six printed decimals of a degree.
const EVEN: f64 = 1e-3;

/// A function a table has to give.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Known {
    /// Its name without a unit, such as `dya`.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
}

/// Functions over the swept angle, linear between nodes.
///
/// A table whose nodes go evenly round the whole turn, in at least 12 steps, the last node one step before the first
/// one's repetition (0°…359°) or at it (0°…360°), repeats: angles outside it are taken modulo a turn, and between the
/// last and the first node it is linear as well. Any other table ends at its first and last node.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    file: PathBuf,
    functions: Vec<Known>,
    /// Angles rise strictly; there are at least two; each has a value for each function.
    nodes: Vec<Node>,
    repeats: bool,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    angle_rad: f64,
    values: Vec<f64>,
    /// Standard uncertainties of the values.
    stds: Vec<f64>,
    line: u64,
}

/// A table's functions at one angle, in mm or rad.
#[derive(Clone, Debug, PartialEq)]
pub struct TableValues {
    /// One of each function.
    pub values: Vec<f64>,
    /// Their standard uncertainties: 0 where the table states none.
    pub stds: Vec<f64>,
}

/// A table's functions at a run's samples.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownAtSamples {
    /// The functions, in the order they were asked for.
    pub functions: Vec<Known>,
    /// Each sample's.
    pub samples: Vec<TableValues>,
}

impl Table {
    /// Reads a table: column `<angle>_deg|_rad`, and `<name>_um|_mm` or `<name>_urad|_rad` for each function; its standard
    /// uncertainty in `u_<name>_um`, where that is known (and no function is called `u_<name>` itself).
    ///
    /// Nodes may come in any order, and twice with the same values.
    ///
    /// # Errors
    /// [`FileError`] where the file cannot be read or is no such file, an angle has two values, or there are fewer than
    /// two angles.
    pub fn read(file: &Path, angle: &str, functions: &[Known]) -> Result<Self, FileError> {
        Self::read_stamped(file, angle, functions).map(|(table, _)| table)
    }

    /// As [`Table::read`], with what was read.
    pub(super) fn read_stamped(file: &Path, angle: &str, functions: &[Known]) -> Result<(Self, Stamp), FileError> {
        let uncertainty = |known: &Known| {
            let name = format!("u_{}", known.name);
            functions.iter().all(|other| other.name != name).then_some(name)
        };
        let uncertain: Vec<Option<String>> = functions.iter().map(uncertainty).collect();
        let stated = functions.iter().zip(&uncertain).filter_map(|(known, name)| Some((known, name.as_ref()?)));
        let stated =
            stated.map(|(known, name)| Wanted { absent: Some(0.0), ..Wanted::new(name, deviation(known.quantity)) });
        let columns: Vec<Wanted> = wanted(angle, functions).into_iter().chain(stated).collect();
        let (lines, stamping) = Lines::stamped(file, &columns)?;
        let mut nodes: Vec<Node> = lines.all(SAMPLES, Need::Interpolation, |line| {
            let (angle_rad, rest) = line.values.split_first()?;
            let (values, stds) = rest.split_at_checked(functions.len())?;
            let mut stated = stds.iter().copied();
            let stds = uncertain.iter().map(|name| name.as_ref().and_then(|_| stated.next()).unwrap_or(0.0)).collect();
            Some(Node { angle_rad: angle_rad + 0.0, values: values.to_vec(), stds, line: line.line })
        })?;
        nodes.sort_by(|a, b| a.angle_rad.total_cmp(&b.angle_rad));
        let fail = |problem| FileError { file: file.to_owned(), problem };
        let bad = [contradictions(&nodes, functions), negative(&nodes, &uncertain)].concat();
        if let Some(bad) = BadLines::of(bad.into_iter()) {
            return Err(fail(FileProblem::Lines(bad)));
        }
        nodes.dedup_by(|a, b| a.angle_rad == b.angle_rad);
        if nodes.len() < 2 {
            return Err(fail(FileProblem::TooFew { present: nodes.len(), needed: 2, why: Need::Interpolation }));
        }
        let repeats = goes_round(&nodes);
        let table = Self { file: file.to_owned(), functions: functions.to_vec(), nodes, repeats };
        Ok((table, stamping.stamp()))
    }

    /// Where it was read from.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Whether it goes round the turn and so has a value at every angle.
    pub fn repeats(&self) -> bool {
        self.repeats
    }

    /// First and last node, rad.
    pub fn range_rad(&self) -> (f64, f64) {
        let angle = |node: Option<&Node>| node.map_or(0.0, |node| node.angle_rad);
        (angle(self.nodes.first()), angle(self.nodes.last()))
    }

    /// Whether there are values at an angle, rad.
    pub(super) fn covers(&self, angle_rad: f64) -> bool {
        let (first, last) = self.range_rad();
        self.repeats || (first..=last).contains(&angle_rad)
    }

    /// The functions' values (mm or rad) at an angle in rad: a node's own at a node, linear between; none outside.
    pub fn at(&self, angle_rad: f64) -> Option<TableValues> {
        let (first, last) = (self.nodes.first()?, self.nodes.last()?);
        let inside = |angle: f64| first.angle_rad <= angle && angle <= last.angle_rad;
        let angle = match (inside(angle_rad), self.repeats) {
            (true, _) => angle_rad,
            (false, true) => first.angle_rad + (angle_rad - first.angle_rad).rem_euclid(TAU),
            (false, false) => return None,
        };
        let after = self.nodes.partition_point(|node| node.angle_rad <= angle);
        let left = self.nodes.get(after.checked_sub(1)?)?;
        if left.angle_rad == angle {
            return Some(TableValues { values: left.values.clone(), stds: left.stds.clone() });
        }
        // Past the last node the first one follows, a turn later.
        let (right, right_rad) = self.nodes.get(after).map_or((first, first.angle_rad + TAU), |n| (n, n.angle_rad));
        let span = right_rad - left.angle_rad;
        let weight = if span > 0.0 { ((angle - left.angle_rad) / span).clamp(0.0, 1.0) } else { 0.0 };
        let between = |l: &[f64], r: &[f64]| l.iter().zip(r).map(|(l, r)| l + weight * (r - l)).collect();
        Some(TableValues { values: between(&left.values, &right.values), stds: between(&left.stds, &right.stds) })
    }

    /// The functions at each sample of a run.
    ///
    /// # Errors
    /// [`FileError`] of the run's file where samples are outside the table, with their lines and the table's range.
    pub fn at_samples(&self, sweep: &Sweep) -> Result<KnownAtSamples, FileError> {
        let mut outside = Vec::new();
        let mut samples = Vec::with_capacity(sweep.samples().len());
        for sample in sweep.samples() {
            match self.at(sample.angle_rad) {
                Some(at) => samples.push(at),
                None => outside.push((sample.line, sample.angle_rad)),
            }
        }
        if outside.is_empty() {
            return Ok(KnownAtSamples { functions: self.functions.clone(), samples });
        }
        let problem = FileProblem::OutsideTable { table: self.file.clone(), range: self.range_rad(), samples: outside };
        Err(FileError { file: sweep.file().to_owned(), problem })
    }

    /// Writes a table of `functions`: for each line the angle in rad and the functions' values in mm or rad, written in
    /// degrees, µm and µrad. Reading gives back each value that has a decimal there ([`Unit::decimal`]).
    ///
    /// [`Unit::decimal`]: trunnion_codegen::quantity::Unit::decimal
    ///
    /// # Errors
    /// [`WriteError`] where the file cannot be written, a value is not finite, or a line has too few or many values.
    pub fn write(
        file: &Path,
        angle: &str,
        functions: &[Known],
        lines: impl IntoIterator<Item = (f64, Vec<f64>)>,
    ) -> Result<(), WriteError> {
        let contents = Self::contents(angle, functions, lines);
        let contents = contents.map_err(|problem| WriteError { file: file.to_owned(), problem })?;
        write_atomically(file, &contents)
    }

    /// What [`Table::write`] writes.
    pub(super) fn contents(
        angle: &str,
        functions: &[Known],
        lines: impl IntoIterator<Item = (f64, Vec<f64>)>,
    ) -> Result<Vec<u8>, WriteProblem> {
        let wanted = wanted(angle, functions);
        let columns: Vec<_> = wanted.iter().filter_map(|wanted| Some((*wanted, *wanted.units.first()?))).collect();
        let lines = lines.into_iter().map(|(angle, values)| [vec![angle], values].concat());
        written(&columns, lines)
    }
}

fn wanted<'a>(angle: &'a str, functions: &'a [Known]) -> Vec<Wanted<'a>> {
    let known = functions.iter().map(|known| Wanted::new(&known.name, deviation(known.quantity)));
    std::iter::once(Wanted::new(angle, SWEEP)).chain(known).collect()
}

/// Neighbours at one angle with different values, in the file's order.
fn contradictions(nodes: &[Node], functions: &[Known]) -> Vec<LineProblem> {
    let mut bad = Vec::new();
    for (before, node) in nodes.iter().zip(nodes.iter().skip(1)) {
        let differs = |((a, b), known): ((&f64, &f64), _)| (a != b).then_some(known);
        let values = before.values.iter().zip(&node.values).zip(functions);
        let different: Option<&Known> = values.filter_map(differs).next();
        if let (true, Some(known)) = (before.angle_rad == node.angle_rad, different) {
            let (first, line) = (before.line.min(node.line), before.line.max(node.line));
            let problem = FieldProblem::TwoValues { angle_rad: node.angle_rad, first, function: known.name.clone() };
            bad.push(LineProblem { line, problem });
        }
    }
    bad.sort_by_key(|problem| problem.line);
    bad
}

/// Uncertainties that are none.
fn negative(nodes: &[Node], names: &[Option<String>]) -> Vec<LineProblem> {
    let of = |node: &Node| {
        let negative = node.stds.iter().zip(names).find(|(std, _)| **std < 0.0);
        let problem = negative.map(|(_, name)| FieldProblem::Negative { column: name.clone().unwrap_or_default() });
        problem.map(|problem| LineProblem { line: node.line, problem })
    };
    nodes.iter().filter_map(of).collect()
}

fn goes_round(nodes: &[Node]) -> bool {
    let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else {
        return false;
    };
    let span = last.angle_rad - first.angle_rad;
    let step = span / (nodes.len() - 1) as f64;
    let near = |a: f64, b: f64| (a - b).abs() <= EVEN * step;
    let even = nodes.iter().zip(nodes.iter().skip(1)).all(|(a, b)| near(b.angle_rad - a.angle_rad, step));
    even && TAU / step >= STEPS_OF_A_TURN as f64 - EVEN && (near(span, TAU) || near(span + step, TAU))
}
