//! Several expressions as one straight line of operations on two operands, every shared part computed once.

use super::{Rational, to_f64};

/// An operand: what a [`Program`] is given, a constant it holds, or the result of one of its steps.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Value {
    /// The input at this place.
    Input(u32),
    /// An index into [`Program::constants`].
    Constant(u32),
    /// An index into [`Program::steps`].
    Step(u32),
}

/// A constant of a [`Program`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Constant {
    /// Not negative: signs are in the steps.
    Rational(Rational),
    /// π
    Pi,
    /// √2
    Sqrt2,
}

impl Constant {
    /// Nearest `f64`.
    #[must_use]
    pub fn value(&self) -> f64 {
        match self {
            Constant::Rational(r) => to_f64(r),
            Constant::Pi => std::f64::consts::PI,
            Constant::Sqrt2 => std::f64::consts::SQRT_2,
        }
    }
}

/// One floating-point operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Step {
    /// a + b
    Add(Value, Value),
    /// a − b
    Sub(Value, Value),
    /// a · b
    Mul(Value, Value),
    /// a / b
    Div(Value, Value),
    /// −a
    Neg(Value),
    /// √a
    Sqrt(Value),
    /// sin a. Where the cosine of the same angle is needed too it is the very next step, so that one call gives both.
    Sin(Value),
    /// cos a
    Cos(Value),
    /// ⌊a⌋ of a turns; not a number where too few digits are left of them
    WholeTurns(Value),
}

impl Step {
    /// The step's operands.
    pub fn operands(self) -> impl Iterator<Item = Value> {
        let (a, b) = match self {
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) | Step::Div(a, b) => (a, Some(b)),
            Step::Neg(a) | Step::Sqrt(a) | Step::Sin(a) | Step::Cos(a) | Step::WholeTurns(a) => (a, None),
        };
        [Some(a), b].into_iter().flatten()
    }
}

/// How many operations of each kind a [`Program`] takes.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Operations {
    /// Multiplications.
    pub multiplications: usize,
    /// Additions, subtractions and changes of sign.
    pub additions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub roots: usize,
    /// Angles whose sine, cosine or both are computed.
    pub angles: usize,
    /// Roundings down.
    pub floors: usize,
}

/// Straight-line code for several outputs: each step uses inputs, constants and earlier steps, and no two are the same.
///
/// Made by [`Graph::lower`](super::Graph::lower).
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Program {
    pub(super) inputs: usize,
    pub(super) constants: Vec<Constant>,
    pub(super) steps: Vec<Step>,
    pub(super) outputs: Vec<Value>,
    pub(super) temporary: Vec<bool>,
}

/// The most operations a printer writes in one expression before it names a part: keeps lines readable, and keeps
/// recursion over expressions shallow however long a sum is.
const LONGEST_EXPRESSION: usize = 14;

impl Program {
    pub(super) fn new(inputs: usize, constants: Vec<Constant>, steps: Vec<Step>, outputs: Vec<Value>) -> Self {
        let mut uses = vec![0_usize; steps.len()];
        let mut is_output = vec![false; steps.len()];
        for value in steps.iter().flat_map(|step| step.operands()).chain(outputs.iter().copied()) {
            if let Value::Step(at) = value {
                uses[at as usize] += 1;
            }
        }
        for value in &outputs {
            if let Value::Step(at) = value {
                is_output[*at as usize] = true;
            }
        }
        let mut temporary = vec![false; steps.len()];
        let mut size = vec![0_usize; steps.len()];
        for (at, step) in steps.iter().enumerate() {
            let parts = step.operands().filter_map(|operand| match operand {
                Value::Step(part) if !temporary[part as usize] => Some(size[part as usize]),
                _ => None,
            });
            size[at] = 1 + parts.sum::<usize>();
            temporary[at] = uses[at] > 1
                || matches!(step, Step::Sin(_) | Step::Cos(_))
                || (size[at] > LONGEST_EXPRESSION && !is_output[at]);
        }
        Program { inputs, constants, steps, outputs, temporary }
    }

    /// How many inputs there are; not all need be used.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The constants, each once.
    #[must_use]
    pub fn constants(&self) -> &[Constant] {
        &self.constants
    }

    /// The operations in the order in which they can be done.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Where each output is found.
    #[must_use]
    pub fn outputs(&self) -> &[Value] {
        &self.outputs
    }

    /// The steps that a printer gives a name: used more than once, a sine or cosine, or the part of a very long
    /// expression. The others are written where they are used.
    pub fn temporaries(&self) -> impl Iterator<Item = (usize, Step)> + '_ {
        let named = self.steps.iter().zip(&self.temporary).enumerate();
        named.filter(|(_, (_, temporary))| **temporary).map(|(at, (step, _))| (at, *step))
    }

    /// Whether the cosine at `at` is of the angle whose sine is the step before.
    #[must_use]
    pub fn is_fused_cosine(&self, at: usize) -> bool {
        match (at.checked_sub(1).and_then(|before| self.steps.get(before)), self.steps.get(at)) {
            (Some(Step::Sin(a)), Some(Step::Cos(b))) => a == b,
            _ => false,
        }
    }

    /// What the program costs.
    #[must_use]
    pub fn operations(&self) -> Operations {
        let mut count = Operations::default();
        for (at, step) in self.steps.iter().enumerate() {
            match step {
                Step::Mul(..) => count.multiplications += 1,
                Step::Add(..) | Step::Sub(..) | Step::Neg(_) => count.additions += 1,
                Step::Div(..) => count.divisions += 1,
                Step::Sqrt(_) => count.roots += 1,
                Step::WholeTurns(_) => count.floors += 1,
                Step::Sin(_) | Step::Cos(_) => count.angles += usize::from(!self.is_fused_cosine(at)),
            }
        }
        count
    }
}
