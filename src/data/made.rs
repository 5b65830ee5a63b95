//! Which of a model's runs files are given for.

use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::Model;

/// Whether a run is that of a name, or one of its three displacements.
pub fn is_of(run: &str, name: &str) -> bool {
    run == name || run.strip_suffix(['x', 'y', 'z']).is_some_and(|r| r.strip_suffix('-') == Some(name))
}

/// The runs of these names, and the others. With a name that no run has all are kept: that is told where the files are read.
pub fn made(model: &Model, names: &[&str]) -> (Vec<RunId>, Vec<RunId>) {
    let known = |name: &&str| model.runs.iter().any(|run| is_of(&run.name, name));
    if !names.iter().all(known) {
        return (model.runs.keys().collect(), Vec::new());
    }
    model.runs.keys().partition(|run| names.iter().any(|name| is_of(&model.runs[*run].name, name)))
}
