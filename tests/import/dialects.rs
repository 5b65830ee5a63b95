//! CSV as instruments and people write it: the fit is that of the native files.

use super::{alike, fitted, number, object, reference, samples, succeeds};
use std::fs;
use std::path::Path;

const NATIVE: [&str; 2] = ["tilting.csv", "separation.csv"];

/// Files with the same numbers, each line made from the text of its angle (degrees) and reading (µm).
fn in_dialect(at: &Path, header: &str, line: impl Fn(&str, &str) -> String, encode: impl Fn(&str) -> Vec<u8>) {
    for file in NATIVE {
        let lines: String = samples(&at.join(file)).iter().map(|(a, r)| line(a, r) + "\n").collect();
        fs::write(at.join(format!("other-{file}")), encode(&format!("{header}\n{lines}"))).unwrap();
    }
}

const OTHER: [&str; 2] = ["other-tilting.csv", "other-separation.csv"];

fn comma(number: &str) -> String {
    number.replace('.', ",")
}

fn plain(text: &str) -> Vec<u8> {
    text.as_bytes().to_vec()
}

fn utf16(text: &str, order: fn(u16) -> [u8; 2]) -> Vec<u8> {
    text.encode_utf16().flat_map(order).collect()
}

fn latin(text: &str) -> Vec<u8> {
    text.chars().map(|letter| u8::try_from(u32::from(letter)).unwrap()).collect()
}

#[test]
fn a_fit_is_the_same_whatever_the_signs_and_the_encoding() {
    let directory = reference("full");
    let at = directory.path();
    let native = fitted(at, NATIVE, &[]);
    let same = || assert_eq!(fitted(at, OTHER, &[]), native);
    let german = |a: &str, r: &str| format!("{};{}", comma(a), comma(r));
    in_dialect(at, "a_deg;dr_um", german, plain);
    same();
    in_dialect(at, "a_deg;dr_um", |a, r| format!("{a};{r}"), plain);
    same();
    in_dialect(at, "\ta_deg\tdr_um", |a, r| format!("x\t{}\t{}", comma(a), comma(r)), plain);
    same();
    in_dialect(at, "dr_um | a_deg", |a, r| format!("{r} | {a}"), plain);
    same();
    in_dialect(at, "a_deg,dr_um", |a, r| format!("\"{}\",\"{}\"", comma(a), comma(r)), plain);
    same();
    // A sign too many at the end of each line.
    in_dialect(at, "a_deg;dr_um", |a, r| format!("{};{};", comma(a), comma(r)), plain);
    same();
    for mark in ["", "\u{feff}"] {
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            in_dialect(at, &format!("{mark}a_deg;dr_um"), german, |text| utf16(&text.replace('\n', "\r\n"), order));
            same();
        }
    }
    // A table of known functions, as well.
    let table = fs::read_to_string(at.join("table.csv")).unwrap();
    fs::write(at.join("table.csv"), utf16(&comma(&table.replace(',', ";")), u16::to_le_bytes)).unwrap();
    same();
}

#[test]
fn texts_above_the_table_and_columns_beside_it_are_passed_over() {
    let directory = reference("full");
    let at = directory.path();
    let native = fitted(at, NATIVE, &[]);
    let header = "Kreisformtest;Maschine 7\nRadius [mm];150\nGrenzen;-10;10\nVorschub, mm/min;1500\n\n\
                  Zeit;Winkel A [°];Temperatur [°C];Abweichung [µm];Status";
    let line = |a: &str, r: &str| format!("12:00:01;{};20,5;{};gut", comma(a), comma(r));
    let named = ["--columns", "a=Winkel A [°],dr=Abweichung [µm]"];
    for encode in [plain, latin] {
        in_dialect(at, header, line, encode);
        assert_eq!(fitted(at, OTHER, &named), native);
    }
    // Units on a line of their own, names with and without them.
    let header = "Maschine 7;;\nVorschub;1500;mm/min\n\nNr.;Winkel A;Abweichung\n;[°];(µm)";
    in_dialect(at, header, |a, r| format!("7;{};{}", comma(a), comma(r)), plain);
    for named in ["a=Winkel A,dr=Abweichung", "a=Winkel A [°],dr_um=Abweichung", "a_deg=Winkel A,dr=Abweichung [µm]"]
    {
        assert_eq!(fitted(at, OTHER, &["--columns", named]), native);
    }
    in_dialect(at, "a,dr\ndeg,um", |a, r| format!("{a},{r}"), plain);
    assert_eq!(fitted(at, OTHER, &[]), native);
    // With quotes, the unit stated, and in another one.
    let mm = |a: &str, r: &str| format!("{a},ok,{:?}", number(r) / 1e3);
    in_dialect(at, "Angle,State,\"Radius, dev.\"", mm, plain);
    let stated = ["--columns", r#"a_deg="Angle",dr_mm="Radius, dev.""#];
    alike(&fitted(at, OTHER, &stated), &native, 1e-9);
}

/// A run there and back and there again, with feed-in and feed-out of a millimetre, degrees and µm: up, samples of each part.
fn with_feed_arcs() -> (Vec<(f64, f64)>, [usize; 4]) {
    let reading = |a: f64| 8.0 * a.to_radians().cos() + 3.0 * (2.0 * a.to_radians()).sin() + 0.05 * (a * 77.0).sin();
    let there: Vec<f64> = (-40..=440).map(|i| f64::from(i) * 0.5).collect();
    let back: Vec<f64> = there.iter().rev().map(|a| a - 0.1).collect();
    let mut all: Vec<(f64, f64)> =
        (0..30).map(|i| (-20.0, reading(-20.0) - 1000.0 * (1.0 - f64::from(i) / 30.0))).collect();
    all.extend(there.iter().chain(&back).map(|a| (*a, reading(*a))));
    all.extend((1..=20).map(|i| (-20.1, reading(-20.1) + 900.0 * f64::from(i) / 20.0)));
    (all, [30, there.len(), back.len(), 20])
}

#[test]
fn feed_arcs_are_trimmed_and_directions_divided() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (all, [fed_in, there, back, fed_out]) = with_feed_arcs();
    let lines: String = all.iter().map(|(a, r)| format!("{a:.3};{r:.3}\n").replace('.', ",")).collect();
    fs::write(at.join("both.csv"), format!("QC20-W\n\nWinkel [°];dr [µm]\n{lines}")).unwrap();
    let arguments = ["import", "both.csv", "--out", "runs", "--columns", "a=Winkel [°]", "--json"];
    let all_of_it = object(&succeeds(at, &arguments));
    let runs = &all_of_it["files"][0]["runs"];
    assert_eq!((&runs[0]["direction"], &runs[1]["direction"]), (&"CCW".into(), &"CW".into()));
    assert_eq!((&runs[0]["trimmed"]["feed_in"], &runs[0]["trimmed"]["feed_out"]), (&fed_in.into(), &0.into()));
    assert_eq!((&runs[1]["trimmed"]["feed_in"], &runs[1]["trimmed"]["feed_out"]), (&0.into(), &fed_out.into()));
    assert_eq!((&runs[0]["samples"], &runs[1]["samples"]), (&there.into(), &back.into()));
    let (ccw, cw) = (samples(&at.join("runs/both-ccw.csv")), samples(&at.join("runs/both-cw.csv")));
    assert_eq!((ccw[0].0.as_str(), ccw[there - 1].0.as_str(), cw[0].0.as_str()), ("-20.0", "220.0", "219.9"));
    // The ends of the arc trim overshoot, in either direction.
    let arc = object(&succeeds(at, &[&arguments[..], &["--from-deg", "0", "--to-deg", "200"]].concat()));
    let runs = &arc["files"][0]["runs"];
    let trimmed = |run: &serde_json::Value| ["before", "after"].map(|key| run["trimmed"][key].as_u64().unwrap());
    assert_eq!((trimmed(&runs[0]), trimmed(&runs[1])), ([40, 40], [40, 41]));
    assert_eq!((&runs[1]["from_deg"], &runs[0]["from_deg"]), (&199.9.into(), &0.0.into()));
    let picture = fs::read_to_string(at.join("runs/both-ccw.svg")).unwrap();
    assert!(picture.contains("trimmed") && picture.contains("kept"), "what was trimmed has a tone of its own");
}

#[test]
fn names_of_columns_are_what_a_project_file_may_hold() {
    #[derive(serde::Deserialize)]
    struct Project {
        columns: trunnion::data::Columns,
    }
    let text = "[columns]\na = \"Angle [deg]\"\ndr_um = \"Radius\"\n";
    let project: Project = toml::from_str(text).unwrap();
    assert_eq!(project.columns, "a=Angle [deg],dr_um=Radius".parse().unwrap());
    assert!(toml::from_str::<Project>("[columns]\na = \"x\"\na_deg = \"y\"\n").is_err());
}
