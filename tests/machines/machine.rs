//! A machine as it is drawn: the model file and the reference are both made from it.

use super::wave::{LENGTHS, Ratio, Wave, Waves, along, rotated, sum};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The six components of an error.
pub const COMPONENTS: [&str; 6] = ["EX", "EY", "EZ", "EA", "EB", "EC"];

pub struct Machine {
    /// On the workpiece's side and the tool's, from the base outwards.
    pub sides: [Vec<Axis>; 2],
    pub runs: Vec<Run>,
    pub assumed: Vec<Assumed>,
}

pub struct Axis {
    pub name: &'static str,
    pub rotary: bool,
    pub direction: [Ratio; 3],
    /// Which location errors it has.
    pub location: [bool; 6],
    pub motion: [&'static Function; 6],
    /// Which motion errors are to be found.
    pub estimated: [bool; 6],
}

/// What is assumed of a motion error.
pub struct Function {
    /// As the model file has it.
    pub text: &'static str,
    /// What its coefficients' names end in.
    pub suffixes: &'static [&'static str],
    /// The functions at a coordinate.
    pub at: fn(f64) -> Vec<f64>,
}

impl Function {
    pub fn is_known(&self) -> bool {
        self.text == "\"known\""
    }
}

#[derive(Clone)]
pub enum Place {
    Rest,
    /// `multiple · sweep + quarters · π/2`
    Turned(i32, i32),
    Travelled(Wave),
}

pub struct Run {
    /// Of every axis, the workpiece's side first.
    pub at: Vec<Place>,
    pub balls: [Ball; 2],
    pub reading: Reading,
}

#[derive(Clone)]
pub struct Ball {
    pub at: Waves,
    /// Which of its side's set-ups.
    pub setup: Option<usize>,
}

pub enum Reading {
    Bar,
    Probe(Waves),
}

/// `Σ factor · parameter = 0`, by name, and its line of the model file.
pub struct Assumed {
    pub line: String,
    pub terms: Vec<(String, Ratio)>,
}

impl Machine {
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.sides.iter().flatten()
    }

    pub fn text(&self) -> String {
        let list =
            |texts: &[String]| format!("[{}]", texts.iter().map(|t| format!("{t:?}")).collect::<Vec<_>>().join(", "));
        let names = |axes: &[Axis]| list(&axes.iter().map(|a| a.name.to_owned()).collect::<Vec<_>>());
        let estimated: Vec<String> = self.axes().flat_map(|a| a.components(|c| a.estimated[c])).collect();
        let constants = LENGTHS.map(|(name, _)| name.to_owned());
        let mut text = format!(
            "name = \"drawn\"\nconstants = {}\nworkpiece = {}\ntool = {}\nestimate = {}\n",
            list(&constants),
            names(&self.sides[0]),
            names(&self.sides[1]),
            list(&estimated)
        );
        for axis in self.axes() {
            let kind = if axis.rotary { "rotary" } else { "linear" };
            let location = (0..6).filter(|c| axis.location[*c]).map(|c| axis.location_name(c));
            let location: Vec<String> = location.collect();
            let direction = list(&axis.direction.map(|d| d.to_string()));
            text += &format!("[axis.{}]\n{kind} = {direction}\nlocation = {}\n", axis.name, list(&location));
        }
        let ball = |side: &str, ball: &Ball| {
            let setup = ball.setup.map(|n| format!(", setup = {}", list(&setup_names(side, n)))).unwrap_or_default();
            format!("{{ at = {}{setup} }}", list(&ball.at.each_ref().map(Wave::to_string)))
        };
        for (n, run) in self.runs.iter().enumerate() {
            let at: Vec<String> =
                self.axes().zip(&run.at).map(|(a, p)| format!("{} = \"{}\"", a.name, p.text())).collect();
            let reading = match &run.reading {
                Reading::Bar => format!("{:?}", LENGTHS[0].0),
                Reading::Probe(along) => {
                    format!("{{ displacement = {} }}", list(&along.each_ref().map(Wave::to_string)))
                }
            };
            text += &format!(
                "[run.run{n}]\nsweep = \"t\"\nat = {{ {} }}\nworkpiece_ball = {}\ntool_ball = {}\nreading = {reading}\n",
                at.join(", "),
                ball(SIDES[0], &run.balls[0]),
                ball(SIDES[1], &run.balls[1])
            );
        }
        text += "[function]\n";
        for axis in self.axes() {
            for (c, function) in axis.motion.iter().enumerate() {
                text += &format!("{} = {}\n", axis.motion_name(c), function.text);
            }
        }
        text += "[assume]\n";
        self.assumed.iter().for_each(|a| text += &format!("{}\n", a.line));
        text
    }
}

/// What the set-ups of each side are called.
pub const SIDES: [&str; 2] = ["w", "u"];

pub fn setup_names(side: &str, setup: usize) -> [String; 3] {
    ["x", "y", "z"].map(|c| format!("{side}{setup}_{c}"))
}

impl Axis {
    pub fn motion_name(&self, component: usize) -> String {
        format!("{}{}", COMPONENTS[component], self.name)
    }

    pub fn location_name(&self, component: usize) -> String {
        format!("{}0{}", COMPONENTS[component], self.name)
    }

    /// The coefficients of a motion error.
    pub fn coefficients(&self, component: usize) -> impl Iterator<Item = String> {
        self.motion[component].suffixes.iter().map(move |suffix| format!("{}{suffix}", self.motion_name(component)))
    }

    fn components(&self, which: impl Fn(usize) -> bool) -> Vec<String> {
        (0..6).filter(|c| which(*c)).map(|c| self.motion_name(c)).collect()
    }

    /// Where the axis carries a point nominally.
    pub fn carried(&self, place: &Place, point: &Waves) -> Waves {
        match place {
            Place::Rest => point.clone(),
            Place::Turned(multiple, quarters) => rotated(&self.direction, &Wave::turn(*multiple, *quarters), point),
            Place::Travelled(by) => sum(point, &along(&self.direction, by)),
        }
    }
}

/// Where the axes of a side carry a point nominally.
pub fn carried(axes: &[Axis], at: &[Place], point: &Waves) -> Waves {
    axes.iter().zip(at).rev().fold(point.clone(), |p, (axis, place)| axis.carried(place, &p))
}

impl Place {
    fn text(&self) -> String {
        match self {
            Self::Rest => "rest".into(),
            Self::Turned(multiple, quarters) => format!("{multiple}*t + {quarters}*pi/2"),
            Self::Travelled(by) => by.to_string(),
        }
    }

    /// The axis' coordinate, rad or mm; one that rests is at 0.
    pub fn coordinate(&self, sweep: f64) -> f64 {
        match self {
            Self::Rest => 0.0,
            Self::Turned(multiple, quarters) => f64::from(*multiple) * sweep + f64::from(*quarters) * FRAC_PI_2,
            Self::Travelled(by) => by.value(sweep),
        }
    }

    pub fn moves(&self) -> bool {
        match self {
            Self::Rest => false,
            Self::Turned(multiple, _) => *multiple != 0,
            Self::Travelled(by) => *by != by.constant(),
        }
    }
}

pub static ZERO: Function = Function { text: "\"zero\"", suffixes: &[], at: |_| vec![] };
pub static KNOWN: Function = Function { text: "\"known\"", suffixes: &[], at: |_| vec![] };

/// Of rotary axes; the polynomials that their conditions make periodic jump at whole turns.
pub static OF_ANGLES: [Function; 7] = [
    Function { text: "{ fourier = 1 }", suffixes: &["_cos1", "_sin1"], at: |x| vec![x.cos(), x.sin()] },
    Function {
        text: "{ fourier = 2 }",
        suffixes: &["_cos1", "_sin1", "_cos2", "_sin2"],
        at: |x| vec![x.cos(), x.sin(), (2.0 * x).cos(), (2.0 * x).sin()],
    },
    Function { text: "{ polynomial = 2 }", suffixes: &["1", "2"], at: |x| vec![x, x * x] },
    Function {
        text: "{ polynomial = 2, conditions = [\"f'(0) = 0\"] }",
        suffixes: &["1", "2"],
        at: |x| vec![x * x, 1.0],
    },
    Function {
        text: "{ polynomial = 3, conditions = [\"f(0) = 0\", \"f(pi) = 0\"] }",
        suffixes: &["1", "2"],
        at: |x| vec![x * x * (x - PI), x * (x - PI)],
    },
    Function {
        text: "{ polynomial = 3, conditions = [\"f(0) = 0\", \"f(2*pi) = f(0)\"] }",
        suffixes: &["1", "2"],
        at: |x| {
            let x = x.rem_euclid(TAU);
            vec![x * x * (x - TAU), x * (x - TAU)]
        },
    },
    Function {
        text: "{ polynomial = 4, conditions = [\"f(0) = 0\", \"f(2*pi) = f(0)\", \"f'(2*pi) = f'(0)\"] }",
        suffixes: &["1", "2"],
        at: |x| {
            let x = x.rem_euclid(TAU);
            vec![x * (x - TAU) * (x * x - 2.0 * PI * PI), x * (x - TAU) * (x - PI)]
        },
    },
];

/// Of linear axes, the cubic ones last.
pub static OF_TRAVELS: [Function; 5] = [
    Function { text: "{ polynomial = 1 }", suffixes: &["1"], at: |x| vec![x] },
    Function { text: "{ polynomial = 2 }", suffixes: &["1", "2"], at: |x| vec![x, x * x] },
    Function {
        text: "{ polynomial = 2, conditions = [\"f(L) = 0\"] }",
        suffixes: &["1", "2"],
        at: |x| vec![x * (x - LENGTHS[1].1), x - LENGTHS[1].1],
    },
    Function {
        text: "{ polynomial = 3, conditions = [\"f(0) = 0\", \"f'(0) = 0\"] }",
        suffixes: &["1", "2"],
        at: |x| vec![x * x * x, x * x],
    },
    Function { text: "{ polynomial = 3 }", suffixes: &["1", "2", "3"], at: |x| vec![x, x * x, x * x * x] },
];
