//! What the sensors of a virtual rig record of a harvester.

use crate::failure::Failure;
use crate::measured::recording::told;
use crate::run::Handed;
use crate::spec::Spec;
use crate::watched::{handed, watched};
use jounce::linear::Response;
use jounce::plant::{Plant, System};
use jounce::spec::Gravity;
use jounce::structure::modes_holding;
use jounce_measure::recording::Recording;
use jounce_measure::rig::{HammerTest, Sensor, ShakerTest, Wander, hammer_test, shaker_test};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The sensors and their clock.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Sensors {
    rate_hz: f64,
    noise: f64,
    bits: Option<u32>,
    seed: u64,
}

/// A hammer test, but for its sensors.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Hits {
    point: String,
    at: Vec<String>,
    hold: Vec<String>,
    hits: usize,
    block_s: f64,
    peak_force_n: f64,
    contact_time_s: f64,
}

impl Sensors {
    fn sensor(&self) -> Sensor {
        Sensor { noise_ratio: self.noise, bits: self.bits }
    }
}

/// Marches the run; what the sensors record over its averaging window, accelerometers at some points among them.
#[pyfunction]
pub fn rig_shaken<'py>(py: Python<'py>, spec: &Spec, sensors: Sensors, at: Vec<String>) -> Handed<'py> {
    let found = watched(py, None, |watch| {
        let prepared = spec.prepared(watch)?;
        let (run, start) = (&prepared.spec.run, prepared.start(&spec.folder())?);
        let test = ShakerTest {
            rate_hz: sensors.rate_hz,
            duration_s: run.average_over_s,
            before_s: run.duration_s - run.average_over_s,
            starts: vec![(0.0, start)],
            wander: Wander::NONE,
            accelerometers: at.clone(),
            sensor: sensors.sensor(),
            seed: sensors.seed,
        };
        Ok::<_, Failure>(shaker_test(&prepared.spec, &prepared.kernel.plant.system.modes, &test, watch)?)
    });
    handed(py, found, |recording| told(py, recording))
}

/// Strikes a point with a hammer, stops and drives taken away; without points to record at, every point and patch records.
#[pyfunction]
pub fn rig_struck<'py>(py: Python<'py>, spec: &Spec, sensors: Sensors, hits: Hits) -> PyResult<Bound<'py, PyDict>> {
    let found = py.detach(|| struck(spec, &sensors, hits)).map_err(|failure| failure.raised(py))?;
    told(py, found)
}

fn struck(spec: &Spec, sensors: &Sensors, hits: Hits) -> Result<Recording, Failure> {
    let mut spec = spec.spec.clone();
    spec.drive.clear();
    spec.stop.clear();
    spec.gravity = Gravity::default();
    let modes = modes_holding(&spec, &hits.hold)?;
    let points: Vec<String> = if hits.at.is_empty() { modes.shape.keys().cloned().collect() } else { hits.at.clone() };
    let patches = modes.patch.keys().filter(|_| hits.at.is_empty()).map(|patch| Response::Voltage(patch.clone()));
    let responses = points.into_iter().map(Response::Acceleration).chain(patches).collect();
    let Hits { point, hits, block_s, peak_force_n, contact_time_s, .. } = hits;
    let (rate_hz, sensor, seed) = (sensors.rate_hz, sensors.sensor(), sensors.seed);
    let test = HammerTest { point, responses, hits, block_s, peak_force_n, contact_time_s, rate_hz, sensor, seed };
    Ok(hammer_test(&Plant::new(System::assemble(&spec, modes)?)?, &test)?)
}
