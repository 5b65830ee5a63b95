//! Compensation tables: the tests' readers of every format on any text, and on what is written of any table.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use trunnion::data::{Quantity, Unit};
use trunnion::export::{AllFormat, Format, Grid, Subject, Table, TakenOff, Told};
use trunnion_codegen::model::Component;

#[path = "../../tests/export/readers/mod.rs"]
mod readers;
#[path = "../../tests/export/written.rs"]
mod written;

/// A file, or a table to write one of.
#[derive(Arbitrary, Debug)]
enum Input<'a> {
    File(&'a str),
    Table(Drawn),
}

/// A table: errors of up to 32 µrad or µm.
#[derive(Arbitrary, Debug)]
struct Drawn {
    from: i8,
    /// Tenths of a degree or mm.
    step: u8,
    errors: Vec<[i16; 2]>,
    component: u8,
    turns: bool,
    both: bool,
    against: bool,
    by_another: bool,
    home: u8,
    constants: [i32; 2],
}

fuzz_target!(|input: Input| match input {
    Input::File(text) => files(text),
    Input::Table(drawn) => tables(&drawn),
});

/// No reader minds what it is given.
fn files(text: &str) {
    for format in Format::ALL {
        match format {
            Format::One(one) => {
                if let Ok(trim) = readers::of(one)(text) {
                    for (x, ahead) in [(0.0, true), (-1e9, false), (90.0, true), (360.0, false), (f64::MAX, true)] {
                        let _ = trim(x, ahead);
                    }
                }
            }
            Format::All(all) => {
                let Ok(errors) = readers::of_all(all)(text) else { continue };
                for name in errors.keys() {
                    let _ = readers::iso_error(&errors, name, true).map(|trim| trim(90.0, true));
                }
            }
        }
    }
}

/// What is written of a table is read.
fn tables(drawn: &Drawn) {
    let rows = drawn.errors.len().min(200);
    let step = f64::from(drawn.step.max(5)) / 10.0;
    let from = f64::from(drawn.from) * step;
    let Ok(grid) = Grid::new(from, from + step * (rows.max(2) - 1) as f64, step) else { return };
    let component = Component::ALL[usize::from(drawn.component % 6)];
    let (quantity, along) = (
        if component.is_rotation() { Quantity::Angle } else { Quantity::Length },
        if drawn.turns { Unit::Deg } else { Unit::Mm },
    );
    let sense = if drawn.against { -1.0 } else { 1.0 };
    let own = component.is_rotation() == drawn.turns;
    let taken_off = match (own, drawn.by_another && !component.is_rotation()) {
        (true, _) => TakenOff::Own(sense),
        (false, true) => TakenOff::Other("Y".to_owned(), sense),
        (false, false) => TakenOff::None,
    };
    let axis = if drawn.turns { "A" } else { "X" }.to_owned();
    let iso = format!("E{}{axis}", ["X", "Y", "Z", "A", "B", "C"][component.index()]);
    let subject = Subject { name: iso.clone(), iso, component, axis, quantity, along, taken_off };
    let error = |at: f64| {
        let row = ((at - from) / step).round() as usize;
        let [forward, reverse] = drawn.errors.get(row).copied().unwrap_or_default().map(|e| f64::from(e) * 1e-9);
        [forward, if drawn.both { reverse } else { forward }]
    };
    let table = Table::new(subject, grid, drawn.both, error);
    let home = from + step * f64::from(drawn.home % 200);
    let told = Told { home, detection_unit: 1e-5, ..Told::default() };
    let placed = written::every_format_is_read(&table, &told);
    assert!(placed.contains(&Format::All(AllFormat::Volcomp)) && placed.contains(&Format::All(AllFormat::Etalon)));
    let constants = drawn.constants.map(|value| f64::from(value) * 1e-12);
    let constants: Vec<_> = ["Y0A", "B0A"].into_iter().map(str::to_owned).zip(constants).collect();
    written::all_errors_are_read(&[table], &constants, &[]);
}
