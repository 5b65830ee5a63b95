//! Where an axis has its ticks, and what stands at them.

/// Steps of an axis in degrees.
const DEGREE_STEPS: [f64; 13] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0, 180.0];

/// The range of an axis and its ticks, rising.
#[derive(Clone, Debug)]
pub(crate) struct Ticks {
    pub range: (f64, f64),
    pub at: Vec<f64>,
    decimals: usize,
}

impl Ticks {
    /// Ticks at 1, 2 or 5 times a power of ten, at most `most` steps; the range ends at ticks.
    pub(crate) fn decimal((low, high): (f64, f64), most: usize) -> Self {
        let (low, high) = widened(low, high);
        let rough = (high - low) / most as f64;
        let power = 10f64.powf(rough.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0, 20.0].map(|factor| factor * power);
        let counted = |step: &&f64| (high / **step).ceil() - (low / **step).floor() <= most as f64;
        let step = steps.iter().find(counted).copied().unwrap_or(20.0 * power);
        Self::outward((low, high), step)
    }

    /// Ticks at parts of a turn; the range ends at the next multiple of a tenth to a third of a step.
    pub(crate) fn degrees((low, high): (f64, f64)) -> Self {
        let (low, high) = widened(low, high);
        let Some(step) = DEGREE_STEPS.into_iter().find(|step| high - low <= 8.5 * step) else {
            return Self::decimal((low, high), 8);
        };
        let grain = if step >= 30.0 { 10.0 } else { step / 5.0 };
        let range = ((low / grain).floor() * grain, (high / grain).ceil() * grain);
        let inside = Self::outward(range, step);
        let at = inside.at.into_iter().filter(|at| range.0 <= *at && *at <= range.1).collect();
        Self { range, at, decimals: inside.decimals }
    }

    fn outward((low, high): (f64, f64), step: f64) -> Self {
        let (first, last) = ((low / step).floor(), (high / step).ceil());
        let count = (last - first) as usize;
        let at: Vec<f64> = (0..=count).map(|i| (first + i as f64) * step).collect();
        Self { range: (first * step, last * step), at, decimals: (-step.log10()).ceil().clamp(0.0, 12.0) as usize }
    }

    /// From a tick to the next one.
    pub(crate) fn step(&self) -> f64 {
        self.at.iter().zip(self.at.iter().skip(1)).map(|(a, b)| b - a).next().unwrap_or(0.0)
    }

    /// What stands at a tick, all with the same number of decimals.
    pub(crate) fn label(&self, at: f64) -> String {
        let largest = self.range.0.abs().max(self.range.1.abs());
        let text = match largest {
            1e-6..1e6 => format!("{at:.*}", self.decimals),
            _ if at == 0.0 => "0".to_owned(),
            _ => format!("{at:.1e}"),
        };
        let zero = text.strip_prefix('-').is_some_and(|rest| rest.chars().all(|c| c == '0' || c == '.'));
        if zero { text.replace('-', "") } else { text.replace('-', "\u{2212}") }
    }
}

/// A range that is not a point; a constant is drawn in the middle of one.
fn widened(low: f64, high: f64) -> (f64, f64) {
    let least = 1e-9 * low.abs().max(high.abs()).max(1e-6);
    if high - low > least {
        return (low, high);
    }
    let half = if low.abs() > 1e-6 { low.abs() / 2.0 } else { 1.0 };
    (low - half, high + half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<String> {
        ticks.at.iter().map(|at| ticks.label(*at)).collect()
    }

    #[test]
    fn degree_axes_tick_at_parts_of_a_turn() {
        let turn = Ticks::degrees((0.0, 359.0));
        assert_eq!(turn.range, (0.0, 360.0));
        assert_eq!(labels(&turn), ["0", "45", "90", "135", "180", "225", "270", "315", "360"]);
        let arc = Ticks::degrees((-20.0, 199.5));
        assert_eq!(arc.range, (-20.0, 200.0));
        assert_eq!(labels(&arc), ["0", "30", "60", "90", "120", "150", "180"]);
    }

    #[test]
    fn decimal_axes_end_at_ticks() {
        assert_eq!(labels(&Ticks::decimal((-0.31, 0.4), 6)), ["\u{2212}0.4", "\u{2212}0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(labels(&Ticks::decimal((3.0, 3.0), 4)), ["1", "2", "3", "4", "5"]);
        for extreme in [(0.0, 0.0), (-1e100, 1e100), (1e-100, 2e-100), (5e-324, 1.0), (1e100, 1e100)] {
            assert!((2..=7).contains(&Ticks::decimal(extreme, 6).at.len()), "{extreme:?}");
        }
    }
}
