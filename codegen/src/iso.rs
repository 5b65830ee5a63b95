//! Errors of an axis: their six components and their names, ISO 230-1's and the paper's.

/// The six components of an error, ISO 230-1's order: X Y Z A B C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Component(u8);

impl Component {
    /// X Y Z A B C
    pub const ALL: [Self; 6] = [Self(0), Self(1), Self(2), Self(3), Self(4), Self(5)];

    /// ISO letter: X, Y, Z for displacements, A, B, C for rotations about them.
    pub fn letter(self) -> char {
        ['X', 'Y', 'Z', 'A', 'B', 'C'][usize::from(self.0)]
    }

    /// The component with an ISO letter.
    pub fn from_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.letter() == letter)
    }

    /// Position in X Y Z A B C.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// True for A, B, C.
    pub fn is_rotation(self) -> bool {
        self.0 >= 3
    }

    /// The direction it acts along or about: x, y or z.
    pub fn direction(self) -> char {
        ['x', 'y', 'z'][usize::from(self.0 % 3)]
    }
}

/// How a model's errors are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Notation {
    /// EYA, EAA, EY0A, EB0A.
    #[default]
    Iso230,
    /// d_ya, e_xa, o_ya, s_ya: δ_ya, ε_xa, o_ya, s_ya in print.
    Paper,
}

impl Notation {
    /// Name of a motion error.
    pub fn motion(self, component: Component, axis: &str) -> String {
        match self {
            Self::Iso230 => iso_motion(component, axis),
            Self::Paper => {
                let letter = if component.is_rotation() { 'e' } else { 'd' };
                format!("{letter}_{}{}", component.direction(), axis.to_lowercase())
            }
        }
    }

    /// Name of a location error.
    pub fn location(self, component: Component, axis: &str) -> String {
        match self {
            Self::Iso230 => iso_location(component, axis),
            Self::Paper => {
                let letter = if component.is_rotation() { 's' } else { 'o' };
                format!("{letter}_{}{}", component.direction(), axis.to_lowercase())
            }
        }
    }

    /// Name of a function as reports give it: `eps_xa` for the paper's ε_xa, else the error's own name.
    pub fn function(self, name: &str) -> String {
        match (self, name.split_once('_')) {
            (Self::Paper, Some(("e", rest))) => format!("eps_{rest}"),
            (Self::Paper, Some(("d", rest))) => format!("delta_{rest}"),
            _ => name.to_owned(),
        }
    }
}

/// ISO 230-1 name of a motion error: `E`, component, axis.
pub fn iso_motion(component: Component, axis: &str) -> String {
    format!("E{}{axis}", component.letter())
}

/// Reads the name of a location error of `axis`: `EC0Y`, or `EC(0X)Y` for the one against the axis X.
pub(crate) fn location_error<'a>(text: &'a str, axis: &str) -> Option<(Component, Option<&'a str>)> {
    let rest = text.strip_prefix('E')?;
    let component = Component::from_letter(rest.chars().next()?)?;
    let place = rest[1..].strip_suffix(axis)?;
    let reference = place.strip_prefix("(0").and_then(|p| p.strip_suffix(')'));
    let angle = component.is_rotation() && reference.is_some_and(|r| !r.is_empty());
    (place == "0" || angle).then_some((component, reference))
}

/// ISO 230-1 name of a location error: `E`, component, `0`, axis.
pub fn iso_location(component: Component, axis: &str) -> String {
    format!("E{}0{axis}", component.letter())
}
