//! What is said of exported tables, as text and as one JSON object.

use super::seen;
use super::tabled::{LeftOut, Location, Tabled};
use serde_json::{Value, json};
use std::fmt::Write;
use trunnion::export::{Facts, Format, Kept, Subject, Table, TakenOff, Verified, Warning, left, warnings};
use trunnion::study::{COVERAGE, CurvePoint, Fit, NotByDirection, Report, Setup, coverage_factor, in_unit};

/// A file that was written, and what is told of it.
pub struct Exported<'a> {
    /// The file.
    pub file: String,
    /// Its format.
    pub format: Format,
    /// What the control makes of that.
    pub facts: Facts,
    /// Its tables.
    pub tables: Vec<OneExported<'a>>,
    /// Location errors.
    pub constants: Vec<Location>,
    /// Functions that are not determined.
    pub left_out: Vec<LeftOut>,
    /// What was assumed of the machine.
    pub assumptions: Vec<String>,
}

/// One table of it.
pub struct OneExported<'a> {
    table: &'a Table,
    kept: Kept,
    /// The largest expanded uncertainty of what is written, forward and in reverse, µm or µrad.
    u95: [f64; 2],
    /// −1 where the values are the error's negative.
    sense: f64,
    /// The hysteresis where it is largest: coordinate, forward less reverse, and the expanded uncertainty of that from noise, µm or
    /// µrad; or why the directions are not told apart.
    hysteresis: Result<[f64; 3], NotByDirection>,
    /// Rows that the control takes, at most.
    most_rows: Option<usize>,
    /// What was taken off all errors, µm or µrad.
    offset: f64,
    /// What the grid leaves, µm or µrad.
    left: f64,
    /// What to be wary of.
    pub warnings: Vec<Warning>,
}

impl<'a> OneExported<'a> {
    /// A table of which the control keeps `kept`, where the axis powers up at `home`, degrees or mm.
    pub fn new(
        setup: &Setup,
        (fit, report): (&Fit, &Report),
        own: &'a Tabled,
        kept: Kept,
        format: Format,
        home: f64,
    ) -> Self {
        let facts = format.facts();
        let Tabled { function, table, directions, offset } = own;
        let (along, unit) = (table.subject.along, table.subject.quantity.deviation());
        let points =
            report.functions.iter().filter(|curve| curve.function == *function).flat_map(|curve| &curve.points);
        let u95 = |point: &CurvePoint| match directions {
            Err(_) => [point.u95; 2],
            Ok(by) => {
                let others = unit.to_inner(point.other_std);
                let own = by.uncertainty(setup, fit, along.to_inner(point.at), others);
                let written = if table.both { [own.forward, own.reverse] } else { [own.mean; 2] };
                written.map(|u95| unit.from_inner(u95))
            }
        };
        let hysteresis = directions.as_ref().map_err(|why| *why).map(|by| {
            let factor = coverage_factor(Some(by.degrees_of_freedom));
            let at = |at: f64| {
                let [difference, std] = by.hysteresis(setup, fit, along.to_inner(at));
                [at, unit.from_inner(difference), unit.from_inner(factor * std)]
            };
            let largest = table.grid.points().map(at).max_by(|a, b| a[1].abs().total_cmp(&b[1].abs()));
            largest.unwrap_or_default()
        });
        let range = setup.axis(*function).and_then(|axis| axis.range).map(|range| range.map(|end| in_unit(along, end)));
        Self {
            table,
            u95: points.map(u95).fold([0.0; 2], |[a, b], [c, d]| [a.max(c), b.max(d)]),
            sense: format.sense(&table.subject),
            hysteresis,
            most_rows: facts.rows,
            offset: unit.from_inner(*offset),
            left: unit.from_inner(left(table, &kept, facts.between, |at| own.error(setup, fit, at))),
            warnings: warnings(table, &facts, &kept, home, range),
            kept,
        }
    }

    fn lines(&self) -> Vec<(&str, String)> {
        let grid = &self.table.grid;
        let Subject { name, iso, axis, quantity, along, .. } = &self.table.subject;
        let (unit, along) = (quantity.deviation().symbol(), along.symbol());
        let directions = match &self.hysteresis {
            Ok([at, by, u95]) => format!(
                "{}; forward less reverse is at most {by:+.3} ± {u95:.3} {unit}, at {at} {along} (95 %, of noise alone; nothing else is \
                 taken to turn with the direction)",
                if self.table.both {
                    "each its own"
                } else {
                    "their mean for both, as the format has one value, so that half stays"
                }
            ),
            Err(why) => format!("the same for both: {why}"),
        };
        let most = self.most_rows.map_or(String::new(), |most| format!(" of at most {most}"));
        let grid_error =
            format!("at most {:.4} {unit} from the function to what the control makes of its table", self.left);
        let within = match self.u95 {
            [forward, reverse] if self.table.both => {
                format!("± {forward:.3} {unit} forward and ± {reverse:.3} {unit} in reverse")
            }
            [u95, _] => format!("± {u95:.3} {unit}"),
        };
        let mut lines = vec![
            ("function", format!("{name} ({iso}) of axis {axis}, at most {within} (95 %)")),
            ("rows", format!("{}{most} from {} to {} {along} by {}", grid.rows(), grid.from(), grid.to(), grid.step())),
            ("directions", directions),
            ("grid error", grid_error),
        ];
        if self.sense < 0.0 {
            let by = if let TakenOff::Other(other, _) = &self.table.subject.taken_off { other } else { axis };
            let words =
                format!("values are −{iso}: {by}, moved further, does the opposite to the tool against the workpiece");
            lines.push(("sign", words));
        }
        if self.offset != 0.0 {
            lines.push((
                "zero",
                format!("{:+.3} {unit} are taken off all: the error where the axis powers up", self.offset),
            ));
        }
        lines
    }

    fn object(&self) -> Value {
        let grid = &self.table.grid;
        let Subject { name, iso, axis, quantity, along, .. } = &self.table.subject;
        let hysteresis = self.hysteresis.as_ref().ok();
        json!({
            "function": name,
            "iso": iso,
            "axis": axis,
            "unit": quantity.deviation().suffix(),
            "coordinate_unit": along.suffix(),
            "rows": grid.rows(),
            "from": grid.from(),
            "to": grid.to(),
            "step": grid.step(),
            "both_directions": self.table.both,
            "not_told_apart": self.hysteresis.as_ref().err().map(ToString::to_string),
            "hysteresis": hysteresis.map(|[at, by, u95]| json!({ "at": at, "value": by, "u95_noise": u95 })),
            "taken_off": self.offset,
            "sign": self.sense,
            "u95": self.u95[0].max(self.u95[1]),
            "u95_forward": self.u95[0],
            "u95_reverse": self.u95[1],
            "grid_error": self.left,
            "warnings": self.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "points": self.points(),
        })
    }

    /// Errors at each row: the function's, and what the control has of them.
    fn points(&self) -> Vec<Value> {
        let unit = self.table.subject.quantity.deviation();
        let one = |(row, at): (usize, f64)| {
            let of = |errors: &[Vec<f64>; 2]| errors.each_ref().map(|own| own.get(row).map(|e| unit.from_inner(*e)));
            let ([forward, reverse], kept) = (of(&self.table.errors), of(&self.kept));
            json!({ "at": at, "forward": forward, "reverse": reverse, "kept_forward": kept[0], "kept_reverse": kept[1] })
        };
        self.table.grid.points().enumerate().map(one).collect()
    }
}

impl Exported<'_> {
    /// What is told of it: of what, and in words.
    pub fn lines(&self) -> Vec<(&str, String)> {
        let facts = &self.facts;
        let tables = self.tables.iter().flat_map(OneExported::lines);
        let constant =
            |own: &'_ Location| format!("{:.9} {unit} ± {:.9} {unit} (95 %)", own.value, own.u95, unit = own.unit);
        let constants = self.constants.iter().map(|own| (own.name.as_str(), constant(own)));
        let left_out = self.left_out.iter().map(|(name, words)| ("left out", format!("{name}, which is {words}")));
        let facts = [
            ("values", format!("{}; {}", facts.unit, facts.sign)),
            ("between rows", facts.between.words().to_owned()),
            ("beyond the ends", facts.ends.words().to_owned()),
            ("over a turn", facts.turn.to_owned()),
            ("resolution", facts.resolution.words()),
            ("needs", facts.needs.to_owned()),
            ("verified", facts.verified.words().to_owned()),
            ("source", facts.source.to_owned()),
        ];
        let assumed = self.assumptions.iter().map(|assumption| ("assumed", assumption.clone()));
        let told = tables.chain(constants).chain(left_out).chain(assumed).chain(facts);
        told.filter(|(_, words)| !words.is_empty()).collect()
    }

    /// A line for each.
    pub fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.file, self.facts.what);
        for (what, words) in self.lines() {
            let _ = writeln!(out, "  {what}: {words}");
        }
        seen(&out)
    }

    /// All of it, and every row.
    pub fn object(&self) -> Value {
        let facts = &self.facts;
        let constants = self
            .constants
            .iter()
            .map(|own| json!({ "name": own.name, "value": own.value, "u95": own.u95, "unit": own.unit.suffix() }));
        let left_out = self.left_out.iter().map(|(name, extent)| json!({ "function": name, "extent": extent }));
        json!({
            "file": self.file,
            "format": self.format.name(),
            "what": facts.what,
            "file_unit": facts.unit,
            "sign": facts.sign,
            "between_rows": facts.between.words(),
            "ends": facts.ends.words(),
            "turn": facts.turn,
            "most_rows": facts.rows,
            "resolution": facts.resolution.words(),
            "resolution_of": facts.resolution.of(),
            "needs": facts.needs,
            "verified": facts.verified == Verified::Tried,
            "source": facts.source,
            "coverage": COVERAGE,
            "assumptions": self.assumptions,
            "tables": self.tables.iter().map(OneExported::object).collect::<Vec<_>>(),
            "constants": constants.collect::<Vec<_>>(),
            "left_out": left_out.collect::<Vec<_>>(),
        })
    }
}
