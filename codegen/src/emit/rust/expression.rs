//! A program's expressions as Rust tokens.

use proc_macro2::{Ident, Literal, Punct, Spacing, TokenStream};
use quote::{ToTokens, TokenStreamExt, quote};

use super::ident;
use crate::emit::infix::{Binding, operator, quotient};
use crate::emit::names::Names;
use crate::graph::{Constant, Program, Rational, Step, Value, to_f64};

pub(super) struct Expressions<'a> {
    program: &'a Program,
    pub inputs: Vec<Ident>,
    constants: Vec<Ident>,
    steps: Vec<Option<Ident>>,
}

impl<'a> Expressions<'a> {
    pub fn new(program: &'a Program, names: &Names) -> Self {
        Self {
            program,
            inputs: names.inputs.iter().map(|name| ident(name)).collect(),
            constants: names.constants.iter().map(|name| ident(name)).collect(),
            steps: names.steps.iter().map(|name| name.as_deref().map(ident)).collect(),
        }
    }

    /// A line for each constant, in the order of their values.
    pub fn constants(&self) -> TokenStream {
        let mut lines: Vec<(&Ident, &Constant)> = self.constants.iter().zip(self.program.constants()).collect();
        lines.sort_by(|(_, a), (_, b)| a.value().total_cmp(&b.value()));
        let line = |(name, constant): (&Ident, &Constant)| {
            let number = match constant {
                Constant::Pi => quote!(core::f64::consts::PI),
                Constant::Sqrt2 => quote!(core::f64::consts::SQRT_2),
                Constant::Rational(r) => number(r),
            };
            quote!(let #name = T::of(#number);)
        };
        lines.into_iter().map(line).collect()
    }

    /// A line for each named step; a sine and cosine of one angle share theirs.
    pub fn temporaries(&self) -> TokenStream {
        let mut tokens = TokenStream::new();
        for (at, step) in self.program.temporaries() {
            let name = &self.steps[at];
            match step {
                Step::Cos(_) if self.program.is_fused_cosine(at) => continue,
                Step::Sin(angle) if self.program.is_fused_cosine(at + 1) => {
                    let cosine = &self.steps[at + 1];
                    let mut pair = TokenStream::new();
                    self.write(angle, Binding::Receiver, &mut pair);
                    tokens.extend(quote!(let (#name, #cosine) = #pair.sine_cosine();));
                }
                _ => {
                    let mut value = TokenStream::new();
                    self.write_step(step, Binding::Sum, &mut value);
                    tokens.extend(quote!(let #name = #value;));
                }
            }
        }
        tokens
    }

    pub fn value(&self, value: Value) -> TokenStream {
        let mut tokens = TokenStream::new();
        self.write(value, Binding::Sum, &mut tokens);
        tokens
    }

    fn write(&self, value: Value, room: Binding, tokens: &mut TokenStream) {
        match value {
            Value::Input(at) => self.inputs[at as usize].to_tokens(tokens),
            Value::Constant(at) => self.constants[at as usize].to_tokens(tokens),
            Value::Step(at) => match &self.steps[at as usize] {
                Some(name) => name.to_tokens(tokens),
                None => self.write_step(self.program.steps()[at as usize], room, tokens),
            },
        }
    }

    fn write_step(&self, step: Step, room: Binding, tokens: &mut TokenStream) {
        let Some((binding, right, sign)) = operator(step) else {
            return self.method(step, tokens);
        };
        if room > binding {
            let mut inner = TokenStream::new();
            self.write_step(step, Binding::Sum, &mut inner);
            return tokens.extend(quote!((#inner)));
        }
        match step {
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) | Step::Div(a, b) => {
                self.write(a, binding, tokens);
                tokens.append(Punct::new(sign, Spacing::Alone));
                self.write(b, right, tokens);
            }
            _ => {
                tokens.append(Punct::new(sign, Spacing::Alone));
                step.operands().for_each(|a| self.write(a, right, tokens));
            }
        }
    }

    fn method(&self, step: Step, tokens: &mut TokenStream) {
        step.operands().for_each(|a| self.write(a, Binding::Receiver, tokens));
        tokens.extend(match step {
            Step::Sin(_) => quote!(.sine_cosine().0),
            Step::Cos(_) => quote!(.sine_cosine().1),
            Step::WholeTurns(_) => quote!(.whole_turns()),
            _ => quote!(.sqrt()),
        });
    }
}

/// A constant as a literal, or as the quotient that the compiler rounds correctly.
fn number(r: &Rational) -> TokenStream {
    match quotient(r).map(|parts| parts.map(Literal::f64_unsuffixed)) {
        None if to_f64(r).is_infinite() => quote!(f64::INFINITY),
        None => Literal::f64_unsuffixed(to_f64(r)).into_token_stream(),
        Some([numer, denom]) => quote!(#numer / #denom),
    }
}
