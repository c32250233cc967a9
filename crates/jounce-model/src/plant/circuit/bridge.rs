//! Rectifiers: a diode bridge between patches and a storage, alone or with a switch.
//!
//! A path of two diodes carries `i = (|V| - V_s - E) / r >= 0`, with `V` the voltage of the
//! patches, `V_s` the voltage of the storage, `E` the drop of both diodes (plus the voltage of a
//! battery) and `r` their resistance. Between changes of the conduction state the circuit is
//! linear; an [`EventFunction`] detects each change.
//!
//! Sources: Y. C. Shu and I. C. Lien, Smart Mater. Struct. 15 (2006) 1499 (bridge); D. Guyomar, A.
//! Badel, E. Lefeuvre and C. Richard, IEEE Trans. UFFC 52 (2005) 584 (synchronised switches); E.
//! Lefeuvre et al., Sens. Actuators A 126 (2006) 405 (comparison).

use crate::drive::Wave;
use crate::plant::Signal;
use crate::plant::system::Connection;
use crate::plant::{Electrical, Regulator, System};
use jounce_spec::Wiring;

/// A rectified circuit.
#[derive(Debug, Clone, PartialEq)]
pub struct Bridge {
    /// Name of the circuit.
    pub name: String,
    /// Patches and their connection.
    pub connections: Vec<Connection>,
    /// Connection of several patches.
    pub wiring: Wiring,
    /// Extraction scheme.
    pub scheme: RectifierScheme,
    /// Storage.
    pub storage: Storage,
    /// Total drop of the two diodes of a path, V.
    pub drop_v: f64,
    /// Resistance of the path while it conducts, ohm.
    pub diode_ohm: f64,
    /// Leakage resistance across the storage, ohm.
    pub leakage_ohm: Option<f64>,
    /// Current state of the bridge.
    pub state: BridgeState,
}

/// Extraction scheme of the charge of the patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RectifierScheme {
    /// Through the diodes only.
    Standard,
    /// Through the diodes; at each extremum of the displaced charge a switch inverts the voltage,
    /// `V -> -q V`.
    ParallelSshi {
        /// `q`, 0 to 1.
        inversion: f64,
    },
    /// At each extremum a switch connects the patches to the bridge through an inductor: the
    /// voltage oscillates about the voltage of the storage.
    SeriesSshi {
        /// `q` of the oscillation.
        inversion: f64,
    },
    /// At each extremum all energy of the patches is extracted.
    Extraction {
        /// Efficiency of the extraction.
        efficiency: f64,
    },
}

/// Storage of the charge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Storage {
    /// A capacitor with a load across it.
    Capacitor {
        /// F.
        capacitance_f: f64,
        /// ohm.
        load_ohm: f64,
    },
    /// A capacitor that supplies a device through a regulator.
    Regulated {
        /// F.
        capacitance_f: f64,
        /// Regulator.
        regulator: Regulator,
    },
    /// A fixed voltage.
    Battery {
        /// V.
        voltage_v: f64,
    },
}

impl Storage {
    /// Returns the capacitance, F; `None` for a battery.
    pub fn capacitance_f(&self) -> Option<f64> {
        match self {
            Self::Capacitor { capacitance_f, .. } | Self::Regulated { capacitance_f, .. } => {
                Some(*capacitance_f)
            }
            Self::Battery { .. } => None,
        }
    }

    /// Returns the conductance of the load or of the regulator across the capacitor, 1/ohm; 0 for
    /// a battery.
    pub fn conductance_per_ohm(&self) -> f64 {
        match self {
            Self::Capacitor { load_ohm, .. } => 1.0 / load_ohm,
            Self::Regulated { regulator, .. } => regulator.conductance_per_ohm(),
            Self::Battery { .. } => 0.0,
        }
    }
}

/// Conducting diodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Conduction {
    /// No diode conducts.
    #[default]
    Blocked,
    /// Diodes of positive voltage.
    Positive,
    /// Diodes of negative voltage.
    Negative,
}

/// State of a bridge at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BridgeState {
    /// Conducting diodes.
    pub conduction: Conduction,
    /// The next extremum of a switch is a maximum: the displaced charge `theta . q` is increasing.
    pub rising: bool,
}

impl Conduction {
    /// Returns 1, -1 or 0.
    pub fn sign(self) -> f64 {
        match self {
            Self::Blocked => 0.0,
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }
}

impl Bridge {
    /// Returns the voltage above which the path conducts, in addition to that of a storage
    /// capacitor, V.
    pub fn threshold_v(&self) -> f64 {
        match self.storage {
            Storage::Capacitor { .. } | Storage::Regulated { .. } => self.drop_v,
            Storage::Battery { voltage_v } => self.drop_v + voltage_v,
        }
    }

    /// Returns the regulator of the storage.
    pub fn regulator(&self) -> Option<&Regulator> {
        match &self.storage {
            Storage::Regulated { regulator, .. } => Some(regulator),
            Storage::Capacitor { .. } | Storage::Battery { .. } => None,
        }
    }

    /// True if a switch acts at extrema.
    pub fn has_switch(&self) -> bool {
        !matches!(self.scheme, RectifierScheme::Standard)
    }

    /// Returns the number of states.
    pub fn states(&self) -> usize {
        if self.has_switch() { 6 } else { 3 }
    }

    fn state_index(&self, state: BridgeState) -> usize {
        let conduction = state.conduction as usize;
        if self.has_switch() {
            2 * conduction + usize::from(state.rising)
        } else {
            conduction
        }
    }
}

impl System {
    /// Returns the number of conduction states of all bridges together.
    pub fn conduction_states(&self) -> usize {
        self.bridges.iter().map(Bridge::states).product()
    }

    /// Returns the index of the conduction state for given states of the bridges; 0 is the one with
    /// all bridges blocked.
    pub fn conduction_state(&self, states: &[BridgeState]) -> usize {
        self.bridges
            .iter()
            .zip(states)
            .fold(0, |number, (bridge, state)| {
                number * bridge.states() + bridge.state_index(*state)
            })
    }

    /// Returns the states of the bridges in a conduction state.
    pub fn bridge_states(&self, conduction_state: usize) -> Vec<BridgeState> {
        let mut rest = conduction_state;
        let mut states: Vec<BridgeState> = (self.bridges.iter().rev())
            .map(|bridge| {
                let state_index = rest % bridge.states();
                rest /= bridge.states();
                let (conduction, rising) = if bridge.has_switch() {
                    (state_index / 2, state_index % 2 == 1)
                } else {
                    (state_index, false)
                };
                let conduction = [
                    Conduction::Blocked,
                    Conduction::Positive,
                    Conduction::Negative,
                ][conduction];
                BridgeState { conduction, rising }
            })
            .collect();
        states.reverse();
        states
    }

    /// Returns the system in a conduction state. While diodes conduct, the voltage of their patches
    /// is measured from its equilibrium value at the threshold, which acts on the structure as a
    /// constant force.
    pub fn in_conduction_state(&self, conduction_state: usize) -> Self {
        let mut system = self.clone();
        system
            .bridges
            .iter_mut()
            .zip(self.bridge_states(conduction_state))
            .for_each(|(bridge, state)| bridge.state = state);
        let electrical = Electrical::of(&system);
        for (number, bridge) in self.bridges.iter().enumerate() {
            for node in electrical.nodes_of(number) {
                let (offset_v, shape) = (
                    electrical.zero_v[node],
                    &electrical.nodes[node].coupling_n_per_v,
                );
                if offset_v != 0.0 && shape.iter().any(|theta| *theta != 0.0) {
                    system.signals.push(Signal {
                        name: bridge.name.clone(),
                        shape: shape.clone(),
                        wave: Wave::Constant(offset_v),
                        base: None,
                        drawn_from: None,
                    });
                }
            }
        }
        system
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bridge(scheme: RectifierScheme) -> Bridge {
        Bridge {
            name: "b".into(),
            connections: Vec::new(),
            wiring: Wiring::Parallel,
            scheme,
            storage: Storage::Battery { voltage_v: 1.0 },
            drop_v: 0.4,
            diode_ohm: 1.0,
            leakage_ohm: None,
            state: BridgeState::default(),
        }
    }

    #[test]
    fn conduction_states_are_numbered_without_gap() {
        let bridges = vec![
            bridge(RectifierScheme::Standard),
            bridge(RectifierScheme::ParallelSshi { inversion: 0.5 }),
            bridge(RectifierScheme::Standard),
        ];
        let system = System {
            bridges,
            ..System::default()
        };
        assert_eq!(system.conduction_states(), 54);
        let is_found = |index| system.conduction_state(&system.bridge_states(index)) == index;
        assert!((0..54).all(is_found));
        assert!(
            system
                .bridge_states(0)
                .iter()
                .all(|state| *state == BridgeState::default())
        );
    }
}
