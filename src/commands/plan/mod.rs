//! `trunnion plan`: what intended runs would tell, before anything is measured.

mod designed;
mod positions;
mod text;

use self::designed::Wanted;
use self::positions::PositionArguments;
use super::Refused;
use super::model::{described, lengths, others, setup, source};
use super::number;
use super::output::print;
use super::predicted::{self, Measuring};
use super::stated::{InstrumentArguments, LimitArguments, RangeArguments};
use clap::{ArgGroup, Args};
use trunnion::data::Radius;
use trunnion::document;
use trunnion::study::plan::{Comparison, Overview, RADII, RANGES_DEG};
use trunnion::study::write_ranges;
use trunnion_codegen::model::Model;

/// Arguments of `plan`.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("wanted").args(["functions", "positions"]).multiple(true)))]
pub struct PlanArguments {
    /// A name from the catalogue, a model file, or a project; without it the project of this folder, trunnion.toml.
    model: Option<String>,
    /// Nominal lengths of the ball-bar to compare, mm, joined by commas or one at a time; 100, 150 and 300 if none is given.
    #[arg(long, value_name = "MM", value_delimiter = ',', allow_negative_numbers = true)]
    radius: Vec<f64>,
    /// Another length of the set-up, mm.
    #[arg(long = "set", value_name = "NAME=MM")]
    lengths: Vec<String>,
    /// Ranges of the sweeps to compare, degrees, joined by commas or one at a time; the full turn, -20:200 and -90:90 if none
    /// is given. Runs go as far as the ranges of their axes let them.
    #[arg(long, value_name = "A:B", value_delimiter = ',', value_parser = predicted::range, allow_hyphen_values = true)]
    range_deg: Vec<(f64, f64)>,
    /// A run to leave out, several joined by commas to leave them out together; each run in turn if none is given.
    #[arg(long, value_name = "RUN")]
    without: Vec<String>,
    /// Instead, search runs for these estimated functions, joined by commas: the fewest placings of the balls, then the fewest
    /// runs, among the model's own and those that its machine allows.
    #[arg(long = "for", value_name = "FUNCTION", value_delimiter = ',', conflicts_with_all = ["range_deg", "without"])]
    functions: Vec<String>,
    /// With --for: how large the expanded uncertainty of 95 % from all sources may be, µrad or µm, one for all or one for each; a
    /// tenth more than the least without it. With --positions fewest: the same, from noise.
    #[arg(long, value_name = "U", value_delimiter = ',', requires = "wanted", value_parser = number::goal, allow_negative_numbers = true)]
    within: Vec<f64>,
    #[command(flatten)]
    positions: PositionArguments,
    #[command(flatten)]
    limits: LimitArguments,
    #[command(flatten)]
    ranges: RangeArguments,
    #[command(flatten)]
    instrument: InstrumentArguments,
    #[command(flatten)]
    measuring: Measuring,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl PlanArguments {
    /// Compares, prints.
    pub fn run(self) -> Result<(), Refused> {
        let source = source(self.model.as_deref())?;
        let mut model = described(&source)?;
        self.ranges.apply(&mut model)?;
        if let Some(count) = self.positions.count {
            let setup = setup(model, self.one_radius()?, &self.lengths)?;
            let asked =
                positions::Asking { functions: &self.functions, within: &self.within, measuring: &self.measuring };
            return self.positions.run(count, &setup, &asked, &source.inputs(), self.json);
        }
        // The model has just been read, so its draft can be.
        let mut draft = source.described.draft().unwrap_or_default();
        write_ranges(&model, &mut draft);
        if !self.functions.is_empty() {
            return self.wanted(&model)?.run(&draft, &model);
        }
        let comparison = self.comparison(&model)?;
        let lengths = lengths(&model, self.first_radius()?, &self.lengths)?;
        let measured = comparison.first(lengths, self.limits.of(&model));
        let found = Overview::new(&draft, &model, &comparison, &measured)?;
        let noise_um = self.measuring.noise_um;
        Ok(print(&match self.json {
            true => format!("{:#}\n", document::overview(&found, noise_um)),
            false => text::text(&found, noise_um, !self.without.is_empty()),
        })?)
    }

    /// The bar, where no two are compared.
    fn one_radius(&self) -> Result<Option<Radius>, Refused> {
        match self.radius.get(1) {
            None => self.first_radius(),
            Some(second) => Err(Refused::Option(
                "radius",
                second.to_string(),
                "of no use with --for and --positions\n  expected one length of the bar",
            )),
        }
    }

    fn first_radius(&self) -> Result<Option<Radius>, Refused> {
        Ok(self.radius.first().map(|&mm| Radius::new(mm)).transpose()?)
    }

    /// What runs are searched for.
    fn wanted(&self, model: &Model) -> Result<Wanted<'_>, Refused> {
        Ok(Wanted {
            functions: &self.functions,
            within: &self.within,
            radius: self.one_radius()?,
            lengths: &self.lengths,
            limits: self.limits.of(model),
            instrument: self.instrument.instrument(model)?,
            measuring: &self.measuring,
            json: self.json,
        })
    }

    /// What is asked for.
    fn comparison(&self, model: &Model) -> Result<Comparison, Refused> {
        let given =
            |given: &[f64]| given.iter().map(|&mm| Ok(Radius::new(mm)?.mm())).collect::<Result<Vec<_>, Refused>>();
        Ok(Comparison {
            radii: if self.radius.is_empty() { RADII.to_vec() } else { given(&self.radius)? },
            lengths: others(model, &self.lengths)?,
            ranges_deg: if self.range_deg.is_empty() { RANGES_DEG.to_vec() } else { self.range_deg.clone() },
            without: self.without(model)?,
            samples: self.measuring.samples as usize,
            sigma: self.measuring.sigma(),
            estimator: self.measuring.estimator.into(),
        })
    }

    /// All runs, and then those left out: each in turn if none is named.
    fn without(&self, model: &Model) -> Result<Vec<Vec<String>>, Refused> {
        let names: Vec<&str> = model.runs.iter().map(|r| r.name.as_str()).collect();
        let one = |name: &str| match names.contains(&name.trim()) {
            true => Ok(name.trim().to_owned()),
            false => Err(Refused::UnknownRun(name.to_owned(), names.join(", "))),
        };
        if self.without.is_empty() {
            return Ok(Comparison::each_run(model));
        }
        let together = self.without.iter().map(|together| together.split(',').map(one).collect());
        std::iter::once(Ok(Vec::new())).chain(together).collect()
    }
}
