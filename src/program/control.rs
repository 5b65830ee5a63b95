//! What is peculiar to each control.

/// A control, as far as its programs go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// LinuxCNC.
    LinuxCnc,
    /// SINUMERIK 840D sl.
    Sinumerik,
    /// Heidenhain, conversational.
    Heidenhain,
    /// Fanuc.
    Fanuc,
}

impl Control {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::LinuxCnc, Self::Sinumerik, Self::Heidenhain, Self::Fanuc];

    /// Its name, as a part of a file's.
    pub fn name(self) -> &'static str {
        match self {
            Self::LinuxCnc => "linuxcnc",
            Self::Sinumerik => "sinumerik",
            Self::Heidenhain => "heidenhain",
            Self::Fanuc => "fanuc",
        }
    }

    /// How its programs' files end.
    pub fn ending(self) -> &'static str {
        match self {
            Self::LinuxCnc => "ngc",
            Self::Sinumerik => "mpf",
            Self::Heidenhain => "h",
            Self::Fanuc => "nc",
        }
    }

    /// What these programs were tried on.
    pub(super) fn verified(self) -> &'static str {
        match self {
            Self::LinuxCnc => "read by LinuxCNC's own interpreter, NOT RUN ON A MACHINE",
            _ => "UNVERIFIED, written from manuals: NOT RUN ON A CONTROL",
        }
    }

    /// Whether an axis can have this name.
    pub(super) fn takes(self, axis: &str) -> bool {
        match self {
            Self::Sinumerik => !axis.is_empty() && axis.chars().all(|c| c.is_ascii_alphanumeric()),
            _ => ["X", "Y", "Z", "A", "B", "C", "U", "V", "W"].contains(&axis),
        }
    }

    pub(super) fn counts_lines(self) -> bool {
        self == Self::Heidenhain
    }

    pub(super) fn comment(self, text: &str) -> String {
        match self {
            Self::LinuxCnc | Self::Sinumerik | Self::Heidenhain => format!("; {text}"),
            // Within brackets: no bracket of the text's own.
            Self::Fanuc => format!("({})", text.replace('(', "[").replace(')', "]").to_ascii_uppercase()),
        }
    }

    pub(super) fn begin(self, name: &str) -> Vec<String> {
        match self {
            Self::LinuxCnc | Self::Sinumerik => Vec::new(),
            Self::Heidenhain => vec![format!("BEGIN PGM {} MM", plain(name))],
            Self::Fanuc => vec!["%".to_owned(), "O0001".to_owned()],
        }
    }

    /// Millimetres, absolute, smooth from block to block.
    pub(super) fn prepare(self) -> &'static [&'static str] {
        match self {
            Self::LinuxCnc => &["G21 G90 G94 G17 G40 G49", "G64 P0.0005"],
            Self::Sinumerik => &["G710 G90 G94 G17 G40", "G64"],
            Self::Heidenhain => &[],
            Self::Fanuc => &["G21 G90 G94 G17 G40 G49", "G64"],
        }
    }

    /// Ends a program that goes no further.
    pub(super) fn end(self, name: &str) -> Vec<String> {
        let stop = match self {
            Self::LinuxCnc => Some("M2"),
            Self::Sinumerik | Self::Fanuc => Some("M30"),
            Self::Heidenhain => None,
        };
        stop.map(str::to_owned).into_iter().chain(self.close(name)).collect()
    }

    /// The last line of a file that has one.
    pub(super) fn close(self, name: &str) -> Option<String> {
        match self {
            Self::LinuxCnc | Self::Sinumerik => None,
            Self::Heidenhain => Some(format!("END PGM {} MM", plain(name))),
            Self::Fanuc => Some("%".to_owned()),
        }
    }

    /// Decimals of a coordinate, mm or degrees: as many as the control reads, and no more than there is any use for. Heidenhain's
    /// read four, Fanuc's with the least increment IS-C; with IS-B these have three.
    pub(super) fn decimals(self) -> usize {
        match self {
            Self::LinuxCnc | Self::Sinumerik => 5,
            Self::Heidenhain | Self::Fanuc => 4,
        }
    }

    /// What a control has to be set to for that.
    pub(super) fn needs(self) -> &'static str {
        if self == Self::Fanuc { ", which increment system IS-C takes" } else { "" }
    }

    /// A coordinate, mm or degrees.
    pub(super) fn word(self, axis: &str, x: f64) -> String {
        let digits = self.decimals();
        let scale = 10f64.powi(digits as i32);
        // No negative zero.
        let x = (x * scale).round() / scale + 0.0;
        match self {
            Self::LinuxCnc | Self::Fanuc => format!("{axis}{x:.digits$}"),
            Self::Sinumerik => format!("{axis}={x:.digits$}"),
            Self::Heidenhain => format!("{axis}{x:+.digits$}"),
        }
    }

    pub(super) fn rapid(self, words: &str) -> String {
        match self {
            Self::Heidenhain => format!("L {words} R0 FMAX"),
            _ => format!("G0 {words}"),
        }
    }

    pub(super) fn pause(self) -> &'static str {
        match self {
            Self::Heidenhain => "STOP",
            _ => "M0",
        }
    }

    pub(super) fn dwell(self, seconds: f64) -> Vec<String> {
        match self {
            Self::LinuxCnc => vec![format!("G4 P{seconds}")],
            Self::Sinumerik => vec![format!("G4 F{seconds}")],
            Self::Heidenhain => vec!["CYCL DEF 9.0 DWELL TIME".to_owned(), format!("CYCL DEF 9.1 DWELL {seconds}")],
            Self::Fanuc => vec![format!("G4 X{seconds:.1}")],
        }
    }

    /// Feeds are now one over the minutes that a block takes.
    pub(super) fn timed(self) -> &'static [&'static str] {
        if self == Self::Heidenhain { &[] } else { &["G93"] }
    }

    pub(super) fn untimed(self) -> &'static [&'static str] {
        if self == Self::Heidenhain { &[] } else { &["G94"] }
    }

    /// A straight block that takes some minutes, its way given in mm or degrees.
    pub(super) fn block(self, words: &str, minutes: f64, way: f64) -> String {
        match self {
            // No inverse time: the feed of the way (*).
            Self::Heidenhain => format!("L {words} R0 F{:.1}", way / minutes),
            _ => format!("G1 {words} F{:.4}", 1.0 / minutes),
        }
    }
}

/// A name of letters, digits and underscores.
fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' }).collect()
}
