//! The fit beside other tools, in one process on one core. `peers-fit solve SAMPLES EXACT` times both runs of the paper in two steps
//! and says how far the coefficients are from a 50-digit solution, and how much memory it takes; `peers-fit unknowns` and `peers-fit runs`
//! show growth; `peers-fit digits DIRECTORY` gives the digits reached on NIST's sets.

mod blocked;
mod dense;
mod digits;
mod grow;
mod solve;

use peak_alloc::PeakAlloc;
use std::hint::black_box;
use std::time::Instant;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// The most that a run has on the heap at any time, beyond what was there before, bytes.
pub fn heap(run: impl FnOnce()) -> usize {
    let before = HEAP.current_usage();
    HEAP.reset_peak_usage();
    run();
    HEAP.peak_usage() - before
}

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
        ["unknowns"] => grow::unknowns(),
        ["runs"] => grow::runs(),
        ["digits", directory] => digits::run(directory),
        _ => eprintln!("peers-fit solve SAMPLES EXACT | unknowns | runs | digits DIRECTORY"),
    }
}
