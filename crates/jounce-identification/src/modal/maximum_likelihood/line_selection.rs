//! Selects the lines of a band that a fit needs.
//!
//! With `D` the distance of a line to a pole, the information of the line on the pole decreases as
//! `D^-4`, and the response varies over distances of `D` only. Therefore all lines within some
//! half-power widths of a pole are kept, and beyond that one line per share of `D`.

use crate::modal::Pole;

/// Bands of at most so many lines keep all lines.
const MAX_ALL_LINES: usize = 4096;
/// Half-power half-widths `zeta f` on both sides of a pole within which all lines are kept; the
/// information beyond is below a hundredth.
const NEAR_POLE_HALF_WIDTHS: f64 = 5.0;
/// Number of kept lines per distance from the nearest pole.
const LINES_PER_DISTANCE: f64 = 25.0;

/// Returns indices of the lines to keep, for ascending frequencies.
pub(super) fn select_lines(frequency_hz: &[f64], poles: &[Pole]) -> Vec<usize> {
    if frequency_hz.len() <= MAX_ALL_LINES {
        return (0..frequency_hz.len()).collect();
    }
    let mut next_hz = f64::NEG_INFINITY;
    let selected = |(k, hz): (usize, &f64)| {
        if *hz < next_hz {
            return None;
        }
        let distance_hz = |pole: &Pole| {
            (hz - pole.frequency_hz).abs()
                - NEAR_POLE_HALF_WIDTHS * pole.damping_ratio * pole.frequency_hz
        };
        next_hz = hz
            + poles
                .iter()
                .map(distance_hz)
                .fold(f64::INFINITY, f64::min)
                .max(0.0)
                / LINES_PER_DISTANCE;
        Some(k)
    };
    frequency_hz
        .iter()
        .enumerate()
        .filter_map(selected)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lines_near_poles_and_fewer_others_are_selected() {
        let frequency_hz: Vec<f64> = (1..=20_000).map(|k| 0.05 * f64::from(k)).collect();
        let poles = [
            Pole {
                frequency_hz: 100.0,
                damping_ratio: 0.01,
            },
            Pole {
                frequency_hz: 700.0,
                damping_ratio: 0.002,
            },
        ];
        let lines = select_lines(&frequency_hz, &poles);
        assert!(lines.len() < 1200, "{}", lines.len());
        for pole in poles {
            let is_near = |hz: f64| {
                (hz - pole.frequency_hz).abs()
                    < NEAR_POLE_HALF_WIDTHS * pole.damping_ratio * pole.frequency_hz
            };
            let near_count = frequency_hz.iter().filter(|hz| is_near(**hz)).count();
            assert_eq!(
                lines.iter().filter(|k| is_near(frequency_hz[**k])).count(),
                near_count
            );
        }
        let widest_gap = lines
            .windows(2)
            .map(|pair| frequency_hz[pair[1]] - frequency_hz[pair[0]])
            .fold(0.0, f64::max);
        assert!(widest_gap < 13.0, "{widest_gap}");
        assert_eq!(select_lines(&frequency_hz[..4000], &poles).len(), 4000);
    }
}
