//! Model files put together from pieces that fit: machines with paths that keep the bar, or the balls together.

use arbitrary::Arbitrary;
use std::fmt::{Display, Formatter, Result};

/// Names that mean something in a language, in ISO 230 or in a file's own text.
const NAMES: [[&str; 3]; 6] = [
    ["R", "L", "t"],
    ["k1", "EBB1", "c"],
    ["class", "int", "b"],
    ["s", "c", "a"],
    ["N", "NULL", "x"],
    ["g", "R", "f1"],
];

/// A machine with a rotary axis across two linear ones.
#[derive(Arbitrary, Debug)]
pub struct Pieces {
    names: u8,
    about: u8,
    reversed: bool,
    /// The rotary axis carries the tool, not the workpiece.
    on_tool: bool,
    paper: bool,
    /// Which location errors there are.
    located: [u8; 3],
    first: Piece,
    others: Vec<Piece>,
    bases: [Basis; 9],
    estimate: u8,
    order: Vec<u8>,
    assume: Option<Assumed>,
    limit: Option<i16>,
}

#[derive(Arbitrary, Debug)]
struct Piece {
    path: Path,
    /// The rotary axis goes this many times as far as the sweep.
    gear: u8,
    phase: u8,
    written: u8,
    nuisance: Vec<Term>,
    same_ball: bool,
}

#[derive(Arbitrary, Clone, Copy, Debug, PartialEq, Eq)]
enum Path {
    Radial,
    Tangential,
    Circular,
    Displacement,
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Term {
    Backlash(u8),
    Play(u8, u8),
    Lag(u8),
    Mismatch,
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Basis {
    Zero,
    Known,
    Polynomial(u8),
    Periodic(u8),
    Fourier(u8),
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Assumed {
    Zero(u8, u8, u8),
    Equal(u8, u8, u8),
    At(u8, u8),
}

/// The motion errors of an axis, as ISO 230 and as the paper begins their names.
const COMPONENTS: [(&str, &str); 6] =
    [("EX", "d_x"), ("EY", "d_y"), ("EZ", "d_z"), ("EA", "e_x"), ("EB", "e_y"), ("EC", "e_z")];

impl Pieces {
    fn axes(&self) -> [char; 3] {
        [['A', 'Y', 'Z'], ['B', 'Z', 'X'], ['C', 'X', 'Y']][usize::from(self.about % 3)]
    }

    fn error(&self, component: u8, axis: u8) -> String {
        let (iso, paper) = COMPONENTS[usize::from(component) % 6];
        let axis = self.axes()[usize::from(axis) % 3];
        if self.paper { format!("{paper}{}", axis.to_ascii_lowercase()) } else { format!("{iso}{axis}") }
    }

    fn axis(&self, f: &mut Formatter, at: usize) -> Result {
        let axis = self.axes()[at];
        let (kind, along) = match at {
            0 => ("rotary", ["x", "y", "z"][usize::from(self.about % 3)]),
            _ => ("linear", ["x", "y", "z"][usize::from(axis as u8 - b'X')]),
        };
        let sign = if at == 0 && self.reversed { "-" } else { "" };
        let errors = ["EX0", "EY0", "EZ0", "EA0", "EB0", "EC0"].iter().enumerate();
        let has = |(bit, _): &(usize, &&str)| self.located[at] >> bit & 1 == 1 && (at == 0 || *bit > 2);
        let errors: Vec<String> = errors.filter(has).map(|(_, error)| format!("\"{error}{axis}\"")).collect();
        writeln!(f, "[axis.{axis}]\n{kind} = \"{sign}{along}\"\nlocation = [{}]", errors.join(", "))
    }

    fn run(&self, f: &mut Formatter, n: usize, run: &Piece) -> Result {
        let [r, l, t] = NAMES[usize::from(self.names) % NAMES.len()];
        let [rotary, u, v] = self.axes();
        let gear = i32::from(run.gear % 3) + 1;
        let turn = match run.phase % 4 {
            0 => format!("{gear}*{t}"),
            quarters => format!("{gear}*{t} + {quarters}*pi/4"),
        };
        // About −d it turns the other way.
        let sign = if self.reversed { "-1*" } else { "" };
        let (c, s) = (format!("cos({turn})"), format!("({sign}sin({turn}))"));
        let (path, at, reading) = match run.path {
            Path::Radial => ([format!("({l} + {r})*{c}"), format!("({l} + {r})*{s}")], true, true),
            Path::Tangential => ([format!("{l}*{c} - {r}*{s}"), format!("{l}*{s} + {r}*{c}")], true, true),
            Path::Circular => ([format!("{r}*{c}"), format!("{r}*{s}")], false, true),
            Path::Displacement => ([format!("{l}*{c}"), format!("{l}*{s}")], true, false),
        };
        writeln!(f, "[run.r{n}]\nsweep = \"{t}\"")?;
        let [at_u, at_v] = path.map(|e| match run.written % 4 {
            0 => e,
            1 => format!("-(-({e}))"),
            2 => format!("({e})*(sin({t})**2 + cos({t})**2)"),
            _ => format!("2*({e})/2 + 0*q"),
        });
        writeln!(f, "define = {{ q = \"{l}*cos({t})\" }}")?;
        let turned = if at { &turn } else { "rest" };
        writeln!(f, "at = {{ {rotary} = \"{turned}\", {u} = \"{at_u}\", {v} = \"{at_v}\" }}")?;
        let mut ball = ["0"; 3];
        ball[(usize::from(self.about % 3) + 1) % 3] = if at { l } else { "0" };
        let own = if run.same_ball { 0 } else { n };
        let carried = format!("{{ at = {ball:?}, setup = [\"w_x{own}\", \"w_y{own}\", \"w_z{own}\"] }}");
        let other = "{ setup = [\"t_x\", \"t_y\", \"t_z\"] }".to_owned();
        let [workpiece, tool] = if self.on_tool { [other, carried] } else { [carried, other] };
        writeln!(f, "workpiece_ball = {workpiece}\ntool_ball = {tool}")?;
        match reading {
            true => writeln!(f, "reading = \"{r}\"")?,
            false => writeln!(f, "reading = {{ displacement = \"xyz\" }}")?,
        }
        let term = |term: &Term| match *term {
            Term::Backlash(axis) => format!("backlash {}", self.axes()[usize::from(axis) % 3]),
            Term::Play(component, axis) => format!("lateral play {}", self.error(component, axis)),
            Term::Lag(axis) => format!("lag {}", self.axes()[usize::from(axis) % 3]),
            Term::Mismatch => "mismatch".to_owned(),
        };
        writeln!(f, "nuisance = {:?}", run.nuisance.iter().take(3).map(term).collect::<Vec<_>>())
    }
}

impl Display for Pieces {
    fn fmt(&self, f: &mut Formatter) -> Result {
        let [r, l, _] = NAMES[usize::from(self.names) % NAMES.len()];
        let [rotary, u, v] = self.axes();
        writeln!(f, "name = \"m\"\nnotation = \"{}\"", if self.paper { "paper" } else { "iso230" })?;
        writeln!(f, "constants = [\"{r}\", \"{l}\"]")?;
        match self.on_tool {
            true => writeln!(f, "workpiece = [\"{u}\", \"{v}\"]\ntool = [\"{rotary}\"]")?,
            false => writeln!(f, "workpiece = [\"{rotary}\"]\ntool = [\"{u}\", \"{v}\"]")?,
        }
        writeln!(f, "estimate = [\"{}\"]", self.error(self.estimate, 0))?;
        let order = self.order.iter().take(3).map(|e| self.error(*e, *e) + "1");
        writeln!(f, "order = {:?}", order.collect::<Vec<_>>())?;
        (0..3).try_for_each(|at| self.axis(f, at))?;
        std::iter::once(&self.first)
            .chain(&self.others)
            .take(3)
            .enumerate()
            .try_for_each(|(n, run)| self.run(f, n, run))?;
        f.write_str("[function]\n")?;
        // All but three errors of each axis are zero: what is derived stays small.
        for axis in 0..3u8 {
            for component in 0..6u8 {
                let chosen = (component + self.about % 2).is_multiple_of(2);
                let basis = if chosen { self.bases[usize::from(axis * 3 + component / 2)] } else { Basis::Zero };
                // What is estimated has functions to be estimated in.
                let estimated = axis == 0 && component == self.estimate % 6;
                let basis = match if estimated { Basis::Fourier(self.estimate) } else { basis } {
                    Basis::Zero => "\"zero\"".to_owned(),
                    Basis::Known => "\"known\"".to_owned(),
                    Basis::Periodic(n) => {
                        format!("{{ polynomial = {}, conditions = [\"f(2*pi) = f(0)\"] }}", n % 4 + 2)
                    }
                    Basis::Fourier(n) if axis == 0 => format!("{{ fourier = {} }}", n % 2 + 1),
                    Basis::Polynomial(n) | Basis::Fourier(n) => format!("{{ polynomial = {} }}", n % 4 + 1),
                };
                writeln!(f, "{} = {basis}", self.error(component, axis))?;
            }
        }
        if let Some(assumed) = self.assume {
            let (parameter, is) = match assumed {
                Assumed::Zero(c, a, n) => (format!("{}{}", self.error(c, a), n % 3 + 1), "0".to_owned()),
                Assumed::Equal(c, a, n) => {
                    (format!("{}{}", self.error(c, a), n % 3 + 1), format!("2*{}1", self.error(n, a)))
                }
                Assumed::At(c, a) => {
                    let coordinate = self.axes()[usize::from(a) % 3].to_ascii_lowercase();
                    (self.error(c, a), format!("0 at {coordinate} = 0"))
                }
            };
            writeln!(f, "[assume]\n{parameter} = \"{is}\"")?;
        }
        match self.limit {
            Some(limit) => writeln!(f, "[limits]\nlength_um = {limit}\nangle_urad = {limit}"),
            None => Ok(()),
        }
    }
}
