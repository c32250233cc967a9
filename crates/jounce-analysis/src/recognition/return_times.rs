//! Return times of a motion: numbers of drive cycles after which it returns near its present state.

use std::collections::VecDeque;

/// Largest ratio of the distance of a shorter return to the nearest one, for a trial. A motion that
/// spirals towards an orbit is nearest to itself after a full turn of the spiral, which is a
/// multiple of the period.
const COMPARABLE_RETURN_RATIO: f64 = 4.0;

/// Last states at the start of a drive cycle.
#[derive(Debug)]
pub struct ReturnTimes {
    states: VecDeque<Vec<f64>>,
    longest: usize,
}

impl ReturnTimes {
    /// Creates a record for returns after up to `longest` cycles.
    pub fn up_to(longest: u32) -> Self {
        Self {
            states: VecDeque::new(),
            longest: longest as usize,
        }
    }

    /// Adds the state one cycle after the last one.
    pub fn push(&mut self, state: Vec<f64>) {
        // Three periods are stored: the change of the distance over one of them shows the
        // contraction.
        if self.states.len() > 3 * self.longest {
            self.states.pop_back();
        }
        self.states.push_front(state);
    }

    /// Returns the distance of the state `back` cycles ago from the state `cycles` earlier; `None`
    /// where one of them is not stored.
    pub fn distance(&self, back: usize, cycles: u32) -> Option<f64> {
        let (now, before) = (
            self.states.get(back)?,
            self.states.get(back + cycles as usize)?,
        );
        Some(jounce_linalg::distance(before, now))
    }

    /// Returns at most two periods for a trial: the shortest return that is nearly as close as the
    /// nearest, and the nearest.
    pub fn periods(&self) -> Vec<u32> {
        let distances: Vec<f64> = (1..=self.longest as u32)
            .map_while(|cycles| self.distance(0, cycles))
            .collect();
        let nearest = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let first = |bound: f64| {
            distances
                .iter()
                .position(|distance| *distance <= bound)
                .map(|index| index as u32 + 1)
        };
        let mut periods: Vec<u32> = [first(COMPARABLE_RETURN_RATIO * nearest), first(nearest)]
            .into_iter()
            .flatten()
            .collect();
        periods.dedup();
        periods
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spiral with multipliers `0.9 exp(+-2 pi i / 3)` about an orbit of one cycle is nearest to itself after three.
    #[test]
    fn spiral_returns_after_a_full_turn_and_shorter_periods_come_first() {
        let mut times = ReturnTimes::up_to(12);
        for k in 0..40 {
            let (radius, angle) = (0.98_f64.powi(k), f64::from(k) * std::f64::consts::TAU / 3.0);
            times.push(vec![1.0 + radius * angle.cos(), radius * angle.sin()]);
        }
        assert_eq!(times.periods(), [3]);
        let mut times = ReturnTimes::up_to(12);
        (0..40).for_each(|k| times.push(vec![1.0 + 0.9_f64.powi(k)]));
        assert_eq!(times.periods(), [1]);
        assert!(times.distance(39, 1).is_none());
    }

    /// Period 18, which divides 72: the shorter returns are far away.
    #[test]
    fn long_period_is_found_first() {
        let mut times = ReturnTimes::up_to(64);
        (0..100).for_each(|k| {
            times.push(vec![
                (f64::from(k % 18) * 1.7).sin(),
                1e-6 * 0.5_f64.powi(k),
            ])
        });
        assert_eq!(times.periods(), [18]);
    }
}
