//! What has changed between reports, held against differences worked out here.

mod program;

use program::{succeeds, trunnion};
use serde_json::{Value, json};
use std::fs;

/// A report of one function at 73 points, by its value and uncertainty there.
fn report(date: &str, value: impl Fn(f64) -> f64, u95: f64) -> String {
    let point = |a: f64| json!({ "a_deg": a, "value": value(a), "std": u95 / 2.0, "u95": u95 });
    let points: Vec<Value> = (0..=72).map(|i| point(5.0 * f64::from(i))).collect();
    let function = json!({ "name": "EAA", "unit": "urad", "value_of": "EAA", "points": points });
    json!({ "model": "m", "machine": { "date": date }, "functions": [function] }).to_string()
}

#[test]
fn a_change_is_told_where_it_is_beyond_the_uncertainty() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(directory.path().join(name), text).unwrap();
    let wave = |a: f64| 20.0 * a.to_radians().sin();
    write("a.json", report("2026-01-01", wave, 3.0));
    write("b.json", report("2026-02-01", |a| wave(a) + 4.0 * a.to_radians().cos(), 4.0));
    write("c.json", report("2026-04-01", |a| wave(a) + 12.0 * a.to_radians().cos(), 4.0));
    let told = succeeds(directory.path(), &["compare", "a.json", "b.json", "c.json", "--json"]);
    let told: Value = serde_json::from_str(&told).unwrap();
    let changes = told["changes"].as_array().unwrap();
    // U = √(3² + 4²) = 5: a wave of 4 is within, one of 12 beyond it where |cos a| > 5/12.
    assert_eq!(changes.iter().map(|c| c["changed"].as_bool().unwrap()).collect::<Vec<_>>(), [false, true]);
    let beyond = (0..=72).filter(|i| f64::from(5 * i).to_radians().cos().abs() > 5.0 / 12.0).count();
    assert_eq!(changes[1]["beyond"], json!(beyond));
    assert_eq!(changes[0]["beyond"], json!(0));
    let largest = &changes[1]["largest"];
    assert!((largest["difference"].as_f64().unwrap().abs() - 12.0).abs() < 1e-9);
    assert!((largest["u95"].as_f64().unwrap() - 5.0).abs() < 1e-9);
    // Bonferroni over 73 points: the quantile of 1 − 0.025/73 over that of 0.975.
    assert!((changes[1]["allowed"].as_f64().unwrap() - 3.3966 / 1.95996).abs() < 1e-3, "{}", changes[1]["allowed"]);
    assert_eq!(told["reports"][2]["day"].as_i64().unwrap() - told["reports"][0]["day"].as_i64().unwrap(), 90);
    let text = succeeds(directory.path(), &["compare", "a.json", "c.json", "--svg", "c.svg", "--over-time", "t.svg"]);
    assert!(text.contains("EAA in c.json: changed; largest "), "{text}");
    let drawn = fs::read_to_string(directory.path().join("t.svg")).unwrap();
    assert!(drawn.contains("days since the first report") && drawn.contains("EAA at a = "), "{drawn}");
    assert!(fs::read_to_string(directory.path().join("c.svg")).unwrap().contains("change"));
}

#[test]
fn the_largest_change_and_the_clearest_one_are_told_apart() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(directory.path().join(name), text).unwrap();
    // Beyond 300° the function is hardly known, and farthest off.
    let uncertain = |text: String| {
        let mut report: Value = serde_json::from_str(&text).unwrap();
        for point in report["functions"][0]["points"].as_array_mut().unwrap() {
            point["u95"] = json!(if point["a_deg"].as_f64().unwrap() > 300.0 { 40.0 } else { 3.0 });
        }
        report.to_string()
    };
    write("a.json", uncertain(report("2026-01-01", |_| 0.0, 1.0)));
    let step = |a: f64| if a == 310.0 { 50.0 } else { 12.0 * f64::from(a == 70.0) };
    write("b.json", uncertain(report("20260201-080000", step, 1.0)));
    let told: Value =
        serde_json::from_str(&succeeds(directory.path(), &["compare", "a.json", "b.json", "--json"])).unwrap();
    let change = &told["changes"][0];
    assert_eq!((&change["largest"]["at"], &change["largest"]["difference"]), (&json!(310.0), &json!(50.0)));
    assert_eq!((&change["clearest"]["at"], &change["clearest"]["difference"]), (&json!(70.0), &json!(12.0)));
    assert_eq!(told["reports"][1]["day"].as_i64().unwrap() - told["reports"][0]["day"].as_i64().unwrap(), 31);
    let text = succeeds(directory.path(), &["compare", "a.json", "b.json"]);
    let said =
        "largest +50.000 ± 56.569 urad at 310 deg, clearest for its uncertainty +12.000 ± 4.243 urad at 70 deg (95 %)";
    assert!(text.contains(said), "{text}");
}

#[test]
fn noise_alone_is_a_change_in_no_more_than_one_comparison_of_twenty() {
    use trunnion::history::{Measured, MeasuredPoint, Reported, compare};
    use trunnion::study::{ErrorLimits, Simulation};
    let setup = trunnion::Setup::from_catalogue("tilting-table-a", &[("R", 150.0)]).unwrap();
    let function = setup.estimated().next().unwrap();
    let measured = |seed: u64| {
        let limits = ErrorLimits { length: 0.0, angle: 0.0 };
        let simulation = Simulation { seed, samples: 90, noise_um: 0.5, limits, range_deg: (0.0, 360.0) };
        let observations = simulation.measure(&setup).observations.raw;
        let fit = trunnion::study::fit(&setup, &observations, trunnion::Estimator::Joint).unwrap();
        let point = |i: u32| {
            let at = f64::from(5 * i);
            let (value, std) = fit.function(&setup, function, at.to_radians());
            MeasuredPoint { at, value, u95: 1.97 * std }
        };
        let (name, unit) = ("EAA".to_owned(), "urad".to_owned());
        // At its ends the function is zero by its conditions, without uncertainty.
        let points = (0..=72).map(point).collect();
        let own = Measured { name, unit, coordinate: "a_deg".to_owned(), value_of: None, points };
        Reported { name: seed.to_string(), day: None, functions: vec![own] }
    };
    let pairs = 400;
    let changed = (0..pairs).filter(|i| {
        let found = compare(&[measured(2 * i), measured(2 * i + 1)]);
        matches!(&found[0].outcome, trunnion::history::Outcome::Compared(own) if own.changed())
    });
    let changed = changed.count();
    assert!(changed <= pairs as usize / 20 + 9, "{changed} of {pairs}");
}

#[test]
fn what_is_no_report_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(directory.path().join(name), text).unwrap();
    write("a.json", &report("", |_| 0.0, 1.0));
    write("b.json", &report("", |_| 0.0, 1.0).replace("\"m\"", "\"other\""));
    write("c.json", "{");
    write("d.json", &report("", |_| 0.0, 1.0).replacen("\"value\":0.0", "\"value\":null", 1));
    for (name, date) in [("e.json", "gestern"), ("f.json", "01.04.2026")] {
        write(name, &report(date, |_| 0.0, 1.0));
    }
    let cases: [(&[&str], &str); 10] = [
        (&["a.json", "e.json"], "e.json: measured on \"gestern\"\n  expected a date such as 2026-04-01"),
        (&["a.json", "f.json"], "f.json: measured on \"01.04.2026\""),
        (&["a.json", "a.json", "--over-time", "x.svg"], "a.json: no date of this report"),
        (&["a.json", "a.json", "--function", "NOPE"], "--function"),
        (&["a.json"], "a.json: one report"),
        (&["a.json", "b.json"], "b.json: a report of other, the first is one of m"),
        (&["a.json", "c.json"], "c.json: "),
        (&["a.json", "d.json"], "d.json: function EAA: a point without value"),
        (&["a.json", "absent.json"], "absent.json: "),
        (&["a.json", "a.json", "--svg", "x.svg", "--function", "Q"], "--function Q: not in the first report"),
    ];
    for (files, told) in cases {
        let output = trunnion(directory.path(), &[&["compare"], files].concat());
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{files:?}");
        assert!(message.contains(told), "{files:?}: {message}");
    }
}
