//! Periodic orbit and its stability.

use jounce_linalg::{Mat, c64, norm};

/// Distance, relative to the size of the states, below which two states of an orbit are identical.
const SAME_STATE_DISTANCE: f64 = 1e-5;

/// Periodic orbit with its stability and its results.
#[derive(Debug, Clone, PartialEq)]
pub struct Orbit {
    /// Period in drive cycles.
    pub period_cycles: u32,
    /// States at the start of each drive cycle and at the end of the last, energy coordinates `(w q, q', sqrt(C) V)`.
    pub strobe_states: Vec<Vec<f64>>,
    /// Mean power of all loads and rectified circuits, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load or, without a load, of the storage or load of the first
    /// rectified circuit, V. NaN where no element takes power.
    pub voltage_rms_v: f64,
    /// Contacts that begin in a period.
    pub contacts: u64,
    /// Conduction state changes of rectified circuits in a period.
    pub switches: u64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Largest magnitude of a contact force, N; 0 without contact.
    pub max_contact_force_n: f64,
    /// Largest impact speed of the contacts that begin in a period, m/s; 0 without one.
    pub max_impact_velocity_m_s: f64,
    /// Half the peak-to-peak displacement at the first stop, m; 0 without a stop.
    pub displacement_peak_m: f64,
    /// Floquet multipliers, largest modulus first. The multiplier of a charge that is conserved
    /// over the period is 0. The list is empty where the motion sticks to a rigid stop, because the
    /// flow has no derivative there.
    pub multipliers: Vec<c64>,
    /// Estimated error, the larger one of the state at the start and of the mean power, each
    /// relative to its size.
    pub error_estimate: f64,
}

impl Orbit {
    /// Returns an orbit of some cycles for tests that set the fields they check.
    #[cfg(test)]
    fn of_cycles(period_cycles: u32) -> Self {
        Self {
            period_cycles,
            strobe_states: Vec::new(),
            mean_power_w: 0.0,
            voltage_rms_v: 0.0,
            contacts: 1,
            switches: 0,
            max_penetration_m: 0.0,
            max_contact_force_n: 0.0,
            max_impact_velocity_m_s: 0.0,
            displacement_peak_m: 0.0,
            multipliers: Vec::new(),
            error_estimate: 0.0,
        }
    }

    /// Returns the largest modulus of a multiplier.
    pub fn floquet_max_abs(&self) -> f64 {
        self.multipliers.first().map_or(0.0, |value| value.norm())
    }

    /// True when all multipliers lie inside the unit circle.
    pub fn is_stable(&self) -> bool {
        self.floquet_max_abs() < 1.0
    }

    /// True when the largest modulus differs from one by no more than the error of the orbit, so
    /// that stability is undecided.
    pub fn is_stability_undecided(&self) -> bool {
        !self.multipliers.is_empty() && (self.floquet_max_abs() - 1.0).abs() <= self.error_estimate
    }

    /// Returns the state at the start of the period, energy coordinates.
    pub fn start(&self) -> &[f64] {
        &self.strobe_states[0]
    }

    /// Returns the norm of the state at the start of the period.
    pub fn size(&self) -> f64 {
        norm(self.start())
    }

    /// Returns the change of the state over half a period; `None` for an odd number of cycles.
    pub fn half_period_difference(&self) -> Option<Vec<f64>> {
        let half = self.period_cycles as usize / 2;
        (self.period_cycles.is_multiple_of(2)).then(|| {
            self.strobe_states[half]
                .iter()
                .zip(&self.strobe_states[0])
                .map(|(a, b)| a - b)
                .collect()
        })
    }

    /// True when the orbit repeats after fewer cycles than its period.
    pub fn repeats_early(&self) -> bool {
        self.shorter_period().is_some()
    }

    /// Returns the smallest number of cycles, fewer than the period, after which the orbit repeats.
    pub fn shorter_period(&self) -> Option<u32> {
        self.shorter_period_within(SAME_STATE_DISTANCE)
    }

    /// Returns the smallest number of cycles, fewer than the period, after which the state is nearer
    /// to the start than a distance relative to the size of the orbit.
    pub fn shorter_period_within(&self, distance: f64) -> Option<u32> {
        let repeats = |shorter: &u32| {
            let state = self.strobe_states.get(*shorter as usize);
            state.is_some_and(|state| {
                jounce_linalg::distance(state, self.start()) < distance * self.size()
            })
        };
        (1..self.period_cycles)
            .filter(|shorter| self.period_cycles.is_multiple_of(*shorter))
            .find(repeats)
    }

    /// Returns `det(M - s I)` up to a positive factor, for `s` of modulus one.
    pub fn determinant_at(&self, s: f64) -> f64 {
        self.multipliers
            .iter()
            .map(|value| *value - s)
            .product::<c64>()
            .re
    }

    /// Returns the number of multipliers outside the unit circle.
    pub fn outside_count(&self) -> usize {
        outside_count(&self.multipliers)
    }

    /// True where an odd number of multipliers passes `s` (+1 or -1) on the way to another orbit.
    pub fn passes(&self, s: f64, to: &Orbit) -> bool {
        self.determinant_at(s) * to.determinant_at(s) < 0.0
    }

    /// True where a complex pair of multipliers crosses the unit circle on the way to another orbit.
    ///
    /// Multipliers cross it in pairs at a Neimark-Sacker point, and singly at +1 and -1. Where two
    /// real ones meet, their number outside stays the same.
    pub fn pair_crosses_circle(&self, to: &Orbit) -> bool {
        let single = [1.0, -1.0].map(|s| usize::from(self.passes(s, to)));
        self.outside_count().abs_diff(to.outside_count()) >= 2 + single[0] + single[1]
    }
}

/// Returns the distance from the unit circle to the nearest complex pair; 1 without a pair.
pub fn nearest_pair_to_circle(multipliers: &[c64]) -> f64 {
    let pairs = multipliers.iter().filter(|value| value.im > 1e-9);
    pairs
        .map(|value| (value.norm() - 1.0).abs())
        .fold(1.0, f64::min)
}

/// Returns the number of multipliers outside the unit circle.
pub fn outside_count(multipliers: &[c64]) -> usize {
    multipliers
        .iter()
        .filter(|value| value.norm_sqr() > 1.0)
        .count()
}

/// Returns `det(M - s I)` of a period map: zero where `s` is a multiplier.
pub fn determinant_at(map: &Mat<f64>, s: f64) -> f64 {
    jounce_linalg::determinant(&Mat::from_fn(map.nrows(), map.ncols(), |i, j| {
        map[(i, j)] - if i == j { s } else { 0.0 }
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two real multipliers meet outside the circle while a complex pair enters it.
    #[test]
    fn a_pair_is_seen_to_cross_where_two_real_multipliers_meet_outside() {
        let orbit = |values: &[(f64, f64)]| Orbit {
            multipliers: values.iter().map(|(re, im)| c64::new(*re, *im)).collect(),
            ..Orbit::of_cycles(1)
        };
        let before = orbit(&[(2.6, 0.0), (1.2, 0.0), (0.0, 1.01), (0.0, -1.01)]);
        let after = orbit(&[(1.7, 0.1), (1.7, -0.1), (0.0, 0.99), (0.0, -0.99)]);
        let only_met = orbit(&[(1.7, 0.1), (1.7, -0.1), (0.0, 1.01), (0.0, -1.01)]);
        assert!(before.pair_crosses_circle(&after) && !before.pair_crosses_circle(&only_met));
        // One that passes +1 and one that passes -1 are no pair.
        let (inside, outside) = (
            orbit(&[(0.9, 0.0), (-0.9, 0.0)]),
            orbit(&[(1.1, 0.0), (-1.1, 0.0)]),
        );
        assert!(!inside.pair_crosses_circle(&outside) && inside.passes(1.0, &outside));
    }

    #[test]
    fn a_multiplier_within_the_error_of_one_decides_nothing() {
        let orbit = |modulus: f64, error_estimate: f64| Orbit {
            multipliers: vec![c64::new(-modulus, 0.0)],
            error_estimate,
            ..Orbit::of_cycles(8)
        };
        assert!(
            orbit(1.0 + 1e-9, 1e-8).is_stability_undecided()
                && orbit(1.0 - 1e-9, 1e-8).is_stability_undecided()
        );
        assert!(
            !orbit(1.0 + 1e-7, 1e-8).is_stability_undecided()
                && !Orbit::of_cycles(1).is_stability_undecided()
        );
    }
}
