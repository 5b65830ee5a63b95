//! Readers of every format, each written from what its control is documented to do, none sharing a line with the writers. Each
//! gives what the control adds to a commanded coordinate, degrees or mm, moving forward or back.

use crate::machine::Trim;
use trunnion::export::OneFormat;

/// The reader of a format.
pub fn of(format: OneFormat) -> fn(&str) -> Trim {
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

/// Straight between rows, the end's value beyond.
fn straight(rows: &[(f64, f64)], x: f64) -> f64 {
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    if x <= first.0 {
        return first.1;
    }
    if x >= last.0 {
        return last.1;
    }
    let behind = rows.iter().position(|row| row.0 > x).unwrap();
    let ((x0, y0), (x1, y1)) = (rows[behind - 1], rows[behind]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

/// Three numbers a line; what is no number ends the reading; a row that does not increase and all beyond 256 are dropped. The trim is
/// nominal − position, in single precision.
pub fn linuxcnc(text: &str) -> Trim {
    let mut rows: Vec<(f64, f64, f64)> = Vec::new();
    for line in text.lines() {
        let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
        let [nominal, forward, reverse] = numbers[..] else { break };
        if rows.len() < 256 && rows.last().is_none_or(|last| nominal > last.0) {
            rows.push((nominal, f64::from((nominal - forward) as f32), f64::from((nominal - reverse) as f32)));
        }
    }
    let forward: Vec<(f64, f64)> = rows.iter().map(|row| (row.0, row.1)).collect();
    let reverse: Vec<(f64, f64)> = rows.iter().map(|row| (row.0, row.2)).collect();
    Box::new(move |x, ahead| straight(if ahead { &forward } else { &reverse }, x))
}

/// Lines without what stands behind `;`.
fn without_comments<'a>(text: &'a str, mark: &'a str) -> impl Iterator<Item = &'a str> {
    text.lines().map(move |line| line.split(mark).next().unwrap().trim()).filter(|line| !line.is_empty())
}

/// `$NAME[index,…]=value` by name and indices.
fn system_variables(text: &str) -> Vec<(String, Vec<String>, String)> {
    let mut found = Vec::new();
    for line in without_comments(text, ";") {
        let Some((left, value)) = line.strip_prefix('$').and_then(|line| line.split_once('=')) else { continue };
        let (name, indices) = left.trim_end_matches(']').split_once('[').unwrap();
        found.push((name.to_owned(), indices.split(',').map(str::to_owned).collect(), value.to_owned()));
    }
    found
}

/// Rows in equal steps, over and over again where they are modulo; a positive value moves the axis in the negative direction.
struct Siemens {
    values: Vec<f64>,
    min: f64,
    max: f64,
    step: f64,
    modulo: bool,
}

impl Siemens {
    fn trim(&self, x: f64) -> f64 {
        let x = if self.modulo { self.min + (x - self.min).rem_euclid(self.max - self.min) } else { x };
        let rows: Vec<(f64, f64)> =
            self.values.iter().enumerate().map(|(row, value)| (self.min + row as f64 * self.step, *value)).collect();
        -straight(&rows, x)
    }
}

pub fn sinumerik(text: &str) -> Trim {
    assert!(text.starts_with("%_N_AX_EEC_INI\n") && text.contains("\nCHANDATA(1)\n") && text.ends_with("\nM17\n"));
    let all = system_variables(text);
    let one = |name: &str| all.iter().find(|(own, ..)| own == name).unwrap().2.parse::<f64>().unwrap();
    let mut values: Vec<(usize, f64)> = Vec::new();
    for (name, indices, value) in &all {
        if name == "AA_ENC_COMP" {
            assert_eq!((indices.len(), indices[0].as_str()), (3, "0"));
            values.push((indices[1].parse().unwrap(), value.parse().unwrap()));
        }
    }
    values.sort_by_key(|(row, _)| *row);
    let table = Siemens {
        values: values.iter().map(|(_, value)| *value).collect(),
        min: one("AA_ENC_COMP_MIN"),
        max: one("AA_ENC_COMP_MAX"),
        step: one("AA_ENC_COMP_STEP"),
        modulo: one("AA_ENC_COMP_IS_MODULO") == 1.0,
    };
    assert!((table.min + table.step * (table.values.len() - 1) as f64 - table.max).abs() < 1e-6);
    Box::new(move |x, _| table.trim(x))
}

/// The tables of both directions, or the one of each.
pub fn cec(text: &str) -> Trim {
    assert!(text.starts_with("%_N_NC_CEC_INI\n") && text.ends_with("\nM17\n"));
    let all = system_variables(text);
    let of = |table: usize, name: &str| {
        let own = |(own, indices, _): &&(String, Vec<String>, String)| own == name && indices[0] == table.to_string();
        all.iter().find(own).map(|(.., value)| value.clone())
    };
    let mut tables = Vec::new();
    while let Some(direction) = of(tables.len(), "AN_CEC_DIRECTION") {
        let t = tables.len();
        let one = |name: &str| of(t, name).unwrap().parse::<f64>().unwrap();
        let values = all.iter().filter(|(name, indices, _)| name == "AN_CEC" && indices[0] == t.to_string());
        let table = Siemens {
            values: values.map(|(.., value)| value.parse().unwrap()).collect(),
            min: one("AN_CEC_MIN"),
            max: one("AN_CEC_MAX"),
            step: one("AN_CEC_STEP"),
            modulo: one("AN_CEC_IS_MODULO") == 1.0,
        };
        assert!(of(t, "AN_CEC_INPUT_AXIS").unwrap().starts_with('('));
        tables.push((direction, table));
    }
    Box::new(move |x, ahead| {
        let acts = |direction: &str| matches!((direction, ahead), ("0", _) | ("1", true) | ("-1", false));
        tables.iter().filter(|(direction, _)| acts(direction)).map(|(_, table)| table.trim(x)).sum()
    })
}

/// Positions, errors in the negative direction where there are such, errors.
pub fn heidenhain(text: &str) -> Trim {
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("BEGIN ") && text.ends_with("[END]\n"));
    let columns: Vec<&str> = lines.next().unwrap().split_whitespace().collect();
    let at = |name: &str| columns.iter().position(|column| *column == name);
    let position = at("AXISPOS").unwrap();
    let own = columns.len() - 1;
    let negative = at("BACKLASH").unwrap_or(own);
    let rows: Vec<Vec<f64>> = lines
        .take_while(|line| *line != "[END]")
        .map(|line| line.split_whitespace().map(|word| word.parse().unwrap()).collect())
        .collect();
    let of = |column: usize| rows.iter().map(|row| (row[position], row[column])).collect::<Vec<(f64, f64)>>();
    let (ahead_rows, back_rows) = (of(own), of(negative));
    Box::new(move |x, ahead| -straight(if ahead { &ahead_rows } else { &back_rows }, x))
}

/// What a person enters of the list: parameters, and the increment of each number.
pub fn fanuc(text: &str) -> Trim {
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let parameter = |number: &str| {
        let line = lines.iter().find(|line| line.starts_with(number));
        line.map(|line| line.split_whitespace().last().unwrap().parse::<f64>().unwrap())
    };
    let mut increments = std::collections::BTreeMap::new();
    for line in &lines {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.len() >= 4 && words.len() <= 6 && words[0].len() < 4 {
            let (Ok(number), Ok(increment)) = (words[0].parse::<i64>(), words[3].parse::<f64>()) else { continue };
            assert!(increments.insert(number, increment).is_none(), "{number} twice");
        }
    }
    let unit = parameter("detection unit").unwrap() * parameter("3623").unwrap();
    let (reference, interval) = (parameter("3620").unwrap() as i64, parameter("3624").unwrap());
    let home = parameter("reference position").unwrap();
    let (low, high) = (parameter("3621").unwrap() as i64, parameter("3622").unwrap() as i64);
    let turn = parameter("3625");
    if turn.is_some() {
        assert_eq!(increments[&low], increments[&high], "the point of the reference is that a turn further");
        assert_eq!((low + 1..=high).map(|n| increments[&n]).sum::<f64>(), 0.0, "a turn adds nothing");
    }
    // Sums from the reference position either way.
    let sums = move |increments: &std::collections::BTreeMap<i64, f64>, shift: i64| {
        let mut rows = vec![(home, 0.0)];
        let mut sum = 0.0;
        for n in reference + 1..=high {
            sum += increments[&(n + shift)];
            rows.push((home + (n - reference) as f64 * interval, sum * unit));
        }
        let mut sum = 0.0;
        for n in (low..=reference).rev().filter(|_| turn.is_none()) {
            sum -= increments[&(n + shift)];
            rows.insert(0, (home + (n - 1 - reference) as f64 * interval, sum * unit));
        }
        rows
    };
    let forward = sums(&increments, 0);
    let both = parameter("3605#0") == Some(1.0);
    let reverse = match both {
        false => forward.clone(),
        true => {
            let offset = parameter("3627").unwrap() * unit;
            let shift = parameter("3626").unwrap() as i64 - low;
            sums(&increments, shift).into_iter().map(|(x, sum)| (x, sum + offset)).collect()
        }
    };
    Box::new(move |x, ahead| {
        let x = turn.map_or(x, |turn| home + (x - home).rem_euclid(turn));
        straight(if ahead { &forward } else { &reverse }, x)
    })
}

/// Errors by their ISO names: over degrees or mm, in rad or mm.
pub type Errors = std::collections::BTreeMap<String, Vec<(f64, f64)>>;

/// Headers and rows; `#` begins another header, a block without an argument is of constants.
pub fn volcomp(text: &str) -> Errors {
    let mut errors = Errors::new();
    let lines: Vec<&str> = without_comments(text, "//").collect();
    for block in lines.split(|line| *line == "#") {
        let names: Vec<&str> = block[0].split_whitespace().collect();
        let argument = (names[0].len() == 1).then_some(0);
        for row in &block[1..] {
            let numbers: Vec<f64> = row.split_whitespace().map(|word| word.parse().unwrap()).collect();
            assert_eq!(numbers.len(), names.len());
            let at = argument.map_or(0.0, |column| numbers[column]);
            for (name, value) in names.iter().zip(&numbers).skip(usize::from(argument.is_some())) {
                errors.entry((*name).to_owned()).or_default().push((at, *value));
            }
        }
    }
    errors
}

/// Blocks with a value or grid points.
pub fn etalon(text: &str) -> Errors {
    let mut errors = Errors::new();
    let mut name = String::new();
    for line in without_comments(text, "//") {
        if let Some(own) = line.strip_prefix('[') {
            own.trim_end_matches(']').clone_into(&mut name);
        } else if let Some(value) = line.strip_prefix("VALUE = ") {
            errors.insert(name.clone(), vec![(0.0, value.parse().unwrap())]);
        } else if line == "Gridpoints = {" {
            errors.insert(name.clone(), Vec::new());
        } else if line != "}" {
            let (at, value) = line.split_once(' ').unwrap();
            errors.get_mut(&name).unwrap().push((at.parse().unwrap(), value.parse().unwrap()));
        }
    }
    errors
}

/// An axis' own error that a control takes off, in degrees or mm; of a rotary axis it is given in rad.
pub fn own_error(errors: &Errors, name: &str, turns: bool) -> Trim {
    let rows = errors[name].clone();
    Box::new(move |x, _| if turns { -straight(&rows, x).to_degrees() } else { -straight(&rows, x) })
}

/// Columns in the units of their names.
pub fn csv(text: &str) -> Trim {
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let header: Vec<&str> = lines[0].split(',').collect();
    let unit = |name: &str| match name.rsplit('_').next().unwrap() {
        "urad" => 1e-6f64.to_degrees(),
        "um" => 1e-3,
        "deg" | "mm" => 1.0,
        other => panic!("{other}"),
    };
    let rows: Vec<Vec<f64>> = lines[1..]
        .iter()
        .map(|line| line.split(',').zip(&header).map(|(x, name)| x.parse::<f64>().unwrap() * unit(name)).collect())
        .collect();
    let of = |column: usize| rows.iter().map(|row| (row[0], row[column])).collect::<Vec<(f64, f64)>>();
    let (forward, reverse) = (of(1), of(header.len() - 1));
    Box::new(move |x, ahead| -straight(if ahead { &forward } else { &reverse }, x))
}

pub fn json(text: &str) -> Trim {
    let object: serde_json::Value = serde_json::from_str(text).unwrap();
    let unit = match object["unit"].as_str().unwrap() {
        "urad" => 1e-6f64.to_degrees(),
        _ => 1e-3,
    };
    let rows = object["rows"].as_array().unwrap();
    let of = |key: &str| -> Vec<(f64, f64)> {
        rows.iter().map(|row| (row["at"].as_f64().unwrap(), unit * row[key].as_f64().unwrap())).collect()
    };
    let (forward, reverse) = (of("forward"), of("reverse"));
    Box::new(move |x, ahead| -straight(if ahead { &forward } else { &reverse }, x))
}
