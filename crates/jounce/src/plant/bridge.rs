//! Rectifiers: a bridge of diodes between patches and a storage, alone or with a switch.
//!
//! A path of two diodes carries `i = (|V| - V_s - E) / r >= 0`, with `V` the voltage of the patches, `V_s` that of the storage, `E` the
//! drop of both diodes (and the voltage of a battery) and `r` their resistance. While nothing changes between carrying and blocking the
//! circuit is linear; it changes where a [`EventFunction`] is met.
//!
//! Sources: Y. C. Shu and I. C. Lien, Smart Mater. Struct. 15 (2006) 1499 (bridge); D. Guyomar, A. Badel, E. Lefeuvre and C. Richard,
//! IEEE Trans. UFFC 52 (2005) 584 (synchronised switches); E. Lefeuvre et al., Sens. Actuators A 126 (2006) 405 (comparison).

use super::system::Connection;
use super::{Electrical, System};
use crate::drive::Wave;
use crate::plant::Signal;
use crate::spec::Wiring;

/// A rectified circuit.
#[derive(Debug, Clone, PartialEq)]
pub struct Bridge {
    /// Name of the circuit.
    pub name: String,
    /// The patches and how they are connected.
    pub connections: Vec<Connection>,
    /// How several patches stand to each other.
    pub wiring: Wiring,
    /// What extracts the charge.
    pub scheme: Scheme,
    /// What takes it.
    pub storage: Storage,
    /// Drop of the two diodes of a path together, V.
    pub drop_v: f64,
    /// Resistance of the path while it conducts, ohm.
    pub diode_ohm: f64,
    /// Resistance across the storage through which it leaks, ohm.
    pub leakage_ohm: Option<f64>,
    /// What it does now.
    pub state: BridgeState,
}

/// How charge comes out of the patches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Through the diodes alone.
    Standard,
    /// Through the diodes; at each extremum of the charge that the motion displaces a switch turns the voltage over, `V -> -q V`.
    ParallelSshi {
        /// `q`, 0 to 1.
        inversion: f64,
    },
    /// At each extremum a switch connects the patches to the bridge through an inductor: the voltage swings about that of the storage.
    SeriesSshi {
        /// `q` of the swing.
        inversion: f64,
    },
    /// At each extremum all energy of the patches is taken out.
    Extraction {
        /// Share of it that arrives.
        efficiency: f64,
    },
}

/// What takes the charge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Storage {
    /// A capacitor with a load across it.
    Capacitor {
        /// F.
        capacitance_f: f64,
        /// ohm.
        load_ohm: f64,
    },
    /// A fixed voltage.
    Battery {
        /// V.
        voltage_v: f64,
    },
}

/// Which diodes conduct.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Conduction {
    /// None.
    #[default]
    Blocked,
    /// Those of positive voltage.
    Positive,
    /// Those of negative voltage.
    Negative,
}

/// What a bridge does at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BridgeState {
    /// Which diodes conduct.
    pub conduction: Conduction,
    /// The next extremum of a switch is met from above: the displaced charge `theta . q` now grows.
    pub rising: bool,
}

impl Conduction {
    /// 1, -1 or 0.
    pub fn sign(self) -> f64 {
        match self {
            Self::Blocked => 0.0,
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }
}

impl Bridge {
    /// Voltage against which the path conducts beside that of a storage capacitor, V.
    pub fn threshold_v(&self) -> f64 {
        match self.storage {
            Storage::Capacitor { .. } => self.drop_v,
            Storage::Battery { voltage_v } => self.drop_v + voltage_v,
        }
    }

    /// True where a switch acts at extrema.
    pub fn has_switch(&self) -> bool {
        !matches!(self.scheme, Scheme::Standard)
    }

    /// Number of states, and the place of one among them.
    pub fn states(&self) -> usize {
        if self.has_switch() { 6 } else { 3 }
    }

    fn place(&self, state: BridgeState) -> usize {
        let conduction = state.conduction as usize;
        if self.has_switch() {
            2 * conduction + usize::from(state.rising)
        } else {
            conduction
        }
    }
}

impl System {
    /// Number of regimes: of all states of all bridges.
    pub fn regimes(&self) -> usize {
        self.bridges.iter().map(Bridge::states).product()
    }

    /// Number of the regime in which the bridges have some states; 0 is that in which all are blocked.
    pub fn regime(&self, states: &[BridgeState]) -> usize {
        self.bridges
            .iter()
            .zip(states)
            .fold(0, |number, (bridge, state)| {
                number * bridge.states() + bridge.place(*state)
            })
    }

    /// The states of the bridges in a regime.
    pub fn bridge_states(&self, regime: usize) -> Vec<BridgeState> {
        let mut rest = regime;
        let mut states: Vec<BridgeState> = (self.bridges.iter().rev())
            .map(|bridge| {
                let place = rest % bridge.states();
                rest /= bridge.states();
                let (conduction, rising) = if bridge.has_switch() {
                    (place / 2, place % 2 == 1)
                } else {
                    (place, false)
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

    /// The system in a regime. While diodes conduct, the voltage of their patches is counted from where the threshold would hold it, which
    /// pushes the structure as a constant force.
    pub fn in_regime(&self, regime: usize) -> Self {
        let mut system = self.clone();
        system
            .bridges
            .iter_mut()
            .zip(self.bridge_states(regime))
            .for_each(|(bridge, state)| bridge.state = state);
        let electrical = Electrical::of(&system);
        for (number, bridge) in self.bridges.iter().enumerate() {
            for node in electrical.nodes_of(number) {
                let (pushed_v, shape) = (
                    electrical.zero_v[node],
                    &electrical.nodes[node].coupling_n_per_v,
                );
                if pushed_v != 0.0 && shape.iter().any(|theta| *theta != 0.0) {
                    system.signals.push(Signal {
                        name: bridge.name.clone(),
                        shape: shape.clone(),
                        wave: Wave::Constant(pushed_v),
                        base: None,
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

    fn bridge(scheme: Scheme) -> Bridge {
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
    fn regimes_are_numbered_without_gap() {
        let bridges = vec![
            bridge(Scheme::Standard),
            bridge(Scheme::ParallelSshi { inversion: 0.5 }),
            bridge(Scheme::Standard),
        ];
        let system = System {
            bridges,
            ..System::default()
        };
        assert_eq!(system.regimes(), 54);
        assert!((0..54).all(|regime| system.regime(&system.bridge_states(regime)) == regime));
        assert!(
            system
                .bridge_states(0)
                .iter()
                .all(|state| *state == BridgeState::default())
        );
    }
}
