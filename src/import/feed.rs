//! Readings while the bar is still on its way to the circle, or away from it.

/// Readings that are so many times the usual distance off the middle one are on no circle.
const FAR: f64 = 20.0;

/// Steps from one reading to the next that are so many times the usual one are not those of a circle.
const STEEP: f64 = 4.0;

/// Not more than this part of the readings at either end.
const PART: usize = 4;

/// How many readings at the beginning and at the end belong to feed-in and feed-out: those that are far off all others, and
/// those that lead on from there steeply. In whatever unit they are.
pub(super) fn feed_arcs(readings: &[f64]) -> [usize; 2] {
    let middle = median(readings.iter().copied());
    let off = |reading: &f64| (reading - middle).abs();
    let far = FAR * median(readings.iter().map(off));
    let steep = STEEP * median(steps(readings.iter()).map(f64::abs));
    let most = readings.len() / PART;
    let length = |along: Vec<f64>| {
        let outside = along.iter().take_while(|reading| off(reading) > far).count();
        if outside == 0 || outside > most {
            return 0;
        }
        // The way from the last one outside into the circle.
        let inward = (middle - along[outside - 1]).signum();
        let leads = |step: &f64| step * inward > steep;
        outside + steps(along.iter().skip(outside)).take(most).take_while(leads).count()
    };
    [length(readings.to_vec()), length(readings.iter().rev().copied().collect())]
}

fn steps<'a>(readings: impl Iterator<Item = &'a f64> + Clone) -> impl Iterator<Item = f64> {
    readings.clone().zip(readings.skip(1)).map(|(one, next)| next - one)
}

/// The middle value, the upper one of two; 0 of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_are_found_and_circles_left_alone() {
        // A shifted, oval circle with noise, µm.
        let noise = |i: usize| 0.1 * ((i * i * 37 % 101) as f64 / 50.0 - 1.0);
        let circle = |i: usize| {
            let a = i as f64 * 0.01;
            20.0 * a.cos() - 15.0 * a.sin() + 4.0 * (2.0 * a).sin() + noise(i)
        };
        let plain: Vec<f64> = (0..620).map(circle).collect();
        assert_eq!(feed_arcs(&plain), [0, 0]);
        assert_eq!(feed_arcs(&[3.0; 100]), [0, 0]);
        assert_eq!(feed_arcs(&[]), [0, 0]);
        // From a millimetre inside onto it in 40 steps, and away outward in 25.
        let to = |n: usize| (0..n).map(move |i| 1000.0 * (i as f64 / n as f64 - 1.0) + circle(0));
        let from = (1..=25).map(|i| 900.0 * i as f64 / 25.0 + circle(619));
        let fed: Vec<f64> = to(40).chain(plain.iter().copied()).chain(from).collect();
        assert_eq!(feed_arcs(&fed), [40, 25]);
        let in_mm: Vec<f64> = fed.iter().map(|um| um / 1e3).collect();
        assert_eq!(feed_arcs(&in_mm), [40, 25]);
        // Reversal spikes at the ends are part of the circle.
        let mut spikes = plain.clone();
        [0, 1, 618, 619].iter().for_each(|at| spikes[*at] += 12.0);
        assert_eq!(feed_arcs(&spikes), [0, 0]);
    }
}
