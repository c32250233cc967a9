//! Stretch of the motion of an attractor without a period.

use super::attractor_place::AttractorPlace;
use crate::error::Error;
use crate::live::LiveAnalysis;
use jounce_analysis::{KeyLine, SectionPoint};
use jounce_control::Control;
use jounce_orbits::{ParametricModel, Shooting};
use serde::Serialize;

/// Drive cycles of the stretch.
const CYCLES: u32 = 500;
/// Drive cycles of the time history, from the start of the stretch.
const HISTORY_CYCLES: usize = 20;
/// Samples of a drive cycle of the time history.
const SAMPLES_PER_CYCLE: usize = 96;
/// Relative tolerance of the integration.
const TOLERANCE: f64 = 1e-9;

/// Motion over some drive cycles from the last state of a start that reached the attractor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AperiodicMotion {
    /// Drive cycles of the stretch.
    pub cycles: u32,
    /// Drive cycles of the time history.
    pub history_cycles: usize,
    /// Mean power of all loads over the stretch, W.
    pub mean_power_w: f64,
    /// Gap of the first stop, m; `None` without a stop.
    pub gap_m: Option<f64>,
    /// Poincaré section: the motion at the start of each drive cycle of the stretch.
    pub section: Vec<SectionPoint>,
    /// Times of the time history, s.
    pub time_s: Vec<f64>,
    /// Motion at these times.
    pub history: Vec<SectionPoint>,
}

impl LiveAnalysis {
    /// Integrates a stretch of the motion of a stored attractor without a period.
    ///
    /// # Errors
    /// [`Error::Option`] for an attractor that is no longer stored or has a period,
    /// [`Error::Orbit`] where the integration fails.
    pub fn aperiodic_motion(
        &self,
        place: &AttractorPlace,
        control: &Control,
    ) -> Result<AperiodicMotion, Error> {
        let (spec, state) = self.stored_last_state(place)?;
        let base = self.model(&spec, control)?;
        let line = KeyLine::at(&base);
        let kernel = line.at(0.0)?.kernel;
        let shooting = Shooting::new(&line, &base.kernel, CYCLES, TOLERANCE);
        let motion = shooting.integrated(kernel, &shooting.unknown(&state))?;
        let (plant, cycle_s) = (&motion.kernel.plant, motion.cycle_s());
        let section = |state: &[f64]| SectionPoint::of(&plant.system, state);
        let times_s: Vec<f64> = (0..SAMPLES_PER_CYCLE)
            .map(|k| cycle_s * k as f64 / SAMPLES_PER_CYCLE as f64)
            .collect();
        let cycles = motion.trajectories.iter().take(HISTORY_CYCLES);
        let instants = cycles.flat_map(|cycle| cycle.at(&motion.kernel, &times_s));
        let history = instants.map(|own| section(&plant.to_physical(&own.state, own.time_s)));
        let strobe_states = motion.strobe_states.iter();
        Ok(AperiodicMotion {
            cycles: CYCLES,
            history_cycles: HISTORY_CYCLES,
            mean_power_w: motion.loads_w.iter().sum(),
            gap_m: plant.system.stops.first().map(|stop| stop.gap_m),
            section: strobe_states
                .map(|own| section(&shooting.physical(own)))
                .collect(),
            time_s: (0..HISTORY_CYCLES)
                .flat_map(|cycle| times_s.iter().map(move |t| cycle as f64 * cycle_s + t))
                .collect(),
            history: history.collect(),
        })
    }
}
