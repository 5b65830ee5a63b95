//! What every target holds a result to: no panic, the same twice, within a second, all numbers finite.

pub mod described;
pub mod pieces;
pub mod tokens;

use std::fmt::Debug;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The longest that an input may take.
const LONGEST: Duration = Duration::from_secs(1);

/// Runs twice and holds the two outcomes to be the same. The quicker run counts: the slower one may have waited for others.
pub fn repeated<T: Debug>(run: impl Fn() -> T) -> T {
    let timed = || {
        let start = Instant::now();
        (run(), start.elapsed())
    };
    let ((first, took), (second, again)) = (timed(), timed());
    // As they are told: a refusal may quote a NaN, which is equal to nothing.
    assert_eq!(format!("{first:?}"), format!("{second:?}"), "not the same twice");
    assert!(took.min(again) <= LONGEST, "took {:?}", took.min(again));
    second
}

/// Holds every number of a result to be finite.
pub fn finite(result: &impl Debug) {
    let told = format!("{result:?}");
    let mut words = told.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '"');
    assert!(!words.any(|word| word == "NaN" || word == "inf"), "{told}");
}

/// Writes an input where a reader of files finds it.
pub fn file(contents: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("trunnion-fuzz-{}", std::process::id()));
    std::fs::write(&path, contents).expect("a place for temporary files");
    path
}
