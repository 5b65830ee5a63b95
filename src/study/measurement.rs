//! What is measured at once: a run, or the three displacements of a ball, which are a run each.

use super::setup::Setup;
use std::collections::BTreeSet;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::{ReadingKind, Run};

/// How the runs of three displacements end.
const ENDINGS: [&str; 3] = ["-x", "-y", "-z"];

/// Runs that are measured at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measurement {
    /// The run's name, or what the names of three have in common.
    pub name: String,
    /// One, or those of the displacements along x, y and z.
    pub runs: Vec<RunId>,
}

impl Measurement {
    /// The first of the runs: they all go the same way.
    pub fn first(&self) -> Option<RunId> {
        self.runs.first().copied()
    }

    /// Whether three displacements are measured.
    pub fn is_displacement(&self) -> bool {
        self.runs.len() == ENDINGS.len()
    }
}

impl Setup {
    /// What is measured, in the order of the runs.
    pub fn measurements(&self) -> Vec<Measurement> {
        let (mut all, mut taken) = (Vec::new(), Vec::new());
        for (run, described) in self.model.runs.iter_enumerated() {
            if taken.contains(&run) {
                continue;
            }
            let measured = self
                .together(described)
                .unwrap_or_else(|| Measurement { name: described.name.clone(), runs: vec![run] });
            taken.extend(&measured.runs);
            all.push(measured);
        }
        all
    }

    /// The runs that are measured at once with a run, itself among them.
    pub fn measured_with(&self, run: RunId) -> Vec<RunId> {
        let own = self.measurements().into_iter().find(|measurement| measurement.runs.contains(&run));
        own.map_or_else(|| vec![run], |measurement| measurement.runs)
    }

    /// How many samples runs that are measured together need: one more than it takes for the base parameters that they see.
    pub fn least(&self, runs: &[RunId]) -> usize {
        let seen = runs.iter().flat_map(|run| &self.derivation.runs[*run].regressors);
        let unknowns = seen.map(|(base, _)| *base).collect::<BTreeSet<_>>().len();
        unknowns.div_ceil(runs.len().max(1)) + 1
    }

    /// The three runs of which this is the first.
    fn together(&self, first: &Run) -> Option<Measurement> {
        let name = first.name.strip_suffix(ENDINGS[0])?;
        let own = |end: &&str| {
            let run = self.run(&format!("{name}{end}"))?;
            let described = &self.model.runs[run];
            let displaced = matches!(described.reading, ReadingKind::Displacement(_));
            (displaced && described.at == first.at && described.sweep == first.sweep).then_some(run)
        };
        let runs = ENDINGS.iter().map(own).collect::<Option<Vec<RunId>>>()?;
        self.run(name).is_none().then(|| Measurement { name: name.to_owned(), runs })
    }
}
