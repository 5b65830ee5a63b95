//! Numbers and texts where they come in: each refused with its name, its value and what is accepted.

mod program;

use program::{succeeds, trunnion};
use std::fs;
use std::path::Path;

/// Exit code 2, nothing on standard output, all of this in the message and what was expected.
fn refused(directory: &Path, arguments: &[&str], told: &[&str]) {
    let output = trunnion(directory, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert!(said.contains("\n  "), "{arguments:?}: {said}");
    told.iter().for_each(|told| assert!(said.contains(told), "{arguments:?}: {said} without {told}"));
}

const TOUCHES: &str = "x_mm,y_mm,z_mm,spindle_deg\n17,200,-168,0\n0,217,-168,0\n-17,200,-168,0\n0,183,-168,0\n\
                       17,200,-168,180\n0,217,-168,180\n-17,200,-168,180\n0,183,-168,180\n";

#[test]
fn every_number_of_an_option_has_its_range() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    fs::write(at.join("t.csv"), TOUCHES).unwrap();
    let (offset, ring) = (["exechon", "offset", "t.csv"], ["exechon", "ring", "t.csv"]);
    let plan = ["exechon", "plan", "ring", "--centre=-319.135,198.236,-168"];
    let drm = ["exechon", "drm", "--ring=-0.625,200.914,-168"];
    let map = ["exechon", "drm", "--svg", "m.svg", "--map"];
    let (length, wide) = ("above 0 to 100000", "from -100000 to 100000");
    let model = |command| [command, "tilting-table-a"];
    let checked: [(&[&str], &str, &str); 24] = [
        (&offset, "--repeatability", "above 0 to 10000"),
        (&offset, "--accuracy", "from 0 to 10000"),
        (&offset, "--diameter", length),
        (&offset, "--stylus", "from 0 to 100000"),
        (&ring, "--stylus", "from 0 to 100000"),
        (&ring, "--step-deg", "above 0 to 360"),
        (&plan, "--size", length),
        (&plan, "--clearance", length),
        (&plan, "--touches", "from 2 to 1000"),
        (&drm, "--diameter", length),
        (&drm, "--touches", "from 7 to 10000"),
        (&map[..4], "--map", wide),
        (&[&map[..], &["0"]].concat(), "--reach", length),
        (&model("simulate"), "--noise-um", "from 0 to 10000"),
        (&model("simulate"), "--samples", "from 1 to 10000000"),
        (&model("simulate"), "--from-deg", "from -3600 to 3600"),
        (&model("simulate"), "--length-um", "from 0 to 10000"),
        (&model("fit"), "--angle-urad", "from 0 to 10000"),
        (&model("fit"), "--instrument-um", "from 0 to 10000"),
        (&model("fit"), "--temperature-k", "from 0 to 10000"),
        (&model("monte-carlo"), "--trials", "from 1 to 100000"),
        (&model("plan"), "--noise-um", "from 0 to 10000"),
        (&model("plan"), "--samples", "from 2 to 100000"),
        (&model("derive"), "--noise-um", "from 0 to 10000"),
    ];
    for (command, option, range) in checked {
        for value in ["NaN", "inf", "1e308", "-1e9", "many"] {
            let given = format!("{option}={value}");
            refused(at, &[command, &[given.as_str()]].concat(), &[option, value, range]);
            // Apart from its option, a negative number is still its value.
            refused(at, &[command, &[option, value]].concat(), &[option, value, range]);
        }
    }
    for centre in ["1,2", "NaN,0,0", "1e300,0,0"] {
        refused(at, &["exechon", "plan", "ring", "--size", "40", &format!("--centre={centre}")], &["--centre", centre]);
    }
    refused(at, &[&offset[..], &["--stylus", "41"]].concat(), &["--stylus", "smaller than --diameter"]);
    for length in ["H=NaN", "H=1e300"] {
        refused(at, &["derive", "bc-trunnion", "--radius", "150", "--set", length], &["--set", length, wide]);
    }
}

#[test]
fn an_option_without_effect_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    fs::write(at.join("t.csv"), TOUCHES).unwrap();
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/src/exechon/xt700.toml"), at.join("m.toml")).unwrap();
    let plan = ["exechon", "plan", "ring", "--centre=-319.135,198.236,-168", "--size", "40"];
    let drm = ["exechon", "drm", "--ring=-0.625,200.914,-168"];
    let ignored: [&[&str]; 13] = [
        &[&plan[..], &["--rings", "3"]].concat(),
        &[&plan[..], &["--repeats", "3"]].concat(),
        &[&drm[..], &["--reach", "100"]].concat(),
        &[&drm[..], &["--frame", "base"]].concat(),
        &["exechon", "drm", "p.csv", "--svg", "p.svg"],
        &["exechon", "drm", "p.csv", "--diameter", "40"],
        &["exechon", "ring", "t.csv", "--machine", "m.toml"],
        &["exechon", "paper", "--force"],
        &["derive", "tilting-table-a", "--samples", "90"],
        &["derive", "tilting-table-a", "--range-deg", "0:90"],
        &["derive", "tilting-table-a", "--emit", "c", "--radius", "150"],
        &["monte-carlo", "tilting-table-a", "--instrument-um", "1"],
        &["plan", "rotary-table-c", "--for", "ECC", "--radius", "100,150"],
    ];
    for arguments in ignored {
        let output = trunnion(at, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn every_number_of_a_machine_file_has_its_range() {
    let directory = tempfile::tempdir().unwrap();
    let (at, built_in) = (directory.path(), include_str!("../src/exechon/xt700.toml"));
    fs::write(at.join("t.csv"), TOUCHES).unwrap();
    let numbers = ["ys2_mm = 450.0", "tz_mm = 380.0", "strut_mm = 1438.0", "a_deg = -45.0", "c_deg = [-270.0, 270.0]"];
    for number in numbers {
        let key = number.split(' ').next().unwrap();
        let line = 1 + built_in.lines().position(|line| line.starts_with(number)).unwrap();
        let range = if key.ends_with("mm") { "from -100000 to 100000" } else { "from -3600 to 3600" };
        for value in ["nan", "inf", "-inf", "1e200", "1e100"] {
            let bad = number.split(" = ").nth(1).unwrap().replace("-270.0", value);
            let bad = if bad.starts_with('[') { bad } else { value.to_owned() };
            fs::write(at.join("m.toml"), built_in.replacen(number, &format!("{key} = {bad}"), 1)).unwrap();
            let told = ["m.toml: ", &format!("line {line}: {key} = "), range];
            refused(at, &["exechon", "offset", "t.csv", "--machine", "m.toml"], &told);
        }
    }
}

#[test]
fn encodings_are_read_or_named() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let machine = include_str!("../src/exechon/xt700.toml");
    let model = trunnion_codegen::catalogue::source("tilting-table-a").unwrap();
    let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>();
    fs::write(at.join("t.csv"), TOUCHES).unwrap();
    // What a person writes for this program is UTF-8.
    let commands: [(&str, &[&str]); 2] =
        [(machine, &["exechon", "offset", "t.csv", "--machine", "f"]), (model, &["derive", "f"])];
    for (text, arguments) in commands {
        fs::write(at.join("f"), format!("\u{feff}{}", text.replace('\n', "\r\n"))).unwrap();
        succeeds(at, arguments);
        fs::write(at.join("f"), utf16(&format!("\u{feff}{text}"))).unwrap();
        refused(at, arguments, &["f:", "UTF-16"]);
        fs::write(at.join("f"), utf16(text)).unwrap();
        refused(at, arguments, &["f:", "UTF-16"]);
        fs::write(at.join("f"), [b"# \n# \xb5m, \xe9tabli\n", text.as_bytes()].concat()).unwrap();
        refused(at, arguments, &["f:", "2:", "Latin-1"]);
    }
    // What an instrument or a spreadsheet writes is what it is.
    let latin = [b"# \n# \xb5m, \xe9tabli\n", TOUCHES.as_bytes()].concat();
    for bytes in [format!("\u{feff}{TOUCHES}").into(), utf16(TOUCHES), utf16(&format!("\u{feff}{TOUCHES}")), latin] {
        fs::write(at.join("f"), bytes).unwrap();
        succeeds(at, &["exechon", "offset", "f"]);
    }
}

#[test]
fn the_parallel_machine_s_files_are_read_as_all_others() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    fs::write(at.join("t.csv"), format!("{TOUCHES}1,2,NaN,0\n1,2,,0\n1,2,3,4\n1;2\n")).unwrap();
    fs::write(at.join("p.csv"), "x_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n0,0,0\n0,0,0,0,0,1\n0,0,x,0,0,1\n").unwrap();
    refused(at, &["exechon", "offset", "t.csv"], &["t.csv:10: ", "t.csv:11: ", "t.csv:13: "]);
    refused(at, &["exechon", "ik", "p.csv"], &["p.csv:3: ", "p.csv:5: "]);
    let absurd: [(&str, &str, &str, &str); 5] = [
        ("ring", "x_mm,y_mm,z_mm", "1e200,0,0", "-100000 to 100000"),
        ("offset", "x_mm,y_mm,z_mm,spindle_deg", "0,0,0,1e9", "-360000 to 360000"),
        ("ik", "x_mm,y_mm,z_mm,i,j,k", "1e308,0,0,0,0,1", "-100000 to 100000"),
        ("fk", "l1_mm,l2_mm,l3_mm,a_deg,c_deg", "1e100,1400,1400,-45,0", "-100000 to 100000"),
        ("fk", "l1_mm,l2_mm,l3_mm,a_deg,c_deg", "1400,1400,1400,-45,1e300", "-360000 to 360000"),
    ];
    for (command, header, line, range) in absurd {
        fs::write(at.join("f.csv"), format!("{header}\n{line}\n")).unwrap();
        refused(at, &["exechon", command, "f.csv"], &["f.csv:2: \"1e", range]);
    }
}
