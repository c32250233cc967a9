//! What the solvers work with: modes, loads, stops and drives, names resolved.

use super::PlantError;
use crate::contact::Law;
use crate::spec::{Side, Spec};
use crate::structure::Modes;

/// A harvester after assembly.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// Modes of the structure.
    pub modes: Modes,
    /// Electrical loads. A patch without one is left open.
    pub loads: Vec<Load>,
    /// Stops.
    pub stops: Vec<Stop>,
    /// Sinusoidal drives.
    pub drives: Vec<Drive>,
}

/// A resistor across a patch.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Name of the circuit.
    pub name: String,
    /// Name of the patch.
    pub patch: String,
    /// Resistance, ohm.
    pub resistance_ohm: f64,
}

/// A stop: penetration is `shape . q - gap`.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// Name of the stop.
    pub name: String,
    /// Relative displacement of the striking point towards the stop, per unit modal coordinate, kg^-1/2.
    pub shape: Vec<f64>,
    /// Gap, m; negative when the contact is preloaded.
    pub gap_m: f64,
    /// Contact law.
    pub law: Law,
}

/// A force `amplitude sin(2 pi frequency t + phase)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Name of the drive.
    pub name: String,
    /// Displacement of the driven point per unit modal coordinate, kg^-1/2.
    pub shape: Vec<f64>,
    /// Amplitude, N, zero to peak.
    pub amplitude_n: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Angle at `t = 0`, rad.
    pub phase_rad: f64,
}

impl System {
    /// Resolves the names of a spec against the modes of its structure.
    ///
    /// # Errors
    /// [`PlantError::UnknownName`], [`PlantError::TwoCircuits`], [`PlantError::ImmobilePort`].
    pub fn assemble(spec: &Spec, modes: Modes) -> Result<Self, PlantError> {
        let loads = loads(spec, &modes)?;
        let stops = stops(spec, &modes)?;
        let drives = drives(spec, &modes)?;
        Ok(Self { modes, loads, stops, drives })
    }
}

fn loads(spec: &Spec, modes: &Modes) -> Result<Vec<Load>, PlantError> {
    let mut loads: Vec<Load> = Vec::new();
    for (name, circuit) in &spec.circuit {
        if !modes.patch.contains_key(&circuit.patch) {
            return Err(unknown(format!("circuit.{name}.patch"), &circuit.patch, modes.patch.keys()));
        }
        if let Some(first) = loads.iter().find(|load| load.patch == circuit.patch) {
            return Err(PlantError::TwoCircuits { patch: circuit.patch.clone(), first: first.name.clone(), second: name.clone() });
        }
        loads.push(Load { name: name.clone(), patch: circuit.patch.clone(), resistance_ohm: circuit.resistance_ohm });
    }
    Ok(loads)
}

fn stops(spec: &Spec, modes: &Modes) -> Result<Vec<Stop>, PlantError> {
    let mut stops = Vec::new();
    for (name, stop) in &spec.stop {
        let at = shape(modes, format!("stop.{name}.at"), &stop.at)?;
        let frame = match stop.frame.as_str() {
            "ground" => vec![0.0; modes.len()],
            body => shape(modes, format!("stop.{name}.frame"), body)?,
        };
        let sign = if stop.side == Side::Positive { 1.0 } else { -1.0 };
        let shape: Vec<f64> = at.iter().zip(&frame).map(|(at, frame)| sign * (at - frame)).collect();
        if shape.iter().all(|s| *s == 0.0) {
            return Err(PlantError::ImmobilePort { stop: name.clone() });
        }
        stops.push(Stop { name: name.clone(), shape, gap_m: stop.gap_m, law: stop.law.into() });
    }
    Ok(stops)
}

fn drives(spec: &Spec, modes: &Modes) -> Result<Vec<Drive>, PlantError> {
    spec.drive
        .iter()
        .map(|(name, drive)| {
            Ok(Drive {
                name: name.clone(),
                shape: shape(modes, format!("drive.{name}.at"), &drive.at)?,
                amplitude_n: drive.amplitude_n,
                frequency_hz: drive.frequency_hz,
                phase_rad: drive.phase_rad,
            })
        })
        .collect()
}

fn shape(modes: &Modes, what: String, point: &str) -> Result<Vec<f64>, PlantError> {
    modes.shape.get(point).cloned().ok_or_else(|| unknown(what, point, modes.shape.keys()))
}

fn unknown<'a>(what: String, name: &str, known: impl Iterator<Item = &'a String>) -> PlantError {
    PlantError::UnknownName { what, name: name.to_owned(), known: known.cloned().collect::<Vec<_>>().join(", ") }
}
