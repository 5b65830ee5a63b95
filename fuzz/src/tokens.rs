//! Mutations of a model file that know its words: most still read, many still derive.

use libfuzzer_sys::fuzzer_mutate;
use trunnion_codegen::catalogue::MODELS;

/// Choices out of a seed (SplitMix64).
struct Choice(u64);

impl Choice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % n.max(1) as u64) as usize
    }

    fn of<'a, T: ?Sized>(&mut self, among: &[&'a T]) -> Option<&'a T> {
        among.get(self.below(among.len())).copied()
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Word,
    Number,
    Blank,
    Sign,
}

fn kind(c: char) -> Kind {
    match c {
        'a'..='z' | 'A'..='Z' | '_' => Kind::Word,
        '0'..='9' => Kind::Number,
        ' ' | '\n' => Kind::Blank,
        _ => Kind::Sign,
    }
}

/// Words (`w_x1`, `EC0Y`), numbers, blanks, and all else by single characters.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let own = kind(first);
        let goes_on = |c: char| match (own, kind(c)) {
            (Kind::Sign, _) => false,
            (Kind::Word, next) => matches!(next, Kind::Word | Kind::Number),
            (_, next) => next == own,
        };
        let end = rest.char_indices().skip(1).find(|(_, c)| !goes_on(*c)).map_or(rest.len(), |(at, _)| at);
        let (token, after) = rest.split_at(end);
        tokens.push(token);
        rest = after;
    }
    tokens
}

/// What a fuzz target's mutator does: mostly one change of words, else of bytes, and so where there is no room for it.
pub fn mutate(data: &mut [u8], size: usize, max_size: usize, seed: u32) -> usize {
    let words = seed % 8 != 0;
    let text = str::from_utf8(&data[..size]).ok().filter(|_| words).map(|text| mutated(text, seed));
    match text.filter(|text| text.len() <= max_size) {
        Some(text) => {
            data[..text.len()].copy_from_slice(text.as_bytes());
            text.len()
        }
        None => fuzzer_mutate(data, size, max_size),
    }
}

/// The text with one change: a token or a line for another of itself or of the catalogue, or an expression grown.
fn mutated(text: &str, seed: u32) -> String {
    let mut choice = Choice(u64::from(seed));
    let donor = match choice.below(2) {
        0 => text,
        _ => MODELS[choice.below(MODELS.len())].1,
    };
    match choice.below(6) {
        0 => by_lines(text, donor, &mut choice),
        1 => grown(text, &mut choice),
        _ => by_tokens(text, donor, &mut choice),
    }
}

fn by_tokens(text: &str, donor: &str, choice: &mut Choice) -> String {
    let mut own = tokens(text);
    // Signs hold the form together: they are seldom changed.
    let named = |at: &usize| own.get(*at).and_then(|token| token.chars().next()).is_some_and(|c| c.is_alphanumeric());
    let tries = [choice.below(own.len()), choice.below(own.len()), choice.below(own.len())];
    let at = tries.into_iter().find(named).unwrap_or(tries[0]);
    let Some(old) = own.get(at).copied() else { return donor.to_owned() };
    let like = |token: &&str| token.chars().next().map(kind) == old.chars().next().map(kind) && *token != old;
    let others: Vec<&str> = tokens(donor).into_iter().filter(like).collect();
    if let Some(new) = choice.of(&others) {
        own[at] = new;
    }
    own.concat()
}

/// Lines inserted, replaced, exchanged, left out.
fn by_lines(text: &str, donor: &str, choice: &mut Choice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let (at, other) = (choice.below(lines.len()), choice.below(lines.len()));
    let new = choice.of(&donor.lines().collect::<Vec<_>>()).unwrap_or("");
    match choice.below(4) {
        _ if lines.is_empty() => lines.push(new),
        0 => lines.insert(at, new),
        1 => lines[at] = new,
        2 => lines.swap(at, other),
        _ => drop(lines.remove(at)),
    }
    lines.join("\n") + "\n"
}

/// A string with another beside it: `"R*cos(a)"` and `"L"` become `"(R*cos(a))*(L)"`.
fn grown(text: &str, choice: &mut Choice) -> String {
    let mut parts: Vec<&str> = text.split('"').collect();
    let strings = parts.len() / 2;
    let (at, other) = (2 * choice.below(strings) + 1, 2 * choice.below(strings) + 1);
    let (Some(one), Some(two)) = (parts.get(at), parts.get(other)) else { return text.to_owned() };
    let sign = ["+", "-", "*", "/", "**"][choice.below(5)];
    let new = match choice.below(3) {
        0 => format!("({one}){sign}({two})"),
        1 => format!("{}({one})", ["sin", "cos", "sqrt", "-", "atan2"][choice.below(5)]),
        _ => format!("{one}{sign}{}", choice.below(9)),
    };
    parts[at] = &new;
    parts.join("\"")
}
