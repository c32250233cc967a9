//! Sampled sensor outputs of a simulated harvester.
//!
//! With the block coordinates `y' = A y + sum_s b_s u_s(t) + sum_p b_p F_p` relative to the steady
//! state `Y` of the tones, a row `c` reads `c (y + Re Y e^{i w t})`, and its rate is
//!
//! ```text
//! c A y + sum_s c b_s u_s(t) + sum_p c b_p F_p + Re(i w c Y e^{i w t})
//! ```
//!
//! An acceleration is the rate of a velocity. Points move relative to their base, whose
//! acceleration is added.

use faer::c64;
use jounce_core::integrate::{Kernel, Trajectory, TrajectoryState};
use jounce_core::plant::Plant;
use jounce_core::spec::Spec;
use std::f64::consts::TAU;

/// Sensor output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SensorOutput {
    /// Voltage of a patch, by index, V.
    PatchVoltage(usize),
    /// Voltage across the resistor of a load, by index, V.
    LoadVoltage(usize),
    /// Force of a stop, by index, N.
    StopForce(usize),
    /// Absolute acceleration of a point, m/s^2.
    Acceleration(String),
    /// Acceleration of a base, m/s^2.
    Base(String),
}

/// Method of reading one output from a state.
enum OutputReader {
    State {
        row: Vec<f64>,
        steady: Vec<c64>,
    },
    Force(usize),
    Rate {
        row: Vec<f64>,
        signals: Vec<f64>,
        ports: Vec<f64>,
        steady: Vec<c64>,
    },
    Base,
}

/// Computes each output at ascending times of the record of a run of `spec`, one row per output.
///
/// An unknown point reads 0: the caller checks names.
pub fn outputs(
    spec: &Spec,
    kernel: &Kernel,
    trajectory: &Trajectory,
    times_s: &[f64],
    wanted: &[SensorOutput],
) -> Vec<Vec<f64>> {
    let plant = &kernel.plant;
    let readers: Vec<OutputReader> = wanted.iter().map(|output| reader(plant, output)).collect();
    let bases: Vec<Option<BaseMotion>> = wanted
        .iter()
        .map(|output| BaseMotion::under(spec, plant, output))
        .collect();
    let mut rows = vec![Vec::with_capacity(times_s.len()); wanted.len()];
    for instant in trajectory.at(kernel, times_s) {
        let turns: Vec<c64> = plant
            .tones
            .iter()
            .map(|tone| c64::cis(tone.angular_frequency_rad_s * instant.time_s))
            .collect();
        let sizes: Vec<f64> = plant
            .system
            .signals
            .iter()
            .map(|signal| size(&signal.wave, instant.time_s))
            .collect();
        for ((row, reader), base) in rows.iter_mut().zip(&readers).zip(&bases) {
            let moving = base
                .as_ref()
                .map_or(0.0, |base| base.at(instant.time_s, &sizes));
            row.push(moving + read(reader, &instant, &turns, &sizes));
        }
    }
    rows
}

fn reader(plant: &Plant, output: &SensorOutput) -> OutputReader {
    let state = |row: Vec<f64>| OutputReader::State {
        steady: plant.steady_output(&row),
        row,
    };
    match output {
        SensorOutput::PatchVoltage(patch) => state(plant.voltage_row(*patch)),
        SensorOutput::LoadVoltage(load) => state(plant.load_voltage_row(*load)),
        SensorOutput::StopForce(stop) => OutputReader::Force(*stop),
        SensorOutput::Base(_) => OutputReader::Base,
        SensorOutput::Acceleration(point) => {
            let still = vec![0.0; plant.system.modes.len()];
            let velocity =
                plant.velocity_row(plant.system.modes.shape.get(point).unwrap_or(&still));
            let along =
                |column: &[f64]| velocity.iter().zip(column).map(|(c, b)| c * b).sum::<f64>();
            let speeded = |(y, tone): (c64, &jounce_core::plant::Tone)| {
                y * c64::new(0.0, tone.angular_frequency_rad_s)
            };
            OutputReader::Rate {
                row: plant.diagonal.block.rate_row(&velocity),
                signals: plant
                    .system
                    .signals
                    .iter()
                    .map(|signal| along(&plant.force_column(&signal.shape)))
                    .collect(),
                ports: plant.ports.iter().map(|port| along(&port.force)).collect(),
                steady: plant
                    .steady_output(&velocity)
                    .into_iter()
                    .zip(&plant.tones)
                    .map(speeded)
                    .collect(),
            }
        }
    }
}

fn read(reader: &OutputReader, instant: &TrajectoryState, turns: &[c64], sizes: &[f64]) -> f64 {
    let dot = |row: &[f64], of: &[f64]| row.iter().zip(of).map(|(c, y)| c * y).sum::<f64>();
    let turned = |steady: &[c64]| {
        steady
            .iter()
            .zip(turns)
            .map(|(y, turn)| (*y * *turn).re)
            .sum::<f64>()
    };
    match reader {
        OutputReader::State { row, steady } => dot(row, &instant.state) + turned(steady),
        OutputReader::Force(stop) => instant.forces_n[*stop],
        OutputReader::Rate {
            row,
            signals,
            ports,
            steady,
        } => {
            dot(row, &instant.state)
                + dot(signals, sizes)
                + dot(ports, &instant.forces_n)
                + turned(steady)
        }
        OutputReader::Base => 0.0,
    }
}

fn size(wave: &jounce_core::drive::Wave, time_s: f64) -> f64 {
    wave.piece(wave.index_at(time_s)).size_at(time_s)
}

/// Base motion: sinusoids, and indices of signals.
struct BaseMotion {
    /// Acceleration (m/s^2, peak), frequency (Hz), angle at time 0.
    tones: Vec<(f64, f64, f64)>,
    signals: Vec<usize>,
}

impl BaseMotion {
    /// Returns the base whose acceleration is added.
    fn under(spec: &Spec, plant: &Plant, output: &SensorOutput) -> Option<Self> {
        let base = match output {
            SensorOutput::Acceleration(point) => spec.base_under(point),
            SensorOutput::Base(base) => base,
            SensorOutput::PatchVoltage(_)
            | SensorOutput::LoadVoltage(_)
            | SensorOutput::StopForce(_) => return None,
        };
        // The plant contains the initial angle of its run.
        let tones = plant
            .system
            .drives
            .iter()
            .filter(|own| own.base.as_deref() == Some(base));
        let signals = plant
            .system
            .signals
            .iter()
            .enumerate()
            .filter(|(_, own)| own.base.as_deref() == Some(base));
        Some(Self {
            tones: tones
                .map(|own| (own.amplitude_n, own.frequency_hz, own.phase_rad))
                .collect(),
            signals: signals.map(|(k, _)| k).collect(),
        })
    }

    fn at(&self, time_s: f64, sizes: &[f64]) -> f64 {
        let tone = |(peak, hz, angle): &(f64, f64, f64)| {
            peak * (TAU * (hz * time_s).fract() + angle).sin()
        };
        self.tones.iter().map(tone).sum::<f64>()
            + self.signals.iter().map(|k| sizes[*k]).sum::<f64>()
    }
}
