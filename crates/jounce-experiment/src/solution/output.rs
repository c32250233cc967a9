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

use jounce_dynamics::{Kernel, Trajectory, TrajectoryState};
use jounce_linalg::c64;
use jounce_model::plant::Plant;
use jounce_spec::Spec;
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
    outputs: &[SensorOutput],
) -> Vec<Vec<f64>> {
    let plant = &kernel.plant;
    let readers: Vec<OutputReader> = outputs.iter().map(|output| reader(plant, output)).collect();
    let bases: Vec<Option<BaseMotion>> = outputs
        .iter()
        .map(|output| BaseMotion::at_output(spec, plant, output))
        .collect();
    let mut rows = vec![Vec::with_capacity(times_s.len()); outputs.len()];
    for instant in trajectory.at(kernel, times_s) {
        let phasors: Vec<c64> = plant
            .tones
            .iter()
            .map(|tone| c64::cis(tone.angular_frequency_rad_s * instant.time_s))
            .collect();
        let signal_values: Vec<f64> = plant
            .system
            .signals
            .iter()
            .map(|signal| signal_value(&signal.wave, instant.time_s))
            .collect();
        for ((row, reader), base) in rows.iter_mut().zip(&readers).zip(&bases) {
            let base_motion = base
                .as_ref()
                .map_or(0.0, |base| base.at(instant.time_s, &signal_values));
            row.push(base_motion + read_output(reader, &instant, &phasors, &signal_values));
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
            let zero_shape = vec![0.0; plant.system.modes.len()];
            let velocity =
                plant.velocity_row(plant.system.modes.shape.get(point).unwrap_or(&zero_shape));
            let project =
                |column: &[f64]| velocity.iter().zip(column).map(|(c, b)| c * b).sum::<f64>();
            let time_derivative = |(y, tone): (c64, &jounce_model::plant::Tone)| {
                y * c64::new(0.0, tone.angular_frequency_rad_s)
            };
            OutputReader::Rate {
                row: plant.diagonal.block.rate_row(&velocity),
                signals: plant
                    .system
                    .signals
                    .iter()
                    .map(|signal| project(&plant.force_column(&signal.shape)))
                    .collect(),
                ports: plant
                    .ports
                    .iter()
                    .map(|port| project(&port.force))
                    .collect(),
                steady: plant
                    .steady_output(&velocity)
                    .into_iter()
                    .zip(&plant.tones)
                    .map(time_derivative)
                    .collect(),
            }
        }
    }
}

fn read_output(
    reader: &OutputReader,
    instant: &TrajectoryState,
    phasors: &[c64],
    signal_values: &[f64],
) -> f64 {
    let dot = |row: &[f64], vector: &[f64]| row.iter().zip(vector).map(|(c, y)| c * y).sum::<f64>();
    let steady_part = |steady: &[c64]| {
        steady
            .iter()
            .zip(phasors)
            .map(|(y, phasor)| (*y * *phasor).re)
            .sum::<f64>()
    };
    match reader {
        OutputReader::State { row, steady } => dot(row, &instant.state) + steady_part(steady),
        OutputReader::Force(stop) => instant.forces_n[*stop],
        OutputReader::Rate {
            row,
            signals,
            ports,
            steady,
        } => {
            dot(row, &instant.state)
                + dot(signals, signal_values)
                + dot(ports, &instant.forces_n)
                + steady_part(steady)
        }
        OutputReader::Base => 0.0,
    }
}

fn signal_value(wave: &jounce_model::drive::Wave, time_s: f64) -> f64 {
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
    fn at_output(spec: &Spec, plant: &Plant, output: &SensorOutput) -> Option<Self> {
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
            .filter(|drive| drive.base.as_deref() == Some(base));
        let signals = plant
            .system
            .signals
            .iter()
            .enumerate()
            .filter(|(_, signal)| signal.base.as_deref() == Some(base));
        Some(Self {
            tones: tones
                .map(|drive| (drive.amplitude_n, drive.frequency_hz, drive.phase_rad))
                .collect(),
            signals: signals.map(|(k, _)| k).collect(),
        })
    }

    fn at(&self, time_s: f64, signal_values: &[f64]) -> f64 {
        let tone = |(peak, hz, angle): &(f64, f64, f64)| {
            peak * (TAU * (hz * time_s).fract() + angle).sin()
        };
        self.tones.iter().map(tone).sum::<f64>()
            + self.signals.iter().map(|k| signal_values[*k]).sum::<f64>()
    }
}
