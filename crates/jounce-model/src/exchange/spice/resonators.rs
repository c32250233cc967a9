//! Modes, drives and friction.

use crate::drive::Wave;
use crate::plant::{Electrical, System};
use std::f64::consts::TAU;

/// Returns the modal coordinate `q` of a mode: the charge of its capacitor, or, for a rigid-body
/// mode, the integral of its current.
pub(super) fn coordinate(system: &System, mode: usize) -> String {
    let speed = system.modes.frequency_rad_s[mode];
    let number = mode + 1;
    match speed > 0.0 {
        true => format!("{:e}*v(c{number})", speed.powi(-2)),
        false => format!("v(q{number})"),
    }
}

/// Returns `sum of factor_i term_i` over the modes with a factor.
pub(super) fn sum(factors: &[f64], term: impl Fn(usize) -> String) -> String {
    let terms = factors
        .iter()
        .enumerate()
        .filter(|(_, factor)| **factor != 0.0);
    let terms: Vec<String> = terms
        .map(|(i, factor)| format!("({factor:e})*{}", term(i)))
        .collect();
    if terms.is_empty() {
        "0".to_owned()
    } else {
        terms.join(" + ")
    }
}

/// Voltage of each drive: its force in N, or its acceleration in m/s^2.
pub(super) fn drives(system: &System) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        "* Drives: forces in N, accelerations in m/s^2".to_owned(),
    ];
    for (index, drive) in system.drives.iter().enumerate() {
        let phase_deg = drive.phase_rad.to_degrees();
        lines.push(format!(
            "Vdrive{0} drive{0} 0 sin(0 {1:e} {2:e} 0 0 {phase_deg:e}) ; {3}",
            index + 1,
            drive.amplitude_n,
            drive.frequency_hz,
            drive.name
        ));
    }
    for (index, signal) in system.signals.iter().enumerate() {
        if let Wave::Constant(value) = signal.wave {
            lines.push(format!(
                "Vsignal{0} signal{0} 0 {value:e} ; {1}",
                index + 1,
                signal.name
            ));
        }
    }
    lines
}

/// The series resonator of each mode, with a controlled source for each force.
pub(super) fn modes(system: &System, electrical: &Electrical) -> Vec<String> {
    let mut lines = Vec::new();
    for mode in 0..system.modes.len() {
        let (number, speed) = (mode + 1, system.modes.frequency_rad_s[mode]);
        let ratio = system.modes.damping_ratio[mode];
        lines.push(String::new());
        lines.push(format!(
            "* Mode {number}: {} Hz, damping ratio {ratio}",
            speed / TAU
        ));
        // From the ground through all forces to the node f, then through sensor, L and R to c.
        let mut from = "0".to_owned();
        let forces = forces(system, electrical, mode);
        for (index, (control, factor)) in forces.iter().enumerate() {
            let to = format!("f{number}_{}", index + 1);
            lines.push(format!(
                "E{number}_{} {to} {from} {control} 0 {factor:e}",
                index + 1
            ));
            from = to;
        }
        lines.push(format!("Vmode{number} {from} m{number} 0"));
        lines.push(format!("L{number} m{number} l{number} 1"));
        let resistance = 2.0 * ratio * speed;
        let end = if speed > 0.0 {
            format!("c{number}")
        } else {
            "0".to_owned()
        };
        if resistance > 0.0 {
            lines.push(format!("R{number} l{number} {end} {resistance:e}"));
        } else {
            lines.push(format!("V0_{number} l{number} {end} 0"));
        }
        if speed > 0.0 {
            lines.push(format!("C{number} c{number} 0 {:e}", speed.powi(-2)));
        } else {
            lines.push(format!("Fq{number} 0 q{number} Vmode{number} 1"));
            lines.push(format!("Cq{number} q{number} 0 1"));
        }
    }
    lines
}

/// Controlling node and factor of each force on a mode.
fn forces(system: &System, electrical: &Electrical, mode: usize) -> Vec<(String, f64)> {
    let numbered = |word: &str, index: usize| format!("{word}{}", index + 1);
    let drives = system.drives.iter().enumerate();
    let signals = system.signals.iter().enumerate();
    let nodes = electrical.nodes.iter().enumerate();
    let dashpots = system.dashpots.iter().enumerate();
    let stops = system.stops.iter().enumerate();
    drives
        .map(|(index, drive)| (numbered("drive", index), drive.shape[mode]))
        .chain(signals.map(|(index, signal)| (numbered("signal", index), signal.shape[mode])))
        .chain(nodes.map(|(index, node)| (numbered("e", index), node.coupling_n_per_v[mode])))
        .chain(
            dashpots.map(|(index, friction)| (numbered("friction", index), -friction.shape[mode])),
        )
        .chain(stops.map(|(index, stop)| (numbered("stop", index), -stop.shape[mode])))
        .filter(|(_, factor)| *factor != 0.0)
        .collect()
}

/// Force of each dashpot, as a voltage.
pub(super) fn friction(system: &System) -> Vec<String> {
    let dashpots = system.dashpots.iter().enumerate();
    let line = |(index, dashpot): (usize, &crate::plant::Dashpot)| {
        let velocity = sum(&dashpot.shape, |i| format!("i(Vmode{})", i + 1));
        format!(
            "Bfriction{0} friction{0} 0 v = {1:e}*({velocity})",
            index + 1,
            dashpot.n_s_m
        )
    };
    dashpots.map(line).collect()
}
