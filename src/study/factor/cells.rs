//! Where the samples of a run were: how many there are in each part of its sweep, and what was read and known there.
//!
//! What a budget asks of samples is smooth along the sweep, so that samples laid evenly over a cell stand for those that were there.

use super::reader::{BytesError, Reader};
use crate::study::hysteresis::{Averages, STEPS};
use crate::study::observation::Sample;
use crate::study::recording::FEW;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// A part of the sweep in one direction: −1, 1, or 0 where that is not known.
type Place = (i8, i32);

/// What was there.
#[derive(Clone, Debug, PartialEq)]
struct Cell {
    samples: u32,
    /// The least and the largest sweep, rad.
    ends: [f64; 2],
    /// Sum of the readings, mm.
    reading: f64,
    /// Of each known function the sum of its values and that of its squared standard uncertainties; none where all are zero.
    known: Vec<[f64; 2]>,
}

impl Cell {
    fn at(sweep: f64) -> Self {
        Self { samples: 0, ends: [sweep; 2], reading: 0.0, known: Vec::new() }
    }

    fn add(&mut self, sample: &Sample) {
        let [low, high] = self.ends;
        self.samples = self.samples.saturating_add(1);
        self.ends = [low.min(sample.sweep), high.max(sample.sweep)];
        self.reading += sample.reading;
        if self.known.is_empty() && sample.known.iter().chain(&sample.known_std).any(|x| *x != 0.0) {
            self.known.resize(sample.known.len(), [0.0; 2]);
        }
        self.known.iter_mut().zip(&sample.known).for_each(|(sum, value)| sum[0] += value);
        self.known.iter_mut().zip(&sample.known_std).for_each(|(sum, std)| sum[1] += std * std);
    }

    fn merge(&mut self, other: &Self) {
        let ([low, high], [other_low, other_high]) = (self.ends, other.ends);
        self.samples = self.samples.saturating_add(other.samples);
        self.ends = [low.min(other_low), high.max(other_high)];
        self.reading += other.reading;
        if self.known.is_empty() {
            self.known.clone_from(&other.known);
        } else {
            let sums = self.known.iter_mut().zip(&other.known);
            sums.for_each(|(sum, other)| *sum = [sum[0] + other[0], sum[1] + other[1]]);
        }
    }

    /// A sample in it, `at` of the way from its low end to its high one.
    fn sample(&self, at: f64, direction: f64, known: usize) -> Sample {
        let [low, high] = self.ends;
        let count = f64::from(self.samples);
        let sums = |i: usize| self.known.get(i).copied().unwrap_or_default();
        Sample {
            sweep: low + (high - low) * at,
            direction,
            reading: 0.0,
            known: (0..known).map(|i| sums(i)[0] / count).collect(),
            known_std: (0..known).map(|i| (sums(i)[1] / count).sqrt()).collect(),
        }
    }
}

/// A run's sweep in cells of 2°.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cells {
    cells: BTreeMap<Place, Cell>,
    /// The one that the last samples were in.
    open: Option<(Place, Cell)>,
}

impl Cells {
    /// The next sample.
    pub fn add(&mut self, sample: &Sample) {
        let place = (if sample.direction == 0.0 { 0 } else { sample.direction.signum() as i8 }, step(sample.sweep));
        if self.open.as_ref().is_none_or(|(at, _)| *at != place) {
            self.close();
        }
        self.open.get_or_insert_with(|| (place, Cell::at(sample.sweep))).1.add(sample);
    }

    /// Puts the open cell to the others.
    pub fn close(&mut self) {
        if let Some((place, cell)) = self.open.take() {
            self.put(place, &cell);
        }
    }

    fn put(&mut self, place: Place, cell: &Cell) {
        self.cells.entry(place).and_modify(|own| own.merge(cell)).or_insert_with(|| cell.clone());
    }

    /// Takes all samples of another.
    pub fn merge(&mut self, other: &Self) {
        other.cells.iter().for_each(|(place, cell)| self.put(*place, cell));
    }

    /// How many samples there are.
    pub fn samples(&self) -> u64 {
        self.cells.values().map(|cell| u64::from(cell.samples)).sum()
    }

    /// Whether it can be of a run with so many known functions.
    pub fn knows(&self, count: usize) -> bool {
        self.cells.values().all(|cell| cell.known.is_empty() || cell.known.len() == count)
    }

    /// Whether a known function was anything but zero.
    pub fn has_known(&self) -> bool {
        self.cells.values().any(|cell| !cell.known.is_empty())
    }

    /// Readings of either direction, averaged over the cells.
    pub fn averages(&self) -> Averages {
        let mut averages = Averages::default();
        for (&(direction, step), cell) in &self.cells {
            averages.add_all(direction, step, cell.reading, cell.samples as usize);
        }
        averages
    }

    /// Samples that stand for all, alike in weight and without readings: up one way, then down the other.
    pub fn standing(&self, known: usize) -> Vec<Sample> {
        let up = self.cells.iter().filter(|((direction, _), _)| *direction >= 0);
        let down = self.cells.iter().rev().filter(|((direction, _), _)| *direction < 0);
        let mut kept = Vec::new();
        // Every so many-th sample; the last one of a way is kept for the end that it is at.
        let every = self.samples().div_ceil(FEW as u64).max(1);
        for (cells, down) in [(up.collect::<Vec<_>>(), false), (down.collect(), true)] {
            let samples: u64 = cells.iter().map(|(_, cell)| u64::from(cell.samples)).sum();
            let mut before: u64 = 0;
            for (&(direction, _), cell) in cells {
                let count = u64::from(cell.samples);
                let first = before.next_multiple_of(every) - before;
                let last = (before + count == samples && !(samples - 1).is_multiple_of(every)).then_some(count - 1);
                let own =
                    std::iter::successors(Some(first), |at| Some(at + every)).take_while(|at| *at < count).chain(last);
                kept.extend(own.map(|at| {
                    let share = at as f64 / count.saturating_sub(1).max(1) as f64;
                    cell.sample(if down { 1.0 - share } else { share }, f64::from(direction), known)
                }));
                before += count;
            }
        }
        kept
    }

    /// As bytes; closed.
    pub fn write(&self, out: &mut Vec<u8>) {
        out.extend((self.cells.len() as u32).to_le_bytes());
        for (&(direction, step), Cell { samples, ends, reading, known }) in &self.cells {
            out.extend(direction.to_le_bytes());
            out.extend(step.to_le_bytes());
            out.extend(samples.to_le_bytes());
            out.extend(ends.iter().chain([reading]).flat_map(|x| x.to_le_bytes()));
            out.push(known.len().to_le_bytes()[0]);
            out.extend(known.iter().flatten().flat_map(|x| x.to_le_bytes()));
        }
    }

    /// From bytes: what samples can have come to, or nothing.
    pub fn read(bytes: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut cells = BTreeMap::new();
        let mut last = None;
        for _ in 0..bytes.count()? {
            let place = (i8::from_le_bytes(bytes.take()?), i32::from_le_bytes(bytes.take()?));
            let samples = bytes.count()?;
            let (ends, reading) = ([bytes.number()?, bytes.number()?], bytes.number()?);
            let count = bytes.byte()?;
            let known: Vec<[f64; 2]> =
                (0..count).map(|_| Ok([bytes.number()?, bytes.number()?])).collect::<Result<_, BytesError>>()?;
            let told = known.iter().all(|[sum, squares]| sum.is_finite() && squares.is_finite() && *squares >= 0.0);
            let whole = (-1..=1).contains(&place.0)
                && last.is_none_or(|last| last < place)
                && samples > 0
                && ends[0] <= ends[1]
                && ends.into_iter().all(|sweep| step(sweep) == place.1)
                && reading.is_finite();
            if !whole || !told {
                return Err(BytesError::Damaged);
            }
            last = Some(place);
            cells.insert(place, Cell { samples, ends, reading, known });
        }
        Ok(Self { cells, open: None })
    }
}

/// The cell of a sweep, rad.
fn step(sweep: f64) -> i32 {
    (sweep / TAU * STEPS as f64).floor() as i32
}
