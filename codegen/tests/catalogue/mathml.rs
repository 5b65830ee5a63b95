//! Typeset equations are the printed ones: the same letters and numbers in the same order, each within an element that is closed.

use super::numbers::{derived, read};
use serde_json::Value;
use trunnion_codegen::catalogue::MODELS;
use trunnion_codegen::emit::equations::{Equation, json, mathml};
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::Model;

/// Letters and digits of elements, all of which are closed in the order in which they were opened.
fn letters(mathml: &str) -> String {
    let (mut open, mut letters): (Vec<&str>, String) = (Vec::new(), String::new());
    for part in mathml.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap();
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name), "{mathml}"),
            None => open.push(tag.split(' ').next().unwrap()),
        }
        let leaf = ["mi", "mn", "mtext"].contains(open.last().unwrap_or(&""));
        assert!(leaf || matches!(text.trim(), "" | "(" | ")" | "+" | "−" | "=" | "&#x2062;" | "&#x2061;"), "{text}");
        letters.extend(text.chars().filter(|c| leaf && c.is_alphanumeric()));
    }
    assert!(open.is_empty(), "{mathml}");
    letters.replace('δ', "d").replace('ε', "e")
}

/// The same of the plain form.
fn plain(text: &str) -> String {
    text.replace("sqrt", "").replace("pi", "π").chars().filter(|c| c.is_alphanumeric()).collect()
}

fn right(equation: &Equation) -> String {
    assert!(equation.left.ends_with("<mo form=\"infix\">=</mo>"));
    letters(&equation.left);
    equation.terms.iter().map(|term| letters(term)).collect()
}

fn check(model: &Model, derivation: &Derivation) {
    let (typeset, printed) = (mathml(model, derivation), json(model, derivation));
    let texts = |list: &str, key: &str| -> Vec<String> {
        let entries = printed[list].as_array().unwrap().iter().filter(|entry| entry["location_error"] != true);
        let texts = entries.map(|entry| entry[key].as_str().unwrap().to_owned());
        texts.filter(|text| text != "known").collect()
    };
    let itself = |c: &&Value| c["name"] != c["definition"];
    let definitions = printed["coefficients"].as_array().unwrap().iter().filter(itself);
    let definitions = definitions.map(|c| c["definition"].as_str().unwrap().to_owned()).collect();
    for (at, expected) in [(0, texts("runs", "reading")), (2, texts("functions", "expression")), (3, definitions)] {
        let found: Vec<String> = typeset[at].equations.iter().map(right).collect();
        assert_eq!(found, expected.iter().map(|text| plain(text)).collect::<Vec<_>>(), "{}", model.name);
    }
    assert!(typeset[1].equations.iter().all(|equation| !right(equation).is_empty()));
    // Lines may end between the terms of a reading.
    assert!(typeset[0].equations.iter().any(|equation| equation.terms.len() > 1), "{}", model.name);
}

#[test]
fn typeset_equations_are_the_printed_ones() {
    for (name, _) in MODELS {
        let (model, derivation) = derived(name);
        check(&model, &derivation);
    }
    let (model, derivation) = read(include_str!("everything.toml"));
    check(&model, &derivation);
}
