//! What of a pipeline's counters says that it lost something.
//!
//! A pipeline that can't hold all lights or surfaces counts what did not fit, and the name of the
//! counter says so: `lights_beyond_numbers`, `pixels_over_capacity`, `texels_of_lost_layers`,
//! `pixels_without_number`, and `unplaced_lights` of a pass. A pipeline of one's own takes part by
//! naming its counters in the same way.

use crate::report::CounterResult;

/// Words in a counter's name that say it counts what was lost.
const WORDS: [&str; 5] = ["over", "beyond", "without", "lost", "unplaced"];

/// Whether a counter counts what was lost.
pub fn counts_losses(name: &str) -> bool {
    let mut words = name.split(['_', ' ']);
    words.any(|word| WORDS.contains(&word))
}

/// The counter that reports a loss in any frame, with the largest number that it reports; the first
/// of several.
pub fn first_loss(counters: &[CounterResult]) -> Option<(&CounterResult, f64)> {
    let losses = counters
        .iter()
        .filter(|counter| counts_losses(&counter.name));
    losses
        .map(|counter| {
            let values = counter.values.iter().copied();
            (counter, values.fold(0.0, f64::max))
        })
        .find(|(_, most)| *most > 0.0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn names_tell_losses_from_other_counts() {
        for name in [
            "lights_beyond_numbers",
            "pixels_over_capacity",
            "tiles_over_capacity",
            "cells_over_capacity",
            "texels_of_lost_layers",
            "pixels_without_number",
            "unplaced_lights of opaque_light_indices",
        ] {
            assert!(counts_losses(name), "{name}");
        }
        for name in [
            "tile_lights",
            "most_tile_lights",
            "cluster_room",
            "numbered_lights",
            "cells_filled",
            // Overdraw is work and no loss.
            "overdraw",
        ] {
            assert!(!counts_losses(name), "{name}");
        }
    }

    #[test]
    fn the_first_counter_that_reports_one_is_named() {
        let counter = |name: &str, values: &[f64]| CounterResult {
            name: name.to_owned(),
            description: String::new(),
            values: values.to_vec(),
        };
        let counters = [
            counter("tile_lights", &[9.0]),
            counter("tiles_over_capacity", &[0.0, 0.0]),
            counter("pixels_over_capacity", &[0.0, 3.0, 1.0]),
        ];
        let (found, most) = first_loss(&counters).unwrap();
        assert_eq!((found.name.as_str(), most), ("pixels_over_capacity", 3.0));
        assert!(first_loss(&counters[..2]).is_none());
    }
}
