//! What a shell and a reader of manuals want: completions, man pages.

use super::Refused;
use super::output::print;
use clap::{Args, Command};
use clap_complete::Shell;
use std::path::PathBuf;
use trunnion::data::{Files, Guard};

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArguments {
    /// The shell; what is printed goes where it looks for completions.
    #[arg(value_enum)]
    shell: Shell,
}

impl CompletionsArguments {
    /// Prints.
    pub fn run(self, mut program: Command) -> Result<(), Refused> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "trunnion", &mut script);
        Ok(print(&String::from_utf8_lossy(&script))?)
    }
}

/// Arguments of `man`.
#[derive(Debug, Args)]
pub struct ManArguments {
    /// Directory for the pages: one for the program, one for each command.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replaces files of their names.
    #[arg(long)]
    force: bool,
}

impl ManArguments {
    /// Writes.
    pub fn run(self, program: Command) -> Result<(), Refused> {
        let mut program = without_help(program);
        program.build();
        let mut files = Files::default();
        pages(&program, &mut files);
        Ok(files.write(&self.out, &Guard { inputs: Vec::new(), force: self.force })?)
    }
}

/// The page of a command and those of the commands below it.
fn pages(command: &Command, files: &mut Files) {
    let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
    let mut page = Vec::new();
    // A vector takes whatever is written to it.
    let _ = clap_mangen::Man::new(command.clone()).render(&mut page);
    files.add(format!("{name}.1"), page);
    command.get_subcommands().for_each(|command| pages(command, files));
}

/// The command `help` has no page, and pages must not name one.
fn without_help(command: Command) -> Command {
    command.disable_help_subcommand(true).mut_subcommands(without_help)
}
