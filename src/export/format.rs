//! The formats: which they are, and what a control makes of each.

/// A table of one function for a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// LinuxCNC's `COMP_FILE` of type 0.
    LinuxCnc,
}

/// How a control goes from one row to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// Straight.
    Straight,
}

/// What a control makes of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Facts {
    /// What is written.
    pub what: &'static str,
    /// Units of coordinates and values.
    pub unit: &'static str,
    /// What a value is, the error being actual − commanded.
    pub sign: &'static str,
    /// Between rows.
    pub between: Between,
    /// Beyond the first and the last row.
    pub ends: &'static str,
    /// Over a turn.
    pub turn: &'static str,
    /// Rows, at most, where there is a limit.
    pub rows: Option<usize>,
    /// Whether a table has a column, or a second table, for the other direction.
    pub both: bool,
    /// The finest that the control takes of a value.
    pub resolution: &'static str,
    /// What of this was tried on a control.
    pub verified: Verified,
    /// Where this is from.
    pub source: &'static str,
}

/// What was tried on a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verified {
    /// A table was loaded and the axis' error went.
    Tried,
    /// Written from documents.
    Documented,
}

impl Verified {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Tried => "tried on the control",
            Self::Documented => "NOT VERIFIED ON A CONTROL",
        }
    }
}

impl Between {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Straight => "straight",
        }
    }
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::LinuxCnc];

    /// Its name as an option has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::LinuxCnc => "linuxcnc",
        }
    }

    /// What is known of it.
    pub fn facts(self) -> Facts {
        match self {
            Self::LinuxCnc => Facts {
                what: "COMP_FILE, COMP_FILE_TYPE = 0: nominal, forward, reverse",
                unit: "degrees or mm",
                sign: "position = nominal + error; the control subtracts the error from what it commands",
                between: Between::Straight,
                ends: "the value at the end",
                turn: "no modulo",
                rows: Some(256),
                both: true,
                resolution: "float32 of nominal − position",
                verified: Verified::Tried,
                source: "LinuxCNC 2.9, its source",
            },
        }
    }
}
