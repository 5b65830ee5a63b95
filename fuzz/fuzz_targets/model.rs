//! Model files, from the text to all that is printed of it; mutations know its words.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target, fuzzer_mutate};
use trunnion_fuzz::{described::described, tokens::mutated};

// Broken TOML is tried as well, but leads no further.
fuzz_target!(|text: &str| -> Corpus { if described(text) { Corpus::Keep } else { Corpus::Reject } });

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let words = seed % 8 != 0;
    let text = str::from_utf8(&data[..size]).ok().filter(|_| words).map(|text| mutated(text, seed));
    match text.filter(|text| text.len() <= max_size) {
        Some(text) => {
            data[..text.len()].copy_from_slice(text.as_bytes());
            text.len()
        }
        None => fuzzer_mutate(data, size, max_size),
    }
});
