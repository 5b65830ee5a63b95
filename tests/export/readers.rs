//! Readers of every format, each written from what its control is documented to do, none sharing a line with the writers. Each
//! gives what the control adds to a commanded coordinate, degrees or mm, moving forward or back.

use crate::machine::Trim;

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
