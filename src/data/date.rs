//! Dates as files tell them.

use toml::value::Datetime;

/// A date of ISO 8601 (2026-04-01, with a time or without), or as instruments write it (20260401-080000), in ISO's way; none of
/// other texts.
pub fn iso_date(text: &str) -> Option<String> {
    let text = text.trim();
    let figures = |part: &str, count: usize| part.len() == count && part.bytes().all(|b| b.is_ascii_digit());
    let written = match text.split_once('-') {
        Some((day, time)) if figures(day, 8) && figures(time, 6) => {
            let (year, month, day) = (&day[..4], &day[4..6], &day[6..]);
            format!("{year}-{month}-{day}T{}:{}:{}", &time[..2], &time[2..4], &time[4..])
        }
        _ => text.to_owned(),
    };
    written.parse::<Datetime>().ok()?.date.map(|_| written)
}

/// Days from 1970-01-01 to such a date, in the Gregorian calendar.
pub fn day(text: &str) -> Option<i64> {
    let date = iso_date(text)?.parse::<Datetime>().ok()?.date?;
    // The year begins in March: the leap day is its last.
    let (month, day) = (i64::from(date.month), i64::from(date.day));
    let year = i64::from(date.year) - i64::from(month < 3);
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    Some(365 * year + year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400) + of_year - 719_468)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted() {
        let days = ["1970-01-01", "2000-02-29", "2000-03-01", "2026-11-29", "2026-11-29T10:00:00"].map(day);
        assert_eq!(days, [Some(0), Some(11_016), Some(11_017), Some(20_786), Some(20_786)]);
        assert_eq!(iso_date("20261129-100000").as_deref(), Some("2026-11-29T10:00:00"));
        assert_eq!(day("20261129-100000"), Some(20_786));
        let none =
            ["", "yesterday", "gestern", "01.04.2026", "2026-13-01", "10:00:00", "20261329-100000", "20261129-99ä00"];
        assert!(none.iter().all(|text| day(text).is_none()));
    }
}
