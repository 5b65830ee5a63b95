//! A factor as bytes, to be kept or sent, and from them.
//!
//! All numbers are little-endian:
//!
//! | bytes | are |
//! |---|---|
//! | 8 | `TRNFACTR` |
//! | 2 | the version of this form, 3 |
//! | 32 | SHA-256 of the model's equations and lengths |
//! | 1 | the estimator: 0 joint, 1 two-step |
//! | 1 + n | how many runs, and which |
//! | 3 · (1 + n) | the columns of the first step, the second's own, those it is given |
//! | 4, each: 9 + squares, cells | how many [kept](super::kept): run, weight, and what they say of themselves |
//! | each step: 4 + 8 n | its samples, its numbers |
//! | 8 | the beginning of the SHA-256 of all before |

use super::Factor;
use super::kept::{read_all, write_all};
use super::reader::{BytesError, Reader, VERSION};
use crate::study::fit::Estimator;
use crate::study::problem::Problem;
use sha2::{Digest, Sha256};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::limits::RUNS;
use trunnion_solver::sized::{self, Columns, LARGEST, Stored};

const MAGIC: &[u8; 8] = b"TRNFACTR";
/// Displacements in all three directions are three runs.
const MOST_RUNS: usize = 3 * RUNS;

impl Factor {
    /// As bytes: the same factor gives the same.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        out.extend(MAGIC);
        out.extend(VERSION.to_le_bytes());
        out.extend(self.of);
        let Problem { estimator, runs, columns: Columns { first, own, given }, sum } = &self.problem;
        out.push(match estimator {
            Estimator::Joint => 0,
            Estimator::TwoStep => 1,
        });
        let mut list = |numbers: Vec<usize>| {
            // Neither runs nor columns are as many as a byte holds.
            out.extend([numbers.len()].into_iter().chain(numbers).map(|n| n.to_le_bytes()[0]));
        };
        list(runs.iter().map(|run| usize::from(*run)).collect());
        [first, own, given].into_iter().for_each(|columns| list(columns.clone()));
        write_all(&self.kept, &mut out);
        for Stored { samples, numbers } in sum.stored() {
            out.extend(samples.to_le_bytes());
            out.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
        }
        let check = check(&out);
        out.extend(check);
        out
    }

    /// From bytes.
    ///
    /// # Errors
    /// [`BytesError`]
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, BytesError> {
        let mut head = Reader(bytes);
        if head.take::<8>() != Ok(*MAGIC) {
            return Err(BytesError::NoFactor);
        }
        let version = u16::from_le_bytes(head.take()?);
        if version != VERSION {
            return Err(BytesError::Version(version));
        }
        let (whole, own) = bytes.split_last_chunk::<8>().ok_or(BytesError::Damaged)?;
        if check(whole) != *own {
            return Err(BytesError::Damaged);
        }
        let mut rest = Reader(whole.get(10..).ok_or(BytesError::Damaged)?);
        let of = rest.take()?;
        let estimator = match rest.take()? {
            [0] => Estimator::Joint,
            [1] => Estimator::TwoStep,
            _ => return Err(BytesError::Damaged),
        };
        let runs: Vec<RunId> = rest.list(MOST_RUNS)?.into_iter().map(RunId::from).collect();
        let [first, own, given] = [rest.list(LARGEST)?, rest.list(LARGEST)?, rest.list(LARGEST)?];
        let columns = Columns { first, own, given };
        let kept = read_all(&mut rest)?;
        let mut all = [columns.first.as_slice(), &columns.own].concat();
        all.sort_unstable();
        let apart = all.iter().enumerate().all(|(at, column)| at == *column);
        let of_first = columns.given.iter().all(|column| columns.first.contains(column));
        if !apart || !of_first || columns.given.len() + columns.own.len() > all.len() {
            return Err(BytesError::Damaged);
        }
        let mut sum = sized::estimator(&columns).ok_or(BytesError::Damaged)?;
        let widths: Vec<usize> = sum.stored().iter().map(|step| step.numbers.len()).collect();
        let step = |numbers| Ok(Stored { samples: rest.count()?, numbers: rest.numbers(numbers)? });
        let steps = widths.into_iter().map(step).collect::<Result<Vec<_>, BytesError>>()?;
        let taken: u64 = steps.iter().map(|step| u64::from(step.samples)).sum();
        if !rest.0.is_empty() || taken != kept.iter().map(|kept| kept.cells.samples()).sum::<u64>() {
            return Err(BytesError::Damaged);
        }
        sum.absorb(&steps).map_err(BytesError::Impossible)?;
        Ok(Self { of, problem: Problem { estimator, runs, columns, sum }, kept })
    }
}

fn check(bytes: &[u8]) -> [u8; 8] {
    let digest: [u8; 32] = Sha256::digest(bytes).into();
    std::array::from_fn(|at| digest[at])
}
