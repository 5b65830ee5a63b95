//! Texts in the encodings that instruments and spreadsheets write, as UTF-8.

use std::io::{self, Cursor, Read};

/// Bytes at the beginning by which UTF-16 is told.
const HEAD: u64 = 1 << 12;

/// Bytes decoded at once.
const BLOCK: usize = 1 << 12;

/// The order of the two bytes of a letter in UTF-16.
#[derive(Clone, Copy)]
enum Order {
    Little,
    Big,
}

impl Order {
    /// By the byte order mark, or by the zeros that plain letters have in it; none of other encodings.
    fn of(head: &[u8]) -> Option<Self> {
        match head {
            [0xff, 0xfe, ..] => return Some(Self::Little),
            [0xfe, 0xff, ..] => return Some(Self::Big),
            _ => {}
        }
        let pairs = head.as_chunks::<2>().0;
        let zeros = |at: usize| pairs.iter().filter(|pair| pair[at] == 0).count();
        match [zeros(0), zeros(1)] {
            [0, low] if 2 * low > pairs.len() => Some(Self::Little),
            [high, 0] if 2 * high > pairs.len() => Some(Self::Big),
            _ => None,
        }
    }

    fn unit(self, pair: [u8; 2]) -> u16 {
        match self {
            Self::Little => u16::from_le_bytes(pair),
            Self::Big => u16::from_be_bytes(pair),
        }
    }
}

/// The same bytes, but UTF-16 as UTF-8.
pub(super) fn decoded(mut source: Box<dyn Read>) -> io::Result<Box<dyn Read>> {
    let mut head = Vec::new();
    source.by_ref().take(HEAD).read_to_end(&mut head)?;
    let order = Order::of(&head);
    let source = Cursor::new(head).chain(source);
    Ok(match order {
        None => Box::new(source),
        Some(order) => Box::new(Utf16 { source, order, bytes: Vec::new(), text: Cursor::default() }),
    })
}

/// A whole text: UTF-16, UTF-8 or, where it is neither, Latin-1; without a byte order mark.
pub(super) fn text(bytes: &[u8]) -> String {
    let text = match Order::of(bytes) {
        Some(order) => utf16(bytes.as_chunks::<2>().0.iter().map(|pair| order.unit(*pair))),
        None => str::from_utf8(bytes).map_or_else(|_| latin(bytes), str::to_owned),
    };
    text.trim_start_matches('\u{feff}').to_owned()
}

/// Each byte a letter, as in Latin-1.
pub(super) fn latin(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| char::from(*byte)).collect()
}

fn utf16(units: impl IntoIterator<Item = u16>) -> String {
    char::decode_utf16(units).map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// UTF-16 that is read as UTF-8.
struct Utf16<R> {
    source: R,
    order: Order,
    /// Bytes of a letter that is not there as a whole yet.
    bytes: Vec<u8>,
    /// Letters decoded and not read yet.
    text: Cursor<Vec<u8>>,
}

impl<R: Read> Read for Utf16<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let read = self.text.read(buffer)?;
            if read > 0 || buffer.is_empty() {
                return Ok(read);
            }
            let taken = self.source.by_ref().take(BLOCK as u64).read_to_end(&mut self.bytes)?;
            if taken == 0 && self.bytes.is_empty() {
                return Ok(0);
            }
            let mut units: Vec<u16> = self.bytes.as_chunks::<2>().0.iter().map(|pair| self.order.unit(*pair)).collect();
            // The first half of a letter waits for the second one, but not beyond the end.
            let half = units.last().is_some_and(|unit| (0xd800..0xdc00).contains(unit));
            if half && taken > 0 {
                units.pop();
            }
            let used = if taken > 0 { 2 * units.len() } else { self.bytes.len() };
            self.bytes.drain(..used);
            self.text = Cursor::new(utf16(units).into_bytes());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_16_is_read_whatever_its_order_and_length() {
        // Letters of one and of two units, across the borders of blocks.
        let text: String = (0..3000)
            .map(|i| {
                if i % 7 == 0 {
                    '𝛿'
                } else if i % 3 == 0 {
                    'µ'
                } else {
                    'a'
                }
            })
            .collect();
        for mark in ["", "\u{feff}"] {
            let whole = format!("{mark}{text}");
            for order in [u16::to_le_bytes, u16::to_be_bytes] {
                let bytes: Vec<u8> = whole.encode_utf16().flat_map(order).collect();
                let mut read = String::new();
                decoded(Box::new(Cursor::new(bytes.clone()))).unwrap().read_to_string(&mut read).unwrap();
                assert!(read == whole, "{mark:?}");
                assert!(super::text(&bytes) == text);
            }
        }
        assert_eq!(super::text(b"\xb5m, \xb0"), "µm, °");
        assert_eq!(super::text(&[0; 64]), "\0".repeat(64));
        // A half of a letter at the end is none.
        assert_eq!(super::text(&[0xff, 0xfe, b'a', 0, 0x00, 0xd8]), "a\u{fffd}");
        let mut read = Vec::new();
        decoded(Box::new(Cursor::new([0xff, 0xfe, b'a', 0, 0x00, 0xd8, 1]))).unwrap().read_to_end(&mut read).unwrap();
        assert_eq!(read, "\u{feff}a\u{fffd}".as_bytes());
    }
}
