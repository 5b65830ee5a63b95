//! Files of poses, joints and touches on the parallel machine: kinematics, ring tests, a probe's offset.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion::exechon::{Coordinates, Gauge, forward, inverse, offset_report, read_machine, ring_report_of};
use trunnion_fuzz::{file, finite, repeated};
use trunnion_solver::exechon::Tilted;

fuzz_target!(|bytes: &[u8]| {
    let file = file(bytes);
    let machine = read_machine(None).expect("built in");
    for (coordinates, tilted) in [(Coordinates::Base, Tilted::Projected), (Coordinates::Machine, Tilted::Carried)] {
        let poses = repeated(|| Some(inverse(&machine, &file, coordinates, tilted).ok()?.collect::<Vec<_>>()));
        let joints = repeated(|| Some(forward(&machine, &file, coordinates, tilted).ok()?.collect::<Vec<_>>()));
        for solved in [poses, joints].into_iter().flatten().flatten() {
            finite(&solved.ok());
        }
    }
    for offset in [None, Some([0.2, -0.1])] {
        finite(&repeated(|| ring_report_of(&machine, &file, offset, 0.1)).ok());
    }
    finite(&repeated(|| offset_report(&machine, &file, &Gauge::new(40.0, 6.0, 1.0, 2.0))).ok());
});
