//! Machine files of the parallel machine, and what such a machine does.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion::exechon::{Compensation, Feature, plan, pose_at, read_machine};
use trunnion_fuzz::{file, finite, repeated};

fuzz_target!(|bytes: &[u8]| {
    let file = file(bytes);
    let Ok(machine) = repeated(|| read_machine(Some(&file))) else { return };
    finite(&machine);
    let home = machine.frame().point_from_base(machine.home().point);
    finite(&home);
    for point in [home, [-300.0, 200.0, -150.0], [0.0, 0.0, 100.0]] {
        for direction in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]] {
            finite(&repeated(|| pose_at(&machine, point, direction)).ok());
        }
        let ring = Feature::Ring { centre: point, radius: 20.0, touches: 8 };
        finite(&repeated(|| plan(&machine, &ring, 3.0, 1.0)).ok());
        finite(&repeated(|| Compensation::fit(&machine, point, 17.0, 8)).ok());
    }
});
