//! What the pages show is what the commands on them do.

mod guide;
mod pictures;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(page: &str) -> String {
    fs::read_to_string(root().join(page)).unwrap()
}

/// Runs a line as a shell would, standard output into a file where the line says so; what cargo runs is the program. What it
/// prints.
fn run(directory: &Path, line: &str) -> String {
    let (command, into) = line.split_once(" > ").map_or((line, None), |(command, file)| (command, Some(file)));
    let words = ["trunnion ", "cargo run --release -- "].iter().find_map(|program| command.strip_prefix(program));
    let words = words.unwrap_or_else(|| panic!("no command: {line}")).split_whitespace();
    let output = Command::new(env!("CARGO_BIN_EXE_trunnion")).current_dir(directory).args(words).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    if let Some(file) = into {
        fs::write(directory.join(file), &output.stdout).unwrap();
    }
    String::from_utf8(output.stdout).unwrap()
}

/// Drawings that a page shows.
fn shown(page: &str) -> Vec<PathBuf> {
    let folder = root().join(page).parent().unwrap().to_owned();
    let text = read(page);
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link);
    links.filter(|link| link.ends_with(".svg")).map(|link| folder.join(link)).collect()
}

/// Holds every drawing of a page to be what was drawn under its name into one of these directories; with `UPDATE_DOCS` set it is
/// written anew.
fn hold(page: &str, drawn: &[&Path]) {
    for kept in shown(page) {
        let name = kept.file_name().unwrap();
        let of = drawn.iter().find_map(|directory| fs::read(directory.join(name)).ok());
        let of = of.unwrap_or_else(|| panic!("{page} shows {name:?}, which none of its commands draws"));
        if std::env::var_os("UPDATE_DOCS").is_some() {
            fs::create_dir_all(kept.parent().unwrap()).unwrap();
            fs::write(&kept, &of).unwrap();
        }
        assert!(
            fs::read(&kept).unwrap_or_default() == of,
            "{page}: {name:?} is drawn otherwise: set UPDATE_DOCS to write it"
        );
    }
}
