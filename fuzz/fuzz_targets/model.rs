//! Model files, from the text to all that is printed of it; mutations know its words.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target};
use trunnion_fuzz::{described::described, tokens::mutate};

// Broken TOML is tried as well, but leads no further.
fuzz_target!(|text: &str| -> Corpus { if described(text) { Corpus::Keep } else { Corpus::Reject } });

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| { mutate(data, size, max_size, seed) });
