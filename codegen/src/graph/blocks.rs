//! A tape run for many values at a time: plain loops over blocks, which a compiler makes vector instructions of.

use super::tape::{Operation, Tape};
use super::whole_turns;
use crate::lanes::{self, LANES, Lanes};

/// Runs a [`Tape`] for [`LANES`] values of each input at a time, without allocating; the results are those of
/// [`Evaluator`](super::Evaluator) up to the last place of a sine or cosine.
#[derive(Clone, Debug)]
pub struct BlockEvaluator<'a> {
    tape: &'a Tape,
    registers: Vec<Lanes>,
}

impl Tape {
    /// Registers to run this tape in by blocks; each thread takes its own.
    #[must_use]
    pub fn block_evaluator(&self) -> BlockEvaluator<'_> {
        let mut registers = vec![[0.0; LANES]; self.registers];
        for (register, &constant) in registers.iter_mut().skip(self.inputs).zip(&self.constants) {
            register.fill(constant);
        }
        BlockEvaluator { tape: self, registers }
    }
}

impl BlockEvaluator<'_> {
    /// The inputs, to be written before [`evaluate`](Self::evaluate); they stay as they are.
    pub fn inputs(&mut self) -> &mut [Lanes] {
        let count = self.tape.inputs.min(self.registers.len());
        &mut self.registers[..count]
    }

    /// An output of the last evaluation, in the program's order; none beyond the last.
    #[must_use]
    pub fn output(&self, at: usize) -> Option<&Lanes> {
        self.registers.get(*self.tape.outputs.get(at)? as usize)
    }

    /// Works out the outputs. To be inlined where vector instructions are at hand.
    #[inline(always)]
    pub fn evaluate(&mut self) {
        let mut next = self.tape.inputs + self.tape.constants.len();
        for operation in &self.tape.operations {
            let (done, rest) = self.registers.split_at_mut(next);
            let [result, second @ ..] = rest else { return };
            let at = |register: u32| &done[register as usize];
            match *operation {
                Operation::Add(a, b) => lanes::both(result, at(a), at(b), |a, b| a + b),
                Operation::Sub(a, b) => lanes::both(result, at(a), at(b), |a, b| a - b),
                Operation::Mul(a, b) => lanes::both(result, at(a), at(b), |a, b| a * b),
                Operation::Div(a, b) => lanes::both(result, at(a), at(b), |a, b| a / b),
                Operation::Neg(a) => lanes::each(result, at(a), |a| -a),
                Operation::Sqrt(a) => lanes::each(result, at(a), f64::sqrt),
                Operation::Sin(a) => lanes::each(result, at(a), f64::sin),
                Operation::Cos(a) => lanes::each(result, at(a), f64::cos),
                Operation::WholeTurns(a) => lanes::each(result, at(a), whole_turns),
                Operation::SinCos(a) => {
                    let Some(cos) = second.first_mut() else { return };
                    lanes::sine_cosine(at(a), result, cos);
                    next += 1;
                }
            }
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::emit::model::run;
    use crate::identify::derive;

    #[test]
    fn a_block_is_what_the_tape_gives_one_by_one() {
        for (name, _) in catalogue::MODELS {
            let Some(Ok(model)) = catalogue::model(name) else { continue };
            let derivation = derive(&model).expect("a model of the catalogue");
            for id in model.runs.keys() {
                let tape = Tape::new(run(&model, &derivation, id).expect("a row").program());
                let (mut one, mut block) = (tape.evaluator(), tape.block_evaluator());
                let input = |k: usize, lane: usize| match k {
                    0 => 150.0,
                    _ => (lane as f64 - 20.0) * 0.17 + k as f64,
                };
                for (k, lanes) in block.inputs().iter_mut().enumerate() {
                    (0..LANES).for_each(|lane| lanes[lane] = input(k, lane));
                }
                block.evaluate();
                let mut outputs = vec![0.0; tape.outputs()];
                for lane in 0..LANES {
                    let inputs: Vec<f64> = (0..tape.inputs()).map(|k| input(k, lane)).collect();
                    one.evaluate(&inputs, &mut outputs).expect("the lengths fit");
                    for (at, y) in outputs.iter().enumerate() {
                        let x = block.output(at).expect("an output")[lane];
                        assert!((x - y).abs() <= 1e-13 * (y.abs() + 5e3), "{name}, output {at}: {x} {y}");
                    }
                }
            }
        }
    }
}
