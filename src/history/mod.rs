//! What has changed between reports of one machine, beyond their uncertainty.
//!
//! Two reports are taken as independent: U² = U₁² + U₂². What they have in common, as the bar's length, cancels in the
//! difference, so that U is rather too wide.

mod pictures;
mod read;

pub use pictures::{changes, over_time};
pub use read::{HistoryError, Measured, MeasuredPoint, Reported};

use statrs::distribution::{ContinuousCDF, Normal};

/// How a function of a later report differs from the first one's.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The function's name.
    pub function: String,
    /// Which report, counted from 0; that of the function is compared with it.
    pub report: usize,
    /// What can be said.
    pub outcome: Outcome,
}

/// What can be said of two functions.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// They are compared.
    Compared(Compared),
    /// They stand for other sums of errors, which the words tell: nothing follows from their difference.
    OtherSums([String; 2]),
    /// There is no coordinate that both have.
    Apart,
    /// The later report does not have it.
    Absent,
}

/// The difference of two functions.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// At each coordinate that both have: it, the difference, its expanded uncertainty of 95 %.
    pub points: Vec<[f64; 3]>,
    /// Points at which the difference is larger than its uncertainty.
    pub beyond: usize,
    /// The point with the largest difference.
    pub largest: [f64; 3],
    /// The point with the largest difference for its uncertainty.
    pub clearest: [f64; 3],
    /// How many times its uncertainty a difference may be, at as many points, with a probability of 95 % that none is larger: by
    /// Bonferroni, whatever the points have in common.
    pub allowed: f64,
}

impl Compared {
    /// Whether it is more than chance explains at any of its points.
    pub fn changed(&self) -> bool {
        self.share() > self.allowed
    }

    /// The largest of the differences over their uncertainties.
    pub fn share(&self) -> f64 {
        share(&self.clearest)
    }
}

/// A difference over its uncertainty; nothing differs where a function is zero by its conditions.
fn share([_, difference, u95]: &[f64; 3]) -> f64 {
    if *difference == 0.0 { 0.0 } else { difference.abs() / u95 }
}

/// Every function of the first report in each later one.
pub fn compare(reports: &[Reported]) -> Vec<Change> {
    let Some((first, later)) = reports.split_first() else { return Vec::new() };
    let each = |own: &Measured| {
        let of = |(at, other): (usize, &Reported)| {
            let theirs = other.functions.iter().find(|f| f.name == own.name && f.unit == own.unit);
            let outcome = theirs.map_or(Outcome::Absent, |theirs| outcome(own, theirs));
            Change { function: own.name.clone(), report: at + 1, outcome }
        };
        later.iter().enumerate().map(of).collect::<Vec<_>>()
    };
    first.functions.iter().flat_map(each).collect()
}

fn outcome(first: &Measured, later: &Measured) -> Outcome {
    if first.value_of != later.value_of || first.coordinate != later.coordinate {
        return Outcome::OtherSums([first, later].map(|f| f.value_of.clone().unwrap_or("nothing".to_owned())));
    }
    let at = |own: &MeasuredPoint| {
        let other = later.at(own.at)?;
        Some([own.at, other.value - own.value, own.u95.hypot(other.u95)])
    };
    let points: Vec<[f64; 3]> = first.points.iter().filter_map(at).collect();
    let most = |of: fn(&[f64; 3]) -> f64| points.iter().max_by(|a, b| of(a).total_cmp(&of(b))).copied();
    let (Some(largest), Some(clearest)) = (most(|point| point[1].abs()), most(share)) else { return Outcome::Apart };
    let beyond = points.iter().filter(|point| share(point) > 1.0).count();
    Outcome::Compared(Compared { beyond, largest, clearest, allowed: allowed(points.len()), points })
}

/// z(1 − 0.025/n) / z(0.975).
fn allowed(points: usize) -> f64 {
    let quantile = |tail: f64| Normal::standard().inverse_cdf(1.0 - tail);
    quantile(0.025 / points.max(1) as f64) / quantile(0.025)
}
