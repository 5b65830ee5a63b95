//! Rows of a budget against fits of readings that were changed by what the row is about, and sums worked out again.

use super::{MODEL, MODELS, RUNS, fit_of, simulated, succeeds, words};
use serde_json::Value;
use std::fs;
use std::path::Path;

const STATED: [&str; 12] = [
    "--instrument-um",
    "0.7",
    "--instrument-share",
    "0.003",
    "--bar-length-um",
    "1.5",
    "--temperature-k",
    "2",
    "--expansion-per-k",
    "1.1e-5",
    "--angle-urad",
    "80",
];

/// Functions of an error that is the same from reading to reading, each with its share of the variance.
const WAVES: usize = 9;

fn fit(directory: &Path) -> Value {
    let fit = ["fit", MODEL, "--radius", "150", "--json"];
    serde_json::from_str(&succeeds(directory, &[&fit[..], &RUNS, &STATED].concat())).unwrap()
}

/// A CSV file with one of its columns changed, of the angle in rad and the value before.
fn change(file: &Path, column: &str, with: impl Fn(f64, f64) -> f64) {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap();
    let at = header.split(',').position(|name| name == column).unwrap();
    let line = |line: &str| {
        let mut values: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        values[at] = with(values[0].to_radians(), values[at]);
        values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(",")
    };
    let changed: Vec<String> = std::iter::once(header.to_owned()).chain(lines.map(line)).collect();
    fs::write(file, changed.join("\n") + "\n").unwrap();
}

fn wave(k: usize, angle: f64) -> f64 {
    let (sin, cos) = (k.div_ceil(2) as f64 * angle).sin_cos();
    0.2f64.sqrt() * if k.is_multiple_of(2) && k > 0 { sin } else { cos }
}

fn number(value: &Value, at: &str) -> f64 {
    value.pointer(at).and_then(Value::as_f64).unwrap_or_else(|| panic!("{at} of {value}"))
}

fn near(found: f64, expected: f64, share: f64, what: &str) {
    // What makes no difference at all is zero but for rounding.
    assert!((found - expected).abs() <= share * expected.abs() + 1e-6, "{what}: {found} where {expected} is expected");
}

/// The value where the uncertainty is largest.
fn value(fit: &Value, at: f64) -> f64 {
    let points = fit["functions"][0]["points"].as_array().unwrap();
    number(points.iter().find(|p| number(p, "/a_deg") == at).unwrap(), "/value")
}

#[test]
fn each_row_is_what_a_changed_quantity_does() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let at = directory.path();
    // The table states 0.4 µm of one function.
    let table = fs::read_to_string(at.join("table.csv")).unwrap();
    let line = |(k, line): (usize, &str)| format!("{line},{}", if k == 0 { "u_dya_um" } else { "0.4" });
    fs::write(at.join("table.csv"), table.lines().enumerate().map(line).collect::<Vec<_>>().join("\n") + "\n").unwrap();
    let undisturbed = fit(at);
    let largest = &undisturbed["functions"][0]["largest"];
    let place = number(largest, "/a_deg");
    let inputs = largest["inputs"].as_array().unwrap();
    let row =
        |quantity: &str| inputs.iter().find(|i| i["quantity"] == quantity).unwrap_or_else(|| panic!("{quantity}"));
    let before = value(&undisturbed, place);
    let by = |files: &[&str], column: &str, with: &dyn Fn(f64, f64) -> f64| {
        let copy = tempfile::tempdir().unwrap();
        for file in ["tilting.csv", "separation.csv", "table.csv"] {
            fs::copy(at.join(file), copy.path().join(file)).unwrap();
        }
        files.iter().for_each(|file| change(&copy.path().join(file), column, with));
        value(&fit(copy.path()), place) - before
    };
    let runs = ["tilting.csv", "separation.csv"];
    let longer = by(&runs, "dr_um", &|_, dr| dr + 1.0).abs();
    near(number(row("bar length"), "/sensitivity"), longer, 1e-6, "bar length");
    near(number(row("bar temperature"), "/sensitivity"), longer * 150e3 * 1.1e-5, 1e-6, "temperature");
    let share = by(&runs, "dr_um", &|_, dr| dr * 1.001).abs() / 0.001;
    near(number(row("share of the reading"), "/sensitivity"), share, 1e-6, "share");
    let waves = |files: &[&str], column: &str| {
        let one = |k: usize| by(files, column, &|angle, x| x + wave(k, angle)).powi(2);
        (0..WAVES).map(one).sum::<f64>().sqrt()
    };
    near(number(row("error of all readings"), "/sensitivity"), waves(&runs, "dr_um"), 1e-6, "instrument");
    near(number(row("table of d_ya"), "/sensitivity"), waves(&["table.csv"], "dya_um"), 1e-6, "table");
    // Bounds over √3 are standard uncertainties, and the table's are as stated.
    let stated = [
        ("bar length", 1.5),
        ("bar temperature", 2.0),
        ("share of the reading", 0.003),
        ("error of all readings", 0.7),
    ];
    for (quantity, bound) in stated {
        near(number(row(quantity), "/bound"), bound, 1e-12, quantity);
        near(number(row(quantity), "/std"), bound / 3f64.sqrt(), 1e-12, quantity);
    }
    near(number(row("table of d_ya"), "/std"), 0.4, 1e-9, "table");
    // A reading scatters as all residuals do: 720 readings, 13 coefficients. Each step of the trace has one sample.
    let recordings = undisturbed["recordings"].as_array().unwrap();
    let residuals = recordings.iter().flat_map(|r| r["increasing"]["residual_um"].as_array().unwrap());
    let squares: Vec<f64> = residuals.map(|r| r.as_f64().unwrap().powi(2)).collect();
    assert_eq!(squares.len(), 720);
    near(number(row("a reading"), "/std"), (squares.iter().sum::<f64>() / 707.0).sqrt(), 1e-9, "scatter");
    assert_eq!(row("a reading")["degrees_of_freedom"], 707);
    // Its sensitivity: the root of the sum of squares of those to single readings, by one in twenty of them.
    let mut sum = 0.0;
    for (file, k) in runs.iter().flat_map(|file| (0..18).map(move |k| (*file, 20 * k))) {
        let single = |angle: f64, dr: f64| if (angle - f64::from(k).to_radians()).abs() < 1e-6 { dr + 1.0 } else { dr };
        sum += 20.0 * by(&[file], "dr_um", &single).powi(2);
    }
    near(number(row("a reading"), "/sensitivity"), sum.sqrt(), 0.05, "scatter");
}

/// Rows make their line, lines the budget; shares are of the whole; the factor is Student's.
fn adds_up(largest: &Value, what: &str) {
    let inputs = largest["inputs"].as_array().unwrap();
    let budget = &largest["budget"];
    for line in budget["lines"].as_array().unwrap() {
        let own = inputs.iter().filter(|i| i["source"] == line["source"]).map(|i| number(i, "/contribution").powi(2));
        near(own.sum::<f64>().sqrt(), number(line, "/std"), 1e-9, &format!("{what}: {}", line["source"]));
    }
    let combined = inputs.iter().map(|i| number(i, "/contribution").powi(2)).sum::<f64>().sqrt();
    near(number(budget, "/std"), combined, 1e-9, what);
    for input in inputs {
        near(number(input, "/contribution"), number(input, "/std") * number(input, "/sensitivity"), 1e-9, what);
    }
    let shares = inputs.iter().map(|i| number(i, "/share_percent")).sum::<f64>();
    near(shares + number(largest, "/correlations/share_percent"), 100.0, 1e-9, what);
    near(number(budget, "/u95"), number(budget, "/std") * number(budget, "/coverage_factor"), 1e-12, what);
    // Welch and Satterthwaite, of the one row of type A.
    let type_a = inputs.iter().find(|i| !i["degrees_of_freedom"].is_null()).unwrap();
    let ratio = number(budget, "/std") / number(type_a, "/contribution");
    let effective = ratio.powi(4) * number(type_a, "/degrees_of_freedom");
    near(number(budget, "/effective_degrees_of_freedom"), effective, 1e-6, what);
}

#[test]
fn budgets_add_up() {
    let directory = simulated(MODEL, &["--radius", "150"]);
    let fit = fit(directory.path());
    let largest = &fit["functions"][0]["largest"];
    adds_up(largest, MODEL);
    // What is nearly normal has nearly the same interval when its distributions are propagated.
    near(number(largest, "/monte_carlo/u95"), number(largest, "/budget/u95"), 0.01, "Monte Carlo");
    for (model, runs) in MODELS {
        let (directory, fit) = fit_of(model, runs);
        let fit = succeeds(directory.path(), &[&words(&fit)[..], &["--json"]].concat());
        let fit: Value = serde_json::from_str(&fit).unwrap();
        let functions = fit["functions"].as_array().unwrap();
        let seen: Vec<&Value> = functions.iter().filter(|f| !f["largest"].is_null()).collect();
        assert!(!seen.is_empty());
        for function in seen {
            adds_up(&function["largest"], &format!("{model}: {}", function["name"]));
        }
    }
}
