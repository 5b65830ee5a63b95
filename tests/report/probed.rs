//! Reports of a probe in a ring: their numbers, rows and trials.

use super::{reported, touches};
use crate::program::succeeds;
use serde_json::Value;
use std::fs;

/// The paper's touches in the ring: four ways, and two with the spindle reversed, with an offset of (0.21, 0.16) mm. The spindle
/// follows the dependent rotation, which is none at home's x.
fn reversal() -> String {
    let (r, [ox, oy]) = (17.0005_f64, [0.21_f64, 0.16]);
    let [along, across] = [(r * r - oy * oy).sqrt(), (r * r - ox * ox).sqrt()];
    let there = [[along - ox, 0.0, 0.0], [-along - ox, 0.0, 0.0], [0.0, across - oy, 0.0], [0.0, -across - oy, 0.0]];
    let back = [[along + ox, 0.0, 180.0], [0.0, across + oy, 180.0]];
    let lines = there.iter().chain(&back).map(|[x, y, spindle]| format!("{x},{y},-168,{spindle}\n"));
    "x_mm,y_mm,z_mm,spindle_deg\n".to_owned() + &lines.collect::<String>()
}

#[test]
fn ring_and_offset_have_theirs() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    fs::write(at.join("touches.csv"), touches(false)).unwrap();
    fs::write(at.join("reversed.csv"), touches(true)).unwrap();
    let (ring, page) = reported(at, &["exechon", "ring", "touches.csv", "--json"]);
    assert!(page.follows(&ring) > 15);
    page.is_whole();
    // Every touch is in its bin, worked out here from the deviations.
    let [from, width] = ["from_um", "width_um"].map(|key| ring["histogram"][key].as_f64().unwrap());
    let mut counts = vec![0; ring["histogram"]["counts"].as_array().unwrap().len()];
    let deviations: Vec<f64> =
        ring["deviations"].as_array().unwrap().iter().map(|d| 1e3 * d["deviation_mm"].as_f64().unwrap()).collect();
    deviations.iter().for_each(|um| counts[((um - from) / width).floor() as usize] += 1);
    assert_eq!(ring["histogram"]["counts"], serde_json::json!(counts));
    let squares: f64 = deviations.iter().map(|um| um * um).sum();
    assert!((ring["rms_um"].as_f64().unwrap() - (squares / 12.0).sqrt()).abs() < 1e-9);
    assert!(page.html.contains("Histogram of the radial deviations"));
    // Nine degrees of freedom: Student's t of 97.5 %.
    for k in 0..3 {
        let budget = &ring["budgets"][k];
        assert!((budget["budget"]["coverage_factor"].as_f64().unwrap() - 2.262_157).abs() < 1e-5);
        near_by_trials(budget, 0.03);
    }
    fs::write(at.join("paper.csv"), reversal()).unwrap();
    let (offset, page) = reported(at, &["exechon", "offset", "reversed.csv"]);
    assert!(page.follows(&offset) > 20);
    page.is_whole();
    assert!((offset["coverage_factor"].as_f64().unwrap() - 1.959_964).abs() < 1e-6);
    // A ring that is 2 µm larger moves the offset by what the budget says, and the rows make what stands beside the result.
    let number = |value: &Value| value.as_f64().unwrap();
    let larger: Value =
        serde_json::from_str(&succeeds(at, &["exechon", "offset", "paper.csv", "--diameter", "40.003"])).unwrap();
    let (nominal, page) = reported(at, &["exechon", "offset", "paper.csv"]);
    page.follows(&nominal);
    page.is_whole();
    for k in 0..2 {
        let budget = &nominal["budgets"][k];
        let moved = number(&larger["reversal"]["exact_mm"][k]) - number(&nominal["reversal"]["exact_mm"][k]);
        let [touch, ring] = [0, 1].map(|row| &budget["inputs"][row]);
        assert!((moved.abs() / 2e-3 - number(&ring["sensitivity"])).abs() < 1e-4, "{moved}");
        let squares = [touch, ring].map(|row| (number(&row["std"]) * number(&row["sensitivity"])).powi(2));
        let std = squares.iter().sum::<f64>().sqrt();
        assert!((std - number(&budget["budget"]["std"])).abs() < 1e-9);
        let told = number(&nominal["reversal"]["expanded_uncertainty_mm"][k]);
        assert!((1e-3 * number(&budget["budget"]["u95"]) - told).abs() < 1e-12);
        near_by_trials(budget, 0.03);
    }
    (0..2).for_each(|k| near_by_trials(&offset["budgets"][k], 0.03));
}

/// By trials, where nothing bends, the interval is that of the budget: 20,000 tell it to 1 %.
fn near_by_trials(budget: &Value, within: f64) {
    let [tried, told] = ["monte_carlo", "budget"].map(|key| budget[key]["u95"].as_f64().unwrap());
    assert!((tried / told - 1.0).abs() < within, "{tried} for {told}");
    assert_eq!(budget["monte_carlo"]["trials"], 20_000);
}

#[test]
fn a_ring_s_budget_has_what_is_stated_of_the_probe() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    // The spindle stands at another angle in each half, and touches scatter.
    let touch = |k: usize| {
        let (angle, spindle) = ((k as f64 * 30.0).to_radians(), if k < 6 { 20.0 } else { 75.0 });
        let r = 17.0 + 0.001 * ((k * k * 7 % 11) as f64 - 5.0);
        let (s, c) = f64::to_radians(spindle).sin_cos();
        let off = [0.21 * c - 0.16 * s, 0.21 * s + 0.16 * c];
        format!("{},{},-168,{spindle}\n", r * angle.cos() - off[0], r * angle.sin() - off[1])
    };
    let lines: String = (0..12).map(touch).collect();
    fs::write(at.join("touches.csv"), format!("x_mm,y_mm,z_mm,spindle_deg\n{lines}")).unwrap();
    let ring = |offset: &str, stylus: &str| {
        let command = ["exechon", "ring", "touches.csv", "--json", "--offset", offset, "--stylus", stylus];
        reported(at, &[&command[..], &["--offset-accuracy", "6", "--stylus-accuracy", "4"]].concat())
    };
    let (document, page) = ring("0.21,0.16", "6");
    page.follows(&document);
    page.is_whole();
    let number = |value: &Value| value.as_f64().unwrap();
    let circle = |document: &Value| {
        let own = &document["least_squares"];
        [&own["centre_mm"][0], &own["centre_mm"][1], &own["diameter_mm"]].map(number)
    };
    let moved = |offset: &str, stylus: &str| {
        let (from, to) = (circle(&document), circle(&ring(offset, stylus).0));
        [0, 1, 2].map(|k| (to[k] - from[k]) / 1e-3)
    };
    let per = [moved("0.211,0.16", "6"), moved("0.21,0.161", "6"), moved("0.21,0.16", "6.001")];
    for k in 0..3 {
        let budget = &document["budgets"][k];
        let row = |source: &str, quantity: &str| {
            let rows = budget["inputs"].as_array().unwrap();
            rows.iter().find(|row| row["source"] == source && row["quantity"] == quantity).unwrap()
        };
        let stated = [row("offset", "its x"), row("offset", "its y"), row("stylus ball", "its diameter")];
        for ((row, per), two) in stated.iter().zip(&per).zip([6.0, 6.0, 4.0]) {
            assert!((number(&row["sensitivity"]) - per[k]).abs() < 1e-3, "{k}: {row}, not {}", per[k]);
            assert_eq!((number(&row["bound"]), number(&row["std"])), (two, two / 2.0));
        }
        let touch = row("probe", "a touch");
        let all = stated.iter().zip(&per).map(|(row, per)| number(&row["std"]) * per[k]);
        let own = number(&touch["contribution"]);
        let square: f64 = all.map(|part| part * part).sum::<f64>() + own * own;
        assert!((square.sqrt() / number(&budget["budget"]["std"]) - 1.0).abs() < 1e-3);
        // Welch and Satterthwaite: only the scatter has degrees of freedom, nine.
        let effective = 9.0 * (square.sqrt() / own).powi(4);
        assert!((effective / number(&budget["budget"]["effective_degrees_of_freedom"]) - 1.0).abs() < 1e-2);
        // Student's t with nine degrees of freedom and a normal distribution together: Welch and Satterthwaite's is up to 4 % short.
        near_by_trials(budget, 0.055);
    }
}
