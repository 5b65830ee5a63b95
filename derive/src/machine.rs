//! From the attributes of a user's type to a description.

use crate::parse::{Item, Items, Rest, items};
use crate::places::Places;
use proc_macro2::Span;
use syn::{Attribute, Data, DeriveInput, Fields, Ident};
use trunnion_codegen::model::{
    AxisKind, Draft, DraftAxis, DraftBall, DraftBasis, DraftFunction, DraftReading, DraftRun, Text,
};

const MACHINE: &[&str] = &["title", "notation", "constants", "estimate", "order", "names"];
const AXIS: &[&str] = &["name", "rotary", "linear", "location"];
const RUN: &[&str] = &["sweep", "define", "at", "workpiece_ball", "tool_ball", "bar", "displacement", "nuisance"];
const BALL: &[&str] = &["at", "setup"];
const BASIS: &[&str] = &["polynomial", "fourier", "known", "zero"];

/// A description while it is being read, with all that is wrong with its attributes.
pub struct Reader {
    pub places: Places,
    errors: Vec<syn::Error>,
}

impl Reader {
    /// The description of a type; its fields are the axes.
    pub fn read(input: &DeriveInput) -> Result<(Draft, Places), syn::Error> {
        let mut reader = Self { places: Places::new(input.ident.span()), errors: Vec::new() };
        let draft = reader.draft(input);
        match reader.errors.into_iter().reduce(|mut all, e| {
            all.combine(e);
            all
        }) {
            Some(errors) => Err(errors),
            None => Ok((draft, reader.places)),
        }
    }

    fn error(&mut self, span: Span, message: impl core::fmt::Display) {
        self.errors.push(syn::Error::new(span, message));
    }

    fn draft(&mut self, input: &DeriveInput) -> Draft {
        let name = input.ident.to_string();
        let mut draft = Draft { name: self.places.text(&name, input.ident.span()), ..Draft::default() };
        if !input.generics.params.is_empty() {
            self.error(input.ident.span(), "a machine has no parameters of type");
        }
        for attribute in &input.attrs {
            match attribute.path().get_ident().map(Ident::to_string).as_deref() {
                Some("machine") => self.machine(attribute, &mut draft),
                Some("run") => draft.runs.extend(self.run(attribute)),
                Some("function") => {
                    for item in self.items(attribute) {
                        draft.functions.extend(self.function(&item));
                    }
                }
                Some("assume") => {
                    for item in self.items(attribute) {
                        draft.assume.extend(self.value(&item).map(|is| (self.text(&item), is)));
                    }
                }
                _ => {}
            }
        }
        match &input.data {
            Data::Struct(data) if matches!(data.fields, Fields::Named(_)) => {
                for field in &data.fields {
                    let Some(name) = &field.ident else { continue };
                    self.field(name, &field.attrs, &mut draft);
                }
            }
            _ => self.error(input.ident.span(), "a machine is a struct with a named field for every axis"),
        }
        draft
    }

    fn items(&mut self, attribute: &Attribute) -> Items {
        attribute.parse_args_with(items).unwrap_or_else(|e| {
            self.errors.push(e);
            Items::new()
        })
    }

    fn unknown(&mut self, item: &Item, known: &[&str]) {
        let known = known.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", ");
        self.error(item.span, format!("unknown `{}`, expected {known}", item.word));
    }

    fn text(&mut self, item: &Item) -> Text {
        self.places.text(&item.word, item.span)
    }

    /// `key = "text"`
    fn value(&mut self, item: &Item) -> Option<Text> {
        match &item.rest {
            Rest::Value(value) if matches!(value.rest, Rest::Nothing) => Some(self.text(value)),
            _ => {
                self.error(item.span, format!("expected `{} = \"…\"`", item.word));
                None
            }
        }
    }

    /// `key("text", name, …)`, or a single text after `=`.
    fn list(&mut self, item: &Item) -> Vec<Text> {
        match &item.rest {
            Rest::Items(items) if items.iter().all(|i| matches!(i.rest, Rest::Nothing)) => {
                items.iter().map(|i| self.text(i)).collect()
            }
            Rest::Value(value) if matches!(value.rest, Rest::Nothing) => vec![self.text(value)],
            _ => {
                self.error(item.span, format!("expected `{}(…)`, a list of texts or names", item.word));
                Vec::new()
            }
        }
    }

    /// `key(name = "text", …)`
    fn pairs(&mut self, item: &Item) -> Vec<(Text, Text)> {
        let Rest::Items(items) = &item.rest else {
            self.error(item.span, format!("expected `{}(NAME = \"…\", …)`", item.word));
            return Vec::new();
        };
        items.iter().filter_map(|i| Some((self.text(i), self.value(i)?))).collect()
    }

    fn machine(&mut self, attribute: &Attribute, draft: &mut Draft) {
        for item in self.items(attribute) {
            match item.word.as_str() {
                "title" => draft.title = self.value(&item).unwrap_or_default(),
                "notation" => draft.notation = self.value(&item),
                "constants" => draft.constants = self.list(&item),
                "estimate" => draft.estimate = self.list(&item),
                "order" => draft.order = self.list(&item),
                "names" => draft.names = self.pairs(&item),
                _ => self.unknown(&item, MACHINE),
            }
        }
    }

    /// A field is an axis: `#[workpiece(…)]` or `#[tool(…)]`, called after the field unless it has a `name`.
    fn field(&mut self, field: &Ident, attributes: &[Attribute], draft: &mut Draft) {
        let side = |a: &&Attribute| a.path().is_ident("workpiece") || a.path().is_ident("tool");
        let Some(attribute) = attributes.iter().find(side) else {
            return self.error(field.span(), "on which side is this axis? `#[workpiece(…)]` or `#[tool(…)]`");
        };
        let mut name = self.places.text(&field.to_string().to_uppercase(), field.span());
        let (mut motion, mut location) = (None, Vec::new());
        for item in self.items(attribute) {
            match item.word.as_str() {
                "name" => name = self.value(&item).unwrap_or(name),
                "rotary" => motion = Some((AxisKind::Rotary, self.list(&item))),
                "linear" => motion = Some((AxisKind::Linear, self.list(&item))),
                "location" => location = self.list(&item),
                _ => self.unknown(&item, AXIS),
            }
        }
        let Some((kind, direction)) = motion else {
            return self.error(field.span(), "what does this axis do? `rotary = \"x\"` or `linear = \"y\"`");
        };
        let carried = if attribute.path().is_ident("tool") { &mut draft.tool } else { &mut draft.workpiece };
        carried.push(name.clone());
        draft.axes.push(DraftAxis { name, kind, direction, location, range: None });
    }

    /// `#[run(radial, sweep = "c", at(…), …)]`
    fn run(&mut self, attribute: &Attribute) -> Option<DraftRun> {
        let items = self.items(attribute);
        let Some((name, rest)) = items.split_first().filter(|(name, _)| matches!(name.rest, Rest::Nothing)) else {
            self.error(attribute.path().get_ident()?.span(), "a run starts with its name: `#[run(radial, …)]`");
            return None;
        };
        let mut run = DraftRun { name: self.text(name), ..DraftRun::default() };
        let mut reading = None;
        for item in rest {
            match item.word.as_str() {
                "sweep" => run.sweep = self.value(item)?,
                "at" => run.at = self.pairs(item),
                "workpiece_ball" => run.workpiece_ball = self.ball(item),
                "tool_ball" => run.tool_ball = self.ball(item),
                "bar" => reading = self.value(item).map(DraftReading::Bar),
                "define" => run.define = self.pairs(item),
                "nuisance" => run.nuisance = self.list(item),
                "displacement" => reading = Some(DraftReading::Displacement(self.list(item))),
                _ => self.unknown(item, RUN),
            }
        }
        if run.sweep.value.is_empty() {
            self.error(name.span, "what does this run sweep? `sweep = \"a\"`");
        }
        match reading {
            Some(reading) => run.reading = reading,
            None => self.error(name.span, "what does this run read? `bar = \"R\"` or `displacement = \"x\"`"),
        }
        Some(run)
    }

    fn ball(&mut self, item: &Item) -> DraftBall {
        let mut ball = DraftBall::default();
        let Rest::Items(items) = &item.rest else {
            self.error(item.span, format!("expected `{}(at(…), setup(…))`", item.word));
            return ball;
        };
        for item in items {
            match item.word.as_str() {
                "at" => ball.at = self.list(item),
                "setup" => ball.setup = self.list(item),
                _ => self.unknown(item, BALL),
            }
        }
        ball
    }

    /// `EAA = polynomial(4, "f(0) = 0")`
    fn function(&mut self, item: &Item) -> Option<DraftFunction> {
        let Rest::Value(value) = &item.rest else {
            self.error(item.span, format!("expected `{} = polynomial(2)`, `fourier(2)`, `known` or `zero`", item.word));
            return None;
        };
        let basis = match (value.word.as_str(), &value.rest) {
            ("known", Rest::Nothing) => DraftBasis::Known,
            ("zero", Rest::Nothing) => DraftBasis::Zero,
            ("polynomial", Rest::Items(items)) => {
                let conditions = items.iter().skip(1).map(|i| self.text(i)).collect();
                DraftBasis::Polynomial(self.number(value, items, 20)?, conditions)
            }
            ("fourier", Rest::Items(items)) => DraftBasis::Fourier(self.number(value, items, 8)?),
            _ => {
                self.unknown(value, BASIS);
                return None;
            }
        };
        Some(DraftFunction { error: self.text(item), basis })
    }

    fn number(&mut self, owner: &Item, items: &[Item], high: u8) -> Option<u8> {
        let span = items.first().map_or(owner.span, |i| i.span);
        let number = items.first().and_then(|i| i.word.parse().ok()).filter(|n| (1..=high).contains(n));
        if number.is_none() {
            self.error(span, format!("expected a whole number from 1 to {high}"));
        }
        number
    }
}
