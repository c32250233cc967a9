//! Linearisation of a recorded integration through the conduction states of its bridges.
//!
//! ```text
//! diodes     dx+ = dx-
//! switch     dx+ = R' dx- + (R' x'- - x'+) s,   s = -(theta . dq') / (theta . q'')
//! ```
//!
//! in physical states `x = (q, q', V, i)`, which all conduction states share. Where diodes change,
//! their current is zero, so that the rate `x'` is equal on both sides and the derivative is
//! unchanged. A switch acts at an extremum of the charge `theta . q`; `R` is its reset map and `s`
//! (s) the delay of the extremum. Where an impact on a rigid stop inverts the current, `s` is the
//! delay of the impact. Diodes that conduct immediately after a switch share its delay,
//! `dx+ = dx- + (x'- - x'+) s`, because their current jumps there.

use super::parameters::Parameters;
use super::tangents::{Tangents, scale};
use super::variational_integration::{
    ConductionSegment, LinearizedSegment, VariationalIntegration,
};
use super::{ParameterSensitivity, SensitivityError};
use crate::kernel::Kernel;
use crate::record::trajectory::{ConductionChange, Impact, Trajectory};
use crate::rectifier::switch_map::SwitchMap;
use crate::tables::odd_tables::OddTables;
use jounce_linalg::{Mat, c64};
use jounce_model::plant::{SignalSample, product};
use jounce_simd::{F64x8, Portable, widest};

/// Recorded integration with its end.
pub struct ConductionRoute<'a> {
    /// Kernel with all bridges blocked.
    pub base: &'a Kernel,
    pub drift: &'a ParameterSensitivity,
    pub trajectory: &'a Trajectory,
    /// Tables of the lengths that are no levels.
    pub odd_tables: OddTables,
    /// Time of the end, s, ...
    pub end_s: f64,
    /// ... its conduction state, ...
    pub end_conduction_state: usize,
    /// ... and its state, block coordinates of that conduction state.
    pub end: Vec<f64>,
    /// Parameters whose derivatives are wanted, for plants without bridges.
    pub parameters: Option<Box<Parameters<'a>>>,
}

impl<'a> ConductionRoute<'a> {
    /// Returns the derivative of the state at the end, in the block coordinates of the base.
    pub fn tangents(mut self) -> Result<(Tangents, Option<Box<Parameters<'a>>>), SensitivityError> {
        let changes = self.trajectory.changes();
        let groups = self.parameters.as_ref().map_or(0, |one| one.groups());
        let mut tangents = Tangents::identity(self.base.plant.len(), groups);
        let first = changes
            .first()
            .map_or(self.end_conduction_state, |change| change.conduction_state);
        self.convert(&mut tangents, 0, first)?;
        let (mut from, mut cause) = (0, None);
        for (k, change) in changes.iter().enumerate() {
            let kernel = self.kernel(change.conduction_state)?;
            let end = kernel.plant.from_physical(&change.state, change.time_s);
            let linearized = self.linearize(
                kernel,
                (from, change.after),
                (change.time_s, &end),
                tangents,
            )?;
            // A change caused by an impact or a switch shares its delay.
            let cause_s = linearized
                .delay_s
                .or(cause.filter(|_| change.after == from));
            let next = changes
                .get(k + 1)
                .map_or(self.end_conduction_state, |next| next.conduction_state);
            (tangents, cause) = self.change(linearized.tangents, cause_s, change, next)?;
            from = change.after;
        }
        let kernel = self.kernel(self.end_conduction_state)?;
        let all = self.trajectory.segments().len();
        let end = std::mem::take(&mut self.end);
        let linearized = self.linearize(kernel, (from, all), (self.end_s, &end), tangents)?;
        let (mut tangents, parameters) = (linearized.tangents, linearized.parameters);
        self.convert(&mut tangents, self.end_conduction_state, 0)?;
        Ok((tangents, parameters))
    }

    fn kernel(&self, conduction_state: usize) -> Result<&'a Kernel, SensitivityError> {
        Ok(self
            .base
            .in_conduction_state(conduction_state)
            .map_err(crate::IntegrationError::from)?)
    }

    /// Converts between the block coordinates of two conduction states.
    fn convert(
        &self,
        tangents: &mut Tangents,
        from: usize,
        to: usize,
    ) -> Result<(), SensitivityError> {
        if from != to {
            let coordinates = &self.kernel(to)?.plant.diagonal.from_physical
                * &self.kernel(from)?.plant.diagonal.to_physical;
            tangents.transform(&coordinates);
        }
        Ok(())
    }

    /// Linearises the steps from one index to another in one conduction state.
    fn linearize(
        &mut self,
        kernel: &Kernel,
        (from, to): (usize, usize),
        (end_s, end): (f64, &[f64]),
        tangents: Tangents,
    ) -> Result<LinearizedSegment<'a>, SensitivityError> {
        let segments = &self.trajectory.segments()[from..to];
        // An impact that changed a bridge belongs to the steps before it.
        let belongs = |impact: &&Impact| impact.after <= to && (impact.after > from || from == 0);
        let impacts: Vec<Impact> = self
            .trajectory
            .impacts()
            .iter()
            .filter(belongs)
            .copied()
            .collect();
        let sizes = segments
            .first()
            .map_or_else(|| sizes(kernel, end_s), |first| first.sizes.to_vec());
        let forced = kernel.plant.forced(&sizes, 0.0);
        let end: Vec<f64> = end
            .iter()
            .zip(forced)
            .map(|(y, forced)| y - forced)
            .collect();
        let segment = ConductionSegment {
            segments,
            first: from,
            impacts: &impacts,
            end_s,
            end: &end,
        };
        widest(VariationalIntegration::new(
            kernel,
            self.drift,
            &mut self.odd_tables,
            segment,
            sizes,
            (tangents, self.parameters.take()),
        ))
    }

    /// Linearises a change into the next conduction state; `cause_s` is the delay of its cause, if
    /// another event caused it. Also returns the delay of the change, s, where it makes the rate
    /// jump.
    fn change(
        &self,
        mut tangents: Tangents,
        cause_s: Option<Vec<F64x8>>,
        change: &ConductionChange,
        next: usize,
    ) -> Result<(Tangents, Option<Vec<F64x8>>), SensitivityError> {
        if change.flipped.is_none() && cause_s.is_none() {
            self.convert(&mut tangents, change.conduction_state, next)?;
            return Ok((tangents, None));
        }
        let (kernel, other) = (self.kernel(change.conduction_state)?, self.kernel(next)?);
        let before = rate(kernel, &change.state, change.time_s, &change.forces_n);
        let (mut state, mut slopes) = (
            change.state.clone(),
            Mat::identity(change.state.len(), change.state.len()),
        );
        tangents.transform(&kernel.plant.diagonal.to_physical);
        let delay_s = cause_s.unwrap_or_else(|| {
            change
                .flipped
                .map_or_else(Vec::new, |bridge| self.delay_s(&tangents, bridge, &before))
        });
        if let Some(bridge) = change.flipped {
            let switch_map = SwitchMap::of(&self.base.plant, bridge, &change.state);
            switch_map.enter(&self.base.plant, bridge, &mut state);
            slopes = self.slopes(bridge, &switch_map);
            tangents.transform(&slopes);
        }
        let after = rate(other, &state, change.time_s, &change.forces_n);
        let jump: Vec<f64> = product(&slopes, &before)
            .iter()
            .zip(after)
            .map(|(mapped, after)| mapped - after)
            .collect();
        tangents.add_product(Portable::new(), &jump, 1.0, &delay_s);
        tangents.transform(&other.plant.diagonal.from_physical);
        Ok((tangents, Some(delay_s)))
    }

    /// Returns the delay of the zero of the current of a bridge, s; `rate` belongs to the physical
    /// state.
    fn delay_s(&self, tangents: &Tangents, bridge: usize, rate: &[f64]) -> Vec<F64x8> {
        let (plant, w) = (&self.base.plant, Portable::new());
        let coupling =
            &plant.electrical.nodes[plant.electrical.bridges[bridge].terminal].coupling_n_per_v;
        let n = coupling.len();
        let mut row = vec![0.0; plant.len()];
        row[n..2 * n].copy_from_slice(coupling);
        let mut delay_s = tangents.along(w, &row, 0.0);
        let hastens: f64 = row.iter().zip(rate).map(|(c, rate)| c * rate).sum();
        scale(w, &mut delay_s, -1.0 / hastens);
        delay_s
    }

    /// Returns `R'`.
    fn slopes(&self, bridge: usize, switch_map: &SwitchMap) -> Mat<f64> {
        let (plant, nodes) = (&self.base.plant, self.base.plant.electrical.bridges[bridge]);
        let first = 2 * plant.system.modes.len();
        let indices =
            [Some(nodes.terminal), nodes.storage].map(|node| node.map(|node| first + node));
        let mut slopes = Mat::identity(plant.len(), plant.len());
        for (i, row) in indices.iter().enumerate() {
            for (j, column) in indices.iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    slopes[(*row, *column)] = switch_map.slopes[i][j];
                }
            }
        }
        slopes
    }
}

/// Returns the sample of each signal of a kernel at a time.
pub fn sizes(kernel: &Kernel, time_s: f64) -> Vec<SignalSample> {
    let of = |signal: &jounce_model::plant::Signal| {
        [
            signal
                .wave
                .piece(signal.wave.index_at(time_s))
                .size_at(time_s),
            0.0,
        ]
    };
    kernel.plant.system.signals.iter().map(of).collect()
}

/// Returns the rate of a physical state under the drives, the signals and the forces of stops.
pub fn rate(kernel: &Kernel, state: &[f64], time_s: f64, forces_n: &[f64]) -> Vec<f64> {
    let plant = &kernel.plant;
    let mut rate = plant
        .diagonal
        .block
        .apply(&plant.from_physical(state, time_s));
    for (forcing, [size, _]) in plant.forcings.iter().zip(sizes(kernel, time_s)) {
        rate.iter_mut()
            .zip(&forcing.column)
            .for_each(|(rate, b)| *rate += b * size);
    }
    for (port, force_n) in plant.ports.iter().zip(forces_n) {
        rate.iter_mut()
            .zip(&port.force)
            .for_each(|(rate, b)| *rate += b * force_n);
    }
    for tone in &plant.tones {
        let turn = c64::new(0.0, tone.angular_frequency_rad_s)
            * c64::cis(tone.angular_frequency_rad_s * time_s);
        rate.iter_mut()
            .zip(&tone.steady)
            .for_each(|(rate, steady)| *rate += (turn * steady).re);
    }
    product(&plant.diagonal.to_physical, &rate)
}
