//! The paper's two runs as a table: a reading each degree, simulated by full kinematics with ±0.1 µm of noise.
//!
//! On a machine these come from the encoder and the ball-bar; here they come from `tests/reference/tilting-table/full`.
#![no_std]

/// The bar's nominal length, mm.
pub const RADIUS: f64 = 150.0;

/// Both runs at one angle.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Angle of the tilting axis, rad.
    pub angle: f64,
    /// ΔR₁: radial deviation of the run `tilting`, mm.
    pub tilting: f64,
    /// ΔR₂: radial deviation of the run `separation`, mm.
    pub separation: f64,
    /// The known δ_ya and δ_za, mm.
    pub known: [f64; 2],
}

/// One degree of the table, pm.
struct Record {
    tilting: i32,
    separation: i32,
    known: [i32; 2],
}

static TABLE: &[Record] = &include!(concat!(env!("OUT_DIR"), "/table.rs"));

/// The samples of one turn, in order.
pub fn turn() -> impl Iterator<Item = Sample> {
    let mm = |pm: i32| f64::from(pm) * 1e-9;
    (0_u32..).zip(TABLE).map(move |(degree, record)| Sample {
        angle: f64::from(degree).to_radians(),
        tilting: mm(record.tilting),
        separation: mm(record.separation),
        known: record.known.map(mm),
    })
}
