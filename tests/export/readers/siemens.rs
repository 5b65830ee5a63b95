//! SINUMERIK: `$AA_ENC_COMP` and `$AN_CEC`.

use super::{Read, Rows, Trim, Unread, number, without_comments};

/// `$NAME[index,…]=value` by name and indices.
struct Variables<'a>(Vec<(&'a str, Vec<&'a str>, &'a str)>);

impl<'a> Variables<'a> {
    fn read(text: &'a str) -> Self {
        let one = |line: &'a str| {
            let (left, value) = line.strip_prefix('$')?.split_once('=')?;
            let (name, indices) = left.strip_suffix(']')?.split_once('[')?;
            Some((name, indices.split(',').collect(), value))
        };
        Self(without_comments(text, ";").filter_map(one).collect())
    }

    /// The value of a name with these first indices.
    fn value(&self, name: &'static str, first: &[&str]) -> Read<&'a str> {
        let found = self.0.iter().find(|(own, indices, _)| *own == name && indices.starts_with(first));
        found.map(|(.., value)| *value).ok_or(Unread::Lacks(name))
    }

    /// The rows of a table, of which the variables begin with `name`, and the points are counted by the second index.
    fn table(&self, [name, min, max, step, modulo]: [&'static str; 5], first: &[&str]) -> Read<Siemens> {
        let one = |what| number(self.value(what, first)?);
        let (min, max, step) = (one(min)?, one(max)?, one(step)?);
        let own = self.0.iter().filter(|(own, indices, _)| *own == name && indices.starts_with(first));
        let mut rows = Vec::new();
        for (row, (_, indices, value)) in own.enumerate() {
            if indices.get(1).and_then(|index| index.parse().ok()) != Some(row) {
                return Err(Unread::Rows);
            }
            rows.push((min + row as f64 * step, number(value)?));
        }
        let ends_there = rows.last().is_some_and(|(last, _)| (last - max).abs() < 1e-6);
        let turn = (one(modulo)? == 1.0).then_some(max - min);
        match Rows::new(rows) {
            Ok(rows) if ends_there && turn.is_none_or(|turn| turn > 0.0) => Ok(Siemens { rows, min, turn }),
            _ => Err(Unread::Rows),
        }
    }
}

/// Rows in equal steps, over and over again where they are modulo; a positive value moves the axis in the negative direction.
struct Siemens {
    rows: Rows,
    min: f64,
    turn: Option<f64>,
}

impl Siemens {
    fn trim(&self, x: f64) -> f64 {
        -self.rows.at(self.turn.map_or(x, |turn| self.min + (x - self.min).rem_euclid(turn)))
    }
}

pub fn sinumerik(text: &str) -> Read<Trim> {
    if !(text.starts_with("%_N_AX_EEC_INI\n") && text.contains("\nCHANDATA(1)\n") && text.ends_with("\nM17\n")) {
        return Err(Unread::Frame);
    }
    const NAMES: [&str; 5] =
        ["AA_ENC_COMP", "AA_ENC_COMP_MIN", "AA_ENC_COMP_MAX", "AA_ENC_COMP_STEP", "AA_ENC_COMP_IS_MODULO"];
    let table = Variables::read(text).table(NAMES, &["0"])?;
    Ok(Box::new(move |x, _| table.trim(x)))
}

/// The tables of both directions, or the one of each.
pub fn cec(text: &str) -> Read<Trim> {
    if !(text.starts_with("%_N_NC_CEC_INI\n") && text.ends_with("\nM17\n")) {
        return Err(Unread::Frame);
    }
    const NAMES: [&str; 5] = ["AN_CEC", "AN_CEC_MIN", "AN_CEC_MAX", "AN_CEC_STEP", "AN_CEC_IS_MODULO"];
    let all = Variables::read(text);
    let mut tables = Vec::new();
    for t in ["0", "1"] {
        let Ok(direction) = all.value("AN_CEC_DIRECTION", &[t]).and_then(number) else { break };
        for axis in ["AN_CEC_INPUT_AXIS", "AN_CEC_OUTPUT_AXIS"] {
            all.value(axis, &[t])?.strip_prefix('(').ok_or(Unread::Lacks(axis))?;
        }
        tables.push((direction, all.table(NAMES, &[t])?));
    }
    if tables.is_empty() {
        return Err(Unread::Lacks("AN_CEC_DIRECTION"));
    }
    Ok(Box::new(move |x, ahead| {
        let acts = |direction: f64| direction == 0.0 || (direction > 0.0) == ahead;
        tables.iter().filter(|(direction, _)| acts(*direction)).map(|(_, table)| table.trim(x)).sum()
    }))
}
