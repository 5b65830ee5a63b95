//! Words that mean something in a language, as names of everything in a model: whatever is printed compiles without a warning,
//! runs, and gives what the exact polynomials give.

mod hal;
mod languages;
mod machines;
mod texts;

use machines::{PLAIN, ROLES, assert_unambiguous, machines, words};
use std::collections::BTreeSet;
use trunnion_codegen::problems::{Colour, read_and_derive, render};

#[test]
fn every_word_has_every_role_and_stands_for_one_thing() {
    let words: BTreeSet<&str> = words().into_iter().collect();
    assert!(words.len() >= 300, "{}", words.len());
    let machines = machines();
    for (role, what) in ROLES.iter().enumerate() {
        let called: BTreeSet<&str> = machines.iter().flat_map(|machine| machine.called[role]).collect();
        assert_eq!(called, words, "{what}");
    }
    machines.iter().for_each(assert_unambiguous);
}

#[test]
fn what_is_no_identifier_is_refused_where_it_is_written() {
    assert!(read_and_derive(&machines::description("plain", &PLAIN)).is_ok());
    for word in ["t-x", "_x", "1x", "δ", "x y", "pi", "sin", "cos", "sqrt", "rest", "f", "at", "\\u001b[31m", "x\\n"] {
        for role in [0, 2, 4, 5, 6] {
            let mut called = PLAIN;
            called[role][1] = word;
            let source = machines::description("m", &called).replace("\\\\", "\\");
            let problems = read_and_derive(&source).expect_err(word);
            let told = render("m.toml", &source, &problems, Colour::Off);
            assert!(
                told.contains("is not a name") || told.contains("is taken already"),
                "{word} {}: {told}",
                ROLES[role]
            );
            assert!(told.chars().all(|c| c == '\n' || !c.is_control()), "{told:?}");
        }
    }
}
