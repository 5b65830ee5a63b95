//! A sheet to draw on, in units of a pixel on the screen.

use plotters::backend::SVGBackend;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{DashedPathElement, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, IntoFont, IntoTextStyle, RGBAColor, RGBColor, ShapeStyle, WHITE};

use super::series::{PlotError, Tone};
use trunnion_codegen::problems::visible;

/// What the first line of each picture has, so that it is known again.
pub const MADE: &str = "data-made-by=\"trunnion\"";

/// The drawing library's coordinates are whole numbers: this many to a pixel keep lines smooth.
const FINE: f64 = 10.0;

/// Between sizes asked for and written, the drawing library divides by this.
const FONT: f64 = 1.24;

/// Grid lines.
pub(crate) const GRID: Ink = Ink { rgb: (222, 222, 222), alpha: 1.0, width: 1.0 };
/// Grid lines at zero.
pub(crate) const ZERO: Ink = Ink { rgb: (150, 150, 150), alpha: 1.0, width: 1.0 };
/// The frame around a panel.
pub(crate) const FRAME: Ink = Ink { rgb: (70, 70, 70), alpha: 1.0, width: 1.0 };

/// Letters.
pub(crate) const INK: (u8, u8, u8) = (30, 30, 30);
/// Behind a text that stands on lines.
pub(crate) const PAPER: Ink = Ink { rgb: (255, 255, 255), alpha: 0.85, width: 0.0 };

/// Colour, opacity and line width in pixels.
#[derive(Clone, Copy)]
pub(crate) struct Ink {
    rgb: (u8, u8, u8),
    alpha: f64,
    width: f64,
}

impl Ink {
    pub(crate) const fn line(tone: Tone) -> Self {
        Self { rgb: tone.rgb(), alpha: 1.0, width: 1.6 }
    }

    pub(crate) const fn thick(tone: Tone) -> Self {
        Self { width: 3.0, ..Self::line(tone) }
    }

    pub(crate) const fn solid(tone: Tone) -> Self {
        Self::fill(tone.rgb())
    }

    pub(crate) const fn band(tone: Tone) -> Self {
        Self { rgb: tone.rgb(), alpha: 0.25, width: 0.0 }
    }

    pub(crate) const fn fill(rgb: (u8, u8, u8)) -> Self {
        Self { rgb, alpha: 1.0, width: 0.0 }
    }

    pub(crate) const fn rgb(self) -> (u8, u8, u8) {
        self.rgb
    }

    fn style(self, filled: bool) -> ShapeStyle {
        let color: RGBAColor = RGBColor(self.rgb.0, self.rgb.1, self.rgb.2).mix(self.alpha);
        ShapeStyle { color, filled, stroke_width: (self.width * FINE) as u32 }
    }
}

/// Which point of a text is at its place.
#[derive(Clone, Copy)]
pub(crate) enum Anchor {
    Left,
    Centre,
    Right,
    /// Reading upwards, centred.
    Upward,
}

type Backend<'a> = SVGBackend<'a>;
type Drawn = Result<(), PlotError>;

pub(crate) struct Canvas<'a> {
    area: DrawingArea<Backend<'a>, plotters::coord::Shift>,
}

fn fine((x, y): (f64, f64)) -> (i32, i32) {
    ((x * FINE).round() as i32, (y * FINE).round() as i32)
}

fn failed<E: std::error::Error + Send + Sync>(_: DrawingAreaErrorKind<E>) -> PlotError {
    PlotError::Backend
}

/// Draws on a white sheet and gives its SVG text.
pub(crate) fn draw(size: (u32, u32), draw: impl FnOnce(&Canvas) -> Drawn) -> Result<String, PlotError> {
    let mut text = String::new();
    let sheet = (size.0 * FINE as u32, size.1 * FINE as u32);
    {
        let area = Backend::with_string(&mut text, sheet).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let canvas = Canvas { area };
        draw(&canvas)?;
        canvas.area.present().map_err(failed)?;
    }
    let large = format!("width=\"{}\" height=\"{}\"", sheet.0, sheet.1);
    let shown = format!("{MADE} stroke-linejoin=\"round\" width=\"{}\" height=\"{}\"", size.0, size.1);
    Ok(subscripts(&text.replacen(&large, &shown, 1)))
}

impl Canvas<'_> {
    pub(crate) fn line(&self, points: impl IntoIterator<Item = (f64, f64)>, ink: Ink) -> Drawn {
        let points: Vec<_> = points.into_iter().map(fine).collect();
        self.area.draw(&PathElement::new(points, ink.style(false))).map_err(failed)
    }

    pub(crate) fn dashed(&self, points: impl IntoIterator<Item = (f64, f64)>, ink: Ink) -> Drawn {
        let points: Vec<_> = points.into_iter().map(fine).collect();
        let (dash, gap) = (7.0 * FINE, 4.5 * FINE);
        let element = DashedPathElement::new(points, dash as i32, gap as i32, ink.style(false));
        self.area.draw(&element).map_err(failed)
    }

    pub(crate) fn area(&self, points: impl IntoIterator<Item = (f64, f64)>, ink: Ink) -> Drawn {
        let points: Vec<_> = points.into_iter().map(fine).collect();
        self.area.draw(&Polygon::new(points, ink.style(true))).map_err(failed)
    }

    pub(crate) fn text(&self, text: &str, at: (f64, f64), size: f64, anchor: Anchor) -> Drawn {
        let h_pos = match anchor {
            Anchor::Left => HPos::Left,
            Anchor::Right => HPos::Right,
            Anchor::Centre | Anchor::Upward => HPos::Center,
        };
        let font = ("Helvetica, Arial, sans-serif", size * FINE * FONT).into_font();
        let turned = if matches!(anchor, Anchor::Upward) { font.transform(FontTransform::Rotate270) } else { font };
        let style = turned.color(&RGBColor(INK.0, INK.1, INK.2)).into_text_style(&self.area);
        let style = style.pos(Pos::new(h_pos, VPos::Center));
        self.area.draw(&Text::new(visible(text).into_owned(), fine(at), style)).map_err(failed)
    }
}

/// About how wide a text is, in pixels: there is no font to ask.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    let mut low = false;
    let mut ems = 0.0;
    for c in text.chars() {
        match c {
            '_' | '{' => low = low || c == '{',
            '}' => low = false,
            _ => ems += if low { 0.42 } else { 0.56 },
        }
    }
    ems * size
}

/// `_{…}` in the text as smaller letters set lower.
fn subscripts(svg: &str) -> String {
    let mut out = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some((before, after)) = rest.split_once("_{") {
        let Some((low, tail)) = after.split_once('}') else {
            break;
        };
        // What follows on the line is raised again; a shift needs a letter to move.
        let (same, next) = tail.split_at(tail.find('\n').unwrap_or(tail.len()));
        out.push_str(before);
        out.push_str(&format!("<tspan dy=\"0.25em\" font-size=\"72%\">{low}</tspan>"));
        if same.is_empty() {
            rest = next;
        } else {
            let (raised, again) = same.split_at(same.find("_{").unwrap_or(same.len()));
            // Readers drop a space at the beginning of a span: it is a shift.
            let space = if raised.starts_with(' ') { " dx=\"0.28em\"" } else { "" };
            let raised = raised.trim_start();
            out.push_str(&format!("<tspan{space} dy=\"-0.18em\">{raised}</tspan>"));
            rest = tail.get(tail.len() - again.len() - next.len()..).unwrap_or_default();
        }
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_are_lowered_and_the_rest_raised_again() {
        let low = |text: &str| format!("<tspan dy=\"0.25em\" font-size=\"72%\">{text}</tspan>");
        let expected = format!("e{}<tspan dy=\"-0.18em\">, d</tspan>{}\n", low("xa"), low("ya"));
        assert_eq!(subscripts("e_{xa}, d_{ya}\n"), expected);
        let expected = format!("e{}\ne{}<tspan dx=\"0.28em\" dy=\"-0.18em\">true</tspan>", low("1"), low("2"));
        assert_eq!(subscripts("e_{1}\ne_{2} true"), expected);
        assert_eq!(subscripts("a_b _{open"), "a_b _{open");
    }
}
