//! What is written: never in place of something else, whole or not at all, nothing left behind.

mod program;

use program::{succeeds, trunnion};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const POSES: &str = "x_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n";
const SIMULATE: [&str; 5] = ["simulate", "tilting-table-a", "--samples", "360", "--out"];

fn command(directory: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trunnion"));
    command.current_dir(directory).args(arguments);
    command
}

/// Exit code 2, this in the message and a remedy below it.
fn refused(output: &Output, message: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains(message) && said.contains("\n  expected"), "{said}");
}

/// Everything in a directory, hidden or not.
fn names(directory: &Path) -> BTreeSet<String> {
    fs::read_dir(directory).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
}

fn of(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn poses() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("p.csv"), POSES).unwrap();
    directory
}

#[test]
fn an_output_never_replaces_an_input() {
    let directory = poses();
    let at = directory.path();
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/src/exechon/xt700.toml"), at.join("m.toml")).unwrap();
    fs::hard_link(at.join("p.csv"), at.join("again.csv")).unwrap();
    let ik = ["exechon", "ik", "p.csv", "--machine", "m.toml", "--svg"];
    let before = names(at);
    for own in ["p.csv", "m.toml", "./p.csv", "again.csv"] {
        refused(&trunnion(at, &[&ik[..], &[own]].concat()), "the command reads this file");
        refused(&trunnion(at, &[&ik[..], &[own, "--force"]].concat()), "the command reads this file");
    }
    assert_eq!((names(at), fs::read_to_string(at.join("p.csv")).unwrap()), (before, POSES.to_owned()));
}

#[test]
fn only_earlier_pictures_are_replaced() {
    let directory = poses();
    let at = directory.path();
    let ik = |more: &[&str]| trunnion(at, &[&["exechon", "ik", "p.csv", "--svg"][..], more].concat());
    fs::write(at.join("notes.svg"), "<svg>mine</svg>").unwrap();
    refused(&ik(&["notes.svg"]), "notes.svg: this file is not one that was written here before");
    assert_eq!(fs::read_to_string(at.join("notes.svg")).unwrap(), "<svg>mine</svg>");
    for more in [&["notes.svg", "--force"][..], &["notes.svg"], &["new.svg"], &["new.svg"]] {
        assert!(ik(more).status.success(), "{more:?}");
    }
    fs::create_dir(at.join("d")).unwrap();
    refused(&ik(&["d", "--force"]), "this is no file");
    refused(&ik(&["none/new.svg"]), "none/new.svg: cannot be written");
    assert_eq!(names(at), of(&["p.csv", "notes.svg", "new.svg", "d"]));
    let unasked = trunnion(at, &["exechon", "ik", "p.csv", "--force"]);
    assert_eq!(unasked.status.code(), Some(2), "an option without effect");
}

#[test]
fn a_set_replaces_an_earlier_one_and_nothing_else() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let (out, simulate) = (at.join("out"), |more: &[&str]| trunnion(at, &[&SIMULATE[..], &["out"], more].concat()));
    let set = ["tilting.csv", "separation.csv", "table.csv", "truth.json"];
    succeeds(at, &["simulate", "rotary-table-c", "--out", "out"]);
    assert!(simulate(&[]).status.success());
    assert_eq!((names(&out), names(at)), (of(&set), of(&["out"])), "the other model's runs are gone");
    fs::write(out.join("notes"), "mine").unwrap();
    fs::write(out.join(".keep"), "").unwrap();
    succeeds(at, &["simulate", "rotary-table-c", "--out", "out"]);
    assert!(simulate(&[]).status.success());
    let with_notes = of(&[&set[..], &["notes", ".keep"]].concat());
    assert_eq!(names(&out), with_notes);
    // A measured file looks as a simulated one does.
    let mut measured = fs::read_to_string(out.join("tilting.csv")).unwrap();
    measured.pop();
    fs::write(out.join("tilting.csv"), &measured).unwrap();
    refused(&simulate(&["--seed", "2"]), "out/tilting.csv: this file is not one that was written here before");
    assert_eq!(fs::read_to_string(out.join("tilting.csv")).unwrap(), measured);
    assert!(simulate(&["--seed", "2", "--force"]).status.success());
    whole(&out);
    assert_eq!((names(&out), fs::read_to_string(out.join("notes")).unwrap()), (with_notes, "mine".to_owned()));
    // The directory in which somebody works stays the same one.
    assert!(command(&out, &["simulate", "tilting-table-a", "--out", "."]).status().unwrap().success());
    whole(&out);
}

/// The files of a set are those that its `truth.json` lists: FNV-1a, 64 bits.
fn whole(directory: &Path) -> BTreeSet<String> {
    let index: Value = serde_json::from_str(&fs::read_to_string(directory.join("truth.json")).unwrap()).unwrap();
    let listed = index["files"].as_object().unwrap();
    for (name, digest) in listed {
        let hash = fs::read(directory.join(name)).unwrap().iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        assert_eq!(format!("{hash:016x}"), digest.as_str().unwrap(), "{name} of another run");
    }
    listed.keys().cloned().chain(["truth.json".to_owned()]).collect()
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, MetadataExt, symlink};

    #[test]
    fn links_lead_to_what_is_written_and_streams_are_written_through() {
        let directory = poses();
        let at = directory.path();
        fs::create_dir(at.join("elsewhere")).unwrap();
        symlink("elsewhere/real.svg", at.join("link.svg")).unwrap();
        symlink("elsewhere", at.join("out")).unwrap();
        let ik = |svg| trunnion(at, &["exechon", "ik", "p.csv", "--svg", svg]);
        for _ in 0..2 {
            assert!(ik("link.svg").status.success());
        }
        assert!(at.join("link.svg").is_symlink() && at.join("elsewhere/real.svg").is_file());
        succeeds(at, &[&SIMULATE[..], &["out"]].concat());
        assert!(at.join("out").is_symlink() && at.join("elsewhere/truth.json").is_file());
        let shown = String::from_utf8(ik("/dev/stdout").stdout).unwrap();
        assert!(shown.starts_with("<svg") && shown.contains("\nx_mm,"));
        assert!(Command::new("mkfifo").arg(at.join("pipe")).status().unwrap().success());
        let reader = Command::new("cat").arg(at.join("pipe")).stdout(Stdio::piped()).spawn().unwrap();
        assert!(ik("pipe").status.success());
        assert!(reader.wait_with_output().unwrap().stdout.starts_with(b"<svg"));
        assert!(fs::metadata(at.join("pipe")).unwrap().file_type().is_fifo());
        let to = File::create(at.join("both")).unwrap();
        let mut both = command(at, &["exechon", "ik", "p.csv", "--svg", "both"]);
        assert!(both.stdout(to).status().unwrap().success());
        assert!(fs::read_to_string(at.join("both")).unwrap().contains("\nx_mm,"), "standard output is replaced");
    }

    #[test]
    fn output_that_does_not_arrive_is_said() {
        let directory = poses();
        let at = directory.path();
        for arguments in [&["models"][..], &["exechon", "ik", "p.csv"], &["--help"], &["derive", "tilting-table-a"]] {
            let full = command(at, arguments).stdout(File::create("/dev/full").unwrap()).output().unwrap();
            refused(&full, "standard output: no storage space");
            let (reader, writer) = std::io::pipe().unwrap();
            drop(reader);
            refused(&command(at, arguments).stdout(writer).output().unwrap(), "standard output: broken pipe");
        }
        refused(
            &trunnion(at, &["exechon", "ik", "p.csv", "--svg", "/dev/full"]),
            "/dev/full: cannot be written: no storage",
        );
        let closed = |arguments: &str, to: &str| {
            let script = format!("exec '{}' {arguments} {to}", env!("CARGO_BIN_EXE_trunnion"));
            Command::new("sh").current_dir(at).args(["-c", &script]).output().unwrap()
        };
        for arguments in ["models", "exechon ik p.csv", "--help", "derive tilting-table-a"] {
            refused(&closed(arguments, ">&-"), "standard output: closed");
            refused(&closed(arguments, ">&- <&-"), "standard output: closed");
            for open in [">/dev/null", "1<>/dev/null", ">/dev/null <&-"] {
                assert!(closed(arguments, open).status.success(), "{arguments} {open}");
            }
        }
        assert!(closed("exechon ik p.csv --wrong", ">&-").stderr.starts_with(b"error: unexpected argument"));
        // Nowhere to say it: still no panic, which has exit code 101.
        let mut silent = command(at, &["models"]);
        silent.stdout(File::create("/dev/full").unwrap()).stderr(File::create("/dev/full").unwrap());
        assert_eq!(silent.status().unwrap().code(), Some(2));
        let nowhere = command(at, &["exechon", "ik", "p.csv"]).env("TMPDIR", "/nowhere").output().unwrap();
        assert!(nowhere.status.success(), "TMPDIR plays no part");
        assert_eq!(names(at), of(&["p.csv"]));
    }

    #[test]
    fn a_directory_that_is_being_written_is_refused() {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        let simulate = [&SIMULATE[..], &["out"]].concat();
        // Not there yet: held by its hidden neighbour; then by itself.
        for held in [".out.trunnion", "out"] {
            fs::create_dir_all(at.join(held)).unwrap();
            let lock = File::open(at.join(held)).unwrap();
            lock.try_lock().unwrap();
            refused(&trunnion(at, &simulate), "out: another process is writing this");
            drop(lock);
            succeeds(at, &simulate);
            assert_eq!(names(at), of(&["out"]));
        }
        let inode = || fs::metadata(at.join("out")).unwrap().ino();
        let before = inode();
        succeeds(&at.join("out"), &[&SIMULATE[..], &["."]].concat());
        assert_eq!(inode(), before, "somebody works here");
    }

    /// Kills commands at random times, most of them while they write: what is seen afterwards is a whole set or none.
    #[test]
    fn a_killed_command_leaves_no_mixture() {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        let (demo, pictures) = (["demo", "--out", "demo"], ["exechon", "paper", "--pictures", "pictures"]);
        fn simulate(seed: &str) -> Vec<&str> {
            [&SIMULATE[..], &["out", "--seed", seed]].concat()
        }
        let took = |arguments: &[&str]| {
            let started = Instant::now();
            succeeds(at, arguments);
            started.elapsed()
        };
        let (of_demo, of_simulate) = (took(&demo), took(&simulate("0")));
        let mut random = 1u64;
        for turn in 0..50u32 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let part = (random >> 40) as f64 / (1u64 << 24) as f64;
            let seed = turn.to_string();
            let (out, arguments, usual) = match turn % 10 {
                0 | 1 => ("demo", demo.to_vec(), of_demo),
                2 => ("pictures", pictures.to_vec(), of_simulate),
                _ => ("out", simulate(&seed), of_simulate),
            };
            let mut child = command(at, &arguments).stdout(Stdio::null()).spawn().unwrap();
            if turn % 2 == 0 {
                std::thread::sleep(usual.mul_f64(0.6 + 0.4 * part));
            } else {
                let staged = at.join(format!(".{out}.trunnion"));
                while child.try_wait().unwrap().is_none() && !staged.exists() {
                    std::thread::sleep(Duration::from_micros(50));
                }
                std::thread::sleep(Duration::from_micros((part * 4000.0) as u64));
            }
            child.kill().unwrap();
            child.wait().unwrap();
            let there = at.join(out);
            match out {
                "pictures" => assert!(!there.exists() || names(&there).len() == 4, "turn {turn}"),
                _ if there.exists() => assert_eq!(names(&there), whole(&there), "turn {turn}"),
                _ => {}
            }
            let sets = ["out", "demo", "pictures"];
            assert!(names(at).iter().all(|name| name.starts_with('.') || sets.contains(&name.as_str())));
        }
        [simulate("1"), demo.to_vec(), pictures.to_vec()].iter().for_each(|arguments| drop(succeeds(at, arguments)));
        assert_eq!(names(at), of(&["out", "demo", "pictures"]), "the next run clears");
    }

    /// Kills a fit at random times, most of them while it writes its report and its curves.
    #[test]
    fn a_killed_fit_leaves_whole_files_or_none() {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        succeeds(at, &[&SIMULATE[..], &["in"]].concat());
        let runs = ["--run", "tilting=in/tilting.csv", "--run", "separation=in/separation.csv"];
        let fit = [&["fit", "tilting-table-a"], &runs[..], &["--report", "r.html", "--csv", "curves"]].concat();
        let started = Instant::now();
        succeeds(at, &fit);
        let usual = started.elapsed();
        let mut random = 7u64;
        for turn in 0..24u32 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let part = (random >> 40) as f64 / (1u64 << 24) as f64;
            if turn % 3 == 0 {
                let _ = (fs::remove_file(at.join("r.html")), fs::remove_dir_all(at.join("curves")));
            }
            let mut child = command(at, &fit).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            if turn % 2 == 0 {
                std::thread::sleep(usual.mul_f64(0.7 + 0.3 * part));
            } else {
                let staged = [".r.html.trunnion", ".curves.trunnion"].map(|name| at.join(name));
                while child.try_wait().unwrap().is_none() && !staged.iter().any(|path| path.exists()) {
                    std::thread::sleep(Duration::from_micros(20));
                }
                std::thread::sleep(Duration::from_micros((part * 1000.0) as u64));
            }
            child.kill().unwrap();
            child.wait().unwrap();
            if let Ok(html) = fs::read_to_string(at.join("r.html")) {
                assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"), "turn {turn}");
            }
            if let Ok(curve) = fs::read_to_string(at.join("curves/eps_xa.csv")) {
                assert_eq!(curve.lines().count(), 75, "turn {turn}");
            }
        }
        succeeds(at, &fit);
        assert_eq!(names(at), of(&["in", "r.html", "curves"]), "the next run clears");
    }

    #[test]
    fn an_interrupt_leaves_nothing() {
        let directory = tempfile::tempdir().unwrap();
        let at = directory.path();
        // Files that take a while to write.
        let simulate = ["simulate", "tilting-table-a", "--samples", "20000", "--out", "out"];
        for pause in [0, 0, 500, 1000, 2000, 4000] {
            let _ = fs::remove_dir_all(at.join("out"));
            let mut child = command(at, &simulate).spawn().unwrap();
            while child.try_wait().unwrap().is_none() && !at.join(".out.trunnion").exists() {}
            std::thread::sleep(Duration::from_micros(pause));
            let id = child.id().to_string();
            Command::new("kill").args(["-INT", &id]).stderr(Stdio::null()).status().unwrap();
            let code = child.wait().unwrap().code();
            assert!(matches!(code, Some(130 | 0)), "{code:?}");
            assert!(names(at).is_subset(&of(&["out"])), "{:?}", names(at));
            if at.join("out").exists() {
                whole(&at.join("out"));
            }
        }
    }
}
