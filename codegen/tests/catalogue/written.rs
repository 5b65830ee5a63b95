//! Equations that were once written so that they said something else, or said it badly.

use super::numbers::read;
use trunnion_codegen::emit::equations;

fn text(source: &str) -> String {
    let (model, derivation) = read(source);
    equations::text(&model, &derivation)
}

#[test]
fn a_root_squared_is_its_number() {
    let text = text(include_str!("head-eighth-of-a-turn.toml"));
    assert!(text.contains("(R·c² + L·s·c)·k3") && !text.contains("√2²"), "{text}");
}

#[test]
fn a_negative_constant_is_subtracted() {
    let text = text(include_str!("head-zero-at-a-length.toml"));
    assert!(text.contains("EXX3·(x − L)") && !text.contains("+ −"), "{text}");
}

#[test]
fn a_sine_is_not_called_like_a_length() {
    let text = text(include_str!("head-s-and-c.toml"));
    assert!(text.contains("s²·s_t³·k4") && text.contains("(s·c_t² + c·s_t·c_t)·k3"), "{text}");
}
