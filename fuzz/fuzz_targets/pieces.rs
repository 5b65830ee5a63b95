//! Model files put together from pieces that fit, so that most derive.
#![no_main]

use libfuzzer_sys::fuzz_target;
use trunnion_fuzz::{described::described, pieces::Pieces};

fuzz_target!(|pieces: Pieces| {
    assert!(described(&pieces.to_string()), "pieces that do not fit: {pieces:?}");
});
