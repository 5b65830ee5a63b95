//! From a fit to the tables that are asked for.

use super::Refused;
use super::measured::Measured;
use trunnion::data::{Recorded, Unit};
use trunnion::export::{Constant, Grid, Subject, Table};
use trunnion::study::{
    ByDirection, Covered, Curve, EstimatedCoefficient, Failing, Fit, NotByDirection, Observation, Report, Setup,
    by_direction,
};
use trunnion_codegen::identify::{Extent, Origin};
use trunnion_codegen::ids::{BaseId, FunctionId};

/// Steps of a table that is asked for without any, degrees.
const STEP_DEG: f64 = 5.0;
/// Steps of a linear axis' range then, at least.
const STEPS: f64 = 20.0;

/// What is asked for.
pub struct Asked<'a> {
    pub function: Option<&'a str>,
    /// Every function that is determined, where none is named.
    pub all: bool,
    pub axis: Option<&'a str>,
    pub range_deg: Option<(f64, f64)>,
    pub range_mm: Option<(f64, f64)>,
    pub step_deg: Option<f64>,
    pub step_mm: Option<f64>,
    /// Where the error is taken as zero, degrees or mm.
    pub zero: Option<f64>,
    /// Whether the format has a place for both directions.
    pub both: bool,
    /// Whether a whole turn of the format's tables is one of every turn, from 0°.
    pub modulo: bool,
    /// Whether the directions have to be told apart.
    pub demanded: bool,
}

/// A function that is not determined: its name, and how far it is.
pub type LeftOut = (String, String);

/// A location error that is identified.
pub struct Location {
    /// `Y0A` of EY0A.
    pub name: String,
    /// mm or rad, as `unit` says.
    pub value: f64,
    /// Its expanded uncertainty.
    pub u95: f64,
    pub unit: Unit,
}

impl Location {
    /// What is written of it.
    pub fn constant(&self) -> Constant {
        (self.name.clone(), self.value)
    }
}

/// What tells the directions of a function apart.
pub type Directions = Result<ByDirection, NotByDirection>;

/// A table, and what it is made of.
pub struct Tabled {
    pub function: FunctionId,
    pub table: Table,
    /// What tells the directions apart, or why nothing does.
    pub directions: Directions,
    /// What was taken off all its errors, mm or rad.
    pub offset: f64,
}

impl Tabled {
    /// The errors in either direction at a coordinate in degrees or mm, the mean of both where the table has one value; mm or rad.
    pub fn error(&self, setup: &Setup, fit: &Fit, at: f64) -> [f64; 2] {
        let x = self.table.subject.along.to_inner(at);
        error(setup, fit, self.function, &self.directions, self.table.both, x).map(|error| error - self.offset)
    }
}

fn error(setup: &Setup, fit: &Fit, function: FunctionId, directions: &Directions, both: bool, x: f64) -> [f64; 2] {
    let errors = match directions {
        Ok(own) => own.at(setup, fit, x),
        Err(_) => [fit.function(setup, function, x).0; 2],
    };
    if both { errors } else { [(errors[0] + errors[1]) / 2.0; 2] }
}

impl Asked<'_> {
    /// The functions that are asked for.
    pub fn functions(&self, setup: &Setup) -> Result<Vec<FunctionId>, Refused> {
        let all: Vec<FunctionId> = setup.estimated().collect();
        let names = || all.iter().map(|f| setup.function_name(*f)).collect::<Vec<_>>().join(", ");
        let is_location = |f: &FunctionId| setup.model.functions[*f].is_location();
        let functions = match self.function {
            // Location errors are constants of their own.
            None if self.all => all.iter().copied().filter(|f| !is_location(f)).collect(),
            None if all.len() == 1 => all,
            None => return Err(Refused::Which(names())),
            Some(wanted) => {
                let is = |function: &&FunctionId| {
                    let error = setup.model.functions[**function].error;
                    let iso = Subject::new(setup, **function, None).map(|subject| subject.iso);
                    setup.function_name(**function) == wanted
                        || setup.model.alphabet.error_name(error) == wanted
                        || iso.is_ok_and(|iso| iso == wanted)
                };
                let found = all.iter().find(is).copied();
                vec![found.ok_or_else(|| Refused::NotEstimated(wanted.to_owned(), names()))?]
            }
        };
        if let Some(location) = functions.iter().find(|f| is_location(f)) {
            return Err(Refused::IsLocation(setup.function_name(*location)));
        }
        let units = functions.iter().map(|f| Ok(Subject::new(setup, *f, None)?.along));
        self.effective(&units.collect::<Result<Vec<Unit>, Refused>>()?)?;
        Ok(functions)
    }

    /// Refuses options of the other kind of axis.
    fn effective(&self, units: &[Unit]) -> Result<(), Refused> {
        let given = [
            ("range-deg", Unit::Deg, self.range_deg.is_some()),
            ("step-deg", Unit::Deg, self.step_deg.is_some()),
            ("range-mm", Unit::Mm, self.range_mm.is_some()),
            ("step-mm", Unit::Mm, self.step_mm.is_some()),
        ];
        match given.into_iter().find(|(_, unit, given)| *given && !units.contains(unit)) {
            Some((option, Unit::Deg, _)) => Err(Refused::Idle(option, "a linear axis", "it is for rotary axes")),
            Some((option, ..)) => Err(Refused::Idle(option, "a rotary axis", "it is for linear axes")),
            None => Ok(()),
        }
    }

    /// A table of each function; of all those that are determined, and the names and words of the others.
    pub fn tables(
        &self,
        measured: &Measured,
        recorded: &[Recorded],
        (fit, observations): (&Fit, &[Observation]),
        functions: &[FunctionId],
    ) -> Result<(Vec<Tabled>, Vec<LeftOut>), Refused> {
        let (mut tables, mut left_out) = (Vec::new(), Vec::new());
        for &function in functions {
            match determined(&measured.setup, fit, function) {
                Err(Refused::NotDetermined { name, words, .. }) if self.all && self.function.is_none() => {
                    left_out.push((name, words));
                }
                refused @ Err(_) => refused?,
                Ok(()) => tables.push(self.table(measured, recorded, (fit, observations), function)?),
            }
        }
        match tables.is_empty() {
            // Of a model that estimates location errors alone these are what is written.
            true if self.all && estimates_locations(&measured.setup) => Ok((tables, left_out)),
            true => Err(Refused::NothingDetermined(
                left_out.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", "),
            )),
            false => Ok((tables, left_out)),
        }
    }

    fn table(
        &self,
        measured: &Measured,
        recorded: &[Recorded],
        (fit, observations): (&Fit, &[Observation]),
        function: FunctionId,
    ) -> Result<Tabled, Refused> {
        let setup = &measured.setup;
        let subject = Subject::new(setup, function, self.axis)?;
        let covered =
            Covered::of(setup, function, observations).ok_or_else(|| Refused::NeverMoves(subject.name.clone()))?;
        let unit = subject.along;
        let grid = self.grid(&covered, unit)?;
        if let Some(zero) = self.zero
            && !covered.has((unit.to_inner(zero), unit.to_inner(zero)))
        {
            return Err(not_measured("home", &zero.to_string(), &covered, unit));
        }
        let directions = self.directions(setup, recorded, fit, function)?;
        let both = self.both && directions.is_ok();
        let plain = |at: f64| error(setup, fit, function, &directions, both, unit.to_inner(at));
        let offset = self.zero.map_or(0.0, |zero| {
            let [forward, reverse] = plain(zero);
            (forward + reverse) / 2.0
        });
        let table = Table::new(subject, grid, both, |at| plain(at).map(|error| error - offset));
        Ok(Tabled { function, table, directions, offset })
    }

    /// The table's coordinates: those asked for, as far as they were measured.
    fn grid(&self, covered: &Covered, unit: Unit) -> Result<Grid, Refused> {
        let (low, high) = (unit.from_inner(covered.low), unit.from_inner(covered.high));
        let (range, step, option) = match unit {
            Unit::Deg => (self.range_deg, self.step_deg, "range-deg"),
            _ => (self.range_mm, self.step_mm, "range-mm"),
        };
        let step = step.unwrap_or_else(|| match unit {
            Unit::Deg => STEP_DEG,
            _ => round_down((high - low) / STEPS),
        });
        if let Some((from, to)) = range {
            return match covered.has((unit.to_inner(from), unit.to_inner(to))) {
                true => Ok(Grid::new(from, to, step)?),
                false => Err(not_measured(option, &format!("{from}:{to}"), covered, unit)),
            };
        }
        let gap = unit.from_inner(covered.step);
        if !covered.whole_turn {
            // The end of a range is often a step behind the last sample: a row there, but none beyond.
            let beyond = if gap < step { gap } else { 0.0 };
            return Ok(Grid::within((low - beyond, high + beyond), step)?);
        }
        // A turn that was measured on the other side of 0 is where the axis goes, unless all turns are one.
        let elsewhere = !self.modulo && low < -gap && high < 360.0 - gap;
        let from = if elsewhere { (low / step).round() * step } else { 0.0 };
        Ok(Grid::new(from, from + 360.0, step)?)
    }

    /// Tells the directions apart, where both were measured.
    fn directions(
        &self,
        setup: &Setup,
        recorded: &[Recorded],
        fit: &Fit,
        function: FunctionId,
    ) -> Result<Directions, Refused> {
        let directions = match by_direction(setup, recorded, fit, function) {
            Ok(own) => Ok(own),
            Err(Failing::Not(why)) => Err(why),
            Err(Failing::Recording(error)) => return Err(Measured::unreadable(error)),
        };
        match directions {
            _ if self.demanded && !self.both => Err(Refused::NotBoth("the format has one value for both".to_owned())),
            Err(why) if self.demanded => Err(Refused::NotBoth(why.to_string())),
            directions => Ok(directions),
        }
    }

    /// The location errors that are identified, by their ISO 230-1 names without the E.
    pub fn constants(&self, setup: &Setup, fit: &Fit, report: &Report) -> Vec<Location> {
        let alone = |(estimate, &base): (&EstimatedCoefficient, &BaseId)| {
            let (parameter, factor) = setup.derivation.base[base].definition.first()?;
            let Origin::Constant(error) = setup.derivation.parameters[*parameter].origin else { return None };
            let own = setup.number(factor);
            setup.derivation.is_alone(base).then(|| (error, estimate.value / own, estimate.u95 / own.abs()))
        };
        let of_its_own = |curve: &Curve| {
            let point =
                curve.points.first().filter(|_| curve.is_location && curve.told.extent == Extent::Determined)?;
            let error = setup.model.functions[curve.function].error;
            Some((error, curve.unit.to_inner(point.value), curve.unit.to_inner(point.u95)))
        };
        let constants = report.coefficients.iter().zip(&fit.base).filter_map(alone);
        let functions = report.functions.iter().filter_map(of_its_own);
        let named = |(error, value, u95)| {
            let name = setup.model.iso_location(error)?.trim_start_matches('E').to_owned();
            Some(Location { name, value, u95, unit: setup.model.alphabet.error_quantity(error).inner() })
        };
        constants.chain(functions).filter_map(named).collect()
    }
}

/// Whether the model estimates location errors.
pub fn estimates_locations(setup: &Setup) -> bool {
    setup.estimated().any(|f| setup.model.functions[f].is_location())
}

fn not_measured(option: &'static str, given: &str, covered: &Covered, unit: Unit) -> Refused {
    let [low, high] = [covered.low, covered.high].map(|end| unit.from_inner(end));
    Refused::NotMeasured {
        option,
        given: given.to_owned(),
        measured: format!("{low:.3} to {high:.3} {}", unit.symbol()),
    }
}

/// A function's value has to be its own.
fn determined(setup: &Setup, fit: &Fit, function: FunctionId) -> Result<(), Refused> {
    let told = fit.seen(function).map(|seen| seen.told(setup)).filter(|told| told.extent != Extent::Determined);
    let Some(told) = told else { return Ok(()) };
    let example = told.up_to.first().map_or(String::new(), |first| format!(", such as {} = \"0\"", first.parameter));
    Err(Refused::NotDetermined { name: setup.function_name(function), words: told.words, example })
}

/// The largest of 1, 2, 5, 10, … that is no larger.
fn round_down(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|step| *step <= x).unwrap_or(power)
}
