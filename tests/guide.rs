//! The commands of the guide, run in its order.

use std::fs;
use std::path::Path;
use std::process::Command;

const GUIDE: &str = include_str!("../docs/guide.md");

/// Runs a line as a shell would, standard output into a file where the line says so.
fn run(directory: &Path, line: &str) {
    let (command, into) = line.split_once(" > ").map_or((line, None), |(command, file)| (command, Some(file)));
    let mut words = command.split_whitespace();
    assert_eq!(words.next(), Some("trunnion"), "{line}");
    let output = Command::new(env!("CARGO_BIN_EXE_trunnion")).current_dir(directory).args(words).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    if let Some(file) = into {
        fs::write(directory.join(file), output.stdout).unwrap();
    }
}

/// Readings under the names that the project has: there, and back in the other order.
fn both_ways(directory: &Path, run: &str) {
    let readings = fs::read_to_string(directory.join(format!("practice/{run}.csv"))).unwrap();
    let lines: Vec<&str> = readings.lines().collect();
    let back: Vec<&str> = lines[..1].iter().chain(lines[1..].iter().rev()).copied().collect();
    fs::write(directory.join(format!("table/{run}-there.csv")), &readings).unwrap();
    fs::write(directory.join(format!("table/{run}-back.csv")), back.join("\n") + "\n").unwrap();
}

#[test]
fn every_command_does_what_the_guide_says() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let blocks = GUIDE.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let commands: Vec<&str> = blocks.flat_map(str::lines).collect();
    assert_eq!(commands.len(), 8);
    let circle = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/circular");
    for line in commands {
        if line.starts_with("trunnion circular") {
            for name in ["cw.csv", "ccw.csv"] {
                fs::copy(Path::new(circle).join(name), at.join(name)).unwrap();
            }
        }
        if line.starts_with("trunnion compare") {
            // Half a year later: a machine drawn anew.
            run(at, "trunnion simulate table --seed 8 --noise-um 0.2 --out practice");
            ["tilting", "separation"].iter().for_each(|run| both_ways(at, run));
            run(at, "trunnion fit table --json > april.json");
        }
        run(at, line);
        if line.starts_with("trunnion new") {
            // What the page has to be stated of the instrument.
            let stated = GUIDE.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
            let project = fs::read_to_string(at.join("table/trunnion.toml")).unwrap();
            let project = project.replace("[instrument]\n", stated).replace("# date = \"\"", "date = \"2026-11-29\"");
            fs::write(at.join("table/trunnion.toml"), project).unwrap();
        }
        if line.starts_with("trunnion simulate") {
            ["tilting", "separation"].iter().for_each(|run| both_ways(at, run));
        }
    }
    let report = fs::read_to_string(at.join("report.html")).unwrap();
    assert!(report.contains("QC20-W") && report.contains("Measured on"), "the report has what the project states");
    let table = fs::read_to_string(at.join("A.comp")).unwrap();
    assert_eq!(table.lines().map(|row| row.split(' ').count()).collect::<Vec<_>>(), [3; 76]);
    assert!(fs::read_dir(at.join("curves")).unwrap().count() > 0);
    for picture in ["circle.svg", "changes.svg", "trend.svg"] {
        assert!(fs::read_to_string(at.join(picture)).unwrap().starts_with("<svg"), "{picture}");
    }
}
