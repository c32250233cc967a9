//! A stable orbit that a march is drawn to.

use crate::orbit::Orbit;
use faer::{Col, ColRef, Mat};

/// Times in a row that the march must come nearer to an orbit to be taken as drawn to it: a transient passes by others on its way.
const NEARER: u32 = 2;

/// Distance from the orbit, beside the size of the state, that needs no such proof.
const THERE: f64 = 1e-6;

/// How much nearer an orbit of a longer period must be than one of a shorter, and a march than it was to go on without a new search.
const CLEARLY: f64 = 0.5;

/// Share of a change foretold by the multipliers of an orbit by which the true one may differ to be told by it. A march that is drawn to
/// another orbit close by, of a longer period, changes by nothing over that.
const TOLD: f64 = 0.3;

/// An orbit, and how near a march has come to it.
pub struct Candidate {
    /// The orbit.
    pub orbit: Orbit,
    /// Distance of the march beside the size of its state.
    distance: f64,
    /// Times in a row that it came nearer.
    nearer: u32,
    /// Derivative of the flow over the period, energy coordinates.
    map: Mat<f64>,
}

impl Candidate {
    /// At a distance, with the derivative of the flow over its period.
    pub fn new(orbit: Orbit, distance: f64, map: Mat<f64>) -> Self {
        Self { orbit, distance, nearer: 0, map }
    }

    /// This one, or one of a longer period that the march is clearly nearer to.
    pub fn or(self, longer: Self) -> Self {
        if longer.distance < CLEARLY * self.distance { longer } else { self }
    }

    /// The next one found, after the one before.
    pub fn after(self, before: Option<Self>) -> Self {
        let same = |known: &Orbit| {
            let (own_w, power_w) = (self.orbit.mean_power_w, known.mean_power_w);
            known.period_cycles == self.orbit.period_cycles && (power_w - own_w).abs() <= 1e-5 * own_w.abs()
        };
        let nearer = before.filter(|before| same(&before.orbit) && self.distance < before.distance).map_or(0, |before| before.nearer + 1);
        Self { nearer, ..self }
    }

    /// Whether what a march near the orbit does over a number of cycles, from one state to another (energy coordinates), is what the
    /// orbit makes of its distance.
    pub fn tells(&self, [from, to]: [&[f64]; 2], cycles: u32) -> bool {
        if !cycles.is_multiple_of(self.orbit.period_cycles) {
            return false;
        }
        let (from, to) = (ColRef::from_slice(from), ColRef::from_slice(to));
        let away = from - ColRef::from_slice(self.orbit.start());
        let later = (0..cycles / self.orbit.period_cycles).fold(away.clone(), |away: Col<f64>, _| &self.map * &away);
        let change = &later - &away;
        let left = to - from - &change;
        left.norm_l2() < TOLD * change.norm_l2()
    }

    /// Counts a march that has clearly come nearer, at whichever cycle of the orbit its state is (energy coordinates); false where it has
    /// not, so that an orbit has to be found anew.
    pub fn is_approached(&mut self, state: &[f64]) -> bool {
        let state = ColRef::from_slice(state);
        let apart = |look: &Vec<f64>| (ColRef::from_slice(look) - state).norm_l2();
        let distance = self.orbit.looks.iter().map(apart).fold(f64::INFINITY, f64::min) / state.norm_l2();
        let is_nearer = distance < THERE || distance < CLEARLY * self.distance;
        if is_nearer {
            (self.distance, self.nearer) = (distance, self.nearer + 1);
        }
        is_nearer
    }

    /// Whether the march is drawn to it.
    pub fn is_certain(&self) -> bool {
        self.nearer >= NEARER || self.distance < THERE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An orbit at 1 with a multiplier of -0.9: two periods on, a march has come nearer by 0.81. One that comes back to the same place is
    /// drawn to an orbit of twice the period.
    #[test]
    fn a_change_that_an_orbit_foretells_is_its_own() {
        let orbit = Orbit { looks: vec![vec![1.0]; 2], ..Orbit::of_cycles(1) };
        let mut known = Candidate::new(orbit, 0.01, Mat::from_fn(1, 1, |_, _| -0.9));
        assert!(known.tells([&[1.01], &[1.0081]], 2) && !known.tells([&[1.01], &[1.01]], 2));
        assert!(!known.is_approached(&[1.009]) && known.is_approached(&[1.004]) && !known.is_certain());
        assert!(known.is_approached(&[1.001]) && known.is_certain());
    }
}
