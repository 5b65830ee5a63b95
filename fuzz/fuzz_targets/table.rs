//! Tables of known functions, at their nodes, between them and beyond.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion::data::{Known, Quantity, Table};
use trunnion_fuzz::{file, finite, repeated};

fuzz_target!(|bytes: &[u8]| {
    let file = file(bytes);
    let known = |name: &str, quantity| Known { name: name.to_owned(), quantity };
    let functions = [known("dya", Quantity::Length), known("exa", Quantity::Angle)];
    let Ok(table) = repeated(|| Table::read(&file, "a", &functions)) else { return };
    finite(&table);
    let (low, high) = table.range_rad();
    for angle in [low, high, (low + high) / 2.0, high + 1.0, -1e300] {
        let at = table.at(angle);
        assert!(at.is_some() || !table.repeats());
        finite(&at);
    }
});
