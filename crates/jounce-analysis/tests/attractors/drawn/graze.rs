//! Stops at the peaks of a motion: the hardest contacts to find.

use super::system::{Drawn, plant};
use super::with_model;
use crate::brute::{Flow, Peak, ReferenceModel, STEP_TOLERANCE};
use jounce_model::contact::Law;
use jounce_model::plant::System;

/// Stop whose gap is the peak of the motion without it, changed by a small part.
#[derive(Debug, Clone, Copy)]
pub struct Graze {
    pub peak: Peak,
    /// Depth of the peak past the stop, relative to its displacement; negative before the stop.
    pub depth: f64,
}

impl Drawn {
    /// Keeps the first stop alone and sets its gap to one of the highest peaks of the free motion,
    /// less a part `depth` of it.
    pub fn graze(&mut self, mut system: System, depth: f64) -> Result<(), String> {
        let duration_s = self.cycles.min(3) as f64 / self.merged.drives[0].frequency_hz;
        let peaks = with_model!(&self.merged, free_peaks, &self.start, duration_s);
        let acts_on_both_sides = matches!(self.merged.stops[0].law, Law::Cubic(_));
        let highest = peaks
            .iter()
            .copied()
            .max_by(|a, b| a.displacement_m.total_cmp(&b.displacement_m));
        // The last one is the end of the motion.
        let is_inside = |peak: &Peak| peak.acceleration_m_s2 < 0.0;
        let Some(peak) = highest.filter(|peak| is_inside(peak) && !acts_on_both_sides) else {
            return Ok(());
        };
        let start_m: f64 = (self.merged.stops[0].shape.iter().zip(&self.start))
            .map(|(s, q)| s * q)
            .sum();
        if peak.displacement_m <= start_m.max(0.0) * (1.0 + 1e-3) {
            return Ok(());
        }
        let gap_m = peak.displacement_m * (1.0 - depth);
        system.stops.truncate(1);
        self.merged.stops.truncate(1);
        system.stops[0].gap_m = gap_m;
        self.merged.stops[0].gap_m = gap_m;
        self.plant = plant(&system)?;
        self.graze = Some(Graze { peak, depth });
        Ok(())
    }
}

fn free_peaks<const N: usize, const D: usize>(
    model: &ReferenceModel<N, D>,
    start: &[f64],
    duration_s: f64,
) -> Vec<Peak> {
    let flow = Flow {
        model,
        tolerance: STEP_TOLERANCE,
        has_series: true,
    };
    flow.free_peaks(0, model.state(start), duration_s)
}
