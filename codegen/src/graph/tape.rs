//! A program made ready to be run many times: run-time models evaluate their rows with it.

use std::fmt;

use super::program::{Constant, Program, Step, Value};
use super::whole_turns;

/// One operation on registers; its result goes to the next register.
#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    Add(u32, u32),
    Sub(u32, u32),
    Mul(u32, u32),
    Div(u32, u32),
    Neg(u32),
    Sqrt(u32),
    Sin(u32),
    Cos(u32),
    WholeTurns(u32),
    /// Gives two results: sine, then cosine.
    SinCos(u32),
}

/// The slice for the inputs or the outputs is of the wrong length.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum WrongLength {
    /// One value for each input is wanted.
    Inputs {
        /// The number of inputs.
        expected: usize,
        /// The number of values given.
        given: usize,
    },
    /// One place for each output is wanted.
    Outputs {
        /// The number of outputs.
        expected: usize,
        /// The number of places given.
        given: usize,
    },
}

impl fmt::Display for WrongLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, expected, given) = match self {
            WrongLength::Inputs { expected, given } => ("inputs", expected, given),
            WrongLength::Outputs { expected, given } => ("outputs", expected, given),
        };
        write!(f, "{expected} {what} wanted, {given} given")
    }
}

impl std::error::Error for WrongLength {}

/// A [`Program`] with its operands resolved to registers: inputs, then constants, then results.
#[derive(Clone, Debug)]
pub struct Tape {
    pub(super) inputs: usize,
    pub(super) constants: Vec<f64>,
    pub(super) operations: Vec<Operation>,
    pub(super) outputs: Vec<u32>,
    pub(super) registers: usize,
}

impl Tape {
    /// Prepares a program.
    #[must_use]
    pub fn new(program: &Program) -> Self {
        let inputs = program.inputs();
        let constants: Vec<f64> = program.constants().iter().map(Constant::value).collect();
        let first = inputs + constants.len();
        let register = |value: Value| match value {
            Value::Input(at) => at,
            Value::Constant(at) => inputs as u32 + at,
            Value::Step(at) => first as u32 + at,
        };
        let mut operations = Vec::with_capacity(program.steps().len());
        for (at, &step) in program.steps().iter().enumerate() {
            let fused = program.is_fused_cosine(at + 1);
            operations.push(match step {
                Step::Cos(_) if program.is_fused_cosine(at) => continue,
                Step::Sin(a) if fused => Operation::SinCos(register(a)),
                Step::Add(a, b) => Operation::Add(register(a), register(b)),
                Step::Sub(a, b) => Operation::Sub(register(a), register(b)),
                Step::Mul(a, b) => Operation::Mul(register(a), register(b)),
                Step::Div(a, b) => Operation::Div(register(a), register(b)),
                Step::Neg(a) => Operation::Neg(register(a)),
                Step::Sqrt(a) => Operation::Sqrt(register(a)),
                Step::Sin(a) => Operation::Sin(register(a)),
                Step::Cos(a) => Operation::Cos(register(a)),
                Step::WholeTurns(a) => Operation::WholeTurns(register(a)),
            });
        }
        let outputs = program.outputs().iter().map(|&value| register(value)).collect();
        Tape { inputs, constants, operations, outputs, registers: first + program.steps().len() }
    }

    /// The number of inputs.
    #[must_use]
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The number of outputs.
    #[must_use]
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Registers to run this tape in; each thread takes its own.
    #[must_use]
    pub fn evaluator(&self) -> Evaluator<'_> {
        let mut registers = vec![0.0; self.registers];
        registers.splice(self.inputs..self.inputs + self.constants.len(), self.constants.iter().copied());
        Evaluator { tape: self, registers }
    }
}

/// Runs a [`Tape`] as often as wanted without allocating.
#[derive(Clone, Debug)]
pub struct Evaluator<'a> {
    tape: &'a Tape,
    registers: Vec<f64>,
}

impl Evaluator<'_> {
    /// Writes the outputs for `inputs`, both in the program's order.
    ///
    /// # Errors
    /// A slice has not the length that the program has; nothing is written then.
    pub fn evaluate(&mut self, inputs: &[f64], outputs: &mut [f64]) -> Result<(), WrongLength> {
        let Tape { inputs: expected, constants, operations, outputs: places, .. } = self.tape;
        if inputs.len() != *expected {
            return Err(WrongLength::Inputs { expected: *expected, given: inputs.len() });
        }
        if outputs.len() != places.len() {
            return Err(WrongLength::Outputs { expected: places.len(), given: outputs.len() });
        }
        let registers = self.registers.as_mut_slice();
        registers[..inputs.len()].copy_from_slice(inputs);
        let mut next = inputs.len() + constants.len();
        for operation in operations {
            let at = |register: u32| registers[register as usize];
            let result = match *operation {
                Operation::Add(a, b) => at(a) + at(b),
                Operation::Sub(a, b) => at(a) - at(b),
                Operation::Mul(a, b) => at(a) * at(b),
                Operation::Div(a, b) => at(a) / at(b),
                Operation::Neg(a) => -at(a),
                Operation::Sqrt(a) => at(a).sqrt(),
                Operation::Sin(a) => at(a).sin(),
                Operation::Cos(a) => at(a).cos(),
                Operation::WholeTurns(a) => whole_turns(at(a)),
                Operation::SinCos(a) => {
                    let (sin, cos) = at(a).sin_cos();
                    registers[next] = sin;
                    next += 1;
                    cos
                }
            };
            registers[next] = result;
            next += 1;
        }
        for (output, &place) in outputs.iter_mut().zip(places) {
            *output = registers[place as usize];
        }
        Ok(())
    }
}
