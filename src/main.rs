//! The command line: reads arguments and files, calls the library, prints. It does no mathematics.

mod commands;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use commands::output::{output, say};
use commands::seen;
use std::io::{StdoutLock, Write};
use std::process::ExitCode;
use trunnion::data::discard_staged;

const CODES: &str = "\
Exit codes:
    0  done
    2  refused: what was wrong is said on standard error, with file and line; nothing is half written
  130  interrupted

Colours are left out where NO_COLOR is set or nobody looks.";

/// Derives, fits and embeds the measurement models of multi-axis machine tools.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// The paper in one command: derive, simulate, fit, and what was recovered against the truth.
    Demo(commands::demo::DemoArguments),
    /// The catalogue: which machine is mine.
    Models(commands::models::ModelsArguments),
    /// A folder to measure with: project file, measuring plan, NC programs.
    New(commands::new::NewArguments),
    /// Equations, base parameters and source code of a model.
    Derive(commands::derive::DeriveArguments),
    /// Measurement files of a drawn machine, from exact lengths.
    Simulate(commands::simulate::SimulateArguments),
    /// Files of instruments and of other programs, made files for `fit`.
    Import(commands::import::ImportArguments),
    /// Errors and their uncertainty from measurement files.
    Fit(commands::fit::FitArguments),
    /// A compensation table for a control from an estimated function.
    Export(commands::export::ExportArguments),
    /// Where the rotary axes are, for a control's kinematics: from location errors that were estimated
    Pivots(commands::pivots::PivotArguments),
    /// The circular test of ISO 230-4: its figures, what is read from the trace, and the polar plot.
    Circular(commands::circular::CircularArguments),
    /// What has changed between reports, beyond their uncertainty.
    Compare(commands::compare::CompareArguments),
    /// What intended runs would tell: ranges, radii and subsets of runs compared, and which added run tells more.
    Plan(commands::plan::PlanArguments),
    /// Distribution of the largest error of an estimated function over many drawn machines.
    MonteCarlo(commands::monte_carlo::MonteCarloArguments),
    /// The parallel machine: kinematics, dependent rotation, probe offset, ring test.
    #[command(subcommand)]
    Exechon(commands::exechon::Exechon),
    /// Completions for a shell.
    Completions(commands::shell::CompletionsArguments),
    /// Manual pages.
    Man(commands::shell::ManArguments),
}

fn main() -> ExitCode {
    // Whoever interrupts finds nothing half written.
    let interrupted = || {
        discard_staged();
        std::process::exit(130);
    };
    // Whoever has it ignore hang-ups wants it to go on; then an interrupt leaves what the next run clears.
    let _ = ctrlc::try_set_handler(interrupted);
    let parsed = program().try_get_matches().and_then(|matches| Arguments::from_arg_matches(&matches));
    let arguments = match parsed {
        Ok(arguments) => arguments,
        Err(told) => return shown(&told),
    };
    let done = match arguments.command {
        Command::Demo(c) => c.run(),
        Command::Models(c) => c.run(),
        Command::New(c) => c.run(),
        Command::Derive(c) => c.run(),
        Command::Simulate(c) => c.run(),
        Command::Import(c) => c.run(),
        Command::Fit(c) => c.run(),
        Command::Export(c) => c.run(),
        Command::Pivots(c) => c.run(),
        Command::Circular(c) => c.run(),
        Command::Compare(c) => c.run(),
        Command::Plan(c) => c.run(),
        Command::MonteCarlo(c) => c.run(),
        Command::Exechon(c) => c.run(),
        Command::Completions(c) => c.run(program()),
        Command::Man(c) => c.run(program()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(refused) => {
            say(format_args!("error: {}", refused.message()));
            ExitCode::from(2)
        }
    }
}

/// The program; each command says its exit codes.
fn program() -> clap::Command {
    fn told(command: clap::Command) -> clap::Command {
        command.after_help(CODES).mut_subcommands(told)
    }
    told(Arguments::command())
}

/// Help, the version, or what is wrong with the arguments.
fn shown(told: &clap::Error) -> ExitCode {
    // In colours, if nothing that is quoted could pass for one or fill the terminal.
    if told.use_stderr() && std::env::args_os().any(|given| given.to_str().is_none_or(|given| seen(given) != given)) {
        say(format_args!("{}", seen(&told.to_string())));
        return ExitCode::from(2);
    }
    let code = ExitCode::from(u8::try_from(told.exit_code()).unwrap_or(2));
    if told.use_stderr() {
        let _ = told.print();
        return code;
    }
    let print = |mut out: StdoutLock<'_>| {
        told.print()?;
        Ok(out.flush()?)
    };
    match output().and_then(print) {
        Err(e) => {
            say(format_args!("error: {e}"));
            ExitCode::from(2)
        }
        Ok(()) => code,
    }
}
