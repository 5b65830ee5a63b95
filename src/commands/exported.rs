//! What is said of an exported table, as text and as one JSON object.

use super::seen;
use serde_json::{Value, json};
use std::fmt::Write;
use trunnion::export::{Facts, Format, Subject, Table, Verified, Warning, Written};
use trunnion::study::COVERAGE;

/// A table that was written, and what is told of it.
pub struct Exported<'a> {
    /// The file.
    pub file: String,
    /// Its format.
    pub format: Format,
    /// What the control makes of that.
    pub facts: Facts,
    /// What was to be written.
    pub table: &'a Table,
    /// What was.
    pub written: &'a Written,
    /// The largest expanded uncertainty of the function, µm or µrad.
    pub u95: f64,
    /// The hysteresis where it is largest: coordinate, forward less reverse, and the expanded uncertainty of that from noise, µm or
    /// µrad; or why the directions are not told apart.
    pub hysteresis: Result<[f64; 3], String>,
    /// What the grid leaves, µm or µrad.
    pub left: f64,
    /// What was assumed of the machine.
    pub assumptions: Vec<String>,
    /// What to be wary of.
    pub warnings: Vec<Warning>,
}

impl Exported<'_> {
    /// A line for each.
    pub fn text(&self) -> String {
        let (grid, facts) = (&self.table.grid, &self.facts);
        let Subject { name, iso, axis, quantity, along, .. } = &self.table.subject;
        let (unit, along) = (quantity.deviation().symbol(), along.symbol());
        let directions = match &self.hysteresis {
            Ok([at, by, u95]) => format!(
                "both; forward less reverse is at most {by:+.3} ± {u95:.3} {unit}, at {at} {along} (95 %, of noise; nothing else is \
                 taken to turn with the direction)"
            ),
            Err(why) => format!("the same for both: {why}"),
        };
        let lines = [
            ("function", format!("{name} ({iso}) of axis {axis}, at most ± {:.3} {unit} (95 %)", self.u95)),
            ("rows", format!("{} from {} to {} {along} by {}", grid.rows(), grid.from(), grid.to(), grid.step())),
            ("values", format!("{}; {}", facts.unit, facts.sign)),
            ("between rows", facts.between.words().to_owned()),
            ("beyond the ends", format!("{}; over a turn: {}", facts.ends, facts.turn)),
            ("resolution", facts.resolution.to_owned()),
            ("directions", directions),
            (
                "grid error",
                format!("at most {:.4} {unit} from the function to what the control makes of the table", self.left),
            ),
        ];
        let assumed = self.assumptions.iter().map(|a| ("assumed", a.clone()));
        let last = [("verified", facts.verified.words().to_owned()), ("source", facts.source.to_owned())];
        let mut out = format!("{}: {}\n", self.file, facts.what);
        for (what, words) in lines.into_iter().chain(assumed).chain(last) {
            let _ = writeln!(out, "  {what}: {words}");
        }
        seen(&out)
    }

    /// All of it, and every row.
    pub fn object(&self) -> Value {
        let (grid, facts) = (&self.table.grid, &self.facts);
        let Subject { name, iso, axis, quantity, along, .. } = &self.table.subject;
        let hysteresis = self.hysteresis.as_ref().ok();
        json!({
            "file": self.file,
            "format": self.format.name(),
            "what": facts.what,
            "function": name,
            "iso": iso,
            "axis": axis,
            "unit": quantity.deviation().suffix(),
            "coordinate_unit": along.suffix(),
            "file_unit": facts.unit,
            "sign": facts.sign,
            "between_rows": facts.between.words(),
            "ends": facts.ends,
            "turn": facts.turn,
            "rows": grid.rows(),
            "most_rows": facts.rows,
            "from": grid.from(),
            "to": grid.to(),
            "step": grid.step(),
            "resolution": facts.resolution,
            "both_directions": self.table.both,
            "one_direction_because": self.hysteresis.as_ref().err(),
            "hysteresis": hysteresis.map(|[at, by, u95]| json!({ "at": at, "value": by, "u95_noise": u95 })),
            "u95": self.u95,
            "coverage": COVERAGE,
            "grid_error": self.left,
            "assumptions": self.assumptions,
            "verified": facts.verified == Verified::Tried,
            "source": facts.source,
            "warnings": self.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "points": self.points(),
        })
    }

    /// Errors at each row: the function's, and what the control has of them.
    fn points(&self) -> Vec<Value> {
        let unit = self.table.subject.quantity.deviation();
        let one = |(row, at): (usize, f64)| {
            let of = |errors: &[Vec<f64>; 2]| errors.each_ref().map(|own| own.get(row).map(|e| unit.from_inner(*e)));
            let ([forward, reverse], kept) = (of(&self.table.errors), of(&self.written.kept));
            json!({ "at": at, "forward": forward, "reverse": reverse, "kept_forward": kept[0], "kept_reverse": kept[1] })
        };
        self.table.grid.points().enumerate().map(one).collect()
    }
}
