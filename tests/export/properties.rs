//! Random functions, ranges and steps: what was written is read.

use crate::machine::Trim;
use crate::readers;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use trunnion::data::{Quantity, Unit};
use trunnion::export::{AllFormat, Format, Grid, OneFormat, Subject, Table, TakenOff, Told, left, write, write_all};
use trunnion::study::Setup;
use trunnion_codegen::model::Component;

const TABLES: u64 = 300;

/// Some waves and a slope, rad over degrees.
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

/// A linear axis, whose positive motion may be against the error's direction.
fn linear(round: u64) -> Subject {
    Subject {
        name: "EXX".to_owned(),
        iso: "EXX".to_owned(),
        component: Component::ALL[0],
        axis: "X".to_owned(),
        quantity: Quantity::Length,
        along: Unit::Mm,
        taken_off: TakenOff::Own(if round.is_multiple_of(2) { 1.0 } else { -1.0 }),
    }
}

#[test]
fn every_reader_finds_what_was_written() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let rotary = Subject::new(&setup, setup.estimated().next().unwrap(), Some("AX4")).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for round in 0..TABLES {
        let (forward, reverse) = (function(&mut random), function(&mut random));
        let step = [0.5, 1.0, 2.5, 5.0, 7.3][random.random_range(0..5)];
        let from = step * f64::from(random.random_range(-40..40));
        let grid = Grid::new(from, from + step * f64::from(random.random_range(1..120)), step).unwrap();
        let both = round.is_multiple_of(2);
        let error = |at: f64| [forward(at), if both { reverse(at) } else { forward(at) }];
        let turns = round % 3 > 0;
        let table = Table::new(if turns { rotary.clone() } else { linear(round) }, grid, both, error);
        let home = from + step * f64::from(random.random_range(0..grid.rows() as i32));
        let told = Told { home, detection_unit: 1e-4, ..Told::default() };
        for format in Format::ALL {
            let facts = format.facts();
            let (trim, kept): (Trim, _) = match format {
                Format::One(one) => {
                    let written = write(&table, one, &told).unwrap();
                    (readers::of(one)(&written.text), written.kept)
                }
                Format::All(all) => {
                    let (text, kept) = write_all(std::slice::from_ref(&table), &[], all, &["note".to_owned()]);
                    let errors =
                        if all == AllFormat::Volcomp { readers::volcomp(&text) } else { readers::etalon(&text) };
                    (readers::own_error(&errors, &table.subject.iso, turns), kept[0].clone())
                }
            };
            // Errors, not positions of the axis, have no sense of it.
            let positions = !matches!(format, Format::All(_) | Format::One(OneFormat::Csv | OneFormat::Json));
            let sense = match table.subject.taken_off {
                TakenOff::Own(sense) if positions => sense,
                _ => 1.0,
            };
            let taken =
                |at: f64, ahead: bool| -sense * if turns { trim(at, ahead).to_radians() } else { trim(at, ahead) };
            let turn = turns && (grid.to() - grid.from() - 360.0).abs() < 1e-6;
            for (row, at) in grid.points().enumerate() {
                for (ahead, kept) in [(true, &kept[0]), (false, &kept[1])] {
                    // Where a turn begins again is one row, of a function that jumps there the first.
                    if turn && row + 1 == grid.rows() {
                        continue;
                    }
                    let (read, own) = (taken(at, ahead), kept[row]);
                    assert!((read - own).abs() < 2e-12, "{} at {at}: {read} {own}", format.name());
                }
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
                    let off =
                        [(true, error(at)[0]), (false, error(at)[1])].map(|(ahead, e)| (e - taken(at, ahead)).abs());
                    assert!(off[0].max(off[1]) <= told * 1.05 + 1e-12, "{at}: {off:?} {told}");
                }
            }
        }
    }
}

/// 257 rows: the control's own reader drops the last, and the writer's warning says so.
#[test]
fn a_row_too_many_is_dropped() {
    let setup = Setup::from_catalogue("tilting-table-a", &[]).unwrap();
    let subject = Subject::new(&setup, setup.estimated().next().unwrap(), None).unwrap();
    let table = Table::new(subject, Grid::new(0.0, 256.0, 1.0).unwrap(), false, |at| [at * 1e-6; 2]);
    let trim = readers::linuxcnc(&write(&table, OneFormat::LinuxCnc, &Told::default()).unwrap().text);
    assert!(
        (trim(256.0, true) - trim(255.0, true)).abs() < 1e-15 && (trim(255.0, true) - trim(254.0, true)).abs() > 1e-7
    );
}
