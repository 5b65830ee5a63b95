//! Random functions, ranges and steps: what was written is read.

use crate::readers;
use crate::written::{all_errors_are_read, every_format_is_read, read, taken};
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use trunnion::data::{Quantity, Unit};
use trunnion::export::{Constant, Format, Grid, OneFormat, Subject, Table, TakenOff, Told, left, write};
use trunnion::study::Setup;
use trunnion_codegen::model::Component;

const TABLES: u64 = 300;

/// Some waves, rad or mm over degrees or mm.
fn function(random: &mut ChaCha8Rng) -> impl Fn(f64) -> f64 + use<> {
    let waves: Vec<[f64; 3]> = (0..3)
        .map(|k| {
            [
                random.random_range(-1e-4..1e-4),
                random.random_range(0.0..7.0),
                f64::from(k) + random.random_range(0.2..1.5),
            ]
        })
        .collect();
    move |at: f64| waves.iter().map(|[size, phase, k]| size * (k * at.to_radians() + phase).sin()).sum()
}

/// The error of a component along an axis.
fn subject(component: usize, axis: &str, along: Unit, taken_off: TakenOff) -> Subject {
    let iso = format!("E{}{axis}", ["X", "Y", "Z", "A", "B", "C"][component]);
    let quantity = if component < 3 { Quantity::Length } else { Quantity::Angle };
    let component = Component::ALL[component];
    Subject { name: iso.clone(), iso, component, axis: axis.to_owned(), quantity, along, taken_off }
}

fn grid(random: &mut ChaCha8Rng) -> Grid {
    let step = [0.5, 1.0, 2.5, 5.0, 7.3][random.random_range(0..5)];
    let from = step * f64::from(random.random_range(-40..40));
    Grid::new(from, from + step * f64::from(random.random_range(1..120)), step).unwrap()
}

#[test]
fn every_reader_finds_what_was_written() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let rotary = Subject::new(&setup, setup.estimated().next().unwrap(), Some("AX4")).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for round in 0..TABLES {
        let (forward, reverse) = (function(&mut random), function(&mut random));
        let grid = grid(&mut random);
        let both = round.is_multiple_of(2);
        let error = |at: f64| [forward(at), if both { reverse(at) } else { forward(at) }];
        let turns = round % 3 > 0;
        // A linear axis' positive motion may be against the error's direction.
        let sense = if round.is_multiple_of(2) { 1.0 } else { -1.0 };
        let linear = subject(0, "X", Unit::Mm, TakenOff::Own(sense));
        let table = Table::new(if turns { rotary.clone() } else { linear }, grid, both, error);
        let home = grid.from() + grid.step() * f64::from(random.random_range(0..grid.rows() as i32));
        let told = Told { home, detection_unit: 1e-4, notes: vec!["note".to_owned()], ..Told::default() };
        assert_eq!(every_format_is_read(&table, &told), Format::ALL);
        for format in Format::ALL {
            let facts = format.facts();
            let (trim, kept) = read(format, &table, &told).unwrap();
            for (row, at) in grid.points().enumerate() {
                // One value for both is the mean; increments begin at the reference position.
                let [forward, reverse] = error(at);
                let mean = (forward + reverse) / 2.0;
                let own = match (facts.both, format) {
                    (_, Format::One(OneFormat::Fanuc)) => continue,
                    (true, _) => [forward, reverse],
                    (false, _) => [mean, mean],
                };
                // Half of the last digit, and single precision.
                let rounding: f64 = match format {
                    Format::One(OneFormat::Heidenhain) => 6e-7,
                    _ => 6e-10,
                };
                let rounding = if turns { rounding.to_radians() } else { rounding };
                assert!((kept[0][row] - own[0]).abs() < rounding, "{} at {at}", format.name());
                assert!((kept[1][row] - own[1]).abs() < rounding, "{} at {at}", format.name());
            }
            // Nothing between the rows is further off than is told.
            if format == Format::One(OneFormat::LinuxCnc) {
                let told = left(&table, &kept, facts.between, error);
                for at in grid.dense(7) {
                    let errors = [(true, error(at)[0]), (false, error(at)[1])];
                    let off = errors.map(|(ahead, e)| (e - taken(format, &table, &trim, at, ahead)).abs());
                    assert!(off[0].max(off[1]) <= told * 1.05 + 1e-12, "{at}: {off:?} {told}");
                }
            }
        }
    }
}

/// Several errors of several axes, some over the same rows, with location errors beside them.
#[test]
fn files_of_all_errors_have_each_under_its_name() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    for _ in 0..TABLES {
        let grids = [grid(&mut random), grid(&mut random)];
        let mut tables = Vec::new();
        for (axis, along) in [("A", Unit::Deg), ("X", Unit::Mm), ("C", Unit::Deg)] {
            for component in 0..6 {
                if random.random_bool(0.3) {
                    let (forward, reverse) = (function(&mut random), function(&mut random));
                    let subject = subject(component, axis, along, TakenOff::None);
                    let grid = grids[random.random_range(0..2)];
                    tables.push(Table::new(subject, grid, random.random_bool(0.5), |at| [forward(at), reverse(at)]));
                }
            }
        }
        let names = ["Y0A", "Z0A", "B0A", "C0A", "X0C", "A0C"].into_iter().filter(|_| random.random_bool(0.4));
        let names: Vec<&str> = names.collect();
        let constants: Vec<Constant> =
            names.into_iter().map(|name| (name.to_owned(), random.random_range(-0.1..0.1))).collect();
        if tables.len() + constants.len() > 0 {
            all_errors_are_read(&tables, &constants, &["note, 1 2".to_owned()]);
        }
    }
}

/// 257 rows: the control's own reader drops the last, and the writer's warning says so.
#[test]
fn a_row_too_many_is_dropped() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let subject = Subject::new(&setup, setup.estimated().next().unwrap(), None).unwrap();
    let table = Table::new(subject, Grid::new(0.0, 256.0, 1.0).unwrap(), false, |at| [at * 1e-6; 2]);
    let trim = readers::linuxcnc(&write(&table, OneFormat::LinuxCnc, &Told::default()).unwrap().text).unwrap();
    assert!(
        (trim(256.0, true) - trim(255.0, true)).abs() < 1e-15 && (trim(255.0, true) - trim(254.0, true)).abs() > 1e-7
    );
}
