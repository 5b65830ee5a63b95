//! The symbols of one model and what the normal form knows about them.

use super::path::{Arctangent, Root};
use super::sense::Sense;
use super::wrapped::WrappedAngle;
use super::{AlgebraError, ErrorId, MAX_NOMINALS, NominalId, SweepId};
use crate::quantity::Quantity;

/// The meaning of a nominal symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Nominal {
    /// π, transcendental: no relation.
    Pi,
    /// √2, with √2² = 2.
    Root2,
    /// A length of the set-up, in mm (R, say).
    Constant(String),
    /// The sweep itself, in rad.
    Sweep(SweepId),
    /// Its sine.
    Sin(SweepId),
    /// Its cosine, with cos² = 1 − sin².
    Cos(SweepId),
    /// An angle less whole turns: independent of the sweep, from which it differs by a constant that jumps.
    Wrapped {
        /// The angle and where its turn begins.
        angle: WrappedAngle,
        /// Its name.
        name: String,
    },
    /// The positive root of a polynomial of the sweep.
    Root {
        /// What it is.
        root: Root,
        /// Its name.
        name: String,
    },
    /// An angle given by its sine and cosine.
    Arctangent {
        /// What it is.
        angle: Arctangent,
        /// Its name.
        name: String,
    },
    /// The sign of a velocity: which way something moves.
    Sense {
        /// Whose.
        sense: Sense,
        /// Its name.
        name: String,
    },
}

impl Nominal {
    /// Its own name, of what has one in equations and is no length.
    fn name(&self) -> Option<&str> {
        match self {
            Self::Wrapped { name, .. }
            | Self::Root { name, .. }
            | Self::Arctangent { name, .. }
            | Self::Sense { name, .. } => Some(name),
            _ => None,
        }
    }

    /// Whether it stands for the same, whatever it is called.
    fn means(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Wrapped { angle, .. }, Self::Wrapped { angle: own, .. }) => angle == own,
            (Self::Root { root, .. }, Self::Root { root: own, .. }) => root == own,
            (Self::Arctangent { angle, .. }, Self::Arctangent { angle: own, .. }) => angle == own,
            (Self::Sense { sense, .. }, Self::Sense { sense: own, .. }) => sense == own,
            _ => self == other,
        }
    }
}

/// All symbols of one model. π and √2 are always there.
#[derive(Clone, Debug)]
pub struct Alphabet {
    nominals: Vec<Nominal>,
    sweeps: Vec<String>,
    errors: Vec<(String, Quantity)>,
    /// Other names that stand in the model's equations: of coefficients, of coordinates.
    others: Vec<String>,
}

impl Default for Alphabet {
    fn default() -> Self {
        Self { nominals: vec![Nominal::Pi, Nominal::Root2], sweeps: Vec::new(), errors: Vec::new(), others: Vec::new() }
    }
}

impl Alphabet {
    /// π
    pub const PI: NominalId = NominalId(0);
    /// √2
    pub const ROOT2: NominalId = NominalId(1);

    fn add(&mut self, nominal: Nominal) -> Result<NominalId, AlgebraError> {
        if self.nominals.len() == MAX_NOMINALS {
            return Err(AlgebraError::TooManyNominals);
        }
        self.nominals.push(nominal);
        Ok(NominalId(self.nominals.len() as u8 - 1))
    }

    /// The symbol that stands for the same, made if there is none.
    fn once(&mut self, nominal: Nominal) -> Result<NominalId, AlgebraError> {
        match self.find(|own| own.means(&nominal)) {
            Some(id) => Ok(id),
            None => self.add(nominal),
        }
    }

    /// The constant called `name`, made if it is new.
    pub fn constant(&mut self, name: &str) -> Result<NominalId, AlgebraError> {
        self.once(Nominal::Constant(name.to_owned()))
    }

    /// The constant called `name`, if the model has it.
    pub fn find_constant(&self, name: &str) -> Option<NominalId> {
        self.find(|n| matches!(n, Nominal::Constant(c) if c == name))
    }

    /// The sweep called `name` with its sine and cosine, made if it is new.
    pub fn sweep(&mut self, name: &str) -> Result<SweepId, AlgebraError> {
        if let Some(id) = self.find_sweep(name) {
            return Ok(id);
        }
        let id = SweepId(self.sweeps.len() as u8);
        for nominal in [Nominal::Sweep(id), Nominal::Sin(id), Nominal::Cos(id)] {
            self.add(nominal)?;
        }
        self.sweeps.push(name.to_owned());
        Ok(id)
    }

    /// The symbol of a wrapped angle, made with the name if it is new.
    pub fn wrapped(&mut self, angle: WrappedAngle, name: String) -> Result<NominalId, AlgebraError> {
        self.once(Nominal::Wrapped { angle, name })
    }

    /// The symbol of a wrapped angle, if a run has it.
    pub fn find_wrapped(&self, wanted: WrappedAngle) -> Option<NominalId> {
        self.find(|n| matches!(n, Nominal::Wrapped { angle, .. } if *angle == wanted))
    }

    /// The symbol of a root, made with the name if it is new.
    pub fn root(&mut self, root: Root, name: String) -> Result<NominalId, AlgebraError> {
        self.once(Nominal::Root { root, name })
    }

    /// Whether a root is called so already.
    pub fn has_root(&self, wanted: &Root, called: &str) -> bool {
        self.find(|n| matches!(n, Nominal::Root { root, name } if root == wanted && name == called)).is_some()
    }

    /// The symbol of an angle given by its sine and cosine, made with the name if it is new.
    pub fn arctangent(&mut self, angle: Arctangent, name: String) -> Result<NominalId, AlgebraError> {
        self.once(Nominal::Arctangent { angle, name })
    }

    /// The roots, the last made first: one may be of others.
    pub(super) fn roots(&self) -> impl Iterator<Item = (NominalId, &Root)> {
        let root = |i: usize| match &self.nominals[i] {
            Nominal::Root { root, .. } => Some((NominalId(i as u8), root)),
            _ => None,
        };
        (0..self.nominals.len()).rev().filter_map(root)
    }

    fn find(&self, is: impl Fn(&Nominal) -> bool) -> Option<NominalId> {
        self.nominals.iter().position(is).map(|i| NominalId(i as u8))
    }

    /// The symbol of a sense, made with the name if it is new.
    pub fn sense(&mut self, sense: Sense, name: String) -> Result<NominalId, AlgebraError> {
        self.once(Nominal::Sense { sense, name })
    }

    /// The symbol of a sense, if a run has it.
    pub fn find_sense(&self, wanted: &Sense) -> Option<NominalId> {
        self.find(|n| matches!(n, Nominal::Sense { sense, .. } if sense == wanted))
    }

    /// The sweep called `name`, if a run has it.
    pub fn find_sweep(&self, name: &str) -> Option<SweepId> {
        self.sweeps.iter().position(|s| s == name).map(|i| SweepId(i as u8))
    }

    /// The error called `name`, made with `quantity` if it is new.
    pub fn error(&mut self, name: &str, quantity: Quantity) -> Result<ErrorId, AlgebraError> {
        if let Some(id) = self.find_error(name) {
            return Ok(id);
        }
        let id = u16::try_from(self.errors.len() + 1).map_err(|_| AlgebraError::TooManyErrors)?;
        self.errors.push((name.to_owned(), quantity));
        Ok(ErrorId(id))
    }

    /// The error called `name`, if the model has it.
    pub fn find_error(&self, name: &str) -> Option<ErrorId> {
        self.errors.iter().position(|(n, _)| n == name).map(|i| ErrorId(i as u16 + 1))
    }

    /// All errors in the order they were made.
    pub fn errors(&self) -> impl Iterator<Item = (ErrorId, &str, Quantity)> {
        self.errors.iter().enumerate().map(|(i, (name, q))| (ErrorId(i as u16 + 1), name.as_str(), *q))
    }

    /// Name of an error.
    pub fn error_name(&self, id: ErrorId) -> &str {
        &self.errors[id.index()].0
    }

    /// Length or angle.
    pub fn error_quantity(&self, id: ErrorId) -> Quantity {
        self.errors[id.index()].1
    }

    /// All nominal symbols.
    pub fn nominals(&self) -> impl Iterator<Item = (NominalId, &Nominal)> {
        self.nominals.iter().enumerate().map(|(i, n)| (NominalId(i as u8), n))
    }

    /// Names of the constants, in the order they were made.
    pub fn constants(&self) -> impl Iterator<Item = &str> {
        self.nominals.iter().filter_map(|n| if let Nominal::Constant(name) = n { Some(name.as_str()) } else { None })
    }

    /// Meaning of a nominal symbol.
    pub fn nominal(&self, id: NominalId) -> &Nominal {
        &self.nominals[usize::from(id.0)]
    }

    /// Name of a sweep.
    pub fn sweep_name(&self, id: SweepId) -> &str {
        &self.sweeps[usize::from(id.0)]
    }

    /// All sweeps in the order they were made.
    pub fn sweeps(&self) -> impl Iterator<Item = SweepId> {
        (0..self.sweeps.len()).map(|i| SweepId(i as u8))
    }

    /// The sweep's own symbol, its sine and its cosine.
    pub fn sweep_symbols(&self, id: SweepId) -> [NominalId; 3] {
        let first = self.nominals.iter().position(|n| *n == Nominal::Sweep(id)).unwrap_or(0) as u8;
        [NominalId(first), NominalId(first + 1), NominalId(first + 2)]
    }

    /// Pairs (sine, cosine) of every sweep.
    pub(super) fn circles(&self) -> impl Iterator<Item = (NominalId, NominalId)> {
        self.sweeps().map(|sweep| {
            let [_, sin, cos] = self.sweep_symbols(sweep);
            (sin, cos)
        })
    }

    /// Keeps a name from whatever is yet to be named.
    pub fn reserve(&mut self, name: String) {
        self.others.push(name);
    }

    /// `wanted`, or the next name like it that is not taken.
    pub(crate) fn free(&self, wanted: String) -> String {
        let numbered = (2..).map(|n| format!("{wanted}_{n}"));
        let mut names = core::iter::once(wanted.clone()).chain(numbered);
        names.find(|name| !self.has_name(name)).unwrap_or(wanted)
    }

    /// Whether something in the model's equations is called so.
    pub fn has_name(&self, name: &str) -> bool {
        let is = |n: &Nominal| n.name() == Some(name);
        self.find_sweep(name).is_some() || self.nominals.iter().any(is) || self.has_name_beside_sweeps(name)
    }

    /// The same of an equation without a sweep.
    pub fn has_name_beside_sweeps(&self, name: &str) -> bool {
        self.find_constant(name).is_some()
            || self.find_error(name).is_some()
            || self.others.iter().any(|other| other == name)
    }

    /// True for π, √2 and the set-up's constants: what does not change along a sweep.
    pub fn is_constant(&self, id: NominalId) -> bool {
        matches!(self.nominal(id), Nominal::Pi | Nominal::Root2 | Nominal::Constant(_))
    }

    /// Name of a nominal symbol in plain text: a single sweep has `s` and `c`, several have `s_a`, `c_a`, …; another
    /// where the model calls something else so, at last `sin(a)` and `cos(a)`.
    pub fn nominal_name(&self, id: NominalId) -> String {
        let both_free = |end: &str| ["s", "c"].into_iter().all(|letter| !self.has_name(&format!("{letter}{end}")));
        let trig = |letter: &str, function: &str, sweep: SweepId| {
            let sweep = self.sweep_name(sweep);
            let ends = [String::new(), format!("_{sweep}")];
            let mut free = ends.into_iter().skip(usize::from(self.sweeps.len() > 1)).filter(|end| both_free(end));
            free.next().map_or_else(|| format!("{function}({sweep})"), |end| format!("{letter}{end}"))
        };
        match self.nominal(id) {
            Nominal::Pi => "pi".to_owned(),
            Nominal::Root2 => "sqrt(2)".to_owned(),
            Nominal::Constant(name)
            | Nominal::Wrapped { name, .. }
            | Nominal::Root { name, .. }
            | Nominal::Arctangent { name, .. }
            | Nominal::Sense { name, .. } => name.clone(),
            Nominal::Sweep(sweep) => self.sweep_name(*sweep).to_owned(),
            Nominal::Sin(sweep) => trig("s", "sin", *sweep),
            Nominal::Cos(sweep) => trig("c", "cos", *sweep),
        }
    }
}
