//! Random linear circuits without inductor, and the equal circuit of one patch.

use super::system::Scales;
use crate::random_specs::Draw;
use jounce_model::plant::{Connection, Load, System};
use jounce_model::structure::{Modes, PatchModes};
use jounce_spec::Wiring;
use std::collections::BTreeMap;

/// Patches with their polarity, all in parallel, and their resistor.
pub struct Circuit {
    patches: Vec<(PatchModes, f64)>,
    resistance_ohm: Option<f64>,
}

fn patch(draw: &mut Draw, modes: &Modes, scales: &Scales) -> PatchModes {
    let capacitance_f = draw.decades(1e-9, 1e-5);
    let first = (draw.decades(1e-4, 0.3) * capacitance_f).sqrt() * scales.angular;
    let coupling = |i: usize| match i {
        0 => first,
        _ => first * draw.within(-2.0, 2.0),
    };
    PatchModes {
        coupling_n_per_v: (0..modes.len()).map(coupling).collect(),
        capacitance_f,
        leakage_ohm: None,
        strain: Vec::new(),
    }
}

/// Draws no patch, an open one, one with a resistor between short circuit and open circuit, or two
/// in parallel of equal or opposite polarity; some leak.
pub fn circuit(draw: &mut Draw, modes: &Modes, scales: &Scales) -> Circuit {
    let count = draw.one_of(&[0, 1, 1, 1, 1, 1, 2]);
    let mut patches: Vec<(PatchModes, f64)> = (0..count)
        .map(|i| (patch(draw, modes, scales), i))
        .map(|(patch, i)| (patch, if i == 0 { 1.0 } else { -1.0 }))
        .collect();
    let capacitance_f: f64 = patches.iter().map(|(patch, _)| patch.capacitance_f).sum();
    let matched_ohm = 1.0 / (capacitance_f * scales.angular);
    let resistance_ohm = matched_ohm * draw.decades(1e-3, 1e3);
    let is_open = count == 1 && draw.happens(0.15);
    if let Some((last, polarity)) = patches.last_mut() {
        last.leakage_ohm = draw
            .happens(0.25)
            .then(|| matched_ohm * draw.decades(1.0, 100.0));
        if count == 2 && draw.happens(0.5) {
            *polarity = 1.0;
        }
    }
    Circuit {
        patches,
        resistance_ohm: (count > 0 && !is_open).then_some(resistance_ohm),
    }
}

impl Circuit {
    /// Returns a system with the patches merged into one.
    pub fn merged(&self, system: &System, modes: &Modes) -> System {
        let mut modes = modes.clone();
        if !self.patches.is_empty() {
            let sum = |i: usize| -> f64 {
                let terms = self.patches.iter();
                terms
                    .map(|(patch, sign)| sign * patch.coupling_n_per_v[i])
                    .sum()
            };
            let patch = PatchModes {
                coupling_n_per_v: (0..modes.len()).map(sum).collect(),
                capacitance_f: self.patches.iter().map(|(p, _)| p.capacitance_f).sum(),
                leakage_ohm: self.patches.iter().find_map(|(p, _)| p.leakage_ohm),
                strain: Vec::new(),
            };
            modes.patch = BTreeMap::from([("p".into(), patch)]);
        }
        let load = self.resistance_ohm.map(|ohm| Load::resistor("c", "p", ohm));
        System {
            modes: modes.into(),
            loads: load.into_iter().collect(),
            ..system.clone()
        }
    }

    /// Gives a system the modes with these patches and their circuit.
    pub fn connect(self, system: &mut System, mut modes: Modes) {
        let connections = self
            .patches
            .iter()
            .enumerate()
            .map(|(i, (_, sign))| Connection {
                patch: format!("p{i}"),
                sign: *sign,
            })
            .collect();
        if let Some(resistance_ohm) = self.resistance_ohm {
            system.loads = vec![Load {
                name: "c".into(),
                connections,
                wiring: Wiring::Parallel,
                resistance_ohm,
                inductor: None,
            }];
        }
        let named = self.patches.into_iter().enumerate();
        modes.patch = named
            .map(|(i, (patch, _))| (format!("p{i}"), patch))
            .collect();
        system.modes = modes.into();
    }
}
