//! Bytes on their way into a factor.

use thiserror::Error;
use trunnion_solver::sized::NotTaken;

/// The version of the form of a factor's bytes.
pub const VERSION: u16 = 3;

/// Why bytes are no factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum BytesError {
    /// Something else altogether.
    #[error("these bytes are no factor\n  expected what a factor was written to")]
    NoFactor,
    /// Of another version of this form.
    #[error(
        "these bytes are a factor of version {0}\n  expected version {VERSION}: write them again with this Trunnion"
    )]
    Version(u16),
    /// Cut short, longer than they say, or changed.
    #[error("these bytes are a damaged factor\n  expected what a factor was written to, whole")]
    Damaged,
    /// Whole, but not of any samples.
    #[error("these bytes are a factor that no samples come to: {0}\n  expected what a factor was written to")]
    Impossible(NotTaken),
}

/// What is still to be read.
pub struct Reader<'a>(pub &'a [u8]);

impl Reader<'_> {
    pub fn take<const N: usize>(&mut self) -> Result<[u8; N], BytesError> {
        let (taken, rest) = self.0.split_first_chunk::<N>().ok_or(BytesError::Damaged)?;
        self.0 = rest;
        Ok(*taken)
    }

    pub fn byte(&mut self) -> Result<usize, BytesError> {
        self.take().map(|[byte]| usize::from(byte))
    }

    pub fn count(&mut self) -> Result<u32, BytesError> {
        self.take().map(u32::from_le_bytes)
    }

    pub fn number(&mut self) -> Result<f64, BytesError> {
        self.take().map(f64::from_le_bytes)
    }

    pub fn numbers(&mut self, count: usize) -> Result<Vec<f64>, BytesError> {
        (0..count).map(|_| self.number()).collect()
    }

    /// A list of at most so many bytes.
    pub fn list(&mut self, most: usize) -> Result<Vec<usize>, BytesError> {
        let len = self.byte()?;
        if len > most {
            return Err(BytesError::Damaged);
        }
        (0..len).map(|_| self.byte()).collect()
    }
}
