//! What happens at the surface of the stop.

use super::linearisation::Linearisation;
use super::tangents::scale;
use crate::contact::ContactLaw;
use crate::march::trajectory::Segment;
use crate::wide::{Lane, Wide};

/// An impulse below this share of the speed is the roundoff of a state that was handed on.
const NO_IMPULSE: f64 = 1e-9;

impl Linearisation<'_> {
    /// Counts the time of the tangents from the start of a contact: `Dy = dy + y' s`. Returns `s`; `None` where the point does not
    /// move into the stop.
    #[inline(always)]
    pub(super) fn onset_shift<W: Wide>(&mut self, w: W, segment: &Segment) -> Option<Vec<Lane>> {
        let plant = &self.kernel.plant;
        let port = &plant.ports[0];
        let driven = self.drift.driven(plant, segment.start_s);
        let speed = dot(&port.velocity, &segment.state) + driven.velocity_m_s;
        if speed <= 0.0 {
            return None;
        }
        let mut shift_s = self.tangents.along(w, &port.displacement, driven.penetration_drift_m);
        scale(w, &mut shift_s, -1.0 / speed);
        self.tangents.add_product(w, &plant.diagonal.block.apply(&segment.state), 1.0, &shift_s);
        Some(shift_s)
    }

    /// A contact whose force starts with a jump, at the end of a flight.
    #[inline(always)]
    pub(super) fn strike<W: Wide, L: ContactLaw>(&mut self, w: W, law: L, segment: &Segment) {
        self.fly(w);
        let plant = &self.kernel.plant;
        let port = &plant.ports[0];
        let time_s = segment.start_s + segment.length_s;
        let before = plant.diagonal.block.flow(segment.length_s, &segment.state);
        let driven = self.drift.driven(plant, time_s);
        let rate = dot(&port.velocity, &before) + driven.velocity_m_s;
        let struck = self.tangents.along(w, &port.displacement, driven.penetration_drift_m);
        self.tangents.add_product(w, &port.force, law.force_n(0.0, rate) / rate, &struck);
    }

    /// An impact on a rigid stop, if there was one between the end of a flight and the state that followed.
    #[inline(always)]
    pub(super) fn impact<W: Wide>(&mut self, w: W, segment: &Segment, after: &[f64]) {
        let plant = &self.kernel.plant;
        let (block, port) = (&plant.diagonal.block, &plant.ports[0]);
        let before = block.flow(segment.length_s, &segment.state);
        let time_s = segment.start_s + segment.length_s;
        let driven = self.drift.driven(plant, time_s);
        let speed = |state: &[f64]| dot(&port.velocity, state) + driven.velocity_m_s;
        let (fast, slow) = (speed(&before), speed(after));
        if fast <= 0.0 || fast - slow <= NO_IMPULSE * fast {
            return;
        }
        self.fly(w);
        let impulse = (fast - slow) / port.mobility_per_kg;
        let gain = impulse / fast;
        let acceleration = dot(&self.kernel.acceleration_row(), &before) + driven.acceleration_m_s2;
        let struck = self.tangents.along(w, &port.displacement, driven.penetration_drift_m);
        let hastened = self.tangents.along(w, &port.velocity, driven.rate_drift_m_s);
        let kick = block.apply(&port.force);
        let late: Vec<f64> = port.force.iter().zip(&kick).map(|(b, ab)| -(b * gain * acceleration - ab * impulse) / fast).collect();
        self.tangents.add_product(w, &port.force, gain, &hastened);
        self.tangents.add_product(w, &late, 1.0, &struck);
    }
}

fn dot(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(r, v)| r * v).sum()
}
