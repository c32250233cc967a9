//! Virtual test: simulated sensor recordings of a harvester.

use crate::cancellable::{cancellable, to_python_result};
use crate::failure::Failure;
use crate::measured::recording::{RecordingInput, into_python};
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::integrate::Control;
use jounce_core::linear::FrfResponse;
use jounce_core::plant::{Plant, System};
use jounce_core::run::StartState;
use jounce_core::spec::{Gravity, driving_channel};
use jounce_core::structure::modes_holding;
use jounce_measure::recording::{Quantity, Recording};
use jounce_measure::rig::{
    Cable, Disturbance, HammerTest, RigError, Sensor, ShakerTest, add_accelerometers, hammer_test,
    on_recorded_base, shaker_test, start_of_run,
};
use jounce_measure::solution::{SolutionSearch, solutions, start_of};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Sensors, their clock, and their effect on the harvester.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Sensors {
    rate_hz: f64,
    noise: f64,
    bits: Option<u32>,
    seed: u64,
    /// Points with an accelerometer, and the mass of each accelerometer.
    at: Vec<String>,
    sensor_mass_kg: Option<f64>,
    cable_f: Option<f64>,
    cable_leakage_ohm: Option<f64>,
    /// Bodies that are fixed.
    hold: Vec<String>,
}

/// Options of a hammer test, without its sensors.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Hits {
    point: String,
    hits: usize,
    block_s: f64,
    peak_force_n: f64,
    contact_time_s: f64,
}

/// Options of a shaker in addition to the spec.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Shaker {
    amplitude_wander: f64,
    frequency_wander: f64,
    wander_time_s: f64,
    amplitude_drift: f64,
    frequency_drift: f64,
    /// Solutions of the model by id, with the time of the record at which each begins, s.
    solution: Vec<(String, f64)>,
    starts: usize,
    starts_seed: u64,
    base_channel: Option<String>,
    keep_mean: bool,
}

impl Sensors {
    fn sensor(&self) -> Sensor {
        Sensor {
            noise_ratio: self.noise,
            bits: self.bits,
        }
    }

    /// Adds cables and accelerometers to the spec.
    fn fit(&self, spec: &mut jounce_core::spec::Spec) -> Result<(), Failure> {
        if self.cable_f.is_some() || self.cable_leakage_ohm.is_some() {
            Cable {
                capacitance_f: self.cable_f.unwrap_or(0.0),
                leakage_ohm: self.cable_leakage_ohm,
            }
            .wire(spec)?;
        }
        if let Some(mass_kg) = self.sensor_mass_kg {
            add_accelerometers(spec, &self.at, mass_kg)?;
        }
        Ok(())
    }
}

impl Shaker {
    fn disturbance(&self) -> Disturbance {
        let disturbance = Disturbance {
            amplitude_ratio: self.amplitude_wander,
            frequency_ratio: self.frequency_wander,
            memory_s: self.wander_time_s,
            amplitude_drift: self.amplitude_drift,
            frequency_drift: self.frequency_drift,
        };
        // A correlation time of zero means no fluctuation.
        let is_zero = Disturbance {
            memory_s: disturbance.memory_s,
            ..Disturbance::NONE
        } == disturbance;
        if is_zero {
            Disturbance::NONE
        } else {
            disturbance
        }
    }

    /// Returns times and states of the requested solutions.
    fn solutions(
        &self,
        spec: &jounce_core::spec::Spec,
        control: &Control,
    ) -> Result<Vec<(f64, StartState)>, Failure> {
        let known_solutions = solutions(
            spec,
            &SolutionSearch {
                starts: self.starts,
                seed: self.starts_seed,
                ..SolutionSearch::default()
            },
            control,
        )?;
        self.solution
            .iter()
            .map(|(id, at_s)| Ok((*at_s, start_of(&known_solutions, id)?)))
            .collect()
    }
}

/// Integrates the run, or a given motion of the base, and returns the sensor recordings of its
/// averaging window.
#[pyfunction]
pub fn rig_shaken<'py>(
    py: Python<'py>,
    spec: &Spec,
    sensors: Sensors,
    shaker: Shaker,
    base: Option<RecordingInput<'py>>,
) -> PythonResult<'py> {
    let base = base.map(|base| base.even()).transpose()?;
    let outcome = cancellable(py, None, |control| {
        record_shaker_test(spec, &sensors, &shaker, base.as_ref(), control)
    });
    to_python_result(py, outcome, |recording| into_python(py, recording))
}

fn record_shaker_test(
    base_spec: &Spec,
    sensors: &Sensors,
    shaker: &Shaker,
    base: Option<&Recording>,
    control: &Control,
) -> Result<Recording, Failure> {
    let mut spec = base_spec.spec().clone();
    sensors.fit(&mut spec)?;
    if let Some(base) = base {
        let channel_name = shaker.base_channel.as_deref();
        let number = driving_channel(
            (&base.name, &base.heads(), &base.findings),
            channel_name,
            Quantity::Acceleration,
        )
        .map_err(RigError::from)?;
        on_recorded_base(
            &mut spec,
            base,
            &base.channels[number].name,
            shaker.keep_mean,
        )?;
    }
    let modes = modes_holding(&spec, &sensors.hold)?;
    let run = &spec.run;
    let (starts, before_s) = match shaker.solution.is_empty() {
        true => (
            vec![(0.0, start_of_run(&spec, &modes, &base_spec.folder())?)],
            run.duration_s - run.average_over_s,
        ),
        false => (shaker.solutions(&spec, control)?, 0.0),
    };
    let test = ShakerTest {
        rate_hz: sensors.rate_hz,
        duration_s: run.average_over_s,
        before_s,
        starts,
        disturbance: shaker.disturbance(),
        accelerometers: sensors.at.clone(),
        sensor: sensors.sensor(),
        seed: sensors.seed,
    };
    Ok(shaker_test(&spec, &modes, &test, control)?)
}

/// Hits a point with a hammer, with stops and drives removed; without given points, every point and
/// patch is recorded.
#[pyfunction]
pub fn rig_struck<'py>(
    py: Python<'py>,
    spec: &Spec,
    sensors: Sensors,
    hits: Hits,
) -> PyResult<Bound<'py, PyDict>> {
    let recording = py
        .detach(|| record_hammer_test(spec, &sensors, hits))
        .map_err(|failure| failure.into_exception(py))?;
    into_python(py, recording)
}

fn record_hammer_test(spec: &Spec, sensors: &Sensors, hits: Hits) -> Result<Recording, Failure> {
    let mut spec = spec.spec().clone();
    sensors.fit(&mut spec)?;
    spec.take_drives_away();
    spec.stop.clear();
    spec.gravity = Gravity::default();
    let modes = modes_holding(&spec, &sensors.hold)?;
    let at_all_points = sensors.at.is_empty();
    let points: Vec<String> = if at_all_points {
        modes.shape.keys().cloned().collect()
    } else {
        sensors.at.clone()
    };
    let patches = modes
        .patch
        .keys()
        .filter(|_| at_all_points)
        .map(|patch| FrfResponse::Voltage(patch.clone()));
    let responses = points
        .into_iter()
        .map(FrfResponse::Acceleration)
        .chain(patches)
        .collect();
    let Hits {
        point,
        hits,
        block_s,
        peak_force_n,
        contact_time_s,
    } = hits;
    let (rate_hz, sensor, seed) = (sensors.rate_hz, sensors.sensor(), sensors.seed);
    let test = HammerTest {
        point,
        responses,
        hits,
        block_s,
        peak_force_n,
        contact_time_s,
        rate_hz,
        sensor,
        seed,
    };
    Ok(hammer_test(
        &Plant::new(System::assemble(&spec, modes)?)?,
        &test,
    )?)
}
