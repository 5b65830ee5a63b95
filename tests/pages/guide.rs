//! The commands of the guide, run in its order.

use super::{hold, read, root, run};
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;

pub const PAGE: &str = "docs/guide.md";

/// Blocks of the page in a language.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let begin = format!("```{language}\n");
    page.split(begin.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

/// What the page has to be stated in the project file, each table in place of the one there.
fn state(project: &Path, stated: &str) {
    let mut text = fs::read_to_string(project).unwrap();
    for table in stated.split("\n\n") {
        let head = table.lines().next().unwrap();
        let (before, own) = text.split_once(&format!("{head}\n")).unwrap_or_else(|| panic!("no {head} in the project"));
        let after = own.find("\n[").map_or("", |end| &own[end..]);
        text = format!("{before}{}\n{after}", table.trim_end());
    }
    fs::write(project, text).unwrap();
}

/// A recording as instruments make it: feed-in, there, back, feed-out, in a table of another program.
fn record(run: &Path, logger: &Path) {
    let readings = fs::read_to_string(run).unwrap();
    let rows: Vec<[f64; 2]> = readings
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').map(|(a, r)| [a, r].map(|number| number.parse().unwrap())).unwrap())
        .collect();
    let [begin, reading] = rows[0];
    let mut out = String::from("Angle;Radius\n");
    let feed = (0..30).map(|k| [begin, reading - 1500.0 * (1.0 - f64::from(k) / 30.0)]);
    let there_and_back = rows.iter().copied().chain(rows.iter().rev().copied());
    for [angle, reading] in feed.clone().chain(there_and_back).chain(feed.rev()) {
        writeln!(out, "{angle:.3};{reading:.2}").unwrap();
    }
    fs::write(logger, out).unwrap();
}

#[test]
fn every_command_does_what_the_guide_says() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let page = read(PAGE);
    let commands: Vec<&str> = blocks(&page, "sh").into_iter().flat_map(str::lines).collect();
    assert_eq!(commands.len(), 10);
    let [planned, _] = blocks(&page, "text")[..] else { panic!("what plan prints, and a table") };
    let [instrument, practice] = blocks(&page, "toml")[..] else { panic!("two blocks for the project file") };
    let project = at.join("table/trunnion.toml");
    for line in commands {
        if line.starts_with("trunnion import") {
            record(&at.join("practice/b-tangential-far.csv"), &at.join("logger.csv"));
        }
        if line.starts_with("trunnion circular") {
            for name in ["cw.csv", "ccw.csv"] {
                fs::copy(root().join("tests/reference/circular").join(name), at.join(name)).unwrap();
            }
        }
        if line.starts_with("trunnion compare") {
            // Half a year later: a machine drawn anew.
            run(at, "trunnion simulate table --seed 8 --noise-um 0.2 --range-deg=-105:105 --out practice");
            let dated = fs::read_to_string(&project).unwrap().replace("2026-11-29", "2027-04-12");
            fs::write(&project, dated).unwrap();
            run(at, "trunnion fit table --json > april.json");
        }
        let printed = run(at, line);
        if line.starts_with("trunnion plan") {
            assert!(printed.contains(planned), "{printed}");
            let five = run(at, &line.replace("--within 10", "--within 5"));
            assert!(five.contains("5 runs") && five.contains("± 3.062 urad") && page.contains("five that give ±3.1"));
        }
        if line.starts_with("trunnion new") {
            state(&project, instrument);
            let dated = fs::read_to_string(&project).unwrap().replace("# date = \"\"", "date = \"2026-11-29\"");
            fs::write(&project, dated).unwrap();
        }
        if line.starts_with("trunnion simulate") {
            state(&project, practice);
        }
    }
    let report = fs::read_to_string(at.join("report.html")).unwrap();
    assert!(report.contains("QC20-W") && report.contains("Measured on"), "the report has what the project states");
    let fitted: Value = serde_json::from_str(&fs::read_to_string(at.join("november.json")).unwrap()).unwrap();
    let u95 = fitted["functions"][0]["largest"]["budget"]["u95"].as_f64().unwrap();
    assert!(page.contains(&format!("the four of the catalogue give ±{u95:.0}")), "{u95}");
    let table = fs::read_to_string(at.join("B.comp")).unwrap();
    assert_eq!(table.lines().map(|row| row.split(' ').count()).collect::<Vec<_>>(), [3; 101]);
    assert!(fs::read_dir(at.join("curves")).unwrap().count() > 0);
    for made in ["imported/logger-ccw.csv", "imported/logger-cw.csv"] {
        assert!(at.join(made).exists(), "{made}");
    }
    hold(PAGE, &[at, &at.join("imported"), &at.join("pictures")]);
}
