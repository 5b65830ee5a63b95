//! The numbers of a rotary axis are the largest of its own errors', and no error is left out silently.

use crate::MODELS;
use crate::program::succeeds;
use serde_json::Value;
use std::fs;
use std::path::Path;

fn plan(at: &Path, model: &str, more: &[&str]) -> Value {
    let plan = ["plan", model, "--positions", "8", "--step-deg", "15", "--json"];
    serde_json::from_str(&succeeds(at, &[&plan[..], more].concat())).unwrap()
}

fn names(list: &Value) -> Vec<&str> {
    list.as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect()
}

/// The names of the errors of one kind of an axis, and the largest of their numbers with its error; read from the names: `EX0C` is
/// the linear one of C along X.
fn largest<'a>(plan: &'a Value, axis: &str, linear: bool, of: &str) -> (Vec<&'a str>, f64, &'a str) {
    let mut found = (Vec::new(), 0.0, "");
    for function in plan["functions"].as_array().unwrap() {
        let name = function["name"].as_str().unwrap();
        if !name.ends_with(axis) || "XYZ".contains(&name[1..2]) != linear {
            continue;
        }
        found.0.push(name);
        let value = function[of]["valuation"].as_f64().unwrap();
        if value > found.1 {
            (found.1, found.2) = (value, name);
        }
    }
    found
}

fn held(plan: &Value, of: &str) -> usize {
    let mut numbers = 0;
    for axis in plan["axes"].as_array().unwrap() {
        let name = axis["name"].as_str().unwrap();
        for (kind, linear, unit) in [("linear", true, "um/um"), ("angular", false, "deg/um")] {
            let (errors, value, error) = largest(plan, name, linear, of);
            if errors.is_empty() {
                assert!(axis[kind].is_null(), "{axis}");
                continue;
            }
            assert_eq!((names(&axis[kind]["of"]), axis[kind]["unit"].as_str()), (errors, Some(unit)), "{axis}");
            assert_eq!(axis[kind][of]["valuation"].as_f64(), Some(value), "{axis}");
            assert_eq!(axis[kind][of]["function"].as_str(), Some(error), "{axis}");
            numbers += 1;
        }
    }
    numbers
}

#[test]
fn a_rotary_axis_has_the_largest_number_of_its_own_errors() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for (model, axes, numbers) in
        MODELS.iter().zip([&["A", "C"][..], &["B", "C"], &["C", "B", "S"]]).zip([4, 4, 4]).map(|((m, a), n)| (*m, a, n))
    {
        let plan = plan(at, model, &[]);
        assert_eq!(
            plan["axes"].as_array().unwrap().iter().map(|own| own["name"].as_str().unwrap()).collect::<Vec<_>>(),
            axes
        );
        assert_eq!([held(&plan, "evenly"), held(&plan, "proposed")], [numbers; 2], "{model}");
        assert!(plan["axes"].as_array().unwrap().iter().all(|own| own["not_determined"] == Value::Array(Vec::new())));
    }
    // The zero of C is no error that this model estimates.
    let of = |more: &[&str]| plan(at, "ac-trunnion-probe", more)["axes"].clone();
    assert_eq!([names(&of(&[])[0]["without"]), names(&of(&[])[1]["without"])], [vec![], vec!["EC0C"]]);
    // Errors that are not asked for are named, an axis of which none is has no place.
    let some = of(&["--for", "EB0A,EC0A"]);
    assert_eq!(some.as_array().unwrap().len(), 1);
    assert_eq!((names(&some[0]["without"]), &some[0]["linear"]), (vec!["EY0A", "EZ0A"], &Value::Null));
    assert_eq!(of(&["--for", "EX0C"])[0]["name"], "C");
}

/// The same in text, and in the measuring plan for the positions that are chosen.
#[test]
fn text_and_measuring_plan_say_the_same() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let object = plan(at, "ac-trunnion-probe", &["--out", "at.toml"]);
    let text = succeeds(at, &["plan", "ac-trunnion-probe", "--positions", "8", "--step-deg", "15"]);
    succeeds(at, &["new", "ac-trunnion-probe", "--at", "at.toml", "--out", "p"]);
    let sheet = fs::read_to_string(at.join("p/measuring-plan.md")).unwrap();
    for (axis, linear) in [("A", true), ("A", false), ("C", true), ("C", false)] {
        let words = |value: f64| if linear { format!("{value:.4} µm/µm") } else { format!("{value:.6} °/µm") };
        let [even, own] = ["evenly", "proposed"].map(|of| largest(&object, axis, linear, of));
        let errors = own.0.join(", ");
        let line = format!("  {axis:8}  {:>16}  {:>16}  of {errors}\n", words(even.1), words(own.1));
        assert!(text.contains(&line), "{line}{text}");
        let row = format!("| {axis} | {} | {errors} |\n", words(own.1));
        assert!(sheet.contains(&row), "{row}{sheet}");
    }
    assert!(text.contains("  C         without EC0C\n"), "{text}");
    assert!(sheet.contains("| C | – | EC0C: not estimated |\n"), "{sheet}");
}

/// Without C probed on the tilted cradle, some of the errors of both axes are seen in sums alone.
#[test]
fn an_error_that_is_not_determined_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let model = trunnion_codegen::catalogue::source("ac-trunnion-probe").unwrap();
    let (before, rest) = model.split_once("[run.c-tilted]").unwrap();
    fs::write(at.join("two.toml"), format!("{before}{}", &rest[rest.find("[function]").unwrap()..])).unwrap();
    let object = plan(at, "two.toml", &["--out", "at.toml"]);
    let text = succeeds(at, &["plan", "two.toml", "--positions", "8", "--step-deg", "15"]);
    succeeds(at, &["new", "two.toml", "--at", "at.toml", "--out", "p"]);
    let sheet = fs::read_to_string(at.join("p/measuring-plan.md")).unwrap();
    // EX0C, EB0C, EB0A and the squareness EB0Z only appear together.
    let of =
        |at: usize, kind: &str| (names(&object["axes"][at][kind]["of"]), names(&object["axes"][at]["not_determined"]));
    assert_eq!(
        [of(0, "linear"), of(0, "angular")],
        [(vec!["EY0A", "EZ0A"], vec!["EB0A"]), (vec!["EC0A"], vec!["EB0A"])]
    );
    assert_eq!(
        [of(1, "linear"), of(1, "angular")],
        [(vec!["EY0C"], vec!["EX0C", "EB0C"]), (vec!["EA0C"], vec!["EX0C", "EB0C"])]
    );
    // The number of a sum is not one of the error, however large it is.
    let number = |name: &str| {
        let functions = object["functions"].as_array().unwrap();
        functions.iter().find(|own| own["name"] == name).unwrap()["proposed"]["valuation"].as_f64().unwrap()
    };
    assert!(number("EB0C") > number("EA0C"));
    assert_eq!(object["axes"][1]["angular"]["proposed"]["valuation"].as_f64(), Some(number("EA0C")));
    for (axis, left) in [("A", "EB0A"), ("C", "EX0C, EB0C")] {
        assert!(text.contains(&format!("  {axis:8}  not determined: {left}\n")), "{text}");
        assert!(sheet.contains(&format!("| {axis} | – | {left}: not determined |\n")), "{sheet}");
    }
    // Where none of a kind is determined there is no number of it.
    let none = plan(at, "two.toml", &["--for", "EX0C"]);
    assert_eq!((&none["axes"][0]["linear"], names(&none["axes"][0]["not_determined"])), (&Value::Null, vec!["EX0C"]));
}
