//! From expressions to a [`Program`].

use rustc_hash::FxHashMap;

use super::Rational;
use super::build::Graph;
use super::evaluate::Unbound;
use super::factor::{Literal, Products};
use super::node::{Addend, Id, Node, Symbol};
use super::program::{Constant, Program, Step, Value};

impl Graph {
    /// Lowers `outputs` together to straight-line code over `inputs`: each part once, one sine and one cosine an
    /// angle, factors shared between products, a division where a divisor is used once and a reciprocal where more often.
    ///
    /// # Errors
    /// An output depends on a symbol that is not among `inputs`.
    pub fn lower(&self, inputs: &[Symbol], outputs: &[Id]) -> Result<Program, Unbound> {
        let used = self.reachable(outputs);
        let mut products = Products::default();
        let mut product_at = FxHashMap::default();
        let mut angles: FxHashMap<Id, [bool; 2]> = FxHashMap::default();
        let nodes = || used.iter().enumerate().filter(|&(_, &used)| used).map(|(at, _)| Id(at as u32));
        for id in nodes() {
            match self.node(id) {
                Node::Product(_, factors) => {
                    product_at.entry(&**factors).or_insert_with(|| {
                        products.push(factors);
                        products.products.len() - 1
                    });
                }
                Node::Sin(u) => angles.entry(*u).or_default()[0] = true,
                Node::Cos(u) => angles.entry(*u).or_default()[1] = true,
                _ => {}
            }
        }
        products.share();
        let mut lowering = Lowering {
            values: vec![Value::Constant(0); used.len()],
            literals: vec![None; products.literals.len()],
            occurrences: products.occurrences(),
            table: &products.literals,
            constants: Vec::new(),
            steps: Vec::new(),
            known: FxHashMap::default(),
        };
        for id in nodes() {
            let value = match self.node(id) {
                Node::Symbol(symbol) => {
                    let at = inputs.iter().position(|input| input == symbol);
                    Value::Input(at.ok_or(Unbound { symbol: *symbol })? as u32)
                }
                Node::Rational(r) if r.is_negative() => {
                    let size = lowering.rational(-r);
                    lowering.step(Step::Neg(size))
                }
                Node::Rational(r) => lowering.rational(r.clone()),
                Node::Pi => lowering.constant(Constant::Pi),
                Node::Sqrt2 => lowering.constant(Constant::Sqrt2),
                Node::Sum(terms) => lowering.sum(terms),
                Node::Product(coefficient, factors) => {
                    let unit = lowering.multiply_out(&products.products[product_at[&**factors]]);
                    let size = lowering.scaled(coefficient.abs(), unit);
                    if coefficient.is_negative() { lowering.step(Step::Neg(size)) } else { size }
                }
                Node::Sqrt(u) => {
                    let u = lowering.at(*u);
                    lowering.step(Step::Sqrt(u))
                }
                Node::WholeTurns(u) => {
                    let u = lowering.at(*u);
                    lowering.step(Step::WholeTurns(u))
                }
                Node::Sin(u) => lowering.angle(*u, angles.get(u).copied().unwrap_or_default())[0],
                Node::Cos(u) => lowering.angle(*u, angles.get(u).copied().unwrap_or_default())[1],
            };
            lowering.values[id.index()] = value;
        }
        let outputs = outputs.iter().map(|output| lowering.at(*output)).collect();
        Ok(Program::new(inputs.len(), lowering.constants, lowering.steps, outputs))
    }
}

struct Lowering<'a> {
    values: Vec<Value>,
    table: &'a [Literal],
    literals: Vec<Option<Value>>,
    occurrences: Vec<u64>,
    constants: Vec<Constant>,
    steps: Vec<Step>,
    known: FxHashMap<Step, Value>,
}

impl Lowering<'_> {
    /// The value of a node that was lowered before: parts come before the whole.
    fn at(&self, id: Id) -> Value {
        self.values[id.index()]
    }

    fn step(&mut self, step: Step) -> Value {
        let next = Value::Step(self.steps.len() as u32);
        *self.known.entry(step).or_insert_with(|| {
            self.steps.push(step);
            next
        })
    }

    fn constant(&mut self, constant: Constant) -> Value {
        let known = self.constants.iter().position(|known| *known == constant);
        Value::Constant(known.unwrap_or_else(|| {
            self.constants.push(constant);
            self.constants.len() - 1
        }) as u32)
    }

    fn rational(&mut self, r: Rational) -> Value {
        self.constant(Constant::Rational(r))
    }

    fn scaled(&mut self, coefficient: Rational, value: Value) -> Value {
        if coefficient.is_one() {
            return value;
        }
        let coefficient = self.rational(coefficient);
        self.step(Step::Mul(coefficient, value))
    }

    /// The first term that is added leads, so that a sign is changed only where all are subtracted.
    fn sum(&mut self, terms: &[Addend]) -> Value {
        let lead = terms.iter().position(|term| !term.coefficient.is_negative()).unwrap_or(0);
        let order = terms.get(lead).into_iter().chain(&terms[..lead]).chain(terms.iter().skip(lead + 1));
        let mut total = None;
        for term in order {
            let size = term.coefficient.abs();
            let part = if term.node == Id::ONE {
                self.rational(size)
            } else {
                let node = self.at(term.node);
                self.scaled(size, node)
            };
            total = Some(match (total, term.coefficient.is_negative()) {
                (None, false) => part,
                (None, true) => self.step(Step::Neg(part)),
                (Some(sum), false) => self.step(Step::Add(sum, part)),
                (Some(sum), true) => self.step(Step::Sub(sum, part)),
            });
        }
        total.unwrap_or_else(|| self.rational(Rational::ZERO))
    }

    /// Sine and cosine, side by side where both are needed.
    fn angle(&mut self, u: Id, [sin, cos]: [bool; 2]) -> [Value; 2] {
        let angle = self.at(u);
        let sine = if sin { self.step(Step::Sin(angle)) } else { angle };
        let cosine = if cos { self.step(Step::Cos(angle)) } else { angle };
        [sine, cosine]
    }

    fn literal(&mut self, literal: u32) -> Value {
        if let Some(value) = self.literals[literal as usize] {
            return value;
        }
        let value = match self.table[literal as usize] {
            Literal::Base(base) => self.at(base),
            Literal::Inverse(base) => {
                let one = self.rational(Rational::ONE);
                let base = self.at(base);
                self.step(Step::Div(one, base))
            }
            Literal::Pair(a, b) => self.multiply_out(&[(a, 1), (b, 1)]),
        };
        self.literals[literal as usize] = Some(value);
        value
    }

    /// Π literal^exponent; divisors that occur nowhere else are multiplied together and divided by once.
    fn multiply_out(&mut self, powers: &[(u32, u64)]) -> Value {
        let (mut over, mut under) = (None, None);
        for literal in powers.iter().flat_map(|&(literal, exponent)| (0..exponent).map(move |_| literal)) {
            match self.table[literal as usize] {
                Literal::Inverse(base) if self.occurrences[literal as usize] == 1 => {
                    let base = self.at(base);
                    under = Some(self.times(under, base));
                }
                _ => {
                    let value = self.literal(literal);
                    over = Some(self.times(over, value));
                }
            }
        }
        let over = over.unwrap_or_else(|| self.rational(Rational::ONE));
        match under {
            Some(under) => self.step(Step::Div(over, under)),
            None => over,
        }
    }

    fn times(&mut self, product: Option<Value>, factor: Value) -> Value {
        match product {
            Some(product) => self.step(Step::Mul(product, factor)),
            None => factor,
        }
    }
}
