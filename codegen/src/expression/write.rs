//! A polynomial as the text of an expression, which reads back as the same polynomial.

use num_traits::{One, Signed};

use crate::algebra::{Alphabet, Monomial, Nominal, Poly};

/// A nominal polynomial as it would be written in a model file: `L*cos(c) - R*sin(c)`.
#[must_use]
pub fn write(poly: &Poly, alphabet: &Alphabet) -> String {
    let mut text = String::new();
    for (monomial, coefficient) in poly.printed() {
        let (numer, denom) = (coefficient.numer(), coefficient.denom());
        text += match (text.is_empty(), numer.is_negative()) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        };
        let [mut above, mut below] = factors(&monomial, alphabet);
        if !numer.abs().is_one() || above.is_empty() {
            above.insert(0, numer.abs().to_string());
        }
        if !denom.is_one() {
            below.push(denom.to_string());
        }
        text += &above.join("*");
        below.iter().for_each(|factor| text += &format!("/{factor}"));
    }
    if text.is_empty() { "0".to_owned() } else { text }
}

/// What stands above and what below the line, constants first.
fn factors(monomial: &Monomial, alphabet: &Alphabet) -> [Vec<String>; 2] {
    let [mut above, mut below] = [Vec::new(), Vec::new()];
    for (id, nominal) in alphabet.nominals() {
        let exponent = monomial.exponent(id);
        let name = match nominal {
            Nominal::Sin(sweep) => format!("sin({})", alphabet.sweep_name(*sweep)),
            Nominal::Cos(sweep) => format!("cos({})", alphabet.sweep_name(*sweep)),
            _ => alphabet.nominal_name(id),
        };
        let side = if exponent > 0 { &mut above } else { &mut below };
        match exponent.unsigned_abs() {
            0 => {}
            1 => side.push(name),
            n => side.push(format!("{name}**{n}")),
        }
    }
    [above, below]
}

#[cfg(test)]
mod tests {
    use super::super::{Scope, parse};
    use super::*;

    #[test]
    fn what_is_written_reads_back() {
        let mut alphabet = Alphabet::default();
        alphabet.constant("R").unwrap();
        alphabet.constant("L").unwrap();
        let sweep = alphabet.sweep("c").unwrap();
        let read = |text: &str| {
            Scope { alphabet: &alphabet, sweep: Some(sweep), defined: &[] }.poly(&parse(text).unwrap()).unwrap()
        };
        for text in [
            "0",
            "-1/2",
            "R*cos(c)",
            "L*cos(c) - R*sin(c)",
            "-R*sqrt(2)/2 + 3*L*sin(c)/4",
            "L**2*pi/R - sin(c)*cos(c)",
            "2*L*(1 - cos(c))/3 + (R + L)**2/L",
        ] {
            let poly = read(text);
            let written = write(&poly, &alphabet);
            assert_eq!(read(&written), poly, "{text}: {written}");
        }
        assert_eq!(write(&read("L*cos(c) - R*sin(c)"), &alphabet), "L*cos(c) - R*sin(c)");
    }
}
