//! Pins and parameters of a component: names that HAL has room for, as it writes them and as C does.

use crate::emit::names::{HAL, Rules, Scope, abbreviated};
use crate::quantity::Unit;

const RULES: Rules = Rules { lower_case: true, places: true, words: &HAL };

/// HAL's longest name, and what of it an instance's number and the dots take: `.99.`.
const LONGEST: usize = 47;
const NUMBER: usize = 4;
/// The longest end of a name that is a unit: `_urad`.
const UNIT: usize = 5;

/// What HAL declares.
#[derive(Clone, Copy)]
pub(super) enum Item {
    Input,
    Bit,
    Output,
    Count,
    Status,
    Parameter,
}

impl Item {
    fn declared(self) -> &'static str {
        match self {
            Self::Input => "pin in float",
            Self::Bit => "pin in bit",
            Self::Output => "pin out float",
            Self::Count => "pin out u32",
            Self::Status => "pin out s32",
            Self::Parameter => "param rw float",
        }
    }
}

/// Declarations of a component, line by line.
pub(super) struct Pins {
    names: Scope,
    stems: Scope,
    /// Characters of a name.
    room: usize,
    pub lines: String,
}

impl Pins {
    /// Of the component `called`.
    pub fn new(called: &str) -> Self {
        let scope = || Scope::new::<&str>(RULES, &[]);
        let room = LONGEST - NUMBER - called.len();
        Self { names: scope(), stems: scope(), room, lines: String::new() }
    }

    /// What the names of a run or a function begin with, so that any of `ends` fits behind it.
    pub fn stem(&mut self, of: &str, ends: &[&str]) -> String {
        let longest = ends.iter().map(|end| end.len()).max().unwrap_or(0);
        self.stems.claim_within(of, self.room - longest)
    }

    /// Declares one and gives its name in C.
    pub fn declare(&mut self, item: Item, name: &str, value: &str, meaning: &str) -> String {
        let name = self.names.claim_within(name, self.room);
        let value = if value.is_empty() { String::new() } else { format!(" = {value}") };
        let (item, hal, meaning) = (item.declared(), name.replace('_', "-"), quoted(meaning));
        self.lines += &format!("{item} {hal}{value} \"{meaning}\";\n");
        name
    }

    /// Declares one that the model names, behind a stem and before its unit.
    pub fn named(&mut self, stem: &str, of: &str, unit: Option<Unit>, meaning: &str) -> String {
        let rest = self.room.saturating_sub(stem.len() + 1 + UNIT);
        let of = abbreviated(&RULES.sanitised(of), rest);
        let unit = unit.map_or(String::new(), |unit| format!("_{}", unit.suffix()));
        self.declare(Item::Input, &format!("{stem}_{of}{unit}"), "", meaning)
    }
}

/// Text as it may stand in halcompile's strings, which have no escapes that mean the same to it and to a compiler.
pub(super) fn quoted(text: &str) -> String {
    let plain = |c: char| match c {
        '"' => '\'',
        '\\' => '/',
        c if c.is_ascii_graphic() || c == ' ' => c,
        _ => '?',
    };
    text.chars().map(plain).collect()
}
