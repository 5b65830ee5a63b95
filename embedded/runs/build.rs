//! Writes the reference measurement as a table of whole picometres: exact, and half the size of doubles.

use std::{env, error::Error, fs, path::Path};

/// Columns after the angle, which is the row's number in degrees.
fn columns(name: &str) -> Result<Vec<Vec<i32>>, Box<dyn Error>> {
    let path = Path::new("../../tests/reference/tilting-table/full").join(name);
    println!("cargo::rerun-if-changed={}", path.display());
    let text = fs::read_to_string(&path)?;
    let mut rows = Vec::new();
    for (degree, line) in text.lines().skip(1).enumerate() {
        let mut cells = line.split(',').map(|cell| cell.parse::<f64>());
        if cells.next() != Some(Ok(degree as f64)) {
            return Err(format!("{}: row {degree} is not at {degree}°", path.display()).into());
        }
        rows.push(cells.map(|um| um.map(|um| (um * 1e6).round() as i32)).collect::<Result<_, _>>()?);
    }
    Ok(rows)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (tilting, separation, table) = (columns("tilting.csv")?, columns("separation.csv")?, columns("table.csv")?);
    let mut source = String::from("[\n");
    for ((t, s), k) in tilting.iter().zip(&separation).zip(&table) {
        source += &format!("Record {{ tilting: {}, separation: {}, known: {k:?} }},\n", t[0], s[0]);
    }
    fs::write(Path::new(&env::var("OUT_DIR")?).join("table.rs"), source + "]")?;
    Ok(())
}
