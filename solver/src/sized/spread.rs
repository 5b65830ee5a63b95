//! Blocks of samples from all over a recording.

use crate::lstsq::{Column, ROWS};

/// From so many places of a recording a block has samples, four from each: most blocks are then like each other, and go in fastest.
const PLACES: usize = 32;

/// How many blocks [`spread`] makes of a recording.
#[must_use]
pub const fn blocks(samples: usize) -> usize {
    samples.div_ceil(PLACES).div_ceil(ROWS / PLACES)
}

/// Copies the values of one of the [`blocks`] of a recording, from all over it; how many they are.
pub fn spread(recording: &[f64], block: usize, to: &mut Column<f64>) -> usize {
    const EACH: usize = ROWS / PLACES;
    let mut count = 0;
    for stretch in recording.chunks(recording.len().div_ceil(PLACES).max(1)) {
        let values = stretch.get(block * EACH..).unwrap_or_default();
        let rest = to.get_mut(count..).unwrap_or_default();
        if let (Some(values), Some(to)) = (values.first_chunk::<EACH>(), rest.first_chunk_mut()) {
            *to = *values;
            count += EACH;
        } else {
            for (to, &value) in rest.iter_mut().zip(values.iter().take(EACH)) {
                *to = value;
                count += 1;
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn every_sample_is_in_one_block_and_the_first_goes_from_end_to_end() {
        for samples in (0..700).chain([3_600, 36_000, 36_001]) {
            let recording: Vec<f64> = (0..samples).map(|i| i as f64).collect();
            let mut all = Vec::new();
            for block in 0..blocks(samples) {
                let mut to = [f64::NAN; ROWS];
                let count = spread(&recording, block, &mut to);
                assert!(count > 0, "{samples}");
                if block == 0 && samples >= PLACES * PLACES {
                    assert!(to[0] == 0.0 && to[count - 1] > 0.9 * samples as f64, "{samples}");
                }
                all.extend_from_slice(&to[..count]);
            }
            assert_eq!(spread(&recording, blocks(samples), &mut [0.0; ROWS]), 0);
            all.sort_by(f64::total_cmp);
            assert_eq!(all, recording, "{samples}");
        }
    }
}
