//! Of every format: written, read as its control does, applied to the exact machine, measured and fitted again.

use crate::machine::{Bench, Trim};
use crate::readers;
use trunnion::export::{Format, Grid, Subject, Table, write};
use trunnion::study::{Covered, Setup, by_direction};

/// One arc second, rad.
const SECOND: f64 = std::f64::consts::PI / 180.0 / 3600.0;

/// Models with the place of a function that is an axis' own position, the range and the rows' step in degrees.
const CASES: [(&str, usize, (f64, f64), f64); 3] = [
    ("tilting-table-a", 0, (0.0, 360.0), 5.0),
    ("tilting-table-b", 0, (-30.0, 110.0), 2.0),
    ("rotary-table-c", 0, (0.0, 360.0), 5.0),
];

fn reader(format: Format) -> fn(&str) -> Trim {
    match format {
        Format::LinuxCnc => readers::linuxcnc,
    }
}

fn benches(seed: u64) -> impl Iterator<Item = (Bench, f64)> {
    CASES.into_iter().map(move |(name, function, range, step)| {
        (Bench::new(Setup::from_catalogue(name, &[]).unwrap(), function, range, seed), step)
    })
}

#[test]
fn what_remains_is_within_the_uncertainty_and_the_wrong_sign_doubles_it() {
    for format in Format::ALL {
        for (bench, step) in benches(5) {
            let setup = &bench.setup;
            let before = bench.measured(None, 0.0);
            let subject = Subject::new(setup, bench.function, None).unwrap();
            let covered = Covered::of(setup, bench.function, &before.observations).unwrap();
            let grid = Grid::within((covered.low.to_degrees(), covered.high.to_degrees()), step).unwrap();
            let error = |at: f64| [before.fit.function(setup, bench.function, bench.inner(at)).0; 2];
            let table = Table::new(subject, grid, false, error);
            let written = write(&table, format).unwrap();
            let left = written.left(&table, format.facts().between, error);
            let trim = reader(format)(&written.text);
            let [after, wrong] = [1.0, -1.0].map(|sign| bench.measured(Some(&trim), sign));
            let allowed = before.u95 + after.u95 + left;
            let (mut largest, mut remains, mut doubled) = (0.0f64, 0.0f64, 0.0f64);
            for at in grid.points() {
                let value =
                    |found: &crate::machine::Found| found.fit.function(setup, bench.function, bench.inner(at)).0;
                largest = largest.max(value(&before).abs());
                remains = remains.max(value(&after).abs());
                doubled = doubled.max((value(&wrong) - 2.0 * value(&before)).abs());
            }
            let named = format!("{} of {}", format.name(), setup.model.name);
            println!("{named}: {:.2} µrad, {:.3} remain, ±{:.3}", largest * 1e6, remains * 1e6, allowed * 1e6);
            assert!(largest > 4.0 * allowed, "{named}: nothing to be seen: {largest} ± {allowed}");
            assert!(remains <= allowed, "{named}: {remains} of {largest}, ± {allowed}");
            assert!(doubled <= 2.0 * allowed, "{named}: {doubled} from twice {largest}");
        }
    }
}

#[test]
fn a_hysteresis_of_four_seconds_is_in_the_columns() {
    for (mut bench, step) in benches(11) {
        bench.hysteresis = 4.0 * SECOND;
        let setup = &bench.setup;
        let found = bench.measured(None, 0.0);
        let own = by_direction(setup, &found.observations, &found.fit, bench.function);
        let Ok(own) = own else { panic!("{}", setup.model.name) };
        let subject = Subject::new(setup, bench.function, None).unwrap();
        let covered = Covered::of(setup, bench.function, &found.observations).unwrap();
        let grid = Grid::within((covered.low.to_degrees(), covered.high.to_degrees()), step).unwrap();
        let error = |at: f64| own.at(setup, &found.fit, bench.inner(at));
        let table = Table::new(subject, grid, true, error);
        let trim = readers::linuxcnc(&write(&table, Format::LinuxCnc).unwrap().text);
        for at in grid.points() {
            let seconds = (trim(at, false) - trim(at, true)) * 3600.0;
            let [_, std] = own.hysteresis(setup, &found.fit, bench.inner(at));
            assert!((seconds - 4.0).abs() < 0.05 + 4.0 * std / SECOND, "{} at {at}: {seconds}″", setup.model.name);
            assert!(std < 0.1 * SECOND, "{}", std / SECOND);
        }
        // With the table it is gone.
        let after = bench.measured(Some(&trim), 1.0);
        let Ok(own) = by_direction(setup, &after.observations, &after.fit, bench.function) else { panic!() };
        for at in grid.points() {
            let [by, std] = own.hysteresis(setup, &after.fit, bench.inner(at));
            assert!(by.abs() < 0.05 * SECOND + 6.0 * std, "{} at {at}: {}″", setup.model.name, by / SECOND);
        }
    }
}
