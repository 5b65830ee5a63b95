//! The paper's two runs, fitted sample by sample on a Cortex-M4F: the page to copy from.
//!
//! In a controller the loop over `runs::turn()` is the cyclic task: the encoder's angle and the ball-bar's reading go into
//! `push_…`, which takes bounded time, and when the runs are over `solve` gives ε_xa. Nothing is stored but the state.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};
use panic_semihosting as _;
use trunnion_solver::Real;
use trunnion_solver::lstsq::student_t_95;
use trunnion_solver::tilting::{Estimate, Joint, Lengths, TwoStep};

#[entry]
fn main() -> ! {
    let done = single().and_then(|()| double());
    if let Err(why) = &done {
        hprintln!("error = {}", why);
    }
    debug::exit(if done.is_ok() { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    unreachable!("the debugger has ended the program")
}

/// In `f32`, which the processor calculates with by itself. Every call answers with a status; here each is only named.
fn single() -> Result<(), &'static str> {
    let lengths = Lengths { r: runs::RADIUS as f32 };
    let mut joint = Joint::new(lengths).map_err(|_| "the radius is no length")?;
    let mut two_step = TwoStep::new(lengths).map_err(|_| "the radius is no length")?;
    for sample in runs::turn() {
        let (a, [y_a, z_a]) = (sample.angle as f32, sample.known.map(|v| v as f32));
        joint.push_tilting(a, sample.tilting as f32, y_a, z_a).map_err(|_| "tilting sample")?;
        joint.push_separation(a, sample.separation as f32).map_err(|_| "separation sample")?;
        two_step.push_tilting(a, sample.tilting as f32, y_a, z_a).map_err(|_| "tilting sample")?;
        two_step.push_separation(a, sample.separation as f32).map_err(|_| "separation sample")?;
    }
    let joint = joint.solve().map_err(|_| "the samples do not separate the coefficients")?;
    let two_step = two_step.solve().map_err(|_| "the samples do not separate the coefficients")?;
    for degree in (0_u16..=360).step_by(30) {
        let a = f32::from(degree).to_radians();
        print("f32 joint", degree, &joint, a)?;
        print("f32 two-step", degree, &two_step, a)?;
    }
    Ok(())
}

/// The same in `f64`, which this processor calculates with in software, some ten times slower.
fn double() -> Result<(), &'static str> {
    let lengths = Lengths { r: runs::RADIUS };
    let mut joint = Joint::new(lengths).map_err(|_| "the radius is no length")?;
    let mut two_step = TwoStep::new(lengths).map_err(|_| "the radius is no length")?;
    for sample in runs::turn() {
        let [y_a, z_a] = sample.known;
        joint.push_tilting(sample.angle, sample.tilting, y_a, z_a).map_err(|_| "tilting sample")?;
        joint.push_separation(sample.angle, sample.separation).map_err(|_| "separation sample")?;
        two_step.push_tilting(sample.angle, sample.tilting, y_a, z_a).map_err(|_| "tilting sample")?;
        two_step.push_separation(sample.angle, sample.separation).map_err(|_| "separation sample")?;
    }
    let joint = joint.solve().map_err(|_| "the samples do not separate the coefficients")?;
    let two_step = two_step.solve().map_err(|_| "the samples do not separate the coefficients")?;
    for degree in (0_u16..=360).step_by(30) {
        let a = f64::from(degree).to_radians();
        print("f64 joint", degree, &joint, a)?;
        print("f64 two-step", degree, &two_step, a)?;
    }
    Ok(())
}

/// ε_xa in µrad, and half the width of its 95 % band.
fn print<T: Real + Into<f64>>(estimator: &str, degree: u16, estimate: &Estimate<T>, a: T) -> Result<(), &'static str> {
    let (eps, std) = estimate.e_xa(a).map_err(|_| "the estimate is not finite")?;
    let band = student_t_95::<T>(estimate.solution.degrees_of_freedom) * std;
    hprintln!("{} {} = {:.9} {:.9}", estimator, degree, eps.into() * 1e6, band.into() * 1e6);
    Ok(())
}
