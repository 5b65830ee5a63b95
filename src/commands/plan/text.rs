//! The plan for reading at a terminal.

use crate::commands::predicted;
use std::fmt::Write;
use trunnion::study::WARN_CONDITION;
use trunnion::study::plan::{Addition, Compared, Overview, Predicted};
use trunnion_codegen::identify::Extent;

/// The comparison and what cannot be told apart, for reading at a terminal; `noise_um` is the half width of the uniform noise, `named`
/// whether the runs to leave out were.
pub fn text(found: &Overview, noise_um: f64, named: bool) -> String {
    let Overview { model, derivation, comparison, compared, described, tried, added, .. } = found;
    let mut out = format!(
        "{}: {} samples a run, noise ±{} µm, {} estimate\n",
        model.name, comparison.samples, noise_um, comparison.estimator
    );
    let _ = writeln!(
        out,
        "  {:>5} {:>10}  {:>4} {:>10}  runs; largest uncertainty of each function",
        "R", "range", "rank", "condition"
    );
    for line in compared {
        let radius = line.radius.map_or(String::from("-"), |mm| mm.to_string());
        let range = format!("{}…{}°", line.range_deg.0, line.range_deg.1);
        let runs = match line.without.is_empty() {
            true => "all".to_owned(),
            false => format!("without {}", line.without.join(", ")),
        };
        match &line.outcome {
            Err(why) => {
                let _ = writeln!(out, "  {radius:>5} {range:>10}  {:>4} {:>10}  {runs}; {why}", "-", "-");
            }
            Ok((setup, prediction)) => {
                let hardly = if prediction.condition > WARN_CONDITION { "!" } else { " " };
                let _ = write!(
                    out,
                    "  {radius:>5} {range:>10}  {:>4} {:>9.0}{hardly}  {runs}",
                    setup.derivation.rank(),
                    prediction.condition
                );
                for f in &prediction.functions {
                    let _ = write!(out, "; {}", predicted::function(setup, f));
                }
                out.push('\n');
            }
        }
    }
    let _ = writeln!(out, "  ! condition above {WARN_CONDITION}: hardly told apart");
    out += &recommendation(found);
    out += &not_determined(compared.iter().filter(|l| named || l.without.is_empty()));
    let _ = writeln!(
        out,
        "\nWhat all runs together cannot tell apart, and what each of the {tried} runs of the catalogue that fit this machine would separate"
    );
    for (group, words) in derivation.groups().iter().zip(described) {
        let _ = writeln!(out, "  {words}");
        let separating: Vec<&Addition> =
            added.iter().filter(|a| a.separates.iter().any(|s| group.kernel.contains(s))).collect();
        if separating.is_empty() {
            let _ = writeln!(out, "    none separates any of them");
        }
        for a in separating.iter().take(3) {
            let count = a.separates.iter().filter(|s| group.kernel.contains(s)).count();
            let of = group.kernel.len();
            let determined = a.determines.iter().filter(|j| group.parameters.contains(j));
            let determined: Vec<&str> = determined.map(|&j| derivation.parameters[j].name.as_str()).collect();
            let then = match determined.as_slice() {
                [] => String::new(),
                names => format!("; then {} can be told", names.join(", ")),
            };
            let _ = writeln!(
                out,
                "    adding {} of {}{} separates {count} of {of} directions{then}",
                a.run,
                a.model,
                kept(a)
            );
        }
        if separating.len() > 3 {
            let _ = writeln!(out, "    and {} more runs of the catalogue", separating.len() - 3);
        }
    }
    for a in added.iter().filter(|a| !a.finds.is_empty()) {
        let _ =
            writeln!(out, "  {} of {} helps to measure {}, taken as known here", a.run, a.model, a.finds.join(", "));
    }
    out
}

fn kept(a: &Addition) -> &'static str {
    if a.ball_kept { ", the tool ball left in place," } else { "" }
}

/// For each subset of runs, the functions that it does not determine, and how far it does.
fn not_determined<'a>(lines: impl Iterator<Item = &'a Compared>) -> String {
    let mut out = String::new();
    let mut said: Vec<&Vec<String>> = Vec::new();
    for line in lines {
        let Ok((setup, prediction)) = &line.outcome else { continue };
        let held: Vec<&Predicted> =
            prediction.functions.iter().filter(|f| f.told.extent != Extent::Determined).collect();
        if held.is_empty() || said.contains(&&line.without) {
            continue;
        }
        said.push(&line.without);
        let runs = if line.without.is_empty() {
            "All runs".to_owned()
        } else {
            format!("Without {}", line.without.join(", "))
        };
        let _ = writeln!(out, "\n{runs}:");
        for f in held {
            let _ = writeln!(out, "  {}: {}", setup.function_name(f.function), f.told.words);
        }
    }
    out
}

/// For each function the fewest runs that do nearly as well as all.
fn recommendation(found: &Overview) -> String {
    let mut out = String::from("\nEnough, within a tenth of what all runs give");
    out += if found.comparison.radii.len() * found.comparison.ranges_deg.len() > 1 {
        " (the first bar and range)\n"
    } else {
        "\n"
    };
    for r in &found.recommended {
        let error = found.model.functions[r.function].error;
        let unit = found.model.alphabet.error_quantity(error).deviation();
        let name = found.model.notation.function(found.model.alphabet.error_name(error));
        let [best, u95] = [r.best, r.u95].map(|x| unit.from_inner(x));
        let _ = writeln!(out, "  {name}: {} (± {u95:.3} {unit}, all ± {best:.3})", r.runs.join(", "));
    }
    if found.recommended.is_empty() {
        out += "  no function is determined: `plan --for` searches runs that do\n";
    }
    out
}
