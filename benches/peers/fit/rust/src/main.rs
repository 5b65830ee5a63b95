//! The fit beside other tools, in one process on one core. `peers-fit solve SAMPLES EXACT` times both runs of the paper in two steps
//! and says how far the coefficients are from a 50-digit solution; `peers-fit grow` shows growth with samples, unknowns, runs;
//! `peers-fit digits DIRECTORY` gives the digits reached on NIST's sets.

mod blocked;
mod dense;
mod digits;
mod grow;
mod solve;

use std::hint::black_box;
use std::time::Instant;

/// Median of the repetitions, ns.
pub fn time(mut run: impl FnMut()) -> f64 {
    run();
    let mut times: Vec<f64> = (0..25)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64() * 1e9
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[12]
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[1..] {
        ["solve", samples, exact] => solve::run(samples.parse().expect("a number"), exact),
        ["grow"] => grow::run(),
        ["digits", directory] => digits::run(directory),
        _ => eprintln!("peers-fit solve SAMPLES EXACT | grow | digits DIRECTORY"),
    }
}
