//! A system as an equivalent circuit for SPICE programs.
//!
//! A mode is a series resonator of 1 H, `2 zeta w` ohm and `1 / w^2` F: its current is the modal
//! velocity `q'`, its charge the modal coordinate `q`, and the voltages in its loop are the modal
//! forces. Drives, electrodes and stops act on it through controlled sources, which are ideal
//! transformers. All numbers are in SI units.
//!
//! The netlist runs from rest for `run.duration` and measures the mean power of each load over the
//! last `run.average_over`, as `mean_power_1`, `mean_power_2` and so on.
//!
//! Source: W. P. Mason, Electromechanical Transducers and Wave Filters (1942); Y. Yang, L. Tang, J.
//! Intell. Mater. Syst. Struct. 20 (2009) 2223.

mod electrical;
mod resonators;
mod stops;

use super::ExchangeFaults;
use crate::contact::Law;
use crate::drive::Wave;
use crate::plant::{Electrical, System};
use jounce_spec::Run;
use std::f64::consts::TAU;

/// Time steps per period of the highest mode and of the fastest drive, at least.
const STEPS_PER_PERIOD: f64 = 60.0;

/// Returns the netlist of a system.
///
/// # Errors
/// One fault for each element that has no equivalent here: circuits with diodes, rigid stops, stops
/// between bases, drives other than sines and gravity.
///
/// # Validation
/// `crates/jounce/tests/library/exchange.rs`: ngspice and jounce agree on the mean power of the
/// harvester of the 2019 paper.
pub fn netlist(title: &str, system: &System, run: &Run) -> Result<String, ExchangeFaults> {
    let faults = faults(system);
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults));
    }
    let electrical = Electrical::of(system);
    let mut lines = vec![
        format!("* {}", title.replace(['\n', '\r'], " ")),
        "* Equivalent circuit in SI units: currents of the modes are modal velocities.".to_owned(),
    ];
    lines.extend(resonators::drives(system));
    lines.extend(resonators::modes(system, &electrical));
    lines.extend(resonators::friction(system));
    lines.extend(electrical::nodes(system, &electrical));
    lines.extend(stops::stops(system));
    lines.extend(analysis(system, run));
    Ok(lines.join("\n") + "\n")
}

fn faults(system: &System) -> Vec<String> {
    let mut faults = Vec::new();
    for bridge in &system.bridges {
        faults.push(format!(
            "circuit {} has diodes; the equivalent circuit has linear loads only: set interface = \"resistor\"",
            bridge.name
        ));
    }
    for stop in &system.stops {
        if matches!(stop.law, Law::Rigid(_)) {
            faults.push(format!(
                "stop {} is rigid; choose a compliant law",
                stop.name
            ));
        }
        if !stop.bases.is_empty() {
            faults.push(format!(
                "stop {} is between two bases that move; give both one base",
                stop.name
            ));
        }
    }
    for signal in &system.signals {
        if !matches!(signal.wave, Wave::Constant(_)) {
            faults.push(format!(
                "drive {} is not a sine; only sines can be exported",
                signal.name
            ));
        }
    }
    faults
}

fn analysis(system: &System, run: &Run) -> Vec<String> {
    let modes = system.modes.frequency_rad_s.iter().map(|speed| speed / TAU);
    let drives = system.drives.iter().map(|drive| drive.frequency_hz);
    let highest_hz = modes.chain(drives).fold(1.0, f64::max);
    let step_s = 1.0 / (STEPS_PER_PERIOD * highest_hz);
    let start_s = run.duration_s - run.average_over_s;
    let mut lines = vec![
        String::new(),
        "* Analysis from rest".to_owned(),
        ".options method=trap reltol=1e-6 abstol=1e-12 vntol=1e-9 chgtol=1e-16".to_owned(),
        format!(
            ".tran {step_s:e} {} {start_s:e} {step_s:e} uic",
            run.duration_s
        ),
    ];
    lines.extend((1..=system.loads.len()).map(|load| {
        format!(
            ".meas tran mean_power_{load} avg v(power{load}) from={start_s:e} to={}",
            run.duration_s
        )
    }));
    lines.push(".end".to_owned());
    lines
}
