//! The sign between the fields of a line.

use thiserror::Error;

/// The sign between the fields of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Separator {
    /// `,`
    #[error("commas")]
    Comma,
    /// `;`
    #[error("semicolons")]
    Semicolon,
    /// A tabulator.
    #[error("tabs")]
    Tab,
    /// `|`
    #[error("vertical bars")]
    Bar,
}

impl Separator {
    /// All of them, the usual one first.
    pub(super) const ALL: [Self; 4] = [Self::Comma, Self::Semicolon, Self::Tab, Self::Bar];

    /// The sign itself.
    pub(super) const fn sign(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Bar => b'|',
        }
    }
}
