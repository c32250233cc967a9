//! Derivatives at events at the surface of a stop (saltation).

use super::tangents::scale;
use super::variational_integration::VariationalIntegration;
use crate::record::trajectory::{Impact, PortForce, TrajectorySegment};
use jounce_model::contact::Law;
use jounce_simd::{F64x8, Simd};

impl VariationalIntegration<'_, '_> {
    /// Shifts the time of the tangents to the start of a contact of a port: `Dy = dy + y' s`.
    /// Returns `s`; `None` where the point does not move into the stop.
    #[inline(always)]
    pub(super) fn onset_shift<W: Simd>(
        &mut self,
        w: W,
        segment: &TrajectorySegment,
        port: usize,
    ) -> Option<Vec<F64x8>> {
        let plant = &self.kernel.plant;
        let row = &plant.ports[port];
        let driven = self.drift.driven(plant, port, segment.start_s);
        let speed = dot(&row.velocity, &segment.state) + driven.velocity_m_s;
        if speed <= 0.0 {
            return None;
        }
        let mut shift_s = self
            .tangents
            .along(w, &row.displacement, driven.penetration_drift_m);
        self.add_drifts(port, (segment.start_s, &segment.state), &mut [&mut shift_s]);
        scale(w, &mut shift_s, -1.0 / speed);
        let rate = self.rate(segment.start_s, &segment.state, &segment.forces);
        self.tangents.add_product(w, &rate, 1.0, &shift_s);
        Some(shift_s)
    }

    /// Adds the changes of the penetration, and of the rate, of a port by the parameters to rows of
    /// columns; the state is without the forced part of constant signals.
    fn add_drifts(
        &self,
        port: usize,
        (time_s, state): (f64, &[f64]),
        rows: &mut [&mut Vec<F64x8>],
    ) {
        let Some(parameters) = &self.parameters else {
            return;
        };
        let plant = &self.kernel.plant;
        let mut full = state.to_vec();
        plant.add_forced(&self.sizes, 0.0, &mut full);
        let drifts = parameters.drifts(plant, port, (time_s, &full));
        for (which, row) in rows.iter_mut().enumerate() {
            parameters.add_drift(row, &drifts, which);
        }
    }

    /// Returns `y'` at a state without the equilibrium under constant signals, under those signals
    /// and the forces of some ports.
    pub(super) fn rate(&self, time_s: f64, state: &[f64], forces: &[PortForce]) -> Vec<f64> {
        let plant = &self.kernel.plant;
        let mut rate = plant.diagonal.block.apply(state);
        for (forcing, [size, _]) in plant.forcings.iter().zip(&self.sizes) {
            rate.iter_mut()
                .zip(&forcing.local)
                .for_each(|(rate, b)| *rate += b * size);
        }
        for force in forces {
            let (port, driven) = (
                &plant.ports[force.port],
                self.drift.driven(plant, force.port, time_s),
            );
            let forced_m = self
                .forced
                .get(force.port)
                .map_or(0.0, |series| series.value(0.0));
            let depth_m = dot(&port.displacement, state) + driven.displacement_m + forced_m
                - plant.system.stops[force.port].gap_m;
            let force_n = self
                .law(force.port)
                .force_n(depth_m, dot(&port.velocity, state) + driven.velocity_m_s);
            rate.iter_mut()
                .zip(&port.force)
                .for_each(|(rate, b)| *rate += b * force_n);
        }
        rate
    }

    /// Passes the start of a contact whose force starts with a jump, at the end of a step.
    #[inline(always)]
    pub(super) fn strike<W: Simd>(
        &mut self,
        w: W,
        law: Law,
        port: usize,
        (time_s, before): (f64, &[f64]),
    ) {
        let plant = &self.kernel.plant;
        let row = &plant.ports[port];
        let driven = self.drift.driven(plant, port, time_s);
        let rate = dot(&row.velocity, before) + driven.velocity_m_s;
        let mut delay = self
            .tangents
            .along(w, &row.displacement, driven.penetration_drift_m);
        self.add_drifts(port, (time_s, before), &mut [&mut delay]);
        self.tangents
            .add_product(w, &row.force, law.force_n(0.0, rate) / rate, &delay);
    }

    /// Passes an impact on a rigid stop after a step, given the state that follows; returns the
    /// delay of the impact, s.
    #[inline(always)]
    pub(super) fn impact<W: Simd>(
        &mut self,
        w: W,
        impact: &Impact,
        earlier: Option<&TrajectorySegment>,
        (time_s, after): (f64, &[f64]),
    ) -> Vec<F64x8> {
        let plant = &self.kernel.plant;
        let port = &plant.ports[impact.port];
        let impulse = impact.impulse_n_s;
        let before: Vec<f64> = after
            .iter()
            .zip(&port.force)
            .map(|(y, b)| y - b * impulse)
            .collect();
        let driven = self.drift.driven(plant, impact.port, time_s);
        let fast = dot(&port.velocity, &before) + driven.velocity_m_s;
        let gain = impulse / fast;
        // Forces of compliant contacts act on both sides of the impact; rate-dependent forces
        // differ.
        let forces = earlier.map_or(&[][..], |earlier| &earlier.forces);
        let (rate_before, rate_after) = (
            self.rate(time_s, &before, forces),
            self.rate(time_s, after, forces),
        );
        let state_acceleration = dot(&port.velocity, &rate_before);
        let acceleration = state_acceleration + driven.acceleration_m_s2;
        let mut delay = self
            .tangents
            .along(w, &port.displacement, driven.penetration_drift_m);
        let mut phase_rate_change = self
            .tangents
            .along(w, &port.velocity, driven.rate_drift_m_s);
        let drifts = &mut [&mut delay, &mut phase_rate_change];
        self.add_drifts(impact.port, (time_s, &before), drifts);
        if let Some(parameters) = &self.parameters {
            let of_impact = (impact.port, impulse, fast);
            parameters.add_impulse(plant, of_impact, &mut self.tangents);
        }
        let kicked = rate_after
            .iter()
            .zip(&rate_before)
            .map(|(after, before)| after - before);
        let late: Vec<f64> = port
            .force
            .iter()
            .zip(kicked)
            .map(|(b, kick)| -(b * gain * acceleration - kick) / fast)
            .collect();
        self.tangents
            .add_product(w, &port.force, gain, &phase_rate_change);
        self.tangents.add_product(w, &late, 1.0, &delay);
        scale(w, &mut delay, -1.0 / fast);
        delay
    }
}

fn dot(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(r, v)| r * v).sum()
}
