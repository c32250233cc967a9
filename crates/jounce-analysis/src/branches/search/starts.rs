//! Orbits on which integrations settle, from which branches are followed.

use super::BranchSearch;
use super::ramp_down::ramped_down_start;
use crate::branches::branch_tracer::tracer::BranchTracer;
use crate::branches::warm_start::KnownOrbit;
use crate::settled_orbits;
use jounce_orbits::{Orbit, ParametricModel};
use rayon::prelude::*;

/// Initial state of an integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SearchStart {
    /// At rest.
    Rest,
    /// Steady state without the stop; without contact it is exactly the low branch.
    Steady,
    /// Shape of the stop's port with a large velocity towards it.
    Kicked,
    /// End of a ramp down from a stronger drive; omitted for zero seeds.
    Eased,
}

/// Initial velocity relative to the steady motion.
const KICK_SPEED: f64 = 20.0;

/// Tolerance of integrations that only compute initial states.
const COARSE_TOLERANCE: f64 = 1e-6;

impl BranchSearch<'_> {
    /// Returns the settled orbits, shorter periods first: at the lower end, the upper end, then
    /// across the range.
    pub(super) fn starts(&self) -> Vec<(Orbit, f64)> {
        let (low, high) = self.range;
        let inner =
            (1..=self.seeds).map(|k| low + (high - low) * k as f64 / (self.seeds + 1) as f64);
        let values: Vec<f64> = [low, high].into_iter().chain(inner).collect();
        let kinds = [
            SearchStart::Rest,
            SearchStart::Steady,
            SearchStart::Kicked,
            SearchStart::Eased,
        ];
        // Without seeds only the orbits of a plain integration.
        let kinds = &kinds[..if self.seeds > 0 { 4 } else { 3 }];
        let control = &self.base.kernel.control;
        control.expect(values.len());
        let settled = |value: &f64| -> Vec<(SearchStart, (Orbit, f64))> {
            let starts = kinds
                .iter()
                .filter_map(|kind| Some((*kind, self.start(*value, *kind)?)));
            let (kinds, starts): (Vec<SearchStart>, Vec<Vec<f64>>) = starts.unzip();
            let orbits = settled_orbits(self.parameter, *value, &starts, self.tolerance);
            control.count();
            let mut with_starts: Vec<(SearchStart, (Orbit, f64))> = Vec::new();
            for (kind, orbit) in kinds.into_iter().zip(orbits) {
                let fresh =
                    orbit.filter(|orbit| !with_starts.iter().any(|(_, (known, _))| known == orbit));
                with_starts.extend(fresh.map(|orbit| (kind, (orbit, *value))));
            }
            with_starts
        };
        let mut with_starts: Vec<(SearchStart, (Orbit, f64))> =
            values.par_iter().flat_map_iter(settled).collect();
        // The ramped starts are last, so they only add to the others.
        with_starts
            .sort_by_key(|(kind, (orbit, _))| (orbit.period_cycles, *kind == SearchStart::Eased));
        with_starts.into_iter().map(|(_, orbit)| orbit).collect()
    }

    /// Returns the orbits of this model next to those of a neighbouring one, each at its own value
    /// of the key. Those at which Newton's method fails are omitted.
    pub(super) fn corrected(
        &self,
        tracer: &BranchTracer,
        known: &[KnownOrbit],
    ) -> Vec<(Orbit, f64)> {
        let corrected = |orbit: &KnownOrbit| {
            let shooting = self.shooting(orbit.period_cycles);
            let parameter = orbit.parameter.clamp(self.range.0, self.range.1);
            let corrected = orbit.corrected(tracer, &shooting, parameter)?;
            Some((corrected, parameter))
        };
        known.par_iter().filter_map(corrected).collect()
    }

    /// Returns the physical state of a start.
    fn start(&self, value: f64, start: SearchStart) -> Option<Vec<f64>> {
        let kernel = self.parameter.at(value).ok()?.kernel;
        let plant = &kernel.plant;
        let mut state = vec![0.0; plant.len()];
        match start {
            SearchStart::Rest => {}
            SearchStart::Eased => {
                state = ramped_down_start(&kernel, self.tolerance.max(COARSE_TOLERANCE))?
            }
            SearchStart::Steady => state = plant.to_physical(&state, 0.0),
            SearchStart::Kicked => {
                let w = plant.tones.first()?.angular_frequency_rad_s;
                let n = plant.system.modes.len();
                let speed = KICK_SPEED * w * plant.scale_m();
                // Towards every stop at once.
                for stop in &plant.system.stops {
                    let square: f64 = stop.shape.iter().map(|s| s * s).sum();
                    stop.shape
                        .iter()
                        .enumerate()
                        .for_each(|(i, s)| state[n + i] += s / square * speed);
                }
            }
        }
        Some(state)
    }
}
