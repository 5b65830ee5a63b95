//! Numbers and comments as files have them.

/// A number with digits behind the point, without a negative zero.
pub fn decimal(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let is_zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text.replacen('-', "", 1) } else { text }
}

/// The number that such a text is.
pub fn number(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

/// Values as they are read back.
pub fn read_back(values: &[Vec<f64>; 2], digits: usize) -> [Vec<f64>; 2] {
    values.each_ref().map(|values| values.iter().map(|x| number(&decimal(*x, digits))).collect())
}

/// Lines of comment in the letters that every control reads.
pub fn comments(sign: &str, notes: &[String]) -> String {
    let plain = |c: char| match c {
        'µ' => "u".to_owned(),
        '°' => "deg".to_owned(),
        '±' => "+-".to_owned(),
        '−' => "-".to_owned(),
        ' '..='~' => c.to_string(),
        _ => "?".to_owned(),
    };
    let line = |note: &String| format!("{sign} {}\n", note.chars().map(plain).collect::<String>());
    notes.iter().map(line).collect()
}
