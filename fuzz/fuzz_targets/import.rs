//! Files of instruments and tables in any dialect, to runs and to the files that are made of them.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion::data::{Columns, Radius, Sweep, Unit, import, native_files};
use trunnion::import::Stated;
use trunnion_fuzz::{file, finite, repeated};

fuzz_target!(|bytes: &[u8]| {
    let file = file(bytes);
    let nothing = Stated::default();
    let all = Stated { unit: Some(Unit::Mm), ends_deg: Some((-20.0, 200.0)), overshoot_deg: 5.0, plane: None };
    let columns: Columns = "a=Angle [deg],dr=Radius [µm]".parse().expect("names");
    for (stated, columns) in [(&nothing, &Columns::default()), (&all, &columns)] {
        let Ok(imported) = repeated(|| import(&file, Some("a"), columns, stated)) else { continue };
        finite(&imported);
        let kept = imported.imported.traces.iter().map(|trace| trace.kept());
        let (files, names) = native_files(&[(&file, &imported)], "a").expect("finite runs");
        // What is written is read again as it is.
        for (name, kept) in names.iter().flatten().zip(kept) {
            let contents = files.get(name).expect("a run's file");
            let again = trunnion_fuzz::file(contents);
            let radius = Radius::new(9999.0).expect("a length");
            let Ok(sweep) = Sweep::read(&again, "a", radius, 1) else { continue };
            assert_eq!(sweep.samples().len(), kept.len());
            for (read, kept) in sweep.samples().iter().zip(kept) {
                let near = |a: f64, b: f64| (a - b).abs() <= 1e-15 * a.abs().max(b.abs()).max(1.0);
                assert!(near(read.angle_rad, kept.angle_rad) && near(read.reading_mm, kept.reading_mm));
            }
        }
    }
});
