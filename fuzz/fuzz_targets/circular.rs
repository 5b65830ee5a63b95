//! Paths of a circular test: a file to a path, one or two paths to figures, figures to text and picture.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion::circular::{Plane, Test, Trace, Traces, circular, picture};
use trunnion::data::{Columns, Radius, import};
use trunnion::import::Stated;
use trunnion_fuzz::{file, finite, repeated};

fuzz_target!(|bytes: &[u8]| {
    // The second direction's file follows the first one's after a NUL, which no text has.
    let mut files = bytes.split(|byte| *byte == 0);
    let [clockwise, counterclockwise] = [files.next(), files.next()].map(|bytes| bytes.and_then(path));
    let Some(traces) = Traces::of(clockwise, counterclockwise) else { return };
    let radius = Radius::new(150.0).expect("a length");
    let test = Test { traces, radius, plane: Plane::default(), feed: Some(20.0) };
    let told = repeated(|| {
        let figures = circular(&test).ok()?;
        Some((figures.to_string(), picture(&test, &figures, "test").svg().ok()?, figures))
    });
    finite(&told.map(|(_, _, figures)| figures));
});

fn path(bytes: &[u8]) -> Option<Trace> {
    let read = import(&file(bytes), None, &Columns::default(), &Stated::default()).ok()?;
    let run = read.imported.traces.first()?;
    Trace::new(run.kept().iter().map(|sample| (sample.angle_rad, sample.reading_mm))).ok()
}
