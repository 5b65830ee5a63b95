//! Numbers as a report prints them: an uncertainty with two digits, a value with the same decimals (GUM 7.2.6).

/// What does not tell anything is not printed: digits of a value of which no uncertainty is known.
const DIGITS: i32 = 6;

/// The power of ten of the first digit, once rounded to so many digits.
fn power(x: f64, digits: i32) -> i32 {
    let written = format!("{x:.*e}", (digits - 1).max(0) as usize);
    written.rsplit_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

/// Decimals that give a number so many digits.
pub(super) fn decimals(x: f64, digits: i32) -> usize {
    if x == 0.0 || !x.is_finite() { 0 } else { (digits - 1 - power(x.abs(), digits)).clamp(0, 12) as usize }
}

/// Decimals of a value beside its uncertainty.
pub(super) fn beside(value: f64, uncertainty: f64) -> usize {
    if uncertainty > 0.0 { decimals(uncertainty, 2) } else { decimals(value, DIGITS) }
}

/// With so many decimals, a true minus sign, and no sign at a zero.
pub(super) fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(size) if size.chars().all(|c| c == '0' || c == '.') => size.to_owned(),
        Some(size) => format!("\u{2212}{size}"),
        None => text,
    }
}

/// What was stated, without zeros behind it.
pub(super) fn plain(x: f64) -> String {
    let text = fixed(x, decimals(x, DIGITS));
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A number as a mantissa and a power of ten, or as it is where it is neither large nor small; the digits are those of
/// [`beside`], the power is that of the larger of `value` and `uncertainty`.
pub(super) fn scientific(x: f64, value: f64, uncertainty: f64) -> String {
    let largest = power(value.abs().max(uncertainty.abs()), 2);
    let power = if (-2..=3).contains(&largest) { 0 } else { largest };
    let scale = 10f64.powi(power);
    let mantissa = fixed(x / scale, beside(value / scale, uncertainty / scale));
    match power {
        0 => mantissa,
        _ => format!("{mantissa}\u{202f}×\u{202f}10<sup>{}</sup>", power.to_string().replace('-', "\u{2212}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_uncertainty_has_two_digits_and_its_value_as_many_decimals() {
        let pair = |x: f64, u: f64| (fixed(x, beside(x, u)), fixed(u, beside(u, u)));
        assert_eq!(pair(-20.796_499, 0.3456), ("\u{2212}20.80".to_owned(), "0.35".to_owned()));
        assert_eq!(pair(1234.5, 99.6), ("1234".to_owned(), "100".to_owned()));
        assert_eq!(pair(-0.0001, 0.0996), ("0.00".to_owned(), "0.10".to_owned()));
        assert_eq!(fixed(2.5, beside(2.5, 0.0)), "2.50000");
        assert_eq!([150.0, 0.003, 100.0, -2.5].map(plain), ["150", "0.003", "100", "\u{2212}2.5"]);
    }

    #[test]
    fn a_small_number_has_the_power_of_its_value() {
        let (value, u) = (-2.597_454e-7, 1.73e-8);
        assert_eq!(scientific(value, value, u), "\u{2212}2.60\u{202f}×\u{202f}10<sup>\u{2212}7</sup>");
        assert_eq!(scientific(u, value, u), "0.17\u{202f}×\u{202f}10<sup>\u{2212}7</sup>");
        assert_eq!(scientific(0.0123, 0.0123, 0.001), "0.0123");
    }
}
