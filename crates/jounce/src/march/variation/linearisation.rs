//! The way along a recorded march, step by step.

use super::VariationError;
use super::drift::Drift;
use super::elimination::NodeSystem;
use super::tangents::Tangents;
use crate::contact::Law;
use crate::march::kernel::Kernel;
use crate::march::tone::Turning;
use crate::march::trajectory::{Segment, Trajectory};
use crate::wide::{Lane, Task, Wide};

/// A march to be linearised.
pub struct Linearisation<'a> {
    pub(super) kernel: &'a Kernel,
    pub(super) drift: &'a Drift,
    trajectory: &'a Trajectory,
    end: &'a [f64],
    pub(super) tangents: Tangents,
    /// Of the contact step in hand.
    pub(super) system: NodeSystem,
    /// Factors of each row of tangents in the right sides of the system.
    pub(super) factors: Vec<Lane>,
    /// The state at the start of the step in hand.
    pub(super) packed: Vec<Lane>,
    /// The drives.
    pub(super) tones: Vec<Turning>,
    /// Flight not yet applied, s.
    pending_s: f64,
}

impl<'a> Linearisation<'a> {
    /// From the start of a record; `end` is the state at its end.
    pub fn new(kernel: &'a Kernel, drift: &'a Drift, trajectory: &'a Trajectory, end: &'a [f64]) -> Self {
        let tangents = Tangents::identity(kernel.plant.len());
        let (system, factors) = (NodeSystem::new(tangents.width), vec![Lane::ZERO; kernel.plant.len()]);
        let port = kernel.plant.ports.first();
        let tones = (kernel.plant.tones.iter().enumerate())
            .filter_map(|(k, tone)| Some(Turning::new(tone.angular_frequency_rad_s, port?.steady_m[k], 0.0)))
            .collect();
        let packed = vec![Lane::ZERO; kernel.layout.lanes()];
        Self { kernel, drift, trajectory, end, tangents, system, factors, packed, tones, pending_s: 0.0 }
    }

    /// Passes one step; `after` is the state at its end, `strikes` says that a contact follows.
    #[inline(always)]
    fn segment<W: Wide>(&mut self, w: W, segment: &Segment, after: &[f64], strikes: bool) -> Result<(), VariationError> {
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        if segment.force.is_some() {
            self.fly(w);
        }
        match (segment.force, law) {
            (Some(_), Some(Law::Rigid(_))) => return Err(VariationError::Rests { time_s: segment.start_s }),
            (Some(force), Some(Law::Hertz(law))) => self.contact(w, law, segment, force, after),
            (Some(force), Some(Law::KelvinVoigt(law))) => self.contact(w, law, segment, force, after),
            (Some(force), Some(Law::HuntCrossley(law))) => self.contact(w, law, segment, force, after),
            (Some(force), Some(Law::Cubic(law))) => self.contact(w, law, segment, force, after),
            (_, law) => {
                self.pending_s += segment.length_s;
                match law {
                    Some(Law::KelvinVoigt(law)) if strikes => self.strike(w, law, segment),
                    Some(Law::Rigid(_)) => self.impact(w, segment, after),
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Applies the flight that has gathered.
    #[inline(always)]
    pub(super) fn fly<W: Wide>(&mut self, w: W) {
        if self.pending_s == 0.0 {
            return;
        }
        let block = &self.kernel.plant.diagonal.block;
        for (k, pair) in block.pairs.iter().enumerate() {
            self.tangents.turn(w, k, pair.flow(self.pending_s));
        }
        for (k, rate) in block.reals.iter().enumerate() {
            self.tangents.decay(w, 2 * block.pairs.len() + k, (rate * self.pending_s).exp());
        }
        self.pending_s = 0.0;
    }
}

impl Task for Linearisation<'_> {
    type Output = Result<Tangents, VariationError>;

    #[inline(always)]
    fn run<W: Wide>(mut self, w: W) -> Self::Output {
        let segments = self.trajectory.segments();
        for (index, segment) in segments.iter().enumerate() {
            let next = segments.get(index + 1);
            let after = next.map_or(self.end, |next| &next.state);
            self.segment(w, segment, after, next.is_some_and(|next| next.force.is_some()))?;
        }
        self.fly(w);
        Ok(self.tangents)
    }
}
