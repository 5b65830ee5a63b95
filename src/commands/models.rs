//! `trunnion models`: the catalogue, a line for each machine.

use super::Refused;
use super::output::print;
use clap::Args;
use serde_json::json;
use std::fmt::Write;
use trunnion_codegen::catalogue;
use trunnion_codegen::model::{Axis, Model};
use trunnion_codegen::problems::{Colour, read_and_derive, render};

/// Arguments of `models`.
#[derive(Debug, Args)]
pub struct ModelsArguments {
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl ModelsArguments {
    /// Reads the catalogue, prints.
    pub fn run(self) -> Result<(), Refused> {
        let read = |(name, source): &(&str, &str)| {
            let read = read_and_derive(source);
            Ok(read.map_err(|problems| Refused::Model(render(name, source, &problems, Colour::Off)))?.0)
        };
        let models = catalogue::MODELS.iter().map(read).collect::<Result<Vec<Model>, Refused>>()?;
        Ok(print(&if self.json { object(&models) } else { text(&models) })?)
    }
}

fn names(axes: &[Axis]) -> String {
    axes.iter().map(|axis| axis.name.as_str()).collect::<Vec<_>>().join(" ")
}

fn estimated(model: &Model) -> Vec<&str> {
    let own = model.functions.iter().filter(|f| f.estimate);
    own.map(|f| model.alphabet.error_name(f.error)).collect()
}

fn text(models: &[Model]) -> String {
    let mut out = format!("{:21} {:8} {:10} {:4} {:28} machine\n", "model", "table", "tool", "runs", "finds");
    for model in models {
        let _ = writeln!(
            out,
            "{:21} {:8} {:10} {:4} {:28} {}",
            model.name,
            names(&model.workpiece),
            names(&model.tool),
            model.runs.len(),
            estimated(model).join(" "),
            model.title
        );
    }
    out += "\nAxes stand from the machine's base outwards. Which is yours: the axes that carry the table, then those that carry the\n\
            tool. `trunnion plan MODEL --for FUNCTION` searches runs for another bar or other travels.\n";
    out
}

fn object(models: &[Model]) -> String {
    let one = |model: &Model| {
        let axes = |axes: &[Axis]| axes.iter().map(|a| a.name.clone()).collect::<Vec<_>>();
        json!({
            "name": model.name,
            "title": model.title,
            "workpiece": axes(&model.workpiece),
            "tool": axes(&model.tool),
            "estimate": estimated(model),
            "runs": model.runs.iter().map(|run| run.name.clone()).collect::<Vec<_>>(),
        })
    };
    format!("{:#}\n", json!({ "models": models.iter().map(one).collect::<Vec<_>>() }))
}
