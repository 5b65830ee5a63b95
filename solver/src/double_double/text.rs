//! Decimals, as they are written and read.

use super::DoubleDouble;
use core::fmt::{Display, Formatter};
use core::num::ParseFloatError;
use core::str::FromStr;
use num_traits::{Float, Num, One, Zero};

/// Both words, each with the digits that tell it from its neighbours.
impl Display for DoubleDouble {
    fn fmt(&self, f: &mut Formatter<'_>) -> core::fmt::Result {
        let sign = if self.low < 0.0 { '-' } else { '+' };
        write!(f, "{} {sign} {}", self.high, self.low.abs())
    }
}

/// What an `f64` reads, with all its digits.
impl FromStr for DoubleDouble {
    type Err = ParseFloatError;

    fn from_str(text: &str) -> Result<Self, ParseFloatError> {
        let nearest: f64 = text.parse()?;
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = whole.bytes().chain(fraction.bytes()).filter(u8::is_ascii_digit);
        let ten = Self::from(10.0);
        let integer = digits.fold(Self::zero(), |sum, digit| sum * ten + f64::from(digit - b'0').into());
        // An exponent that is no small number leaves a zero or an infinity.
        let places = exponent.parse::<i32>().unwrap_or(0).saturating_sub(fraction.len() as i32);
        let power = ten.powi(places.saturating_abs());
        let magnitude = if places < 0 { integer / power } else { integer * power };
        let value = if text.starts_with('-') { -magnitude } else { magnitude };
        let exact = nearest.is_finite() && nearest != 0.0 && value.is_finite() && power.is_finite();
        Ok(if exact { value } else { nearest.into() })
    }
}

impl Num for DoubleDouble {
    type FromStrRadixErr = num_traits::ParseFloatError;

    /// In another base than ten, what an `f64` reads.
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        let nearest = f64::from_str_radix(text, radix)?;
        Ok(if radix == 10 { text.parse().unwrap_or(nearest.into()) } else { nearest.into() })
    }
}

impl Zero for DoubleDouble {
    #[inline]
    fn zero() -> Self {
        0.0.into()
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for DoubleDouble {
    #[inline]
    fn one() -> Self {
        1.0.into()
    }
}
