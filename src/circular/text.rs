//! The figures for reading at a terminal.

use super::effects::{Effect, Estimate};
use super::figures::Circular;
use super::plane::{Axis, Reversal};
use super::spikes::{Height, Spike};
use super::terms::Measure;
use super::undetermined::Undetermined;
use core::fmt;
use trunnion_codegen::quantity::Unit;

/// Width of a row's name.
const NAME: usize = 44;
/// Width of a column.
const COLUMN: usize = 18;

impl fmt::Display for Circular {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Circular test (ISO 230-4) in the plane {}, R = {} mm", self.plane, self.radius.mm())?;
        self.deviations(f)?;
        self.effects(f)?;
        self.spikes(f)
    }
}

/// A row of the table: a name, then what stands in each column.
fn row(f: &mut fmt::Formatter<'_>, name: &str, columns: impl IntoIterator<Item = String>) -> fmt::Result {
    let columns: String = columns.into_iter().map(|column| format!(" {column:>COLUMN$}")).collect();
    writeln!(f, "{}", format!("{name:NAME$}{columns}").trim_end())
}

/// A number without a sign at zero.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    if text.contains(|c| ('1'..='9').contains(&c)) { text } else { text.replace('-', "") }
}

fn um(length: f64) -> String {
    format!("{} µm", number(Unit::Um.from_inner(length)))
}

/// A length and where it is.
fn at(length: f64, angle: f64) -> String {
    format!("{} {:>6}", um(length), format!("{:.1}°", angle.to_degrees()))
}

impl Circular {
    fn deviations(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (paths, both) = (&self.paths, self.both.as_ref());
        // What one path has, each path's and then that of both.
        let headings = paths.iter().map(|path| path.direction.to_string());
        row(f, "", headings.chain(both.map(|_| "both".to_owned())))?;
        row(f, "  samples", paths.iter().map(|path| path.samples.to_string()))?;
        row(f, "  arc", paths.iter().map(|path| format!("{:.1}°", path.arc.to_degrees())))?;
        let circles = || paths.iter().map(|path| &path.circles).chain(both.map(|both| &both.circles));
        let radial = || paths.iter().map(|path| path.radial).chain(both.map(|both| both.radial));
        writeln!(f, "circular deviation G; of both paths bi-directional, G(b)")?;
        row(f, "  minimum zone", circles().map(|circles| um(circles.zone.width())))?;
        row(f, "  about the least-squares centre", circles().map(|c| um(c.least_squares.roundness())))?;
        writeln!(f, "radial deviation F, about the instrument's centre")?;
        row(f, "  Fmax", radial().map(|radial| at(radial.max.deviation, radial.max.angle)))?;
        row(f, "  Fmin", radial().map(|radial| at(radial.min.deviation, radial.min.angle)))?;
        if paths.iter().any(|path| path.whole) {
            writeln!(f, "radial deviation F, about the least-squares centre")?;
            let centred = |which: usize| {
                let of = move |path| self.centred(path).map_or_else(|_| "-".to_owned(), |ends| um(ends[which]));
                paths.iter().map(of)
            };
            row(f, "  Fmax", centred(0))?;
            row(f, "  Fmin", centred(1))?;
        }
        writeln!(f, "least-squares circle")?;
        for (at, axis) in Axis::ALL.into_iter().enumerate() {
            let name = format!("  centre along {}", self.plane.axis(axis));
            row(f, &name, circles().map(|circles| um(circles.least_squares.circle.centre[at])))?;
        }
        row(f, "  radius less nominal", circles().map(|circles| um(circles.radius(self.radius))))?;
        let told = |figure: Result<String, Undetermined>| figure.unwrap_or_else(|why| why.to_string());
        let one = || Undetermined::OneDirection;
        let mean = both.ok_or_else(one).and_then(|both| both.mean_radial).map(um);
        let apart = both.ok_or_else(one).and_then(|both| both.hysteresis).map(|h| at(h.deviation, h.angle));
        writeln!(f, "{:NAME$} {}", "mean bi-directional radial deviation D", told(mean))?;
        writeln!(f, "{:NAME$} {}", "circular hysteresis H", told(apart))
    }

    fn effects(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nread from the trace by least squares")?;
        for Effect { term, estimate } in &self.effects {
            write!(f, "{:NAME$} ", format!("  {}", term.name(self.plane)))?;
            match estimate {
                Err(why) => writeln!(f, "{why}")?,
                Ok(Estimate { value, u95, .. }) => {
                    let ways = term.measures(self.radius, self.feed);
                    let way =
                        |m: &Measure| format!("{} ± {} {}", number(value * m.factor), number(u95 * m.factor), m.symbol);
                    writeln!(f, "{}", ways.iter().map(way).collect::<Vec<_>>().join(" = "))?;
                }
            }
        }
        let Some(scatter) = self.scatter else { return Ok(()) };
        write!(f, "± 95 % from the scatter of what is left of the readings, {}", um(scatter.std))?;
        if scatter.alike > 1.0 {
            write!(f, ", neighbours alike: {:.0} count as one", scatter.alike)?;
        }
        writeln!(f, "; the instrument's error is not in it")
    }

    fn spikes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "\nreversal spikes, outwards")?;
        row(f, "", self.paths.iter().map(|path| path.direction.to_string()))?;
        let height = |height: Height| {
            let top = at(height.height, height.angle);
            if height.stands_out() { top } else { format!("({})", um(height.height)) }
        };
        for reversal in Reversal::ALL {
            let own = self.spikes.iter().filter(|spike| spike.reversal == reversal);
            let column = |spike: &Spike| spike.height.map_or_else(|_| "-".to_owned(), height);
            row(f, &format!("  at {}", self.plane.end(reversal)), own.map(column))?;
        }
        let heights = || self.spikes.iter().map(|spike| spike.height);
        if heights().flatten().any(|height| !height.stands_out()) {
            writeln!(f, "(in brackets: no more than the readings' scatter makes)")?;
        }
        match heights().find_map(Result::err) {
            Some(why) => writeln!(f, "-: {why}"),
            None => Ok(()),
        }
    }
}
