//! Small printed examples; that printed functions compute right is tested in `tests/printed.rs`.
