//! Model files: TOML into a draft, every problem with its place.

use super::draft::{
    Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftInstrument, DraftReading, DraftRun, Number,
};
use super::size::excess;
use super::{AxisKind, Model, Problem, ProblemKind};
use crate::limits::FILE;
use crate::source::{Span, Text};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reads a model file; all problems are reported together, in the order of their places.
pub fn read(source: &str) -> Result<Model, Vec<Problem>> {
    read_stated(source, None)
}

/// Reads a model file with what a second text states [over it](super::STATED); its places are behind the first one's, after a
/// byte between them.
pub fn read_stated(source: &str, stated: Option<&str>) -> Result<Model, Vec<Problem>> {
    let (draft, mut problems) = parts(source, stated)?;
    // Of what is too much, everything else may be wrong as well.
    let excess = excess(&draft);
    if !excess.is_empty() {
        return Err(excess);
    }
    let built = draft.build();
    if problems.is_empty() {
        return built;
    }
    // What was misspelt is missing elsewhere: only what does not follow from that is told along with it.
    problems.extend(built.err().unwrap_or_default().into_iter().filter(|p| !p.kind.may_follow()));
    problems.sort_by_key(|p| p.span.start);
    problems.dedup();
    Err(problems)
}

/// Reads a model file without resolving what it says; problems of its form alone.
pub fn read_draft(source: &str) -> Result<Draft, Vec<Problem>> {
    read_draft_stated(source, None)
}

/// As [`read_draft`], with what a second text states over it.
pub fn read_draft_stated(source: &str, stated: Option<&str>) -> Result<Draft, Vec<Problem>> {
    let (draft, problems) = parts(source, stated)?;
    if problems.is_empty() { Ok(draft) } else { Err(problems) }
}

fn parts(source: &str, stated: Option<&str>) -> Result<(Draft, Vec<Problem>), Vec<Problem>> {
    let mut reader = Reader { problems: Vec::new() };
    let mut draft = reader.draft(table(source)?.get_ref());
    if let Some(stated) = stated {
        let behind = "\n".repeat(source.len() + 1) + stated;
        reader.state(&mut draft, parsed(&behind)?.get_ref());
    }
    Ok((draft, reader.problems))
}

fn table(source: &str) -> Result<Spanned<DeTable<'_>>, Vec<Problem>> {
    if source.len() > FILE {
        return Err(vec![Problem { span: 0..0, kind: ProblemKind::TooMany("bytes in a model file", FILE) }]);
    }
    parsed(source)
}

fn parsed(source: &str) -> Result<Spanned<DeTable<'_>>, Vec<Problem>> {
    DeTable::parse(source).map_err(|e| {
        let span = e.span().unwrap_or(0..0);
        vec![Problem { span, kind: ProblemKind::Toml(e.message().to_owned()) }]
    })
}

const TOP: &[&str] = &[
    "name",
    "title",
    "notation",
    "constants",
    "lengths",
    "workpiece",
    "tool",
    "estimate",
    "order",
    "assume",
    "limits",
    "instrument",
    "axis",
    "names",
    "run",
    "function",
];
const AXIS: &[&str] = &["rotary", "linear", "location", "range"];
const INSTRUMENT: &[&str] =
    &["preset", "constant_um", "noise_um", "proportional", "bar_length_um", "temperature_k", "expansion_per_k"];
const RUN: &[&str] = &["sweep", "define", "at", "workpiece_ball", "tool_ball", "reading", "nuisance"];
const READING: &[&str] = &["displacement"];
const BALL: &[&str] = &["at", "setup"];
const BASIS: &[&str] = &["polynomial", "conditions", "fourier"];
const WORDS: &[&str] = &["known", "zero"];
const READINGS: &str = "a reading: a bar's length such as \"R\", or { displacement = \"x\" }";

type Entry<'a> = (&'a Spanned<std::borrow::Cow<'a, str>>, &'a Spanned<DeValue<'a>>);

pub(super) struct Reader {
    problems: Vec<Problem>,
}

impl Reader {
    pub(super) fn problem<T: Default>(&mut self, span: Span, kind: ProblemKind) -> T {
        self.problems.push(Problem { span, kind });
        T::default()
    }

    fn draft(&mut self, table: &DeTable) -> Draft {
        self.known_keys(table, TOP);
        let mut draft = Draft {
            name: self.required(table, "name", 0..0),
            title: self.optional(table, "title").unwrap_or_default(),
            notation: self.optional(table, "notation"),
            constants: self.list(table, "constants"),
            workpiece: self.list(table, "workpiece"),
            tool: self.list(table, "tool"),
            estimate: self.list(table, "estimate"),
            order: self.list(table, "order"),
            ..Draft::default()
        };
        for (name, value) in self.tables(table, "axis") {
            draft.axes.extend(self.table(value).and_then(|axis| self.axis(text_of(name), axis)));
        }
        draft.names = self.texts(table, "names");
        for (name, value) in self.tables(table, "run") {
            draft.runs.extend(self.table(value).map(|run| self.run(text_of(name), run)));
        }
        draft.assume = self.texts(table, "assume");
        draft.lengths = self.numbers(table, "lengths");
        draft.limits = self.numbers(table, "limits");
        draft.instrument = self.table_at(table, "instrument").map(|table| self.instrument(table));
        for (error, value) in self.tables(table, "function") {
            let basis = self.basis(value);
            draft.functions.extend(basis.map(|basis| DraftFunction { error: text_of(error), basis }));
        }
        draft
    }

    fn axis(&mut self, name: Text, table: &DeTable) -> Option<DraftAxis> {
        self.known_keys(table, AXIS);
        let (kind, key) = match (table.get("rotary"), table.get("linear")) {
            (Some(_), None) => (AxisKind::Rotary, "rotary"),
            (None, Some(_)) => (AxisKind::Linear, "linear"),
            _ => {
                // The axis stands in for the one that was meant, so that its errors are not all unknown too.
                self.problem::<()>(name.span.clone(), ProblemKind::Missing("rotary` or `linear"));
                return Some(DraftAxis::linear(name, "x").located(self.list(table, "location")));
            }
        };
        let direction = self.direction(table, key);
        let range = table.get("range").and_then(|value| self.range(value));
        Some(DraftAxis { name, kind, direction, location: self.list(table, "location"), range })
    }

    pub(super) fn instrument(&mut self, table: &DeTable) -> DraftInstrument {
        self.known_keys(table, INSTRUMENT);
        let values = table.iter().filter(|(key, _)| key.get_ref().as_ref() != "preset");
        let values = values.filter_map(|(key, value)| Some(Number { name: text_of(key), value: self.float(value)? }));
        DraftInstrument { values: values.collect(), preset: self.optional(table, "preset") }
    }

    /// Two numbers, the lower first.
    pub(super) fn range(&mut self, value: &Spanned<DeValue>) -> Option<[f64; 2]> {
        let ends: Vec<f64> = match value.get_ref() {
            DeValue::Array(items) => items.iter().filter_map(|item| number(item.get_ref())).collect(),
            _ => Vec::new(),
        };
        match ends.as_slice() {
            &[low, high] if low < high => Some([low, high]),
            _ => self.problem(value.span(), ProblemKind::NotARange),
        }
    }

    pub(super) fn numbers(&mut self, table: &DeTable, key: &str) -> Vec<Number> {
        let entries = self.tables(table, key);
        entries
            .into_iter()
            .filter_map(|(name, value)| Some(Number { name: text_of(name), value: self.float(value)? }))
            .collect()
    }

    pub(super) fn texts(&mut self, table: &DeTable, key: &str) -> Vec<(Text, Text)> {
        let entries = self.tables(table, key);
        entries.into_iter().filter_map(|(name, value)| Some((text_of(name), self.text(value)?))).collect()
    }

    fn float(&mut self, value: &Spanned<DeValue>) -> Option<f64> {
        number(value.get_ref()).or_else(|| self.problem(value.span(), ProblemKind::Type("a number")))
    }

    fn run(&mut self, name: Text, table: &DeTable) -> DraftRun {
        self.known_keys(table, RUN);
        let (define, at) = (self.texts(table, "define"), self.texts(table, "at"));
        DraftRun {
            sweep: self.required(table, "sweep", name.span.clone()),
            define,
            at,
            workpiece_ball: self.ball(table, "workpiece_ball"),
            tool_ball: self.ball(table, "tool_ball"),
            reading: self.reading(table, name.span.clone()),
            nuisance: self.list(table, "nuisance"),
            name,
        }
    }

    fn reading(&mut self, run: &DeTable, parent: Span) -> DraftReading {
        match run.get("reading").map(|value| (value, value.get_ref())) {
            None => self.problem(parent, ProblemKind::Missing("reading")),
            Some((_, DeValue::Table(table))) => {
                self.known_keys(table, READING);
                DraftReading::Displacement(self.direction(table, "displacement"))
            }
            Some((value, DeValue::String(_))) => DraftReading::Bar(self.text(value).unwrap_or_default()),
            Some((value, _)) => self.problem(value.span(), ProblemKind::Type(READINGS)),
        }
    }

    fn direction(&mut self, table: &DeTable, key: &str) -> Vec<Text> {
        match table.get(key) {
            Some(value) if matches!(value.get_ref(), DeValue::Array(_)) => self.list(table, key),
            Some(value) => self.text(value).into_iter().collect(),
            None => Vec::new(),
        }
    }

    fn ball(&mut self, table: &DeTable, key: &str) -> DraftBall {
        let Some(ball) = self.table_at(table, key) else { return DraftBall::default() };
        self.known_keys(ball, BALL);
        DraftBall { at: self.list(ball, "at"), setup: self.list(ball, "setup") }
    }

    fn basis(&mut self, value: &Spanned<DeValue>) -> Option<DraftBasis> {
        match value.get_ref() {
            DeValue::String(word) if word == "known" => Some(DraftBasis::Known),
            DeValue::String(word) if word == "zero" => Some(DraftBasis::Zero),
            DeValue::String(word) => self.problem(value.span(), ProblemKind::OneOf(word.to_string(), WORDS)),
            DeValue::Table(table) => {
                self.known_keys(table, BASIS);
                match (table.get("polynomial"), table.get("fourier")) {
                    (Some(degree), None) => {
                        Some(DraftBasis::Polynomial(self.number(degree, 20)?, self.list(table, "conditions")))
                    }
                    (None, Some(n)) => Some(DraftBasis::Fourier(self.number(n, 8)?)),
                    _ => self.problem(value.span(), ProblemKind::Missing("polynomial` or `fourier")),
                }
            }
            _ => self.problem(
                value.span(),
                ProblemKind::Type("a basis: \"known\", \"zero\", { polynomial = n } or { fourier = n }"),
            ),
        }
    }

    pub(super) fn known_keys(&mut self, table: &DeTable, known: &'static [&'static str]) {
        for (key, _) in table.iter().filter(|(key, _)| !known.contains(&key.get_ref().as_ref())) {
            self.problem::<()>(key.span(), ProblemKind::UnknownKey(key.get_ref().to_string(), known));
        }
    }

    fn required(&mut self, table: &DeTable, key: &'static str, parent: Span) -> Text {
        match table.get(key) {
            Some(value) => self.text(value).unwrap_or_default(),
            None => self.problem(parent, ProblemKind::Missing(key)),
        }
    }

    fn optional(&mut self, table: &DeTable, key: &str) -> Option<Text> {
        table.get(key).and_then(|value| self.text(value))
    }

    fn list(&mut self, table: &DeTable, key: &str) -> Vec<Text> {
        match table.get(key).map(|value| (value, value.get_ref())) {
            None => Vec::new(),
            Some((_, DeValue::Array(items))) => items.iter().filter_map(|item| self.text(item)).collect(),
            Some((value, _)) => self.problem(value.span(), ProblemKind::Type("a list of strings")),
        }
    }

    pub(super) fn tables<'a>(&mut self, table: &'a DeTable<'a>, key: &str) -> Vec<Entry<'a>> {
        let Some(value) = table.get(key) else { return Vec::new() };
        self.table(value).map(|t| t.iter().collect()).unwrap_or_default()
    }

    pub(super) fn table_at<'a>(&mut self, table: &'a DeTable<'a>, key: &str) -> Option<&'a DeTable<'a>> {
        table.get(key).and_then(|value| self.table(value))
    }

    pub(super) fn table<'a>(&mut self, value: &'a Spanned<DeValue<'a>>) -> Option<&'a DeTable<'a>> {
        match value.get_ref() {
            DeValue::Table(table) => Some(table),
            _ => self.problem(value.span(), ProblemKind::Type("a table")),
        }
    }

    fn text(&mut self, value: &Spanned<DeValue>) -> Option<Text> {
        match value.get_ref() {
            DeValue::String(s) => Some(Text { value: s.to_string(), span: value.span() }),
            _ => self.problem(value.span(), ProblemKind::Type("a string")),
        }
    }

    fn number(&mut self, value: &Spanned<DeValue>, high: u8) -> Option<u8> {
        let parsed = match value.get_ref() {
            DeValue::Integer(n) => u8::from_str_radix(n.as_str(), n.radix()).ok(),
            _ => None,
        };
        parsed.filter(|n| (1..=high).contains(n)).or_else(|| self.problem(value.span(), ProblemKind::Range(1, high)))
    }
}

/// A number, whole or not.
fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Integer(n) => i64::from_str_radix(n.as_str(), n.radix()).ok().map(|n| n as f64),
        DeValue::Float(x) => x.as_str().parse().ok(),
        _ => None,
    }
}

pub(super) fn text_of(key: &Spanned<std::borrow::Cow<str>>) -> Text {
    Text { value: key.get_ref().to_string(), span: key.span() }
}
