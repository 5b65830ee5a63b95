//! Readers of every format, each written from what its control is documented to do, none sharing a line with the writers. Each
//! gives what the control adds to a commanded coordinate, degrees or mm, moving forward or back, or refuses the file.

mod iso;
mod siemens;

pub use iso::{Errors, etalon, iso_error, volcomp};
pub use siemens::{cec, sinumerik};
use std::collections::BTreeMap;
use trunnion::export::{AllFormat, OneFormat};

/// What a control adds to a commanded coordinate, degrees or mm, as the axis moves forward or back.
pub type Trim = Box<dyn Fn(f64, bool) -> f64>;

/// Why a control takes no such file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unread {
    /// It does not begin and end as it should.
    Frame,
    /// Something is not there.
    Lacks(&'static str),
    /// Something is no number, or one that cannot be.
    NoNumber(String),
    /// Rows are missing, there twice, or do not increase.
    Rows,
    /// The increments of a turn do not close it.
    Turn,
}

/// What a reader makes of a file.
pub type Read<T> = Result<T, Unread>;

/// The reader of a format.
pub fn of(format: OneFormat) -> fn(&str) -> Read<Trim> {
    match format {
        OneFormat::LinuxCnc => linuxcnc,
        OneFormat::Sinumerik840d | OneFormat::Sinumerik808d => sinumerik,
        OneFormat::Cec => cec,
        OneFormat::Heidenhain => heidenhain,
        OneFormat::Fanuc => fanuc,
        OneFormat::Csv => csv,
        OneFormat::Json => json,
    }
}

/// The reader of a format of errors under their ISO names.
pub fn of_all(format: AllFormat) -> fn(&str) -> Read<Errors> {
    match format {
        AllFormat::Volcomp => volcomp,
        AllFormat::Etalon => etalon,
    }
}

/// Increasing coordinates with a value each, straight between them, the end's value beyond; one at least.
#[derive(Clone)]
struct Rows(Vec<(f64, f64)>);

impl Rows {
    fn new(rows: Vec<(f64, f64)>) -> Read<Self> {
        let finite = rows.iter().all(|(at, value)| at.is_finite() && value.is_finite());
        let increase = rows.windows(2).all(|two| two[0].0 < two[1].0);
        if finite && increase && !rows.is_empty() { Ok(Self(rows)) } else { Err(Unread::Rows) }
    }

    fn at(&self, x: f64) -> f64 {
        let behind = self.0.partition_point(|row| row.0 <= x);
        match (behind.checked_sub(1).and_then(|before| self.0.get(before)), self.0.get(behind)) {
            (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (x - x0) / (x1 - x0),
            (Some((_, end)), None) | (None, Some((_, end))) => *end,
            (None, None) => 0.0,
        }
    }
}

/// What is taken off in either direction.
fn off([forward, reverse]: [Rows; 2]) -> Trim {
    Box::new(move |x, ahead| -if ahead { &forward } else { &reverse }.at(x))
}

fn number(text: &str) -> Read<f64> {
    let number = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    number.ok_or_else(|| Unread::NoNumber(text.to_owned()))
}

/// Numbers with blanks between them.
fn numbers(line: &str) -> Read<Vec<f64>> {
    line.split_whitespace().map(number).collect()
}

/// Three numbers a line; what is no number ends the reading; a row that does not increase and all beyond 256 are dropped. The trim is
/// nominal − position, in single precision.
pub fn linuxcnc(text: &str) -> Read<Trim> {
    let mut rows: Vec<(f64, f64, f64)> = Vec::new();
    for line in text.lines() {
        let numbers: Vec<f64> = line.split_whitespace().map_while(|word| number(word).ok()).collect();
        let [nominal, forward, reverse] = numbers[..] else { break };
        if rows.len() < 256 && rows.last().is_none_or(|last| nominal > last.0) {
            rows.push((nominal, f64::from((nominal - forward) as f32), f64::from((nominal - reverse) as f32)));
        }
    }
    let forward = Rows::new(rows.iter().map(|row| (row.0, row.1)).collect())?;
    let reverse = Rows::new(rows.iter().map(|row| (row.0, row.2)).collect())?;
    Ok(Box::new(move |x, ahead| if ahead { &forward } else { &reverse }.at(x)))
}

/// Lines without what stands behind a mark.
fn without_comments<'a>(text: &'a str, mark: &'a str) -> impl Iterator<Item = &'a str> {
    let plain = move |line: &'a str| line.split_once(mark).map_or(line, |(before, _)| before).trim();
    text.lines().map(plain).filter(|line| !line.is_empty())
}

/// Positions, errors in the negative direction where there are such, errors.
pub fn heidenhain(text: &str) -> Read<Trim> {
    let mut lines = text.lines();
    if !(lines.next().is_some_and(|first| first.starts_with("BEGIN ")) && text.ends_with("[END]\n")) {
        return Err(Unread::Frame);
    }
    let columns: Vec<&str> = lines.next().unwrap_or_default().split_whitespace().collect();
    let at = |name: &str| columns.iter().position(|column| *column == name);
    let position = at("AXISPOS").ok_or(Unread::Lacks("AXISPOS"))?;
    let own = columns.len() - 1;
    let negative = at("BACKLASH").unwrap_or(own);
    let rows: Vec<Vec<f64>> = lines.take_while(|line| *line != "[END]").map(numbers).collect::<Read<_>>()?;
    Ok(off([pairs(&rows, [position, own])?, pairs(&rows, [position, negative])?]))
}

/// Two columns of rows.
fn pairs(rows: &[Vec<f64>], [at, value]: [usize; 2]) -> Read<Rows> {
    let pair = |row: &Vec<f64>| Some((*row.get(at)?, *row.get(value)?));
    Rows::new(rows.iter().map(pair).collect::<Option<_>>().ok_or(Unread::Rows)?)
}

/// Numbers of points, at most.
const POINTS: i64 = 9999;

/// What a person enters of the list: parameters, and the increment of each number.
pub fn fanuc(text: &str) -> Read<Trim> {
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let stated = |name: &'static str| {
        let line = lines.iter().find(|line| line.starts_with(name));
        line.map(|line| number(line.split_whitespace().last().unwrap_or_default())).transpose()
    };
    let parameter = |name: &'static str| stated(name)?.ok_or(Unread::Lacks(name));
    let point = |name: &'static str| match parameter(name)? {
        x if x.fract() == 0.0 && x.abs() <= POINTS as f64 => Ok(x as i64),
        x => Err(Unread::NoNumber(x.to_string())),
    };
    let mut increments = BTreeMap::new();
    for line in &lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        if let [first, _, _, increment, ..] = words[..]
            && words.len() <= 6
            && first.len() < 4
            && let (Ok(n), Ok(increment)) = (first.parse::<i64>(), number(increment))
            && increments.insert(n, increment).is_some()
        {
            return Err(Unread::Rows);
        }
    }
    let unit = parameter("detection unit")? * parameter("3623")?;
    let (reference, interval) = (point("3620")?, parameter("3624")?);
    let home = parameter("reference position")?;
    let (low, high) = (point("3621")?, point("3622")?);
    let turn = stated("3625")?;
    let increment = |n: i64| increments.get(&n).copied().ok_or(Unread::Rows);
    if let Some(turn) = turn {
        // The point of the reference is that a turn further, and a turn adds nothing.
        let sum = (low + 1..=high).map(increment).sum::<Read<f64>>()?;
        if turn <= 0.0 || increment(low)? != increment(high)? || sum != 0.0 {
            return Err(Unread::Turn);
        }
    }
    // Sums from the reference position either way.
    let sums = |shift: i64, offset: f64| {
        let at = |n: i64| home + (n - reference) as f64 * interval;
        let mut rows = vec![(home, offset)];
        let mut sum = 0.0;
        for n in reference + 1..=high {
            sum += increment(n + shift)?;
            rows.push((at(n), sum * unit + offset));
        }
        let mut sum = 0.0;
        for n in (low..=reference).rev().filter(|_| turn.is_none()) {
            sum -= increment(n + shift)?;
            rows.push((at(n - 1), sum * unit + offset));
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        Rows::new(rows)
    };
    let forward = sums(0, 0.0)?;
    let reverse = match stated("3605#0")? == Some(1.0) {
        false => forward.clone(),
        true => sums(point("3626")? - low, parameter("3627")? * unit)?,
    };
    Ok(Box::new(move |x, ahead| {
        let x = turn.map_or(x, |turn| home + (x - home).rem_euclid(turn));
        if ahead { &forward } else { &reverse }.at(x)
    }))
}

/// Columns in the units of their names.
pub fn csv(text: &str) -> Read<Trim> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().ok_or(Unread::Lacks("header"))?.split(',').collect();
    let unit = |name: &&str| match name.rsplit('_').next() {
        Some("urad") => Ok(1e-6f64.to_degrees()),
        Some("um") => Ok(1e-3),
        Some("deg" | "mm") => Ok(1.0),
        _ => Err(Unread::Lacks("unit")),
    };
    let units: Vec<f64> = header.iter().map(unit).collect::<Read<_>>()?;
    let row =
        |line: &str| line.split(',').zip(&units).map(|(x, unit)| Ok(number(x)? * unit)).collect::<Read<Vec<f64>>>();
    let rows: Vec<Vec<f64>> = lines.map(row).collect::<Read<_>>()?;
    Ok(off([pairs(&rows, [0, 1])?, pairs(&rows, [0, header.len() - 1])?]))
}

pub fn json(text: &str) -> Read<Trim> {
    let object: serde_json::Value = serde_json::from_str(text).map_err(|_| Unread::Frame)?;
    let unit = match object["unit"].as_str() {
        Some("urad") => 1e-6f64.to_degrees(),
        Some("um") => 1e-3,
        _ => return Err(Unread::Lacks("unit")),
    };
    let rows = object["rows"].as_array().ok_or(Unread::Lacks("rows"))?;
    let of = |key: &str| {
        let pair = |row: &serde_json::Value| Some((row["at"].as_f64()?, unit * row[key].as_f64()?));
        Rows::new(rows.iter().map(pair).collect::<Option<_>>().ok_or(Unread::Rows)?)
    };
    Ok(off([of("forward")?, of("reverse")?]))
}
