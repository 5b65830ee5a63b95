//! What measurements of a run are called.

use super::observation::Observation;
use super::setup::Setup;

/// The name of an observation's run; where that was measured several times with the number of the time, `tilting/2`.
pub(super) fn called(setup: &Setup, observations: &[Observation], at: usize) -> String {
    let own = observations.get(at).map(|o| o.run);
    let of_run = |o: &&Observation| Some(o.run) == own;
    let times = observations.iter().filter(of_run).count();
    let before = observations.iter().take(at).filter(of_run).count();
    let number = if times > 1 { format!("/{}", before + 1) } else { String::new() };
    own.map_or(number.clone(), |run| format!("{}{number}", setup.model.runs[run].name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_measured_several_times_is_numbered() {
        let setup = Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
        let runs: Vec<_> = setup.model.runs.keys().collect();
        let all = [runs[0], runs[0], runs[1]].map(|run| Observation::zero(&setup, run, &[0.0, 1.0]));
        let names = [0, 1, 2, 3].map(|at| called(&setup, &all, at));
        assert_eq!(names, ["tilting/1", "tilting/2", "separation", ""]);
    }
}
