//! Rectifiers in an integration: where an event function passes zero, the plant changes and the
//! integration continues in the new conduction state.
//!
//! Diodes change the circuit but not the state, whose voltages and velocities are continuous:
//! current and forward voltage are both zero there. A switch inverts a voltage within an instant;
//! the energies of this change are counted in closed form.
//!
//! The charge `Q` through the diodes is the charge that the patches displaced and did not retain or
//! leak, `-[C V + theta . q]` without leakage, exact to roundoff (see [`super::charge_balance`]).

use super::charge_balance::ChargeBalance;
use super::energies::RectifiedEnergies;
use super::regulation::Regulation;
use super::switch_map::SwitchMap;
use crate::error::IntegrationError;
use crate::integrator::{FullState, Integrator};
use crate::record::energies::Energies;
use crate::record::trajectory::ConductionChange;
use jounce_model::plant::{
    BridgeChange, BridgeNodes, BridgeState, Conduction, EnergyOutlet, Port, SignalIntegrals,
};

/// Largest number of changes of bridges at one instant. A switch may close many times there: where
/// the voltage that it inverts holds the current at zero from either side, it closes until too
/// little voltage is left.
const MAX_CHANGES_PER_INSTANT: usize = 1000;

/// Time between changes that count as simultaneous, in units of the fastest motion of the plant
/// with all bridges blocked.
const SIMULTANEOUS_CHANGE: f64 = 1e-8;

/// Fraction of the terms of an event function by which it must pass zero: smaller values are
/// roundoff, and would change a bridge back and forth.
const EVENT_ROUNDOFF: f64 = 1e-13;

/// Bridges of an integration.
#[derive(Debug, Clone, Default)]
pub(crate) struct Switching {
    /// Index of the current conduction state.
    pub conduction_state: usize,
    /// Event function that has passed zero.
    pub pending_event: Option<usize>,
    /// Energies up to the last change.
    earlier: Energies,
    /// Time and physical state at the last change.
    pub since: (f64, Vec<f64>),
    /// Time of the last change, and the number of changes at it.
    changed: (f64, usize),
    /// Regulator of each bridge.
    pub regulations: Vec<Option<Regulation>>,
}

impl Integrator<'_> {
    /// Enters the conduction state of the current state.
    pub(crate) fn open_switching(&mut self) -> Result<(), IntegrationError> {
        let system = &self.base.plant.system;
        if system.bridges.is_empty() {
            return Ok(());
        }
        self.switching.earlier.rectified = vec![RectifiedEnergies::default(); system.bridges.len()];
        self.switching.earlier.loads_j = vec![0.0; system.loads.len()];
        self.switching.earlier.leaks_j = vec![0.0; self.base.plant.electrical.leaks.len()];
        self.switching.regulations = (system.bridges.iter())
            .map(|bridge| {
                bridge
                    .regulator()
                    .map(|it| Regulation::new(it, self.time_s))
            })
            .collect();
        let x = self.physical();
        let current = |nodes: &BridgeNodes| -> f64 {
            let coupling = &self.base.plant.electrical.nodes[nodes.terminal].coupling_n_per_v;
            coupling
                .iter()
                .enumerate()
                .map(|(i, theta)| theta * x[coupling.len() + i])
                .sum()
        };
        let states: Vec<BridgeState> = (self
            .base
            .plant
            .electrical
            .bridges
            .iter()
            .zip(&system.bridges))
        .map(|(nodes, bridge)| BridgeState {
            rising: bridge.has_switch() && current(nodes) > 0.0,
            ..BridgeState::default()
        })
        .collect();
        self.change_to(&states, &x, None)?;
        self.change_on_events()
    }

    /// Changes the bridges as long as an event function is past zero.
    pub(crate) fn change_on_events(&mut self) -> Result<(), IntegrationError> {
        while let Some(p) = self
            .switching
            .pending_event
            .take()
            .or_else(|| self.crossed_event())
        {
            let guard = self.kernel.plant.guards[p - self.kernel.plant.system.stops.len()].clone();
            self.count_change(guard.bridge)?;
            if matches!(guard.change, BridgeChange::Rises | BridgeChange::Falls) {
                self.regulate(guard.bridge, guard.change);
                continue;
            }
            let state = self.full_state();
            self.note_change(guard.change, guard.bridge, &state.physical);
            self.close_conduction_state(&state);
            let mut x = state.physical;
            let mut states: Vec<BridgeState> = self
                .kernel
                .plant
                .system
                .bridges
                .iter()
                .map(|bridge| bridge.state)
                .collect();
            match guard.change {
                BridgeChange::Rises | BridgeChange::Falls => {}
                BridgeChange::Conducts(conduction) => states[guard.bridge].conduction = conduction,
                BridgeChange::Blocks => states[guard.bridge].conduction = Conduction::Blocked,
                BridgeChange::Switches => {
                    self.switch(guard.bridge, &mut x);
                    states[guard.bridge] = BridgeState {
                        conduction: Conduction::Blocked,
                        rising: !states[guard.bridge].rising,
                    };
                }
            }
            let switched = (guard.change == BridgeChange::Switches).then_some(guard.bridge);
            self.change_to(&states, &x, switched)?;
        }
        Ok(())
    }

    /// Records a change.
    fn note_change(&mut self, change: BridgeChange, bridge: usize, x: &[f64]) {
        let conduction_state = self.switching.conduction_state;
        let (time_s, forces_n) = (self.time_s, self.forces_n());
        if let Some(record) = &mut self.record {
            let flipped = (change == BridgeChange::Switches).then_some(bridge);
            record.push_change(ConductionChange {
                after: record.segments().len(),
                time_s,
                conduction_state,
                flipped,
                state: x.to_vec(),
                forces_n,
            });
        }
    }

    fn count_change(&mut self, bridge: usize) -> Result<(), IntegrationError> {
        // An instant is accurate to the roundoff of its time and of the event function, and no two
        // changes have exactly equal times.
        let instant_s =
            SIMULTANEOUS_CHANGE / self.base.fastest_rad_s + 64.0 * f64::EPSILON * self.time_s;
        let (time_s, changes) = &mut self.switching.changed;
        *changes = if self.time_s - *time_s <= instant_s {
            *changes + 1
        } else {
            1
        };
        *time_s = self.time_s;
        if *changes > MAX_CHANGES_PER_INSTANT {
            let circuit = self.kernel.plant.system.bridges[bridge].name.clone();
            return Err(IntegrationError::ChangesWithoutEnd {
                time_s: self.time_s,
                circuit,
                changes: *changes,
            });
        }
        Ok(())
    }

    /// Returns an event function that has passed zero.
    pub(crate) fn crossed_event(&self) -> Option<usize> {
        let stops = self.kernel.plant.system.stops.len();
        (stops..self.kernel.plant.ports.len()).find(|p| self.ports[*p].penetration_m > 0.0)
    }

    /// Returns the magnitude below which an event function is roundoff, in the current state.
    fn roundoff(&self, p: usize, state: &FullState) -> f64 {
        let (plant, port) = (&self.kernel.plant, &self.ports[p]);
        let guard = &plant.guards[p - plant.system.stops.len()];
        let row = &plant.ports[p].displacement;
        let terms = row
            .iter()
            .zip(&state.block)
            .map(|(row, y)| (row * y).abs())
            .sum::<f64>();
        // The free motion and the motion forced by signals may cancel.
        let forced = self.excitation.motion_after(p, 0.0)[0].abs();
        let free = self.terms_of(&port.rows.displacement);
        let mut size = terms.max(free) + forced + self.static_size(row) + port.rows.tone_scale_m;
        if guard.change != BridgeChange::Switches {
            let (nodes, first) = (
                plant.electrical.bridges[guard.bridge],
                2 * plant.system.modes.len(),
            );
            let (node, x) = (&plant.electrical.nodes[nodes.terminal], &state.physical);
            let displaced_c: f64 = node
                .coupling_n_per_v
                .iter()
                .zip(x)
                .map(|(theta, q)| (theta * q).abs())
                .sum();
            size += x[first + nodes.terminal].abs()
                + nodes
                    .storage
                    .map_or(0.0, |storage| x[first + storage].abs());
            size +=
                plant.system.bridges[guard.bridge].threshold_v() + displaced_c / node.capacitance_f;
        }
        // The accuracy of a time is limited by its own roundoff.
        EVENT_ROUNDOFF * size + 4.0 * f64::EPSILON * self.time_s * port.rate_m_s.abs()
    }

    /// Returns the size of the static response of an output to the present contact forces: its only
    /// scale where a stop presses on a harvester at rest.
    fn static_size(&self, row: &[f64]) -> f64 {
        let (plant, block) = (&self.kernel.plant, &self.kernel.plant.diagonal.block);
        let forces = self.forces_n().into_iter().zip(&plant.ports);
        let by_force = |(force_n, port): (f64, &Port)| {
            let response = block.solve(&port.force, &block.free());
            let terms = row.iter().zip(response).map(|(row, y)| (row * y).abs());
            force_n.abs() * terms.sum::<f64>()
        };
        forces
            .filter(|(force_n, _)| *force_n != 0.0)
            .map(by_force)
            .sum()
    }

    /// Moves the threshold of an event by its roundoff.
    pub(super) fn shift_threshold(&mut self, p: usize, state: &FullState) {
        let roundoff = self.roundoff(p, state);
        self.ports[p].gap_m += roundoff;
        self.ports[p].penetration_m -= roundoff;
    }

    /// Moves the threshold of the next extremum to the current that the switch left: the time of an
    /// extremum has roundoff, so that this current may be past zero already.
    fn start_at_zero(&mut self, p: usize) {
        let port = &mut self.ports[p];
        let past = port.penetration_m.max(0.0);
        port.gap_m += past;
        port.penetration_m -= past;
    }

    /// Continues from a physical state with the bridges in given states, after the switch of one of
    /// them if one closed.
    fn change_to(
        &mut self,
        states: &[BridgeState],
        x: &[f64],
        switched: Option<usize>,
    ) -> Result<(), IntegrationError> {
        let conduction_state = self.base.plant.system.conduction_state(states);
        let kernel = self.base.in_conduction_state(conduction_state)?;
        let state = self.enter_kernel(kernel, x);
        self.switching.conduction_state = conduction_state;
        self.switching.since = (self.time_s, x.to_vec());
        (0..self.switching.regulations.len()).for_each(|bridge| self.aim_at_band(bridge));
        let first = kernel.plant.system.stops.len();
        for (p, guard) in (first..).zip(&kernel.plant.guards) {
            if guard.change == BridgeChange::Switches && switched == Some(guard.bridge) {
                self.start_at_zero(p);
            }
            self.shift_threshold(p, &state);
        }
        Ok(())
    }

    /// Applies the switch at an extremum: its effect on the state and its energies.
    fn switch(&mut self, k: usize, x: &mut [f64]) {
        let switch_map = SwitchMap::of(&self.base.plant, k, x);
        switch_map.enter(&self.base.plant, k, x);
        self.switching.earlier.stored_j += switch_map.stored_j;
        self.switching.earlier.rectified[k].add(&switch_map.rectified);
    }

    /// Adds the conduction state that ends to the previous energies.
    fn close_conduction_state(&mut self, state: &FullState) {
        let integrals = self.take_signal_integrals(state);
        let all = self.energies_of_all(state, &integrals);
        self.switching.earlier = all;
        self.open_regulations();
    }

    /// Returns the energies since the start of the integration, in the current state, with the
    /// integrals of the signals since the last change.
    pub(crate) fn energies_of_all(
        &self,
        state: &FullState,
        integrals: &(SignalIntegrals, Vec<f64>),
    ) -> Energies {
        let energies = self.energies_in_conduction_state(state, integrals);
        let plant = &self.kernel.plant;
        let drawn_c = self.drawn_c();
        let mut all = self.switching.earlier.clone();
        let change: Vec<f64> = (state.physical.iter())
            .zip(&self.switching.since.1)
            .map(|(x, since)| x - since)
            .collect();
        let charge_balance = ChargeBalance {
            plant,
            change: &change,
            length_s: self.time_s - self.switching.since.0,
            drawn_c: &drawn_c,
        };
        let loads = plant.system.loads.len();
        all.loads_j
            .iter_mut()
            .zip(&energies.loads_j)
            .for_each(|(sum, energies)| *sum += energies);
        let outputs = &self.kernel.meters().outputs;
        let mut leaks = all.leaks_j.iter_mut();
        for (output, energy_j) in outputs.iter().zip(&energies.loads_j[loads..]) {
            let energy_j = energy_j + charge_balance.standing_j(output);
            match output.outlet {
                EnergyOutlet::Load => all.rectified[output.bridge].load_j += energy_j,
                EnergyOutlet::Regulator => {
                    all.rectified[output.bridge].idle_j += energy_j;
                    all.rectified[output.bridge].regulator_j += energy_j;
                }
                EnergyOutlet::Leakage => all.rectified[output.bridge].leakage_j += energy_j,
                EnergyOutlet::Diodes => all.rectified[output.bridge].diodes_j += energy_j,
                EnergyOutlet::Patch => leaks.by_ref().take(1).for_each(|sum| *sum += energy_j),
            }
        }
        let supplied_j = charge_balance.add_conducted(&mut all.rectified);
        let signals_j = self.add_regulated(&integrals.0, &drawn_c, &mut all.rectified);
        all.input_j += energies.input_j - supplied_j - signals_j;
        all.damping_j += energies.damping_j;
        all.contact_loss_j += energies.contact_loss_j;
        all.stored_j += energies.stored_j;
        all.scale_j = all.scale_j.max(energies.scale_j).max(all.input_j.abs());
        all
    }
}
