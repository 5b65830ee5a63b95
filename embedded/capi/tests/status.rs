//! The library and the generated C99 answer alike: a status has one number, and a number one status.

use std::collections::BTreeMap;

/// Name and number of every status, from lines `PREFIX_NAME = 3,`.
fn statuses(header: &'static str, prefix: &str) -> BTreeMap<&'static str, u32> {
    let lines = header.lines().filter_map(|line| line.trim().strip_prefix(prefix)?.split_once(" = "));
    lines.map(|(name, number)| (name, number.trim_end_matches(',').parse().unwrap())).collect()
}

#[test]
fn statuses_are_those_of_the_generated_c99() {
    let library = statuses(include_str!("../include/trunnion.h"), "TRUNNION_STATUS_");
    let generated = statuses(include_str!("../../../codegen/src/emit/c99/solver.h.in"), "@PREFIX@_");
    let shared = library.keys().filter(|name| generated.contains_key(*name)).count();
    assert_eq!((library.len(), generated.len(), shared), (10, 8, 7));
    let mut name_of = BTreeMap::new();
    for (name, number) in library.iter().chain(&generated) {
        assert_eq!(name_of.entry(number).or_insert(name), &name, "both are {number}");
    }
    assert_eq!(name_of.len(), library.len() + generated.len() - shared, "a status has two numbers");

    let page = include_str!("../../../docs/controller.md");
    let rows = page.lines().filter_map(|line| {
        let [number, name, _] = line.strip_prefix("| ")?.strip_suffix(" |")?.split(" | ").collect::<Vec<_>>()[..]
        else {
            return None;
        };
        Some((number.parse().ok()?, name.trim_matches('`')))
    });
    assert!(rows.eq(name_of.iter().map(|(number, name)| (**number, **name))), "docs/controller.md lists others");
}
