//! Inputs without measure: each is refused within ten seconds and a gigabyte of address space, by a short message.
#![cfg(unix)]

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

const LONGEST: Duration = Duration::from_secs(60);

/// Runs the program in a gigabyte, with a shell's words before it.
fn run(directory: &Path, before: &str, arguments: &str) -> Output {
    let program = env!("CARGO_BIN_EXE_trunnion");
    let script = format!("ulimit -v 1000000; {before} exec '{program}' {arguments}");
    let began = Instant::now();
    let output = Command::new("sh").current_dir(directory).args(["-c", &script]).output().unwrap();
    assert!(began.elapsed() < LONGEST, "{before} {arguments}: {:?}", began.elapsed());
    output
}

/// Exit code 2, nothing on standard output, and a message that says this and is short.
fn refused(directory: &Path, before: &str, arguments: &str, told: &str) {
    let output = run(directory, before, arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    let beginning: String = said.chars().take(2000).collect();
    assert_eq!(output.status.code(), Some(2), "{arguments}: {beginning}");
    assert!(output.stdout.is_empty(), "{arguments}");
    assert!(said.len() < 10_000 && said.lines().all(|line| line.chars().count() <= 420), "{arguments}: {beginning}");
    assert!(said.contains(told), "{arguments}: {beginning} without {told}");
}

/// Both balls go along with each other, wherever `x` and the angle are.
fn model(constants: &str, x: &str, angle: &str, basis: &str) -> String {
    let motion = ["EX", "EY", "EZ", "EA", "EB", "EC"];
    let functions = motion.iter().flat_map(|e| ["X", "U", "A", "B"].map(|axis| format!("{e}{axis} = {basis}\n")));
    format!(
        "name = 'm'\nconstants = [{constants}]\nworkpiece = ['X', 'A']\ntool = ['B', 'U']\n\
         [axis]\nX.linear = 'x'\nU.linear = 'x'\nA.rotary = 'x'\nB.rotary = 'x'\n[run.r]\nsweep = 't'\nat = {{ X = '{x}', U = '{x}', A = '{angle}', B = '{angle}' }}\n\
         reading = {{ displacement = 'xyz' }}\n[function]\n{}",
        functions.collect::<String>()
    )
}

fn plain(x: &str) -> String {
    model("'R', 'L'", x, "t", "{ polynomial = 2 }")
}

fn numbered(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect()
}

#[test]
fn a_model_file_has_a_size_that_a_machine_may_have() {
    let directory = tempfile::tempdir().unwrap();
    let names: Vec<String> = (0..9).map(|i| format!("K{i}")).collect();
    let nine: String = names.iter().fold("'R', 'L'".to_owned(), |all, name| all + ", '" + name + "'");
    let power = model(&nine, &format!("(R+L+{})**20", names.join("+")), "t", "{ polynomial = 2 }");
    let list = |count| numbered(count, |i| format!("'k{i}',"));
    let definitions = numbered(300, |i| format!("d{i} = 'R', "));
    let files: [(&str, String, &str); 18] = [
        ("sum", plain(&("R".to_owned() + &"+R".repeat(12_000))), "more than 500 operators"),
        ("parentheses", plain(&"(".repeat(20_000)), "nested more than 100 deep"),
        ("signs", plain(&"-".repeat(20_000)), "nested more than 100 deep"),
        ("power", power, "more than 200 terms"),
        ("product", plain("((1+R)*(1+L)*(1+t))**10"), "more than 200 terms"),
        ("constants", model(&list(5000), "R", "t", "'zero'"), "more than 200 entries"),
        ("nominals", model(&list(100), "k0", "t", "'zero'"), "… and 59 more"),
        ("axes", plain("R") + &numbered(1000, |i| format!("[axis.N{i}]\nrotary = 'x'\n")), "more than 12 axes"),
        ("runs", plain("R") + &numbered(1000, |i| format!("[run.N{i}]\nsweep = 't'\n")), "more than 64 runs"),
        (
            "definitions",
            plain("R").replace("sweep", &format!("define = {{ {definitions} z = 'R' }}\nsweep")),
            "definitions",
        ),
        ("keys", numbered(1000, |i| format!("key{i} = 1\n")) + &plain("R"), "… and 980 more"),
        ("name", plain("R").replace("'m'", &format!("'{}'", "m".repeat(50_000))), "is not a name"),
        ("value", plain("R") + "[instrument]\npreset = '" + &"p".repeat(50_000) + "'\n", "unknown value"),
        ("bytes", "# ".to_owned() + &"x".repeat(1 << 20), "more than 65536 bytes"),
        ("brackets", "name = ".to_owned() + &"[".repeat(50_000), "not TOML"),
        ("dots", "a".to_owned() + &".a".repeat(30_000) + " = 1\n", "not TOML"),
        // What each of these means is short; what follows from it is not.
        ("degree", model("'R', 'L'", "R*cos(t)+L+(R+L+pi)**10*sin(t)", "t", "{ polynomial = 20 }"), "grow beyond use"),
        ("terms", model("'R', 'L'", "(1+R+cos(t)+t)**6", "t", "{ polynomial = 20 }"), "grow beyond use"),
    ];
    for (name, text, told) in files {
        fs::write(directory.path().join(name), text).unwrap();
        refused(directory.path(), "", &format!("derive {name}"), told);
    }
    fs::write(directory.path().join("good"), plain("R*cos(t)")).unwrap();
    assert!(run(directory.path(), "", "derive good").status.success());
}

#[test]
fn what_has_no_end_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    assert!(run(at, "", "simulate tilting-table-a --out .").status.success());
    let other = "--run separation=separation.csv";
    let (touches, poses) = ("x_mm,y_mm,z_mm,spindle_deg", "x_mm,y_mm,z_mm,i,j,k");
    for (before, arguments, told) in [
        ("", "derive /dev/zero", "more than 65536 bytes"),
        ("", "exechon paper --machine /dev/zero", "more than 65536 bytes"),
        ("", &format!("fit tilting-table-a --run tilting=/dev/zero {other}"), "a line of more than 65536 bytes"),
        ("", &format!("fit tilting-table-a --run tilting=tilting.csv {other} --table /dev/zero"), "a line of more"),
        ("", "exechon ik /dev/zero", "a line of more than 65536 bytes"),
        ("", "exechon offset /dev/zero", "a line of more than 65536 bytes"),
        (
            "yes 'a_deg,dr_um' | tr -d '\\n' |",
            &format!("fit tilting-table-a --run tilting=- {other}"),
            "a line of more",
        ),
        ("yes '' |", &format!("fit tilting-table-a --run tilting=- {other}"), "more than 25000000 lines"),
        (
            "(echo a_deg,dr_um; yes 1,2) |",
            &format!("fit tilting-table-a --run tilting=- {other}"),
            "more than 1000000 samples",
        ),
        (
            "(echo a_deg,dr_um; echo '1,\"2'; yes 3,4) |",
            &format!("fit tilting-table-a --run tilting=- {other}"),
            "a line of more",
        ),
        (
            "(echo a_deg,dr_um; yes x,y | head -1000) |",
            &format!("fit tilting-table-a --run tilting=- {other}"),
            "and 995 more",
        ),
        ("", "import /dev/zero --out x", "a line of more than 65536 bytes"),
        ("(echo '<a>'; yes) |", "import - --out x", "more than 16777216 bytes"),
        ("(printf '\\377\\376'; yes) |", "import - --out x", "a line of more than 65536 bytes"),
        ("(echo 'a_deg;dr_um'; yes '1;2,5') |", "import - --out x", "more than 300000 samples"),
        (&format!("(echo {touches}; yes 17,200,-168,0) |"), "exechon ring -", "more than 10000 touches"),
        (&format!("(echo {poses}; yes x) |"), "exechon ik -", "more than 25000000 lines"),
    ] {
        refused(at, before, arguments, told);
    }
}

#[test]
fn a_test_of_an_instrument_has_a_size() {
    let directory = tempfile::tempdir().unwrap();
    let nested = numbered(19_000, |i| format!("<a xmlns:n{i}='{i}'>")) + &"</a>".repeat(19_000);
    let attributes = format!("<a{}/>", numbered(300_000, |i| format!(" a{i}='>'")));
    let runs = "<BALLBAR_RUN><RUN_DIRECTION>CW</RUN_DIRECTION>".repeat(6000);
    let files = [
        ("namespaces", nested, "more than 64 namespaces"),
        ("attributes", attributes, "a tag of more than 4096 bytes"),
        ("elements", format!("<a>{}</a>", "<b/>".repeat(30_000)), "more than 20000 elements"),
        ("runs", format!("<TEST_DOCUMENT>{runs}{}</TEST_DOCUMENT>", "</BALLBAR_RUN>".repeat(6000)), "no READINGS"),
        ("letters", format!("<TEST_DOCUMENT>{}", "&#48; ".repeat(2_500_000)), "expected a whole XML file"),
        ("name", format!("<{}/>", "x".repeat(4000)), "its first element is <xxx"),
    ];
    for (name, text, told) in files {
        fs::write(directory.path().join(name), text).unwrap();
        refused(directory.path(), "", &format!("import {name} --out x"), told);
    }
}

#[test]
fn what_is_quoted_is_short() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let long = "x".repeat(100_000);
    let mut header = String::new();
    (0..10_000).for_each(|i| write!(header, "c{i},").unwrap());
    fs::write(at.join("wide.csv"), header + "\n").unwrap();
    fs::write(at.join("machine.toml"), format!("{long}=1\n").split_at(60_000).0).unwrap();
    for (arguments, told) in [
        (format!("derive {long}"), "x…"),
        (format!("simulate tilting-table-a --samples {long} --out ."), "from 1 to 10000000"),
        (format!("derive tilting-table-a --radius 150 --set {long}"), "expected for example"),
        (format!("plan tilting-table-a --for {long}"), "expected"),
        (long.clone(), "x…"),
        ("fit tilting-table-a --run tilting=wide.csv --run separation=wide.csv".to_owned(), "… and 9998 more"),
        ("exechon ik --machine machine.toml wide.csv".to_owned(), "expected the keys"),
    ] {
        refused(at, "", &arguments, told);
    }
}

#[test]
fn a_number_of_things_has_a_range() {
    let directory = tempfile::tempdir().unwrap();
    for (arguments, told) in [
        ("monte-carlo tilting-table-a --samples 150001", "at most 150000 for each of 2 runs"),
        ("monte-carlo tilting-table-a --trials 100001", "from 1 to 100000"),
        ("exechon plan plane --centre=-319,198,-168 --size 40 --touches 101", "at most 10000 in all"),
        ("exechon plan sphere --centre=-319,198,-168 --size 40 --touches 101 --rings 100", "at most 10000 in all"),
    ] {
        refused(directory.path(), "", arguments, told);
    }
    assert!(!directory.path().join("x").exists());
}

/// The largest memory of a command, kB, as Linux counts it while it runs.
#[cfg(target_os = "linux")]
fn peak(directory: &Path, arguments: &str) -> u64 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trunnion"));
    let mut child = command.current_dir(directory).args(arguments.split(' ')).spawn().unwrap();
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let now = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB")?.parse().ok());
        peak = peak.max(now.unwrap_or(0));
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(child.wait().unwrap().success(), "{arguments}");
    peak
}

#[test]
#[cfg(target_os = "linux")]
fn what_is_simulated_is_not_kept() {
    let directory = tempfile::tempdir().unwrap();
    let simulate =
        |samples| peak(directory.path(), &format!("simulate tilting-table-a --samples {samples} --out {samples}"));
    let (few, many) = (simulate(20_000), simulate(500_000));
    assert!(few > 1_000 && many < few + 10_000, "{few} kB, {many} kB");
    // An earlier result of any length is known again.
    simulate(500_000);
}
