//! The shape of the source: a file can be read before those that use it, and none is long.
//!
//! A file depends on another where it names an item that is defined there; re-exports are followed to the definition and
//! are no dependency themselves. Tests inside a file may use anything.

mod imports;

use imports::Crates;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Longest file, in lines.
const LONGEST: usize = 350;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files that each file depends on.
type Graph = BTreeMap<PathBuf, Vec<PathBuf>>;

/// A way from a file back to itself, if there is one.
fn circle(graph: &Graph) -> Option<Vec<PathBuf>> {
    /// Leaves in `done` what leads into no circle.
    fn walk<'a>(
        graph: &'a Graph,
        file: &'a Path,
        way: &mut Vec<&'a Path>,
        done: &mut Vec<&'a Path>,
    ) -> Option<Vec<PathBuf>> {
        if let Some(at) = way.iter().position(|f| *f == file) {
            return Some(way[at..].iter().copied().chain([file]).map(Path::to_owned).collect());
        }
        if done.contains(&file) {
            return None;
        }
        way.push(file);
        let found = graph.get(file).into_iter().flatten().find_map(|next| walk(graph, next, way, done));
        way.pop();
        done.push(file);
        found
    }
    let mut done = Vec::new();
    graph.keys().find_map(|file| walk(graph, file, &mut Vec::new(), &mut done))
}

#[test]
fn no_file_imports_in_a_circle() {
    let crates = Crates::read(&[
        ("trunnion_codegen", root().join("codegen/src/lib.rs")),
        ("trunnion_solver", root().join("solver/src/lib.rs")),
        ("trunnion_derive", root().join("derive/src/lib.rs")),
        ("trunnion", root().join("src/lib.rs")),
        ("the command line", root().join("src/main.rs")),
        ("trunnion_python", root().join("python/src/lib.rs")),
    ]);
    let mut graph = crates.dependencies();
    assert!(graph.len() > 150 && graph.values().map(Vec::len).sum::<usize>() > 300, "the source was not found");
    let mut circles = Vec::new();
    while let Some(circle) = circle(&graph) {
        let name = |file: &PathBuf| file.strip_prefix(root()).unwrap_or(file).display().to_string();
        circles.push(circle.iter().map(name).collect::<Vec<_>>().join(" → "));
        // Without its last step the next circle shows.
        if let [.., from, to] = circle.as_slice() {
            graph.entry(from.clone()).or_default().retain(|file| file != to);
        }
    }
    assert!(circles.is_empty(), "files import each other in circles: {circles:#?}");
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && !name.starts_with('.') {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn no_file_is_long() {
    let mut files = Vec::new();
    sources(root(), &mut files);
    let lines = |path: &PathBuf| std::fs::read_to_string(path).unwrap().lines().count();
    let long: Vec<String> = files
        .iter()
        .map(|f| (f, lines(f)))
        .filter(|(_, n)| *n > LONGEST)
        .map(|(f, n)| format!("{}: {n}", f.display()))
        .collect();
    assert!(long.is_empty(), "more than {LONGEST} lines: {long:#?}");
}
