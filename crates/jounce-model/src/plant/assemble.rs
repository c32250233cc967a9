//! Resolution of the names of a spec against the modes of its structure.

use super::{
    Bridge, BridgeState, Connection, Dashpot, Drive, Load, PlantError, RectifierScheme, Regulator,
    Signal, Stop, Storage, System,
};
use crate::contact::Law;
use crate::drive::{Wave, displaced, wave};
use crate::structure::Modes;
use jounce_spec::{Circuit, DriveKind, DriveSignal, Interface, Side, Spec};
use std::f64::consts::TAU;
use std::sync::Arc;

impl System {
    /// Resolves the names of a spec against the modes of its structure.
    ///
    /// # Errors
    /// [`PlantError::UnknownName`], [`PlantError::TwoCircuits`], [`PlantError::ImmobilePort`],
    /// [`PlantError::NoForceCurve`].
    pub fn assemble(spec: &Spec, modes: impl Into<Arc<Modes>>) -> Result<Self, PlantError> {
        Self::assemble_unless(spec, modes, &|| false)
    }

    /// As [`System::assemble`], without the samples of noise if `is_stopped` reports that the run
    /// is cancelled.
    ///
    /// # Errors
    /// As [`System::assemble`].
    pub fn assemble_unless(
        spec: &Spec,
        modes: impl Into<Arc<Modes>>,
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<Self, PlantError> {
        let modes = modes.into();
        let (loads, bridges) = circuits(spec, &modes)?;
        let dashpots = dashpots(spec, &modes)?;
        let stops = stops(spec, &modes)?;
        let drives = drives(spec, &modes)?;
        let signals = Self::signals(spec, &modes, is_stopped)?;
        Ok(Self {
            modes,
            loads,
            bridges,
            dashpots,
            stops,
            drives,
            signals,
        })
    }

    /// Returns the drives of a spec that are not sinusoidal, its gravity, and the currents of its
    /// regulators. Noise is generated
    /// for `run.duration`, unless `is_stopped` reports that the run is cancelled.
    ///
    /// # Errors
    /// [`PlantError::UnknownName`].
    pub fn signals(
        spec: &Spec,
        modes: &Modes,
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<Vec<Signal>, PlantError> {
        let mut signals = Vec::new();
        for (name, drive) in &spec.drive {
            let waves = match drive.kind {
                DriveKind::BaseDisplacement => displaced(&drive.signal),
                DriveKind::Force | DriveKind::BaseAcceleration => {
                    wave(&drive.signal, spec.run.duration_s, is_stopped)
                        .into_iter()
                        .collect()
                }
            };
            for wave in waves {
                signals.push(Signal {
                    name: name.clone(),
                    shape: driven(modes, name, drive)?,
                    wave,
                    base: drive.base().map(str::to_owned),
                    drawn_from: None,
                });
            }
        }
        if let Some(acceleration) = spec
            .gravity
            .acceleration_m_s2
            .filter(|acceleration| *acceleration != 0.0)
        {
            let wave = Wave::Constant(acceleration);
            signals.push(Signal {
                name: "gravity".to_owned(),
                shape: modes.participation_sqrt_kg.clone(),
                wave,
                base: None,
                drawn_from: None,
            });
        }
        // The circuits with a scheme are the bridges, in this order.
        let rectified = spec.circuit.values().filter(|own| scheme(own).is_some());
        for (bridge, circuit) in rectified.enumerate() {
            if !circuit.regulator.is_empty() {
                signals.push(Signal {
                    name: circuit.regulator.clone(),
                    shape: vec![0.0; modes.len()],
                    wave: Wave::Constant(0.0),
                    base: None,
                    drawn_from: Some(bridge),
                });
            }
        }
        Ok(signals)
    }
}

fn circuits(spec: &Spec, modes: &Modes) -> Result<(Vec<Load>, Vec<Bridge>), PlantError> {
    let (mut loads, mut bridges) = (Vec::new(), Vec::new());
    let mut assigned: Vec<(String, String)> = Vec::new();
    for (name, circuit) in &spec.circuit {
        let mut connections: Vec<Connection> = Vec::new();
        for (patch, sign) in circuit.connections() {
            if !modes.patch.contains_key(patch) {
                return Err(unknown(
                    format!("circuit.{name}.patch"),
                    patch,
                    modes.patch.keys(),
                ));
            }
            if let Some((_, first)) = assigned.iter().find(|(assigned, _)| assigned == patch) {
                return Err(PlantError::TwoCircuits {
                    patch: patch.to_owned(),
                    first: first.clone(),
                    second: name.clone(),
                });
            }
            assigned.push((patch.to_owned(), name.clone()));
            connections.push(Connection {
                patch: patch.to_owned(),
                sign,
            });
        }
        if connections.is_empty() {
            return Err(unknown(
                format!("circuit.{name}.patch"),
                "",
                modes.patch.keys(),
            ));
        }
        if let Some(scheme) = scheme(circuit) {
            bridges.push(bridge(spec, (name, circuit), connections, scheme));
            continue;
        }
        let inductor = circuit
            .inductance_h
            .map(|inductance_h| (inductance_h, circuit.inductor));
        loads.push(Load {
            name: name.clone(),
            connections,
            wiring: circuit.wiring,
            resistance_ohm: circuit.resistance_ohm,
            inductor,
        });
    }
    Ok((loads, bridges))
}

/// `None` for a circuit without diodes. An inversion by an inductor retains `q = exp(-pi / (2 Q))`
/// of the voltage.
fn scheme(circuit: &Circuit) -> Option<RectifierScheme> {
    let inversion = circuit.quality_factor.map_or(0.0, |quality| {
        (-std::f64::consts::PI / (2.0 * quality)).exp()
    });
    match circuit.interface {
        Interface::Resistor => None,
        Interface::Bridge => Some(RectifierScheme::Standard),
        Interface::ParallelSshi => Some(RectifierScheme::ParallelSshi { inversion }),
        Interface::SeriesSshi => Some(RectifierScheme::SeriesSshi { inversion }),
        Interface::Sece => Some(RectifierScheme::Extraction {
            efficiency: circuit.efficiency,
        }),
    }
}

fn bridge(
    spec: &Spec,
    (name, circuit): (&str, &Circuit),
    connections: Vec<Connection>,
    scheme: RectifierScheme,
) -> Bridge {
    let capacitance_f = circuit.storage_f.unwrap_or(f64::NAN);
    let regulator = Regulator::of(spec, circuit);
    let storage = match (circuit.battery_v, regulator) {
        (Some(voltage_v), _) => Storage::Battery { voltage_v },
        (None, Some(regulator)) => Storage::Regulated {
            capacitance_f,
            regulator,
        },
        (None, None) => Storage::Capacitor {
            capacitance_f,
            load_ohm: circuit.resistance_ohm,
        },
    };
    Bridge {
        name: name.to_owned(),
        connections,
        wiring: circuit.wiring,
        scheme,
        storage,
        drop_v: 2.0 * circuit.diode_drop_v,
        diode_ohm: 2.0 * circuit.diode_resistance_ohm,
        leakage_ohm: circuit.leakage_ohm,
        state: BridgeState::default(),
    }
}

fn dashpots(spec: &Spec, modes: &Modes) -> Result<Vec<Dashpot>, PlantError> {
    let braked = spec
        .mass
        .iter()
        .filter_map(|(name, mass)| Some((name, mass.friction_n_s_m.filter(|n_s_m| *n_s_m > 0.0)?)));
    braked
        .map(|(name, n_s_m)| {
            Ok(Dashpot {
                name: name.clone(),
                shape: shape(modes, format!("mass.{name}"), name)?,
                n_s_m,
            })
        })
        .collect()
}

fn stops(spec: &Spec, modes: &Modes) -> Result<Vec<Stop>, PlantError> {
    let mut stops = Vec::new();
    for (name, stop) in &spec.stop {
        let at = shape(modes, format!("stop.{name}.at"), &stop.at)?;
        let frame = match stop.frame.as_str() {
            base if spec.is_base(base) => vec![0.0; modes.len()],
            body => shape(modes, format!("stop.{name}.frame"), body)?,
        };
        let sign = if stop.side == Side::Positive {
            1.0
        } else {
            -1.0
        };
        let shape: Vec<f64> = at
            .iter()
            .zip(&frame)
            .map(|(at, frame)| sign * (at - frame))
            .collect();
        if shape.iter().all(|s| *s == 0.0) {
            return Err(PlantError::ImmobilePort { stop: name.clone() });
        }
        let under = [(&stop.at, sign), (&stop.frame, -sign)]
            .map(|(point, way)| (spec.base_under(point).to_owned(), way));
        let bases = if under[0].0 == under[1].0 {
            Vec::new()
        } else {
            under.to_vec()
        };
        stops.push(Stop {
            name: name.clone(),
            shape,
            gap_m: stop.gap_m,
            law: Law::of(stop).ok_or_else(|| PlantError::NoForceCurve { stop: name.clone() })?,
            bases,
        });
    }
    Ok(stops)
}

fn drives(spec: &Spec, modes: &Modes) -> Result<Vec<Drive>, PlantError> {
    let mut drives = Vec::new();
    for (name, drive) in &spec.drive {
        let DriveSignal::Sine {
            amplitude,
            frequency_hz,
            phase_rad,
        } = drive.signal
        else {
            continue;
        };
        // a = -w^2 x for a sinusoidal displacement of the base.
        let amplitude_n = match drive.kind {
            DriveKind::Force | DriveKind::BaseAcceleration => amplitude,
            DriveKind::BaseDisplacement => -(TAU * frequency_hz).powi(2) * amplitude,
        };
        let (shape, base) = (driven(modes, name, drive)?, drive.base().map(str::to_owned));
        drives.push(Drive {
            name: name.clone(),
            shape,
            amplitude_n,
            frequency_hz,
            phase_rad,
            base,
        });
    }
    Ok(drives)
}

/// Returns the modal force of a drive of 1 N or 1 m/s^2.
pub fn driven(
    modes: &Modes,
    name: &str,
    drive: &jounce_spec::Drive,
) -> Result<Vec<f64>, PlantError> {
    match drive.base() {
        None => shape(modes, format!("drive.{name}.at"), &drive.at),
        Some(base) => Ok(modes
            .participation_in_sqrt_kg(base)
            .iter()
            .map(|p| -p)
            .collect()),
    }
}

fn shape(modes: &Modes, owner: String, point: &str) -> Result<Vec<f64>, PlantError> {
    modes
        .shape
        .get(point)
        .cloned()
        .ok_or_else(|| unknown(owner, point, modes.shape.keys()))
}

fn unknown<'a>(owner: String, name: &str, known: impl Iterator<Item = &'a String>) -> PlantError {
    PlantError::UnknownName {
        what: owner,
        name: name.to_owned(),
        known: known.cloned().collect::<Vec<_>>().join(", "),
    }
}
