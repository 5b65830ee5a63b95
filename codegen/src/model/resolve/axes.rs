//! The axes of either side with their errors.

use super::names::WORDS;
use super::resolver::Resolver;
use crate::algebra::{ErrorId, Quantity};
use crate::iso::{Component, Notation, iso_location, iso_motion, location_error};
use crate::model::{Axis, AxisKind, Draft, DraftAxis, ProblemKind, Reference};
use crate::source::{Span, Text};

impl Resolver {
    pub fn side(
        &mut self,
        draft: &Draft,
        side: &[Text],
        notation: Notation,
        names: &mut Vec<(Text, Text)>,
    ) -> Vec<Axis> {
        let mut axes: Vec<Axis> = Vec::new();
        for text in side {
            match draft.axes.iter().find(|a| a.name.value == text.value) {
                None => self.problem(&text.span, ProblemKind::UnknownAxis(text.value.clone())).unwrap_or(()),
                Some(_) if self.iso.iter().any(|(iso, _)| *iso == iso_motion(Component::ALL[0], &text.value)) => {
                    self.problem(&text.span, ProblemKind::Taken(text.value.clone())).unwrap_or(());
                }
                Some(axis) => axes.extend(self.axis(axis, notation, names)),
            }
        }
        axes
    }

    pub fn axis(&mut self, axis: &DraftAxis, notation: Notation, names: &mut Vec<(Text, Text)>) -> Option<Axis> {
        if !self.is_name(&axis.name) {
            return None;
        }
        let name = &axis.name.value;
        let mut location = [None; 6];
        let mut references = Vec::new();
        for text in &axis.location {
            let Some((c, reference)) = location_error(&text.value, name) else {
                self.problem::<()>(&text.span, ProblemKind::NotALocation(text.value.clone()));
                continue;
            };
            location[c.index()] =
                self.make_error(&text.span, iso_location(c, name), notation.location(c, name), c, names);
            let place = text.span.clone();
            references.extend(reference.map(|axis| Reference { component: c, axis: axis.to_owned(), place }));
        }
        let mut motion = Vec::with_capacity(6);
        for c in Component::ALL {
            motion.extend(self.make_error(&axis.name.span, iso_motion(c, name), notation.motion(c, name), c, names));
        }
        let direction = self.direction(&axis.direction, &axis.name.span, None);
        Some(Axis {
            name: name.clone(),
            // Once everything else is named.
            coordinate: String::new(),
            kind: axis.kind,
            // A refused direction has no use: the description is refused with it.
            direction: direction.unwrap_or_default(),
            location,
            references,
            range: axis.range.map(|range| range.map(|end| quantity(axis.kind).coordinate().to_inner(end))),
            motion: motion.try_into().ok()?,
        })
    }

    /// The axis with a name for its coordinate that stands for nothing else: its letter, which may be a sweep's, too.
    pub fn named(&mut self, axis: Axis) -> Axis {
        let letter = axis.name.to_lowercase();
        let taken = WORDS.contains(&letter.as_str()) || self.alphabet.has_name_beside_sweeps(&letter);
        let coordinate = if taken { self.alphabet.free(format!("{letter}_axis")) } else { letter };
        self.alphabet.reserve(coordinate.clone());
        Axis { coordinate, ..axis }
    }

    /// Makes an error under the model's own name for it, if it has one.
    fn make_error(
        &mut self,
        span: &Span,
        iso: String,
        name: String,
        c: Component,
        names: &mut Vec<(Text, Text)>,
    ) -> Option<ErrorId> {
        let own = names.iter().position(|(i, _)| i.value == iso).map(|at| names.swap_remove(at).1);
        let (name, span) = own.map_or((name, span.clone()), |text| (text.value, text.span));
        let text = Text { value: name, span: span.clone() };
        if !self.is_name(&text) || !self.is_free(&text) {
            return None;
        }
        let made = self.alphabet.error(&text.value, if c.is_rotation() { Quantity::Angle } else { Quantity::Length });
        let id = self.exact(&span, made)?;
        self.iso.push((iso, id));
        Some(id)
    }
}

/// What a coordinate measures.
fn quantity(kind: AxisKind) -> Quantity {
    match kind {
        AxisKind::Rotary => Quantity::Angle,
        AxisKind::Linear => Quantity::Length,
    }
}
