//! Reset map of a switch: the voltages after it, its energies, and its derivative.
//!
//! ```text
//! parallel SSHI   V -> -q V
//! series SSHI     V -> V - s Q / C,  V_s -> V_s + Q / C_s,   Q = C' (1 + q) (|V| - V_s - E) > 0,   1 / C' = 1 / C + 1 / C_s
//! extraction      V -> 0,            V_s -> sqrt(V_s^2 + n C V^2 / C_s)
//! ```
//!
//! `V`, `C` belong to the patches, `V_s`, `C_s` to the storage (`C_s` is absent for a battery). `s`
//! is the sign of `V`, `E` the threshold of the path, `q` the inversion and `n` the efficiency.

use super::energies::RectifiedEnergies;
use jounce_model::plant::{Bridge, Plant, RectifierScheme, Storage};

/// Action of a switch at one instant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SwitchMap {
    /// Voltages of the patches and of the storage after the switch, V.
    pub volts: [f64; 2],
    /// Derivatives of these voltages by those before.
    pub slopes: [[f64; 2]; 2],
    /// Energies of the circuit.
    pub rectified: RectifiedEnergies,
    /// Change of the energy stored in both, J.
    pub stored_j: f64,
}

/// Capacitances of the patches and of the storage, F; infinite for a battery.
struct Capacitances([f64; 2]);

impl SwitchMap {
    /// Computes the map of a bridge at a physical state.
    pub fn of(plant: &Plant, number: usize, x: &[f64]) -> Self {
        let (bridge, nodes) = (
            &plant.system.bridges[number],
            plant.electrical.bridges[number],
        );
        let first = 2 * plant.system.modes.len();
        let storage_f = nodes.storage.map_or(f64::INFINITY, |node| {
            plant.electrical.nodes[node].capacitance_f
        });
        let both = Capacitances([
            plant.electrical.nodes[nodes.terminal].capacitance_f,
            storage_f,
        ]);
        let volts = [
            x[first + nodes.terminal],
            nodes.storage.map_or(0.0, |node| x[first + node]),
        ];
        let mut switch_map = match bridge.scheme {
            RectifierScheme::Standard => Self::without_effect(volts),
            RectifierScheme::ParallelSshi { inversion } => Self {
                volts: [-inversion * volts[0], volts[1]],
                slopes: [[-inversion, 0.0], [0.0, 1.0]],
                ..Self::without_effect(volts)
            },
            RectifierScheme::SeriesSshi { inversion } => {
                Self::half_oscillation(bridge, inversion, &both, volts)
            }
            RectifierScheme::Extraction { efficiency } => {
                Self::extracted(bridge, efficiency, &both, volts)
            }
        };
        switch_map.stored_j = both.energy_j(switch_map.volts) - both.energy_j(volts);
        switch_map.rectified.switch_j =
            -switch_map.stored_j - switch_map.rectified.battery_j - switch_map.rectified.diodes_j;
        switch_map
    }

    /// Sets the voltages after the switch in a physical state.
    pub fn enter(&self, plant: &Plant, number: usize, x: &mut [f64]) {
        let (nodes, first) = (
            plant.electrical.bridges[number],
            2 * plant.system.modes.len(),
        );
        x[first + nodes.terminal] = self.volts[0];
        if let Some(storage) = nodes.storage {
            x[first + storage] = self.volts[1];
        }
    }

    /// Returns the map of a switch without effect.
    fn without_effect(volts: [f64; 2]) -> Self {
        Self {
            volts,
            slopes: [[1.0, 0.0], [0.0, 1.0]],
            rectified: RectifiedEnergies::default(),
            stored_j: 0.0,
        }
    }

    /// Returns the map of a half oscillation through an inductor into the storage: the voltage
    /// inverts about the voltage against which it conducts.
    fn half_oscillation(
        bridge: &Bridge,
        inversion: f64,
        both: &Capacitances,
        volts: [f64; 2],
    ) -> Self {
        let mut switch_map = Self::without_effect(volts);
        let over_v = volts[0].abs() - volts[1] - bridge.threshold_v();
        if over_v <= 0.0 {
            return switch_map;
        }
        let (Capacitances([terminal_f, storage_f]), sign) = (both, volts[0].signum());
        let per_volt_f = (1.0 + inversion) / (1.0 / terminal_f + 1.0 / storage_f);
        let charge_c = per_volt_f * over_v;
        switch_map.volts = [
            volts[0] - sign * charge_c / terminal_f,
            volts[1] + charge_c / storage_f,
        ];
        let by = [sign * per_volt_f, -per_volt_f];
        switch_map.slopes = [
            [1.0 - sign * by[0] / terminal_f, -sign * by[1] / terminal_f],
            [by[0] / storage_f, 1.0 + by[1] / storage_f],
        ];
        switch_map.rectified.charge_c = charge_c;
        switch_map.rectified.diodes_j = bridge.drop_v * charge_c;
        switch_map.rectified.battery_j = (bridge.threshold_v() - bridge.drop_v) * charge_c;
        switch_map
    }

    /// Returns the map of an extraction of all energy of the patches.
    fn extracted(bridge: &Bridge, efficiency: f64, both: &Capacitances, volts: [f64; 2]) -> Self {
        let mut switch_map = Self {
            volts: [0.0, volts[1]],
            slopes: [[0.0, 0.0], [0.0, 1.0]],
            ..Self::without_effect(volts)
        };
        let arrives_j = efficiency * 0.5 * both.0[0] * volts[0] * volts[0];
        match bridge.storage {
            Storage::Capacitor { capacitance_f, .. } | Storage::Regulated { capacitance_f, .. } => {
                switch_map.volts[1] =
                    (volts[1] * volts[1] + 2.0 * arrives_j / capacitance_f).sqrt();
                if switch_map.volts[1] > 0.0 {
                    switch_map.slopes[1] = [
                        efficiency * both.0[0] * volts[0] / (capacitance_f * switch_map.volts[1]),
                        volts[1] / switch_map.volts[1],
                    ];
                }
            }
            Storage::Battery { .. } => switch_map.rectified.battery_j = arrives_j,
        }
        switch_map
    }
}

impl Capacitances {
    fn energy_j(&self, volts: [f64; 2]) -> f64 {
        self.0
            .iter()
            .zip(volts)
            .filter(|(capacitance_f, _)| capacitance_f.is_finite())
            .map(|(c, v)| 0.5 * c * v * v)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]
    use super::*;
    use jounce_model::plant::{BridgeState, Connection, System};
    use jounce_model::structure::{Modes, PatchModes};
    use jounce_spec::Wiring;
    use std::collections::BTreeMap;

    fn plant(scheme: RectifierScheme, storage: Storage) -> Plant {
        let patch = PatchModes {
            coupling_n_per_v: vec![0.5],
            capacitance_f: 2.0,
            leakage_ohm: None,
            strain: Vec::new(),
        };
        let modes = Modes {
            frequency_rad_s: vec![1.0],
            damping_ratio: vec![0.05],
            shape: BTreeMap::from([("mass".into(), vec![1.0])]),
            patch: BTreeMap::from([("patch".into(), patch)]),
            participation_sqrt_kg: vec![1.0],
            base_sqrt_kg: BTreeMap::new(),
            discretisation_error: vec![0.0],
            ..Modes::default()
        };
        let bridge = Bridge {
            name: "b".into(),
            connections: vec![Connection {
                patch: "patch".into(),
                sign: 1.0,
            }],
            wiring: Wiring::Parallel,
            scheme,
            storage,
            drop_v: 0.3,
            diode_ohm: 1e-3,
            leakage_ohm: None,
            state: BridgeState::default(),
        };
        Plant::new(System {
            modes: modes.into(),
            bridges: vec![bridge],
            ..System::default()
        })
        .unwrap()
    }

    /// The derivative against difference quotients, on either sign of the voltage.
    #[test]
    fn slopes_are_differences_of_the_switch() {
        let capacitor = Storage::Capacitor {
            capacitance_f: 7.0,
            load_ohm: 1.0,
        };
        for scheme in [
            RectifierScheme::ParallelSshi { inversion: 0.6 },
            RectifierScheme::SeriesSshi { inversion: 0.6 },
            RectifierScheme::Extraction { efficiency: 0.9 },
        ] {
            for (storage, sign) in [
                (capacitor, 1.0),
                (capacitor, -1.0),
                (Storage::Battery { voltage_v: 0.4 }, -1.0),
            ] {
                let plant = plant(scheme, storage);
                let states = plant.len();
                let at = |volts: [f64; 2]| {
                    let x: Vec<f64> = [0.0, 0.0].into_iter().chain(volts).take(states).collect();
                    SwitchMap::of(&plant, 0, &x)
                };
                let volts = [sign * 3.0, 1.1];
                let (map, step) = (at(volts), 1e-6);
                for k in 0..states - 2 {
                    let shifted = |by: f64| {
                        at(std::array::from_fn(|i| {
                            volts[i] + if i == k { by } else { 0.0 }
                        }))
                        .volts
                    };
                    for i in 0..states - 2 {
                        let difference = (shifted(step)[i] - shifted(-step)[i]) / (2.0 * step);
                        assert!(
                            (difference - map.slopes[i][k]).abs() < 1e-8,
                            "{scheme:?} {i} by {k}: {difference}"
                        );
                    }
                }
            }
        }
    }
}
