//! Which run of another model would separate what these runs confound.
//!
//! A run fits a machine whose axes are those that it moves: of the same name, kind, direction and side, in the same order.
//! The machine's other axes rest. Its set-up errors are new ones, a function of which the machine assumes nothing takes the
//! other model's basis. With the run added the model is derived anew; the directions of the kernel that survive are the
//! projection of the new kernel onto the old parameters, so what is separated is an exact statement for any lengths.

use std::collections::BTreeSet;
use trunnion_codegen::algebra::{Alphabet, Fraction, Row, reduce, subtract};
use trunnion_codegen::basis::Basis;
use trunnion_codegen::identify::{Derivation, Origin, derive};
use trunnion_codegen::ids::{BaseId, FunctionId, KernelId, ParameterId};
use trunnion_codegen::model::{Draft, DraftBall, DraftFunction, DraftRun, Model, Text, iso_motion, read_draft};
use typed_index_collections::ti_vec;

/// A run that tells more.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Addition {
    /// The model it is from.
    pub model: String,
    /// Its name there.
    pub run: String,
    /// True where that takes the tool ball left in the spindle since the machine's last run: its set-up errors are then
    /// the same.
    pub ball_kept: bool,
    /// Directions of the kernel that would change a reading.
    pub separates: Vec<KernelId>,
    /// By how much the dimension of the kernel over the machine's own parameters falls.
    pub gain: usize,
    /// Parameters that would be determined and are not.
    pub determines: Vec<ParameterId>,
    /// Names of functions taken as known that the other model is made to find.
    pub finds: Vec<String>,
}

/// Tries every run of the `sources` (name and model file) on the machine of `draft`: how many fit it, and those that tell
/// something new, the one that separates most first.
pub fn additions(
    draft: &Draft,
    model: &Model,
    derivation: &Derivation,
    sources: &[(&str, &str)],
) -> (usize, Vec<Addition>) {
    let mut tried = 0;
    let mut found = Vec::new();
    for (name, source) in sources.iter().filter(|(name, _)| *name != model.name) {
        let Ok(other) = read_draft(source) else { continue };
        let Ok(other_model) = other.build() else { continue };
        let Ok(other_derivation) = derive(&other_model) else { continue };
        for run in &other.runs {
            let finds = finds(model, &other_model, &other_derivation, &run.name.value);
            let with = |ball_kept: bool| {
                let whole = fitted(draft, model, &other, &other_model, run, ball_kept)?;
                let built = whole.build().ok()?;
                let after = derive(&built).ok()?;
                let (separates, gain, determines) = gained(derivation, &after, &built.alphabet)?;
                let (model, run, finds) = ((*name).to_owned(), run.name.value.clone(), finds.clone());
                Some(Addition { model, run, ball_kept, separates, gain, determines, finds })
            };
            let Some(anew) = with(false) else { continue };
            tried += 1;
            let kept = with(true).filter(|kept| kept.gain > anew.gain);
            let new = |a: &Addition| a.gain > 0 || !a.finds.is_empty();
            found.extend(Some(anew).into_iter().filter(new));
            found.extend(kept);
        }
    }
    found.sort_by_key(|a| (core::cmp::Reverse(a.gain), core::cmp::Reverse(a.determines.len())));
    (tried, found)
}

/// The machine with a run of another model, if its axes fit.
fn fitted(
    draft: &Draft,
    model: &Model,
    other: &Draft,
    other_model: &Model,
    run: &DraftRun,
    ball_kept: bool,
) -> Option<Draft> {
    let moves = |name: &str| run.at.iter().any(|(axis, at)| axis.value == name && at.value.trim() != "rest");
    let sides = |m: &Model| {
        [&m.workpiece, &m.tool].map(|side| {
            let moving = side.iter().filter(|a| moves(&a.name));
            moving.map(|a| (a.name.clone(), a.kind, a.direction.clone())).collect::<Vec<_>>()
        })
    };
    if sides(model) != sides(other_model) {
        return None;
    }
    let mut whole = draft.clone();
    for constant in &other.constants {
        if whole.constants.iter().all(|c| c.value != constant.value) {
            whole.constants.push(unplaced(constant));
        }
    }
    let at = |axis: &trunnion_codegen::model::Axis| {
        let own = run.at.iter().find(|(name, _)| name.value == axis.name);
        (Text::from(axis.name.as_str()), own.map_or_else(|| Text::from("rest"), |(_, at)| unplaced(at)))
    };
    let name = format!("{}-of-{}", run.name.value, other_model.name);
    let ball = |ball: &DraftBall| DraftBall {
        at: ball.at.iter().map(unplaced).collect(),
        // A name in formulas: no hyphens.
        setup: ball.setup.iter().map(|t| Text::from(format!("{}_of_{name}", t.value).replace('-', "_"))).collect(),
    };
    let mut added = run.clone();
    added.at = model.axes().map(at).collect();
    added.workpiece_ball = ball(&run.workpiece_ball);
    added.tool_ball = ball(&run.tool_ball);
    if ball_kept {
        let last = &draft.runs.last()?.tool_ball;
        let place = |ball: &DraftBall| ball.at.iter().map(|t| t.value.clone()).collect::<Vec<_>>();
        if place(last) != place(&run.tool_ball) || run.tool_ball.setup.is_empty() {
            return None;
        }
        added.tool_ball.setup = last.setup.iter().map(unplaced).collect();
    }
    added.sweep = unplaced(&run.sweep);
    added.name = Text::from(name);
    whole.runs.push(added);
    for (function, written) in other_model.functions.iter().zip(&other.functions) {
        let Some(iso) = iso(other_model, function.error) else { continue };
        let machine_has =
            model.axes().any(|axis| axis.motion.iter().any(|&e| self::iso(model, e).as_deref() == Some(&iso)));
        let assumed = model.functions.iter().any(|f| self::iso(model, f.error).as_deref() == Some(&iso));
        if machine_has && !assumed {
            whole.functions.push(DraftFunction { error: Text::from(iso), basis: written.basis.clone() });
        }
    }
    Some(whole)
}

/// A text whose place is in another file.
fn unplaced(text: &Text) -> Text {
    Text::from(text.value.as_str())
}

/// ISO 230-1's name of a motion error.
fn iso(model: &Model, error: trunnion_codegen::algebra::ErrorId) -> Option<String> {
    let (axis, component) = model.axis_of(error)?;
    Some(iso_motion(component, &model.axis(axis)?.name))
}

/// Kernel directions that are gone, how many dimensions, and parameters that are determined now.
fn gained(
    before: &Derivation,
    after: &Derivation,
    alphabet: &Alphabet,
) -> Option<(Vec<KernelId>, usize, Vec<ParameterId>)> {
    let zeros: Row<ParameterId> = ti_vec![Fraction::zero(); before.parameters.len()];
    let place = |j: ParameterId| {
        let name = &after.parameters.get(j)?.name;
        before.parameters.position(|p| p.name == *name)
    };
    let project = |vector: &Vec<(ParameterId, Fraction)>| {
        let mut row = zeros.clone();
        for (j, factor) in vector {
            if let Some(slot) = place(*j).and_then(|at| row.get_mut(at)) {
                *slot = factor.clone();
            }
        }
        row
    };
    let order = before.parameters.keys();
    let left = reduce(after.kernel.iter().map(project).collect(), order, alphabet).ok()?;
    let mut separates = Vec::new();
    for (i, vector) in before.kernel.iter_enumerated() {
        let mut row = zeros.clone();
        vector.iter().for_each(|(j, f)| row[*j] = f.clone());
        for (pivot, other) in &left.rows {
            subtract(&mut row, other, *pivot, alphabet).ok()?;
        }
        if row.iter().any(|f| !f.is_zero()) {
            separates.push(i);
        }
    }
    let open: BTreeSet<ParameterId> = before.kernel.iter().flatten().map(|(j, _)| *j).collect();
    let still = |j: &ParameterId| left.rows.iter().any(|(_, row)| !row[*j].is_zero());
    let determines = open.into_iter().filter(|j| !still(j)).collect();
    Some((separates, before.kernel.len() - left.rows.len().min(before.kernel.len()), determines))
}

/// Functions that `model` takes as known and that this run of `other` helps to estimate.
fn finds(model: &Model, other: &Model, derivation: &Derivation, run: &str) -> Vec<String> {
    let sees = |(i, f): (FunctionId, &trunnion_codegen::model::ErrorFunction)| {
        // Of a reading in three components each is a run: `low-x`.
        let own = |name: &str| name == run || name.strip_prefix(run).is_some_and(|rest| rest.starts_with('-'));
        let holds = |b: &BaseId| {
            let parameters = derivation.base.get(*b).map_or(&[][..], |b| &b.definition);
            let of = |j: &ParameterId| derivation.parameters.get(*j).map(|p| p.origin);
            parameters.iter().any(|(j, _)| matches!(of(j), Some(Origin::Coefficient(c)) if c.function == i))
        };
        let runs = derivation.runs.iter().filter(|r| own(&r.name));
        let seen = runs.flat_map(|r| r.regressors.iter()).any(|(b, _)| holds(b));
        (f.estimate && seen).then(|| iso(other, f.error)).flatten()
    };
    let estimated: Vec<String> = other.functions.iter_enumerated().filter_map(sees).collect();
    let known = model.functions.iter().filter(|f| f.basis == Basis::Known);
    let found = known.filter(|f| iso(model, f.error).is_some_and(|name| estimated.contains(&name)));
    found.map(|f| model.alphabet.error_name(f.error).to_owned()).collect()
}
