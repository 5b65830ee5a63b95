//! Drawings of the pages, each by a command that stands on its page.

use super::{hold, read, root, run, shown};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Pages with the commands that draw, the directories that they draw into, and what they read.
const DRAWN: [(&str, &str, &str, &[&str]); 3] = [
    ("README.md", "cargo run --release -- demo", "trunnion-demo", &[]),
    ("docs/exechon.md", "trunnion exechon paper --pictures pictures", "pictures", &[]),
    (
        "docs/circular.md",
        "trunnion circular --cw cw.csv --ccw ccw.csv --radius 150 --feed 1000 --svg circular-test.svg",
        ".",
        &["circular/cw.csv", "circular/ccw.csv"],
    ),
];

#[test]
fn every_drawing_is_what_a_command_of_its_page_draws() {
    for (page, command, into, files) in DRAWN {
        assert!(read(page).lines().any(|line| line.trim() == command), "{page} lacks: {command}");
        let directory = tempfile::tempdir().unwrap();
        for file in files {
            let file = root().join("tests/reference").join(file);
            fs::copy(&file, directory.path().join(file.file_name().unwrap())).unwrap();
        }
        run(directory.path(), command);
        hold(page, &[&directory.path().join(into)]);
    }
}

fn drawings(folder: &Path) -> BTreeSet<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let own = files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "svg"));
    own.chain(folders.iter().flat_map(|folder| drawings(folder))).collect()
}

#[test]
fn no_drawing_is_left_over_and_no_page_left_out() {
    let held = DRAWN.map(|(page, ..)| page).into_iter().chain([super::guide::PAGE]);
    let held: BTreeSet<PathBuf> = held.flat_map(shown).collect();
    assert_eq!(held, drawings(&root().join("docs")));
    let docs =
        fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let pages =
        docs.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}")).chain(["README.md".to_owned()]);
    let all: BTreeSet<PathBuf> = pages.flat_map(|page| shown(&page)).collect();
    assert_eq!(all, held);
}
