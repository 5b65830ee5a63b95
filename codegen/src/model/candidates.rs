//! Runs that could measure a rotary axis: what the machine itself allows, before anything is asked of them.
//!
//! The axis turns through the sweep θ and carries a ball at p; all other rotary axes rest, the linear axes keep the other ball
//! at D(θ) from it. With u along p's part square to the axis d, and v = d × u, the turned directions are
//! u(θ) = u cos θ + v sin θ and v(θ) = v cos θ − u sin θ, and D is R·u(θ) (*radial*), R·v(θ) (*tangential*), R·d (*axial*), or
//! 0 where displacements are read. *Circular* is the circle of the linear axes about a ball on the resting axis (ISO 230-4).

use crate::algebra::vectors::{cross, dot, scaled, sum};
use crate::algebra::{
    AlgebraError, Alphabet, Monomial, NominalId, Poly, PolyVector, Rational, difference, nominal_value,
};
use crate::basis::Coordinate;
use crate::expression::write;
use crate::ids::AxisId;
use crate::source::Text;

use super::description::{Axis, AxisKind, Ball, Model, ReadingKind, Run};
use super::draft::{DraftBall, DraftReading, DraftRun};

/// Where the carried ball may be, as a multiple of the place that the model's own runs have it at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// There.
    Own,
    /// Twice as far from the axis.
    Far,
    /// On the other side.
    Opposite,
    /// As far above it, along the axis.
    Above,
    /// On the axis.
    Centred,
}

impl Place {
    fn suffix(self) -> &'static str {
        match self {
            Self::Own => "",
            Self::Far => "-far",
            Self::Opposite => "-opposite",
            Self::Above => "-above",
            Self::Centred => "-centred",
        }
    }
}

/// Which way the bar points.
#[derive(Clone, Copy)]
enum Pointing {
    Radial,
    Tangential,
    Axial,
}

/// The runs for rotary axes, none of them tried yet: a machine may lack the linear axes, or say nothing of errors that one would
/// see.
///
/// # Errors
/// [`AlgebraError`]
pub fn candidates(model: &Model, axes: &[AxisId]) -> Result<Vec<DraftRun>, AlgebraError> {
    let (mut runs, mut named) = (Vec::new(), 0);
    for &axis in axes {
        let Some(turning) = model.axis(axis).filter(|a| a.kind == AxisKind::Rotary) else { continue };
        let mut machine = Machine::new(model, axis, turning, named)?;
        machine.runs(&mut runs)?;
        named = machine.named;
    }
    Ok(runs)
}

/// What of a machine the runs of one axis need.
struct Machine<'a> {
    model: &'a Model,
    axis: AxisId,
    on_workpiece: bool,
    alphabet: Alphabet,
    sweep: String,
    /// The axis' direction, and two square to it: out to the carried ball, and ahead of it.
    d: PolyVector,
    u: PolyVector,
    v: PolyVector,
    /// The carried ball in the model's own runs, and how far from the axis it is.
    own: PolyVector,
    distance: Poly,
    bar: Option<NominalId>,
    /// Set-up errors of the carried ball at `own`, and of the other ball; none of a ball that the model takes as exact.
    setups: [Vec<Text>; 2],
    /// Set-ups that were named here.
    named: usize,
}

/// A ball that the axis carries.
struct Carried {
    at: PolyVector,
    setup: Vec<Text>,
}

impl<'a> Machine<'a> {
    fn new(model: &'a Model, axis: AxisId, turning: &Axis, named: usize) -> Result<Self, AlgebraError> {
        let mut alphabet = model.alphabet.clone();
        let on_workpiece = usize::from(axis) < model.workpiece.len();
        let moves = |run: &&Run| matches!(run.at.get(axis), Some(Coordinate::Rotary(angle)) if angle.sweep.is_some());
        let own_runs: Vec<&Run> = model.runs.iter().filter(moves).collect();
        let letter = turning.coordinate.clone();
        let sweep = own_runs.first().map_or(letter, |run| alphabet.sweep_name(run.sweep).to_owned());
        alphabet.sweep(&sweep)?;
        let bar = model.runs.iter().find_map(|run| match run.reading {
            ReadingKind::BarLength(id) => Some(id),
            ReadingKind::Displacement(_) => None,
        });
        let d = turning.direction.clone();
        let balls = |run: &'a Run| {
            let both = [&run.workpiece_ball, &run.tool_ball];
            if on_workpiece { both } else { [both[1], both[0]] }
        };
        let mut found = None;
        for [carried, other] in own_runs.into_iter().map(balls) {
            let Some((u, distance)) = outwards(&carried.at, &d, &alphabet)? else { continue };
            // The nearest one, on the positive side if there is one on either.
            let size = distance.evaluate(|id| nominal_value(id, &alphabet, 0.0, &|_| 1.0), |_| 0.0);
            let negative = u.iter().find_map(|p| p.terms().first()).is_some_and(|(_, factor)| factor.is_negative());
            let near = found.as_ref().is_none_or(|(before, ..): &((f64, bool), _, _, _, _)| (size, negative) < *before);
            if near {
                let setups = [carried, other].map(|ball| setup(ball, &alphabet));
                found = Some(((size, negative), carried.at.clone(), u, distance, setups));
            }
        }
        let other = model.runs.first().map(|run| setup(balls(run)[1], &alphabet)).unwrap_or_default();
        let beside = found.is_none();
        let (own, u, distance, setups) = match found {
            Some((_, own, u, distance, setups)) => (own, u, distance, setups),
            None => {
                let (own, u, distance) = somewhere(&alphabet, bar, &d)?;
                (own, u, distance, [Vec::new(), other])
            }
        };
        let v = cross(&d, &u, &alphabet)?;
        let mut machine =
            Self { model, axis, on_workpiece, alphabet, sweep, d, u, v, own, distance, bar, setups, named };
        if beside {
            machine.setups[0] = machine.new_setup();
        }
        Ok(machine)
    }

    fn runs(&mut self, runs: &mut Vec<DraftRun>) -> Result<(), AlgebraError> {
        // A head carries the tool: the ball is where the tool ends.
        let places: &[Place] = match self.on_workpiece {
            true => &[Place::Own, Place::Far, Place::Opposite, Place::Above, Place::Centred],
            false => &[Place::Own, Place::Far],
        };
        for &place in places {
            let carried = self.carried(place)?;
            if self.bar.is_some() {
                for pointing in [Pointing::Radial, Pointing::Tangential, Pointing::Axial] {
                    runs.extend(self.bar_run(place, pointing, &carried)?);
                }
            } else {
                runs.extend(self.displacement_run(place, &carried)?);
            }
        }
        runs.extend(self.circular()?);
        Ok(())
    }

    /// The carried ball at a place; away from the model's own it is set up anew.
    fn carried(&mut self, place: Place) -> Result<Carried, AlgebraError> {
        let out = scaled(&self.distance, &self.u, &self.alphabet)?;
        let times = |n: i128, vector: &PolyVector| scaled(&Poly::integer(n), vector, &self.alphabet);
        let at = match place {
            Place::Own => return Ok(Carried { at: self.own.clone(), setup: self.setups[0].clone() }),
            // A head has a longer tool.
            Place::Far if !self.on_workpiece => times(2, &self.own)?,
            Place::Far => sum(&self.own, &out)?,
            Place::Opposite => sum(&self.own, &times(-2, &out)?)?,
            Place::Above => sum(&self.own, &scaled(&self.distance, &self.d, &self.alphabet)?)?,
            Place::Centred => sum(&self.own, &times(-1, &out)?)?,
        };
        let setup = if self.setups[0].is_empty() { Vec::new() } else { self.new_setup() };
        Ok(Carried { at, setup })
    }

    /// Names of three set-up errors of a carried ball that the model does not have.
    fn new_setup(&mut self) -> Vec<Text> {
        let ball = if self.on_workpiece { 'w' } else { 't' };
        let name = |n: usize| ['x', 'y', 'z'].map(|c| format!("{ball}_{c}{n}"));
        let free = |names: &[String; 3]| names.iter().all(|name| self.alphabet.find_error(name).is_none());
        let fresh = (1..).map(name).filter(free).nth(self.named);
        self.named += 1;
        fresh.into_iter().flatten().map(Text::from).collect()
    }

    fn bar_run(&self, place: Place, pointing: Pointing, carried: &Carried) -> Result<Option<DraftRun>, AlgebraError> {
        let Some(bar) = self.bar.map(Poly::nominal) else { return Ok(None) };
        let turned = |vector: &PolyVector, sign: i128| {
            let length = bar.scaled(&Rational::from(sign))?;
            self.turned(&scaled(&length, vector, &self.alphabet)?)
        };
        let (name, apart, along) = match pointing {
            // In line with a head's tool the other ball is beyond the one it carries.
            Pointing::Radial => ("radial", turned(&self.u, if self.on_workpiece { 1 } else { -1 })?, None),
            Pointing::Tangential => ("tangential", turned(&self.v, 1)?, None),
            // The other ball is held beside, so that no axis has to move there.
            Pointing::Axial => {
                let length = if self.on_workpiece { bar } else { bar.negated() };
                ("axial", PolyVector::default(), Some(scaled(&length, &self.d, &self.alphabet)?))
            }
        };
        let name = format!("{}-{name}{}", self.sweep, place.suffix());
        let reading = DraftReading::Bar(self.bar.map_or_else(String::new, |id| self.alphabet.nominal_name(id)).into());
        self.run(name, carried, &along.unwrap_or_default(), &apart, true, reading)
    }

    fn displacement_run(&self, place: Place, carried: &Carried) -> Result<Option<DraftRun>, AlgebraError> {
        let (name, zero) = (format!("{}-displacement{}", self.sweep, place.suffix()), PolyVector::default());
        self.run(name, carried, &zero, &zero, true, DraftReading::Displacement(vec!["xyz".into()]))
    }

    /// The linear axes alone, about a ball on the axis.
    fn circular(&mut self) -> Result<Option<DraftRun>, AlgebraError> {
        let Some(bar) = self.bar else { return Ok(None) };
        let apart = self.turned(&scaled(&Poly::nominal(bar), &self.u, &self.alphabet)?)?;
        let carried = if self.on_workpiece { self.carried(Place::Centred)? } else { self.carried(Place::Own)? };
        let reading = DraftReading::Bar(self.alphabet.nominal_name(bar).into());
        self.run(format!("{}-circular", self.sweep), &carried, &PolyVector::default(), &apart, false, reading)
    }

    /// The run with its carried ball and the other one, which is held at `other` and is `apart` from it otherwise; `None`
    /// where the linear axes do not reach.
    fn run(
        &self,
        name: String,
        carried: &Carried,
        other: &PolyVector,
        apart: &PolyVector,
        turns: bool,
        reading: DraftReading,
    ) -> Result<Option<DraftRun>, AlgebraError> {
        let ball = if turns { self.turned(&carried.at)? } else { carried.at.clone() };
        // Where the tool's last axis must be: ball + apart with the table's ball carried, apart − ball with the tool's.
        let place = if self.on_workpiece { sum(&ball, apart)? } else { difference(apart, &ball)? };
        let Some(at) = self.coordinates(&place, turns)? else { return Ok(None) };
        let draft = |at: &PolyVector, setup: &[Text]| DraftBall {
            at: if at.iter().all(Poly::is_zero) { Vec::new() } else { at.iter().map(|p| self.text(p)).collect() },
            setup: setup.to_vec(),
        };
        let balls = [draft(&carried.at, &carried.setup), draft(other, &self.setups[1])];
        let [workpiece_ball, tool_ball] = if self.on_workpiece {
            balls
        } else {
            let [c, o] = balls;
            [o, c]
        };
        Ok(Some(DraftRun {
            name: name.into(),
            sweep: self.sweep.as_str().into(),
            at,
            workpiece_ball,
            tool_ball,
            reading,
            define: Vec::new(),
            nuisance: Vec::new(),
        }))
    }

    /// The coordinates of all axes that put the tool's last axis at `place`.
    fn coordinates(&self, place: &PolyVector, turns: bool) -> Result<Option<Vec<(Text, Text)>>, AlgebraError> {
        let mut left = place.clone();
        let mut at = Vec::new();
        for (i, axis) in self.model.axes().enumerate() {
            let text = match axis.kind {
                AxisKind::Rotary if AxisId::from(i) == self.axis && turns => self.sweep.as_str().into(),
                AxisKind::Rotary => Text::from("rest"),
                AxisKind::Linear => {
                    let along = dot(&axis.direction, place, &self.alphabet)?;
                    left = difference(&left, &scaled(&along, &axis.direction, &self.alphabet)?)?;
                    let moved = if i < self.model.workpiece.len() { along.negated() } else { along };
                    if moved.is_zero() { "rest".into() } else { self.text(&moved) }
                }
            };
            at.push((axis.name.as_str().into(), text));
        }
        Ok(left.iter().all(Poly::is_zero).then_some(at))
    }

    /// A vector as the axis turns it.
    fn turned(&self, vector: &PolyVector) -> Result<PolyVector, AlgebraError> {
        let Some(sweep) = self.alphabet.find_sweep(&self.sweep) else { return Ok(vector.clone()) };
        let [_, sin, cos] = self.alphabet.sweep_symbols(sweep).map(Poly::nominal);
        let along = scaled(&dot(&self.d, vector, &self.alphabet)?, &self.d, &self.alphabet)?;
        let out = difference(vector, &along)?;
        let ahead = cross(&self.d, &out, &self.alphabet)?;
        let turned = sum(&scaled(&cos, &out, &self.alphabet)?, &scaled(&sin, &ahead, &self.alphabet)?)?;
        sum(&along, &turned)
    }

    fn text(&self, poly: &Poly) -> Text {
        write(poly, &self.alphabet).into()
    }
}

fn setup(ball: &Ball, alphabet: &Alphabet) -> Vec<Text> {
    ball.setup.iter().flatten().map(|e| alphabet.error_name(*e).into()).collect()
}

/// The unit vector from an axis along `d` to a place, and how far that is; `None` on the axis, or where the distance is no
/// constant times a root that is exact.
fn outwards(at: &PolyVector, d: &PolyVector, alphabet: &Alphabet) -> Result<Option<(PolyVector, Poly)>, AlgebraError> {
    let out = difference(at, &scaled(&dot(d, at, alphabet)?, d, alphabet)?)?;
    let constants = |m: &Monomial| m.with_exponent(Alphabet::ROOT2, 0);
    let mut lengths: Vec<Monomial> = out.iter().flat_map(|p| p.terms()).map(|(m, _)| constants(m)).collect();
    lengths.dedup();
    let &[length] = lengths.as_slice() else { return Ok(None) };
    let direction = scaled(&Poly::term(length.recip()?, Rational::ONE), &out, alphabet)?;
    let Some(square) = dot(&direction, &direction, alphabet)?.as_number() else { return Ok(None) };
    // n, or n·√2.
    let half = &square * &Rational::new(1, 2);
    let (root, power) = match (square.sqrt(), half.sqrt()) {
        (Some(root), _) => (root, 0),
        (None, Some(root)) => (root, 1),
        _ => return Ok(None),
    };
    let inverse = Poly::term(Monomial::nominal(Alphabet::ROOT2, -power), root.recip()?);
    let unit = scaled(&inverse, &direction, alphabet)?;
    Ok(Some((unit, Poly::term(length.with_exponent(Alphabet::ROOT2, power), root))))
}

/// A ball beside an axis that no run of the model turns, at the distance of a constant.
fn somewhere(
    alphabet: &Alphabet,
    bar: Option<NominalId>,
    d: &PolyVector,
) -> Result<(PolyVector, PolyVector, Poly), AlgebraError> {
    let constants = || alphabet.constants().filter_map(|name| alphabet.find_constant(name));
    let length = constants().find(|id| Some(*id) != bar).or(bar).map_or(Poly::ZERO, Poly::nominal);
    let unit = |i: usize| core::array::from_fn(|k| Poly::integer(i128::from(k == i)));
    let square = (0..3).map(unit).find(|e| dot(d, e, alphabet).is_ok_and(|p| p.is_zero()));
    let u = match square {
        Some(u) => u,
        None => return Err(AlgebraError::DivisionByZero),
    };
    Ok((scaled(&length, &u, alphabet)?, u, length))
}
