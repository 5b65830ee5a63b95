//! Sums of products of a run's rows, each with itself and with its neighbour: with an estimate, how large the residuals are and how
//! alike neighbours.

use super::reader::{BytesError, Reader};
use crate::study::rows::Rows;
use trunnion_codegen::graph::{LANES, Lanes};
use trunnion_solver::sized::{LARGEST, Work, vectorised};

/// Sums that go on side by side: what the processor's vectors hold, and in one order on any processor.
const SIDES: usize = 8;
/// Larger sums of squares no readings have.
const MOST: f64 = 1e150;
/// By how much of itself a sum of many may be off.
const ROUNDED: f64 = 1e-6;

/// The lower triangles of two sums, row after row, over the regressors of a run and what is left of its readings.
#[derive(Clone, Debug, PartialEq)]
pub struct Squares {
    width: usize,
    /// Of rows with themselves.
    own: Vec<f64>,
    /// Of rows with their neighbours: the mean of either order.
    neighbours: Vec<f64>,
}

/// Rows on their way into sums.
pub struct Squaring {
    squares: Squares,
    columns: Vec<Lanes>,
    /// The same, each a sample later.
    before: Vec<Lanes>,
}

impl Squaring {
    /// Of a run with so many regressors.
    pub fn new(regressors: usize) -> Self {
        let width = regressors + 1;
        Self { squares: Squares::new(width), columns: vec![[0.0; LANES]; width], before: vec![[0.0; LANES]; width] }
    }

    /// The next block of rows.
    pub fn add(&mut self, rows: &Rows) {
        let (count, explained) = (rows.samples(), rows.explained());
        let lanes = rows.regressors().chain([&explained]);
        for ((column, before), lanes) in self.columns.iter_mut().zip(&mut self.before).zip(lanes) {
            // Every block but the last is full.
            before[0] = column[LANES - 1];
            column.fill(0.0);
            column[..count].copy_from_slice(&lanes[..count]);
            before[1..].copy_from_slice(&column[..LANES - 1]);
        }
        vectorised(Products { squares: &mut self.squares, columns: &self.columns, before: &self.before });
    }

    /// The sums.
    pub fn squares(self) -> Squares {
        self.squares
    }
}

struct Products<'a> {
    squares: &'a mut Squares,
    columns: &'a [Lanes],
    before: &'a [Lanes],
}

impl Work for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        let mut at = 0;
        for (i, (x, x_before)) in self.columns.iter().zip(self.before).enumerate() {
            for (y, y_before) in self.columns.iter().zip(self.before).take(i + 1) {
                let (mut own, mut neighbours) = ([0.0; SIDES], [0.0; SIDES]);
                for from in (0..LANES).step_by(SIDES) {
                    for side in 0..SIDES {
                        let k = from + side;
                        own[side] += x[k] * y[k];
                        neighbours[side] += x[k] * y_before[k] + x_before[k] * y[k];
                    }
                }
                self.squares.own[at] += own.iter().sum::<f64>();
                self.squares.neighbours[at] += 0.5 * neighbours.iter().sum::<f64>();
                at += 1;
            }
        }
    }
}

impl Squares {
    fn new(width: usize) -> Self {
        let zeros = vec![0.0; width * (width + 1) / 2];
        Self { width, own: zeros.clone(), neighbours: zeros }
    }

    /// Regressors of its run.
    pub fn regressors(&self) -> usize {
        self.width - 1
    }

    /// Adds another of the same run.
    pub fn merge(&mut self, other: &Self) {
        let own = self.own.iter_mut().chain(&mut self.neighbours);
        own.zip(other.own.iter().chain(&other.neighbours)).for_each(|(sum, other)| *sum += other);
    }

    /// The sum of the squares of the residuals, and that of the products of neighbours, mm²: of a value for each regressor.
    pub fn residuals(&self, values: &[f64]) -> [f64; 2] {
        let factors: Vec<f64> = values.iter().copied().chain([-1.0]).collect();
        let form = |sums: &[f64]| {
            let mut rest = sums.iter();
            let mut sum = 0.0;
            for (i, a) in factors.iter().enumerate() {
                for (j, (b, own)) in factors.iter().zip(rest.by_ref().take(i + 1)).enumerate() {
                    sum += if i == j { own * a * b } else { 2.0 * own * a * b };
                }
            }
            sum
        };
        [form(&self.own).max(0.0), form(&self.neighbours)]
    }

    /// As bytes.
    pub fn write(&self, out: &mut Vec<u8>) {
        out.push(self.width.to_le_bytes()[0]);
        out.extend(self.own.iter().chain(&self.neighbours).flat_map(|x| x.to_le_bytes()));
    }

    /// From bytes.
    pub fn read(bytes: &mut Reader<'_>) -> Result<Self, BytesError> {
        let width = bytes.byte()?;
        if !(1..=LARGEST + 1).contains(&width) {
            return Err(BytesError::Damaged);
        }
        let count = width * (width + 1) / 2;
        let (own, neighbours) = (bytes.numbers(count)?, bytes.numbers(count)?);
        let read = Self { width, own, neighbours };
        if read.is_possible() { Ok(read) } else { Err(BytesError::Damaged) }
    }

    /// No product of two columns is larger than both of them (Cauchy and Schwarz), nor any so large that sums of them would be infinite.
    fn is_possible(&self) -> bool {
        let square = |i: usize| self.own[i * (i + 3) / 2];
        let mut both = self.own.iter().zip(&self.neighbours);
        (0..self.width).all(|i| (0.0..MOST).contains(&square(i)))
            && (0..self.width).all(|i| {
                both.by_ref().take(i + 1).enumerate().all(|(j, (own, neighbours))| {
                    let most = (square(i) * square(j)).sqrt() * (1.0 + ROUNDED);
                    own.abs() <= most && neighbours.abs() <= most
                })
            })
    }
}
