//! The formats: which there are, and what each is called.

use super::table::{Subject, TakenOff};

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A table of one function.
    One(OneFormat),
    /// All errors that are identified.
    All(AllFormat),
}

/// A table of one function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OneFormat {
    /// LinuxCNC's `COMP_FILE` of type 0.
    LinuxCnc,
    /// SINUMERIK 840D sl, `$AA_ENC_COMP`.
    Sinumerik840d,
    /// SINUMERIK 808D, `$AA_ENC_COMP`.
    Sinumerik808d,
    /// SINUMERIK 840D sl, `$AN_CEC`.
    Cec,
    /// Heidenhain, `.COM`.
    Heidenhain,
    /// Fanuc, a list to be entered.
    Fanuc,
    /// Comma-separated values.
    Csv,
    /// One JSON object.
    Json,
}

/// Errors under their ISO 230-1 names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AllFormat {
    /// ISG and Beckhoff, VOLCOMP, CSV.
    Volcomp,
    /// Etalon's exchange format.
    Etalon,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::One(OneFormat::LinuxCnc),
        Self::One(OneFormat::Sinumerik840d),
        Self::One(OneFormat::Sinumerik808d),
        Self::One(OneFormat::Cec),
        Self::One(OneFormat::Heidenhain),
        Self::One(OneFormat::Fanuc),
        Self::All(AllFormat::Volcomp),
        Self::All(AllFormat::Etalon),
        Self::One(OneFormat::Csv),
        Self::One(OneFormat::Json),
    ];

    /// −1 where its values are of an axis' position that, further along, does the opposite of the error; else 1.
    pub fn sense(self, subject: &Subject) -> f64 {
        match (self, &subject.taken_off) {
            (Self::All(_) | Self::One(OneFormat::Csv | OneFormat::Json), _) => 1.0,
            (Self::One(OneFormat::Heidenhain), TakenOff::Other(..)) | (_, TakenOff::None) => 1.0,
            (_, TakenOff::Own(sense) | TakenOff::Other(_, sense)) => *sense,
        }
    }

    /// Its name as an option has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::One(OneFormat::LinuxCnc) => "linuxcnc",
            Self::One(OneFormat::Sinumerik840d) => "sinumerik-840d",
            Self::One(OneFormat::Sinumerik808d) => "sinumerik-808d",
            Self::One(OneFormat::Cec) => "cec",
            Self::One(OneFormat::Heidenhain) => "heidenhain",
            Self::One(OneFormat::Fanuc) => "fanuc",
            Self::One(OneFormat::Csv) => "csv",
            Self::One(OneFormat::Json) => "json",
            Self::All(AllFormat::Volcomp) => "volcomp",
            Self::All(AllFormat::Etalon) => "etalon",
        }
    }
}
