//! What is known of each format, and from where.

use super::format::{AllFormat, Format, OneFormat};

/// What a control makes of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Facts {
    /// What is written.
    pub what: &'static str,
    /// Units of values, and of coordinates where they differ.
    pub unit: &'static str,
    /// What a value is, the error being actual − commanded.
    pub sign: &'static str,
    /// Between rows.
    pub between: Between,
    /// Beyond the first and the last row.
    pub ends: Ends,
    /// Over a turn.
    pub turn: &'static str,
    /// Rows, at most, where there is a limit.
    pub rows: Option<usize>,
    /// Whether there is a place for the other direction.
    pub both: bool,
    /// The finest step of a value.
    pub resolution: Resolution,
    /// What has to be set beside, if anything.
    pub needs: &'static str,
    /// What of this was tried on a control.
    pub verified: Verified,
    /// Where this is from.
    pub source: &'static str,
}

/// How a control goes from one row to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// Straight.
    Straight,
    /// From one row's value to the next somewhere between them.
    Somewhere,
}

/// What a control does beyond the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// It takes the value of the row at the end.
    Held,
    /// As held, but for a table that is a whole turn, from 0 to 360°, which begins again.
    HeldOrRepeated,
    /// It is not documented, but for a table that is a whole turn, which begins again.
    UnknownOrRepeated,
    /// It is not documented.
    Unknown,
    /// No control reads it.
    NoControl,
}

/// The finest step of a value, and whose it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Resolution {
    /// The control's.
    Control(&'static str),
    /// The file's: the control's is not known.
    File(&'static str),
    /// The file's, which no control reads.
    NoControl(&'static str),
}

/// What was tried on a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verified {
    /// A table of this form was loaded, and the axis' error went.
    Tried,
    /// Written from documents.
    Documented,
    /// No control reads it.
    NoControl,
}

impl Between {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Straight => "straight",
            Self::Somewhere => "not documented where: the error is that of the worst place",
        }
    }
}

impl Ends {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Held => "the value of the row at the end",
            Self::HeldOrRepeated => "the value of the row at the end; a whole turn begins again",
            Self::UnknownOrRepeated => "not documented; a whole turn begins again",
            Self::Unknown => "not documented",
            Self::NoControl => "none",
        }
    }

    /// Whether a table that is a whole turn is one of every turn.
    pub fn repeats(self) -> bool {
        matches!(self, Self::HeldOrRepeated | Self::UnknownOrRepeated)
    }
}

impl Resolution {
    /// In words.
    pub fn words(self) -> String {
        match self {
            Self::Control(step) => format!("{step}: the control's"),
            Self::File(digit) => format!("{digit}, the file's last digit; the control's own is not known"),
            Self::NoControl(digit) => format!("{digit}, the file's last digit"),
        }
    }

    /// Whose it is, `control` or `file`.
    pub fn of(self) -> &'static str {
        if matches!(self, Self::Control(_)) { "control" } else { "file" }
    }
}

impl Verified {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Tried => "a table of this form was tried on the control",
            Self::Documented => "NOT VERIFIED ON A CONTROL: try it on one row that is easily seen, and measure again",
            Self::NoControl => "for programs, not for a control",
        }
    }
}

/// A table of SINUMERIK's encoder compensation.
const ENC_COMP: Facts = Facts {
    what: "encoder error compensation, $AA_ENC_COMP",
    unit: "degrees or mm",
    sign: "value = error, measured - commanded: a positive value moves the axis in the negative direction",
    between: Between::Straight,
    ends: Ends::HeldOrRepeated,
    turn: "IS_MODULO = 1 where the table is a whole turn, else 0",
    rows: None,
    both: false,
    resolution: Resolution::File("1e-9 of the unit"),
    needs: "MD38000 at least the number of rows; MD32700 = 1 switches it on; the axis referenced",
    verified: Verified::Documented,
    source: "Siemens, Extended Functions, K3",
};

/// Errors under their ISO 230-1 names.
const ISO: Facts = Facts {
    what: "errors under their ISO 230-1 names",
    unit: "mm or rad; coordinates in mm or degrees",
    sign: "value = error, as ISO 230-1 has it (the key `negate` not set)",
    between: Between::Straight,
    ends: Ends::Unknown,
    turn: "not documented",
    rows: None,
    both: false,
    resolution: Resolution::File("1e-12 mm or rad"),
    needs: "the tool's position is compensated, not its orientation",
    verified: Verified::Documented,
    source: "ISG and Beckhoff, volumetric compensation",
};

/// Values for programs.
const PLAIN: Facts = Facts {
    what: "values",
    unit: "µm or µrad; coordinates in mm or degrees",
    sign: "value = error",
    between: Between::Straight,
    ends: Ends::NoControl,
    turn: "as written",
    rows: None,
    both: true,
    resolution: Resolution::NoControl("1e-6 µm or µrad"),
    needs: "",
    verified: Verified::NoControl,
    source: "docs/export.md",
};

impl Format {
    /// What is known of it.
    pub fn facts(self) -> Facts {
        match self {
            Self::One(OneFormat::LinuxCnc) => Facts {
                what: "COMP_FILE, COMP_FILE_TYPE = 0: nominal, forward, reverse",
                unit: "degrees or mm",
                sign: "position = nominal + error: the control commands nominal − position more",
                between: Between::Straight,
                ends: Ends::Held,
                turn: "no modulo",
                rows: Some(256),
                both: true,
                resolution: Resolution::Control("single precision of nominal − position"),
                needs: "[JOINT_n] COMP_FILE and COMP_FILE_TYPE = 0; BACKLASH has no effect beside it",
                verified: Verified::Tried,
                source: "LinuxCNC 2.9, its source",
            },
            Self::One(OneFormat::Sinumerik840d) => ENC_COMP,
            Self::One(OneFormat::Sinumerik808d) => Facts {
                rows: Some(200),
                needs: "MD32700 = 1 switches it on; the axis referenced",
                source: "Siemens, 808D Function Manual",
                ..ENC_COMP
            },
            Self::One(OneFormat::Cec) => Facts {
                what: "sag and angularity compensation, $AN_CEC: one table, or one for each direction",
                sign: "value = error as one of the output axis' position, measured - commanded: the opposite where one carries the workpiece and the other the tool",
                both: true,
                needs: "MD18342 at least the number of rows; MD32710 = 1 and SD41300 switch it on",
                ..ENC_COMP
            },
            Self::One(OneFormat::Heidenhain) => Facts {
                what: "axis-error compensation, .COM: AXISPOS, BACKLASH (in the negative direction), the axis or C1 to C6",
                unit: "degrees or mm",
                sign: "value = error, positive where the axis goes too far: NOT VERIFIED",
                between: Between::Straight,
                ends: Ends::Unknown,
                turn: "not documented",
                rows: None,
                both: true,
                resolution: Resolution::File("1e-6 of the unit"),
                needs: "AXISPOS is against the machine datum; the .CMA file, or COMPTAB of the kinematics, names the file",
                verified: Verified::Documented,
                source: "Heidenhain, technical manuals iTNC 530 HSCI and MANUALplus 620",
            },
            Self::One(OneFormat::Fanuc) => Facts {
                what: "stored pitch error compensation: a list for a person to enter",
                unit: "detection units times parameter 3623",
                sign: "increments of −error from one point to the next, 0 at the reference position: NOT VERIFIED",
                between: Between::Somewhere,
                ends: Ends::UnknownOrRepeated,
                turn: "parameter 3625; the increments of a turn have the sum 0",
                rows: Some(128),
                both: true,
                resolution: Resolution::Control("the detection unit times parameter 3623"),
                needs: "parameters 3620 to 3625, as in the list; power off and on, reference return",
                verified: Verified::Documented,
                source: "Fanuc, B-63980EN p. 100, A-77810E; the number of rows from others",
            },
            Self::All(AllFormat::Volcomp) => Facts { what: "VOLCOMP, ISG CSV", ..ISO },
            Self::All(AllFormat::Etalon) => Facts { what: "Etalon exchange format", ..ISO },
            Self::One(OneFormat::Csv) => Facts { what: "CSV", ..PLAIN },
            Self::One(OneFormat::Json) => Facts { what: "JSON", ..PLAIN },
        }
    }
}
