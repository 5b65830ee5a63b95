//! What the solver costs on the target, against a budget and the documentation.

use crate::{Outcome, qemu};
use object::{Object, ObjectSection, SectionFlags, elf};
use std::{collections::BTreeMap, fs, path::Path};

/// How far a figure in the documentation may be from the measured one: another compiler is no other solver.
const DRIFT: f64 = 0.1;
const BEGIN: &str = "<!-- cost: written by `check cost DIR BUDGET bless` -->\n";
const END: &str = "<!-- end of cost -->\n";

/// Rows of the table: what the firmware calls it, and what the reader does.
const ROWS: [(&str, &str); 21] = [
    ("state of 8", "state for 8 unknowns, bytes"),
    ("state, joint", "state, joint (13 unknowns), bytes"),
    ("state, two-step", "state, two-step (10 and 8 unknowns), bytes"),
    ("flash", "flash, joint: rows, push, solve, ε_xa, bytes"),
    ("row of 8", "row of 8 regressors, instructions"),
    ("push of 8", "push of 8, instructions"),
    ("row and push of 8", "row and push of 8, mean, instructions"),
    ("row and push of 8, longest", "row and push of 8, longest, instructions"),
    ("joint, sample of run 1", "joint, a sample of run 1, instructions"),
    ("joint, sample of run 2", "joint, a sample of run 2, instructions"),
    ("two-step, sample of each run", "two-step, a sample of each run, instructions"),
    ("own machine, row", "own machine, row of 6 regressors, instructions"),
    ("own machine, sample", "own machine, a sample, instructions"),
    ("solve of 8", "solve of 8 with covariance, instructions"),
    ("solve, joint", "solve, joint, with covariance, instructions"),
    ("solve, two-step", "solve, two-step, with covariance, instructions"),
    ("stack, row and push of 8", "stack, row and push of 8, bytes"),
    ("stack, joint sample", "stack, joint sample, bytes"),
    ("stack, solve of 8", "stack, solve of 8, bytes"),
    ("stack, solve, joint", "stack, solve, joint, bytes"),
    ("stack, solve, two-step", "stack, solve, two-step, bytes"),
];

/// Measures, and compares with the budget and the table; `bless` writes the table.
pub fn check(directory: &Path, budget: &Path, bless: bool) -> Outcome {
    let measured = measure(directory)?;
    // A loop of 10,000 turns of two instructions, and what brings it there: the clock counts instructions.
    match measured.get("delay of 10000") {
        Some(20_000..=20_050) => (),
        other => return Err(format!("the clock counts {other:?} instructions for 20,000")),
    }
    within_budget(&measured, budget)?;
    let mut table = String::from("| | f32 | f64 |\n|---|---:|---:|\n");
    for (key, name) in ROWS {
        let cell = |kind: &str| measured.get(&format!("{kind} {key}")).ok_or(format!("not measured: {kind} {key}"));
        table += &format!("| {name} | {} | {} |\n", cell("f32")?, cell("f64")?);
    }
    print!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/controller.md");
    let page = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let split = page.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?)));
    let (before, (old, after)) = split.ok_or("docs/controller.md has no place for the table")?;
    if bless {
        let page = format!("{before}{BEGIN}{table}{END}{after}");
        return fs::write(&path, page).map_err(|e| format!("{}: {e}", path.display()));
    }
    same_table(old, &table)
}

fn measure(directory: &Path) -> Result<BTreeMap<String, u64>, String> {
    let text = qemu::output(&directory.join("measure"))?;
    let mut measured = BTreeMap::new();
    for (name, value) in qemu::values(&text) {
        let value = value.parse().map_err(|_| format!("not a number: {name} = {value}"))?;
        measured.insert(name.to_owned(), value);
    }
    let bare = flash(&directory.join("flash-none"))?;
    for kind in ["f32", "f64"] {
        let own = flash(&directory.join(format!("flash-{kind}")))?.saturating_sub(bare);
        measured.insert(format!("{kind} flash"), own);
    }
    Ok(measured)
}

/// Bytes of code and constants.
fn flash(path: &Path) -> Result<u64, String> {
    let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let file = object::File::parse(&*bytes).map_err(|e| format!("{}: {e}", path.display()))?;
    let loaded = |flags| matches!(flags, SectionFlags::Elf { sh_flags } if sh_flags & u64::from(elf::SHF_ALLOC) != 0);
    let sections = file.sections().filter(|s| loaded(s.flags()) && s.kind() != object::SectionKind::UninitializedData);
    Ok(sections.map(|section| section.size()).sum())
}

/// Every budget is of something measured, and kept.
fn within_budget(measured: &BTreeMap<String, u64>, path: &Path) -> Outcome {
    let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let budgets: BTreeMap<String, BTreeMap<String, u64>> = toml::from_str(&text).map_err(|e| e.to_string())?;
    let mut passed = Vec::new();
    for (kind, budget) in &budgets {
        for (key, most) in budget {
            let name = format!("{kind} {key}");
            match measured.get(&name) {
                None => return Err(format!("budget of what is not measured: {name}")),
                Some(value) if value > most => passed.push(format!("{name}: {value} where the budget is {most}")),
                Some(_) => (),
            }
        }
    }
    if passed.is_empty() { Ok(()) } else { Err(format!("budget passed\n{}", passed.join("\n"))) }
}

fn same_table(old: &str, new: &str) -> Outcome {
    let bless = "`check cost DIR BUDGET bless` writes the table anew";
    if old.lines().count() != new.lines().count() {
        return Err(format!("the table in docs/controller.md has other rows: {bless}"));
    }
    for (old, new) in old.lines().zip(new.lines()) {
        let cells = old.split('|').zip(new.split('|'));
        let near = |(old, new): (&str, &str)| match (old.trim().parse::<f64>(), new.trim().parse::<f64>()) {
            (Ok(old), Ok(new)) => (old - new).abs() <= DRIFT * new,
            _ => old == new,
        };
        if !cells.into_iter().all(near) {
            return Err(format!("docs/controller.md has\n{old}\nwhere now is\n{new}\n{bless}"));
        }
    }
    Ok(())
}
