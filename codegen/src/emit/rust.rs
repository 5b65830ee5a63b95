//! Rust, generic over the float, for `core` alone: no allocation, no index, no panic.

use proc_macro2::{Ident, Literal, Punct, Spacing, Span, TokenStream};
use quote::{ToTokens, TokenStreamExt, quote};

use crate::graph::{Constant, Program, Rational, Step, Value, to_f64};

use super::code::terminates;
use super::function::{Function, Shape};
use super::header::header;
use super::names::{Names, Rules};

/// Source of a file of functions, formatted, under its header; `source` says what it was made from. The file needs
/// the crate `num-traits`.
#[must_use]
pub fn source(functions: &[Function], source: &str) -> String {
    let num_traits = quote!(num_traits);
    let items: TokenStream = functions.iter().map(|function| item(function, &num_traits)).collect();
    header("//", source) + &pretty(items)
}

/// Formats items; tokens that are no items are left as they are.
#[must_use]
pub fn pretty(items: TokenStream) -> String {
    match syn::parse2(items.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        Err(_) => items.to_string(),
    }
}

/// `pub fn name<T>(r: T, a: T) -> [T; 10] where T: Float + FloatConst + 'static, f64: AsPrimitive<T>` as tokens, for a
/// macro or a build script. Several outputs are returned as a tuple. `num_traits` is the path to that crate.
#[must_use]
pub fn item(function: &Function, num_traits: &TokenStream) -> TokenStream {
    let names = Names::new(function, Rules { lower_case: true, places: false, reserved: RESERVED });
    let writer = Writer::new(&function.program, &names);
    let name = ident(&names.function);
    let docs = function.documentation().map(|line| if line.is_empty() { line } else { format!(" {line}") });
    let kinds = function.results.iter().map(|(_, shape)| match *shape {
        Shape::Scalar => quote!(T),
        Shape::Array(n) => {
            let n = Literal::usize_unsuffixed(n);
            quote!([T; #n])
        }
        Shape::Matrix(rows, columns) => {
            let (rows, columns) = (Literal::usize_unsuffixed(rows), Literal::usize_unsuffixed(columns));
            quote!([[T; #columns]; #rows])
        }
    });
    let elements: Vec<Ident> = names.outputs.iter().map(|name| ident(name)).collect();
    let mut rest = elements.as_slice();
    let results = function.results.iter().map(|&(_, shape)| {
        let (own, others) = rest.split_at(shape.len());
        rest = others;
        match shape {
            Shape::Scalar => quote!(#(#own)*),
            Shape::Array(_) => quote!([#(#own),*]),
            Shape::Matrix(_, columns) => {
                let rows = own.chunks(columns.max(1)).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
        }
    });
    let (kind, result) = (tuple(kinds.collect()), tuple(results.collect()));
    let inputs = &writer.inputs;
    let unused = function.unused().map(|at| &inputs[at]);
    let constants = writer.constants(num_traits);
    let steps = writer.temporaries();
    let lines = elements.iter().zip(function.program.outputs()).map(|(name, &value)| {
        let value = writer.value(value);
        quote!(let #name = #value;)
    });
    quote! {
        #(#[doc = #docs])*
        #[must_use]
        #[allow(clippy::all)]
        pub fn #name<T>(#(#inputs: T),*) -> #kind
        where
            T: #num_traits::Float + #num_traits::FloatConst + 'static,
            f64: #num_traits::AsPrimitive<T>,
        {
            #(let _ = #unused;)*
            #constants
            #steps
            #(#lines)*
            #result
        }
    }
}

fn tuple(parts: Vec<TokenStream>) -> TokenStream {
    match parts.as_slice() {
        [only] => only.clone(),
        _ => quote!((#(#parts),*)),
    }
}

fn ident(name: &str) -> Ident {
    Ident::new(name, Span::call_site())
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Operand,
    Receiver,
}

struct Writer<'a> {
    program: &'a Program,
    inputs: Vec<Ident>,
    constants: Vec<Ident>,
    steps: Vec<Option<Ident>>,
}

impl<'a> Writer<'a> {
    fn new(program: &'a Program, names: &Names) -> Self {
        Writer {
            program,
            inputs: names.inputs.iter().map(|name| ident(name)).collect(),
            constants: names.constants.iter().map(|name| ident(name)).collect(),
            steps: names.steps.iter().map(|name| name.as_deref().map(ident)).collect(),
        }
    }

    fn constants(&self, num_traits: &TokenStream) -> TokenStream {
        let lines = self.constants.iter().zip(self.program.constants()).map(|(name, constant)| {
            let value = match constant {
                Constant::Pi => quote!(T::PI()),
                Constant::Sqrt2 => quote!(T::SQRT_2()),
                Constant::Rational(r) => {
                    let number = number(r);
                    quote!(#num_traits::AsPrimitive::as_(#number))
                }
            };
            quote!(let #name: T = #value;)
        });
        lines.collect()
    }

    /// A line for each named step; a sine and cosine of one angle share theirs.
    fn temporaries(&self) -> TokenStream {
        let mut tokens = TokenStream::new();
        for (at, step) in self.program.temporaries() {
            let name = &self.steps[at];
            match step {
                Step::Cos(_) if self.program.is_fused_cosine(at) => continue,
                Step::Sin(angle) if self.program.is_fused_cosine(at + 1) => {
                    let cosine = &self.steps[at + 1];
                    let mut pair = TokenStream::new();
                    self.write(angle, Binding::Receiver, &mut pair);
                    tokens.extend(quote!(let (#name, #cosine) = #pair.sin_cos();));
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

    fn value(&self, value: Value) -> TokenStream {
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

    /// Operators group to the left, and grouping is rounding: what stands right of one is parenthesised.
    fn write_step(&self, step: Step, room: Binding, tokens: &mut TokenStream) {
        let (binding, right, operator) = match step {
            Step::Add(..) => (Binding::Sum, Binding::Product, '+'),
            Step::Sub(..) => (Binding::Sum, Binding::Product, '-'),
            Step::Mul(..) => (Binding::Product, Binding::Operand, '*'),
            Step::Div(..) => (Binding::Product, Binding::Operand, '/'),
            Step::Neg(_) => (Binding::Sum, Binding::Operand, '-'),
            Step::Sqrt(a) => return self.method("sqrt", a, tokens),
            Step::Sin(a) => return self.method("sin", a, tokens),
            Step::Cos(a) => return self.method("cos", a, tokens),
        };
        if room > binding {
            let mut inner = TokenStream::new();
            self.write_step(step, Binding::Sum, &mut inner);
            return tokens.extend(quote!((#inner)));
        }
        match step {
            Step::Add(a, b) | Step::Sub(a, b) | Step::Mul(a, b) | Step::Div(a, b) => {
                self.write(a, binding, tokens);
                tokens.append(Punct::new(operator, Spacing::Alone));
                self.write(b, right, tokens);
            }
            _ => {
                tokens.append(Punct::new(operator, Spacing::Alone));
                step.operands().for_each(|a| self.write(a, right, tokens));
            }
        }
    }

    fn method(&self, method: &str, receiver: Value, tokens: &mut TokenStream) {
        self.write(receiver, Binding::Receiver, tokens);
        let method = ident(method);
        tokens.extend(quote!(.#method()));
    }
}

/// A constant as a literal, or as the quotient that the compiler rounds correctly.
fn number(r: &Rational) -> TokenStream {
    let exact = |n: i128| n.unsigned_abs() <= 1 << 53;
    let literal = |n: f64| Literal::f64_suffixed(n);
    let (numer, denom) = (*r.numer(), *r.denom());
    if denom == 1 || !exact(numer) || !exact(denom) || terminates(denom) {
        return literal(to_f64(r)).into_token_stream();
    }
    let (numer, denom) = (literal(numer as f64), literal(denom as f64));
    quote!(#numer / #denom)
}

/// Keywords of any edition.
const RESERVED: &[&str] = &[
    "abstract",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "const",
    "continue",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
    "f64",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "let",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "struct",
    "super",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
    "num_traits",
];
