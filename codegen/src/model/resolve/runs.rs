//! The runs: their paths, balls and readings.

use super::nuisance::Path;
use super::resolver::Resolver;
use crate::algebra::{NominalId, Poly, Quantity, SweepId};
use crate::basis::Coordinate;
use crate::expression::{ExprKind, parse};
use crate::ids::AxisId;
use crate::model::{Axis, AxisKind, Ball, Draft, DraftBall, DraftReading, DraftRun, ProblemKind, ReadingKind, Run};
use crate::source::Text;
use typed_index_collections::TiVec;

impl Resolver {
    /// One run, or one for each component that is read.
    pub fn run(&mut self, run: &DraftRun, axes: &[&Axis], draft: &Draft) -> Option<Vec<Run>> {
        let sweep = &run.sweep;
        if !self.is_name(sweep) || (self.alphabet.find_sweep(&sweep.value).is_none() && !self.is_free(sweep)) {
            return None;
        }
        let made = self.alphabet.sweep(&sweep.value);
        let sweep = self.exact(&run.sweep.span, made)?;
        for (i, (name, _)) in run.at.iter().enumerate() {
            if draft.axes.iter().all(|a| a.name.value != name.value) {
                self.problem::<()>(&name.span, ProblemKind::UnknownAxis(name.value.clone()));
            }
            if run.at[..i].iter().any(|(n, _)| n.value == name.value) {
                self.problem::<()>(&name.span, ProblemKind::Taken(name.value.clone()));
            }
        }
        self.define(run, sweep);
        let at: TiVec<AxisId, Coordinate> = axes.iter().filter_map(|axis| self.coordinate(run, axis, sweep)).collect();
        let workpiece_ball = self.ball(&run.workpiece_ball, run, sweep);
        let tool_ball = self.ball(&run.tool_ball, run, sweep);
        let readings = self.readings(run, sweep);
        let name = self.is_file_name(&run.name).then(|| run.name.value.clone());
        (at.len() == axes.len()).then_some(())?;
        let nuisance = self.nuisances(run, &Path { axes, at: &at, sweep });
        let places = [run.name.span.clone(), run.reading.span()];
        let (workpiece_ball, tool_ball, name) = (workpiece_ball?, tool_ball?, name?);
        let complete = |(suffix, reading): (&str, ReadingKind)| Run {
            name: format!("{name}{suffix}"),
            sweep,
            at: at.clone(),
            workpiece_ball: workpiece_ball.clone(),
            tool_ball: tool_ball.clone(),
            reading,
            nuisance: nuisance.clone(),
            left_out: Vec::new(),
            places: places.clone(),
        };
        Some(readings?.into_iter().map(complete).collect())
    }

    /// What is read, with what the name of its run is to end in.
    fn readings(&mut self, run: &DraftRun, sweep: SweepId) -> Option<Vec<(&'static str, ReadingKind)>> {
        match &run.reading {
            DraftReading::Bar(text) => Some(vec![("", ReadingKind::BarLength(self.constant(text)?))]),
            DraftReading::Displacement(direction) if matches!(direction.as_slice(), [t] if t.value == "xyz") => {
                let component = |(at, suffix)| {
                    let unit = core::array::from_fn(|i| Poly::integer(i128::from(i == at)));
                    (suffix, ReadingKind::Displacement(unit))
                };
                Some([(0, "-x"), (1, "-y"), (2, "-z")].map(component).into())
            }
            DraftReading::Displacement(direction) => {
                let direction = self.direction(direction, &run.name.span, Some(sweep))?;
                Some(vec![("", ReadingKind::Displacement(direction))])
            }
        }
    }

    fn coordinate(&mut self, run: &DraftRun, axis: &Axis, sweep: SweepId) -> Option<Coordinate> {
        let Some((_, text)) = run.at.iter().find(|(name, _)| name.value == axis.name) else {
            return self.problem(&run.name.span, ProblemKind::NoCoordinate(axis.name.clone()));
        };
        if text.value.trim() == "rest" {
            return Some(Coordinate::Rest);
        }
        let expr = self.parsed(text, parse(&text.value))?;
        let scope = self.scope(Some(sweep));
        match (axis.kind, &expr.node) {
            (AxisKind::Rotary, ExprKind::Arctangent(sin, cos)) => {
                self.arctangent(text, sin, cos, axis, sweep).map(Coordinate::Rotary)
            }
            (AxisKind::Linear, _) => {
                let value = scope.poly(&expr);
                self.meaning(text, value).map(Coordinate::Linear)
            }
            (AxisKind::Rotary, _) => {
                let value = scope.angle(&expr);
                self.meaning(text, value).map(Coordinate::Rotary)
            }
        }
    }

    fn ball(&mut self, ball: &DraftBall, run: &DraftRun, sweep: SweepId) -> Option<Ball> {
        let at = self.vector(&ball.at, &run.name.span, Some(sweep));
        let mut setup = Vec::new();
        for text in &ball.setup {
            let known = self.alphabet.find_error(&text.value).filter(|id| self.iso.iter().all(|(_, i)| i != id));
            if known.is_some() || (self.is_name(text) && self.is_free(text)) {
                let made = self.alphabet.error(&text.value, Quantity::Length);
                setup.extend(self.exact(&text.span, made));
            }
        }
        match ball.setup.len() {
            0 => Some(Ball { at: at?, setup: None }),
            3 => Some(Ball { at: at?, setup: Some(setup.try_into().ok()?) }),
            n => self.problem(&ball.setup[0].span, ProblemKind::NotThree(n)),
        }
    }

    fn constant(&mut self, text: &Text) -> Option<NominalId> {
        let found = self.alphabet.find_constant(&text.value);
        found.map_or_else(|| self.problem(&text.span, ProblemKind::NotAConstant(text.value.clone())), Some)
    }
}
