//! Symbols for angles less whole turns: what a periodic basis is a function of.

use super::resolver::Resolver;
use crate::algebra::{Angle, Poly, Turned, WrappedAngle};
use crate::basis::{Basis, BasisFunction, Coordinate};
use crate::ids::{FunctionId, RunId};
use crate::model::{Axis, ErrorFunction, ProblemKind, Run};
use typed_index_collections::TiSlice;

impl Resolver {
    /// Makes them for every run's coordinates of axes with a periodic basis.
    pub fn turns(
        &mut self,
        axes: &[&Axis],
        runs: &TiSlice<RunId, Run>,
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) {
        for run in runs {
            for (axis, coordinate) in axes.iter().zip(&run.at) {
                let Coordinate::Rotary(angle) = coordinate else { continue };
                let own = functions.iter().filter(|f| axis.motion.contains(&f.error));
                for start in own.filter_map(|f| f.basis.turn_from()).collect::<Vec<_>>() {
                    if angle.given.is_some() {
                        self.problem::<()>(&run.places[0], ProblemKind::TurnOfArctangent(axis.name.clone()));
                        continue;
                    }
                    let Some(wrapped) = Turned::new(angle, start).wrapped else { continue };
                    if self.alphabet.find_wrapped(wrapped).is_some() {
                        continue;
                    }
                    let name = self.turn_name(wrapped, axes, runs, functions);
                    let made = self.alphabet.wrapped(wrapped, name);
                    self.exact(&run.places[0], made);
                }
            }
        }
    }

    /// The sweep's own name where the angle is the sweep and stands for it everywhere; else one of its own.
    fn turn_name(
        &self,
        angle: WrappedAngle,
        axes: &[&Axis],
        runs: &TiSlice<RunId, Run>,
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) -> String {
        let WrappedAngle { sweep, multiple, start } = angle;
        let name = self.alphabet.sweep_name(sweep);
        if (multiple, start) == (1, 0) && !self.is_raw(angle, axes, runs, functions) {
            return name.to_owned();
        }
        let from = if start == 0 { String::new() } else { format!("_from{}", 15 * start) };
        let times = if multiple == 1 { String::new() } else { multiple.to_string() };
        self.alphabet.free(format!("turn_{times}{name}{from}"))
    }

    /// Whether the sweep itself, or another turn of it, stands in a reading.
    fn is_raw(
        &self,
        angle: WrappedAngle,
        axes: &[&Axis],
        runs: &TiSlice<RunId, Run>,
        functions: &TiSlice<FunctionId, ErrorFunction>,
    ) -> bool {
        let sweep = angle.sweep;
        let [own, ..] = self.alphabet.sweep_symbols(sweep);
        let has = |p: &Poly| p.terms().iter().any(|(m, _)| m.exponent(own) != 0);
        let raw = |axis: &Axis, at: &Angle| {
            functions.iter().filter(|f| axis.motion.contains(&f.error)).any(|f| match &f.basis {
                Basis::Functions(functions) => {
                    let polynomial = functions.terms.iter().any(|f| matches!(f, BasisFunction::Polynomial(_)));
                    let turned = functions.turn_from.map(|start| Turned::new(at, start).wrapped);
                    polynomial && turned != Some(Some(angle))
                }
                _ => false,
            })
        };
        runs.iter().filter(|run| run.sweep == sweep).any(|run| {
            let balls = [&run.workpiece_ball, &run.tool_ball].into_iter().any(|ball| ball.at.iter().any(has));
            balls
                || axes.iter().zip(&run.at).any(|(axis, coordinate)| match coordinate {
                    Coordinate::Linear(p) => has(p),
                    Coordinate::Rotary(at) => at.sweep.is_some() && raw(axis, at),
                    Coordinate::Rest => false,
                })
        })
    }
}
