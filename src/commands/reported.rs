//! Reports beside the output, and what an output says of how it was made.

use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use trunnion::data::{Guard, Stamp, WriteError, write_report};

/// A report, and whether files are replaced. The command has a group `written` of all options that name a file to write.
#[derive(Clone, Debug, Args)]
pub struct ReportArguments {
    /// Writes a report (one HTML file that needs nothing else, for the screen and for A4), in place of an earlier one.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Replaces files even if they are no earlier results.
    #[arg(long, requires = "written")]
    pub force: bool,
}

impl ReportArguments {
    /// Whether one is asked for.
    pub fn is_wanted(&self) -> bool {
        self.report.is_some()
    }

    /// What outputs have to leave alone.
    pub fn guard(&self, inputs: impl IntoIterator<Item = impl AsRef<Path>>) -> Guard {
        Guard { inputs: inputs.into_iter().map(|input| input.as_ref().to_owned()).collect(), force: self.force }
    }

    /// Whether it can be written, if it is asked for.
    pub fn admit(&self, guard: &Guard) -> Result<(), WriteError> {
        self.report.as_deref().map_or(Ok(()), |file| guard.admits(file))
    }

    /// Writes it, if it is asked for.
    pub fn write(&self, guard: &Guard, page: Option<String>) -> Result<(), WriteError> {
        self.report.iter().zip(page).try_for_each(|(file, page)| write_report(file, &page, guard))
    }

    /// What made an output, of which files; when, if it is a report: all else is the same for the same files.
    pub fn made(&self, files: &[Value]) -> Value {
        let own = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
        let command: Vec<String> = std::iter::once("trunnion".to_owned()).chain(own).collect();
        let now = || humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "command": command,
            "files": files,
            "at": self.is_wanted().then(now),
        })
    }
}

/// A file that was read.
pub fn read(role: &str, name: &str, stamp: Option<Stamp>) -> Value {
    let (bytes, sha256) = stamp.map(|stamp| (stamp.bytes, stamp.sha256)).unzip();
    json!({ "role": role, "name": name, "bytes": bytes, "sha256": sha256 })
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=./:,+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}
