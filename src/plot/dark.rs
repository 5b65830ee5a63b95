//! The colours of pictures on a dark page.

use super::canvas::{FRAME, GRID, INK, Ink, PAPER, ZERO};
use super::series::Tone;

type Rgb = (u8, u8, u8);

/// What stands for each colour of a line chart, a polar chart or a sketch: as far from a dark ground as they are from white.
fn pairs() -> [(Rgb, Rgb); 10] {
    let of = |ink: Ink| ink.rgb();
    [
        (of(PAPER), (22, 25, 29)),
        (of(GRID), (52, 57, 63)),
        (of(ZERO), (116, 122, 130)),
        (of(FRAME), (168, 174, 182)),
        (INK, (226, 229, 233)),
        (Tone::Blue.rgb(), (86, 180, 233)),
        (Tone::Vermilion.rgb(), (255, 140, 66)),
        (Tone::Green.rgb(), (60, 200, 155)),
        (Tone::Purple.rgb(), (229, 159, 197)),
        (Tone::Black.rgb(), (240, 240, 240)),
    ]
}

/// Rules of CSS that turn pictures within elements of a class to their dark colours.
pub fn dark_style(class: &str) -> String {
    let rule = |(light, dark): (Rgb, Rgb)| {
        let hex = |(r, g, b): Rgb| format!("#{r:02X}{g:02X}{b:02X}");
        let (light, dark) = (hex(light), hex(dark));
        ["fill", "stroke"].map(|part| format!(".{class} [{part}=\"{light}\"]{{{part}:{dark}}}\n")).concat()
    };
    pairs().map(rule).concat()
}
