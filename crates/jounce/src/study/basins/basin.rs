//! Marches a cloud until every start is recognised, and counts.

use super::Starts;
use super::expected::expected_power_w;
use super::fate::{Fate, late_state};
use super::lyapunov::{Lyapunov, Wandering};
use super::share::{Share, wilson};
use super::signature::{Signature, letters};
use crate::march::{Kernel, MarchError};
use crate::orbit::{Harvester, Orbit};
use crate::run::{Exceeded, Limits, RunError, check_outside};
use crate::study::orbit_limits::{passed_by_orbit, passed_over};
use crate::study::{Parameter, Prepared, StudyError};
use rayon::prelude::*;

/// Drive cycles over which a motion without a period is held against limits.
const LATE_CYCLES: u32 = 64;

/// A cloud to be marched.
#[derive(Debug)]
pub struct Basins<'s> {
    /// The spec.
    pub base: &'s Prepared,
    /// Its harvester, as one value of any key.
    pub parameter: &'s Parameter<'s>,
    /// That value.
    pub value: f64,
    /// From where it starts.
    pub starts: Starts,
    /// Relative tolerance of the marches.
    pub tolerance: f64,
}

/// An attractor with its share of the cloud.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Drive cycles of its period and a letter by falling power: `1a`, `1b`, `2a`; `chaos`; `torus`; `unsettled`.
    pub id: String,
    /// Drive cycles of the period; 0 for none.
    pub period_cycles: u32,
    /// True when neighbouring motions part exponentially.
    pub chaotic: bool,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Contacts per period; 0 for none.
    pub contacts_per_period: u64,
    /// The orbit, where there is one.
    pub orbit: Option<Orbit>,
    /// Largest Lyapunov exponent and its error, 1/s, where there is no orbit.
    pub lyapunov: Option<(f64, f64)>,
    /// Share of the cloud, 95 %.
    pub share: Share,
    /// Numbers of the starts that end here.
    pub starts: Vec<usize>,
    /// Limits of patches that it passes.
    pub exceeded: Vec<Exceeded>,
}

/// What a cloud answers.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsAnswer {
    /// Attractors: orbits by period and falling power, then chaos, tori, and what was still settling.
    pub attractors: Vec<Attractor>,
    /// `sum fraction power`, W.
    pub expected_power_w: f64,
    /// Lower end of its 95 % interval, W; it allows for an answer that no start came to and that gives nothing.
    pub expected_power_low_w: f64,
    /// Upper end among the answers that were seen, W.
    pub expected_power_high_w: f64,
    /// Starts whose march failed, with the reason.
    pub lost: Vec<(usize, String)>,
}

impl Basins<'_> {
    /// Marches all starts, in parallel; `done` hears of each that is finished. Stopped by its watch it answers from those that are.
    ///
    /// # Errors
    /// A harvester that cannot be made.
    pub fn run(&self, done: &(dyn Fn() + Sync)) -> Result<BasinsAnswer, StudyError> {
        let kernel = self.parameter.at(self.value)?.kernel;
        let watch = &self.base.kernel.watch;
        watch.expect(self.starts.len());
        let finished = |index: usize| {
            if watch.is_stopped() {
                return None;
            }
            let start = self.starts.start(&kernel.plant, index);
            let fate = match check_outside(&kernel.plant, &start[..kernel.plant.system.modes.len()]) {
                Ok(()) => Fate::of(self.parameter, (&kernel, self.value), &start, self.tolerance),
                Err(inside) => Fate::Lost(inside.to_string()),
            };
            watch.count();
            done();
            (!watch.is_stopped()).then_some((index, fate))
        };
        let fates: Vec<(usize, Fate)> = (0..self.starts.len()).into_par_iter().filter_map(finished).collect();
        let mut answer = answer(&fates);
        let limits = Limits::of(&self.base.spec, &kernel.plant);
        for attractor in answer.attractors.iter_mut().filter(|_| !limits.is_empty() && !watch.is_stopped()) {
            let fate = fates.iter().find(|(index, _)| attractor.starts.first() == Some(index)).map(|(_, fate)| fate);
            attractor.exceeded = self.passed(&limits, &kernel, fate, &attractor.starts).map_err(RunError::from)?;
        }
        Ok(answer)
    }

    /// The limits that an attractor passes: over its period, or over some cycles late on the way of its first start.
    fn passed(&self, limits: &Limits, kernel: &Kernel, fate: Option<&Fate>, starts: &[usize]) -> Result<Vec<Exceeded>, MarchError> {
        match (fate, starts.first()) {
            (Some(Fate::Orbit(orbit)), _) => passed_by_orbit(limits, (self.parameter, kernel), orbit, self.tolerance),
            (_, Some(start)) => {
                let start = self.starts.start(&kernel.plant, *start);
                let state = late_state(kernel, &start, self.tolerance)?;
                passed_over(limits, kernel, &state, LATE_CYCLES, self.tolerance)
            }
            (_, None) => Ok(Vec::new()),
        }
    }
}

fn answer(fates: &[(usize, Fate)]) -> BasinsAnswer {
    let mut orbits: Vec<(&Orbit, Vec<usize>)> = Vec::new();
    let mut wanderers: Vec<(usize, Lyapunov)> = Vec::new();
    let mut lost: Vec<(usize, String)> = Vec::new();
    for (index, fate) in fates {
        let index = *index;
        match fate {
            Fate::Orbit(orbit) => match orbits.iter_mut().find(|(known, _)| Signature::of(known).is(&Signature::of(orbit))) {
                Some((_, starts)) => starts.push(index),
                None => orbits.push((orbit, vec![index])),
            },
            Fate::Wandering(found) => wanderers.push((index, *found)),
            Fate::Lost(why) => lost.push((index, why.clone())),
        }
    }
    let of = fates.len() - lost.len();
    orbits.sort_by(|(a, _), (b, _)| a.period_cycles.cmp(&b.period_cycles).then(b.mean_power_w.total_cmp(&a.mean_power_w)));
    let mut attractors: Vec<Attractor> = Vec::new();
    for (orbit, starts) in orbits {
        let place = attractors.iter().filter(|known| known.period_cycles == orbit.period_cycles).count();
        attractors.push(Attractor {
            id: format!("{}{}", orbit.period_cycles, letters(place)),
            period_cycles: orbit.period_cycles,
            chaotic: false,
            mean_power_w: orbit.mean_power_w,
            contacts_per_period: orbit.contacts,
            orbit: Some(orbit.clone()),
            lyapunov: None,
            share: wilson(starts.len(), of),
            starts,
            exceeded: Vec::new(),
        });
    }
    for kind in [Wandering::Chaos, Wandering::Torus, Wandering::Unsettled] {
        let own: Vec<(usize, Lyapunov)> = wanderers.iter().copied().filter(|(_, found)| found.wandering() == kind).collect();
        attractors.extend(wandering(kind, &own, of));
    }
    let seen: Vec<(usize, f64)> = attractors.iter().map(|a| (a.starts.len(), a.mean_power_w)).collect();
    let [expected_power_w, expected_power_low_w, expected_power_high_w] = expected_power_w(&seen);
    BasinsAnswer { attractors, expected_power_w, expected_power_low_w, expected_power_high_w, lost }
}

fn wandering(kind: Wandering, found: &[(usize, Lyapunov)], of: usize) -> Option<Attractor> {
    let count = found.len() as f64;
    let mean = |value: fn(&Lyapunov) -> f64| found.iter().map(|(_, found)| value(found)).sum::<f64>() / count;
    (!found.is_empty()).then(|| Attractor {
        id: kind.name().to_owned(),
        period_cycles: 0,
        chaotic: kind == Wandering::Chaos,
        mean_power_w: mean(|found| found.mean_power_w),
        contacts_per_period: 0,
        orbit: None,
        lyapunov: Some((mean(|found| found.exponent_per_s), mean(|found| found.error_per_s) / count.sqrt())),
        share: wilson(found.len(), of),
        starts: found.iter().map(|(index, _)| *index).collect(),
        exceeded: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit(period_cycles: u32, mean_power_w: f64) -> Fate {
        Fate::Orbit(Orbit { mean_power_w, ..Orbit::of_cycles(period_cycles) })
    }

    #[test]
    fn shares_and_expected_power_are_counted() {
        let fates = [orbit(1, 2.0), orbit(1, 1.0), orbit(2, 4.0), orbit(1, 1.0 + 1e-9)];
        let found = answer(&fates.into_iter().enumerate().collect::<Vec<_>>());
        let ids: Vec<&str> = found.attractors.iter().map(|a| a.id.as_str()).collect();
        assert_eq!(ids, ["1a", "1b", "2a"]);
        assert_eq!(found.attractors[1].starts, [1, 3]);
        assert!((found.expected_power_w - 2.0).abs() < 1e-9 && found.expected_power_low_w < 2.0);
    }
}
