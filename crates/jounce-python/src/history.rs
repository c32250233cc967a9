//! Samples of the recorded end of a run.

use crate::arrays::PythonDict;
use jounce_core::integrate::Kernel;
use jounce_core::run::{RunPlan, RunResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Motion at given times.
pub struct Samples {
    time_s: Vec<f64>,
    /// Values per point, stop or patch, then per time.
    displacement_m: Vec<Vec<f64>>,
    velocity_m_s: Vec<Vec<f64>>,
    relative_displacement_m: Vec<Vec<f64>>,
    voltage_v: Vec<Vec<f64>>,
    force_n: Vec<Vec<f64>>,
}

/// Samples of a record: evenly spaced, and once per drive cycle.
pub struct History {
    even: Samples,
    strobed: Samples,
    point: Vec<String>,
    patch: Vec<String>,
    stop: Vec<String>,
}

impl History {
    /// Samples the record of a plan.
    pub fn new(kernel: &Kernel, answer: &RunResult, plan: &RunPlan, sample_rate_hz: f64) -> Self {
        let system = &kernel.plant.system;
        let begin_s = plan.duration_s - plan.record_s;
        let count = (plan.record_s * sample_rate_hz * (1.0 + 1e-12)) as usize + 1;
        let even: Vec<f64> = (0..count)
            .map(|k| begin_s + k as f64 / sample_rate_hz)
            .collect();
        let cycle_s = kernel
            .plant
            .tones
            .first()
            .map(|tone| std::f64::consts::TAU / tone.angular_frequency_rad_s);
        let cycles = cycle_s.map_or(0, |cycle_s| (plan.record_s / cycle_s) as usize + 1);
        let strobed: Vec<f64> = (0..cycles)
            .rev()
            .map(|k| plan.duration_s - k as f64 * cycle_s.unwrap_or_default())
            .collect();
        Self {
            even: Samples::new(kernel, answer, even),
            strobed: Samples::new(kernel, answer, strobed),
            point: system.modes.shape.keys().cloned().collect(),
            patch: system.modes.patch.keys().cloned().collect(),
            stop: system.stops.iter().map(|stop| stop.name.clone()).collect(),
        }
    }

    /// Converts the samples for Python.
    pub fn dict<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let answer = PythonDict::new(py)
            .with("point", self.point)?
            .with("patch", self.patch)?
            .with("stop", self.stop)?;
        let answer = self.even.told(answer, "")?;
        Ok(self.strobed.told(answer, "poincare_")?.dict())
    }
}

impl Samples {
    fn new(kernel: &Kernel, answer: &RunResult, time_s: Vec<f64>) -> Self {
        let plant = &kernel.plant;
        let (modes, n) = (&plant.system.modes, plant.system.modes.len());
        let instants = answer.trajectory.at(kernel, &time_s);
        let states: Vec<Vec<f64>> = instants
            .iter()
            .map(|at| plant.to_physical(&at.state, at.time_s))
            .collect();
        let voltages: Vec<Vec<f64>> = states.iter().map(|x| plant.patch_voltages_v(x)).collect();
        let along = |shape: &[f64], first: usize| -> Vec<f64> {
            states
                .iter()
                .map(|x| {
                    shape
                        .iter()
                        .zip(&x[first..first + n])
                        .map(|(s, q)| s * q)
                        .sum()
                })
                .collect()
        };
        Self {
            displacement_m: modes.shape.values().map(|shape| along(shape, 0)).collect(),
            velocity_m_s: modes.shape.values().map(|shape| along(shape, n)).collect(),
            relative_displacement_m: plant
                .system
                .stops
                .iter()
                .map(|stop| along(&stop.shape, 0))
                .collect(),
            voltage_v: (0..modes.patch.len())
                .map(|patch| voltages.iter().map(|v| v[patch]).collect())
                .collect(),
            force_n: (0..plant.system.stops.len())
                .map(|stop| instants.iter().map(|at| at.forces_n[stop]).collect())
                .collect(),
            time_s,
        }
    }

    fn told<'py>(self, answer: PythonDict<'py>, prefix: &str) -> PyResult<PythonDict<'py>> {
        let name = |name: &str| format!("{prefix}{name}");
        let columns = self.time_s.len();
        answer
            .rows(&name("displacement_m"), &self.displacement_m, columns)?
            .rows(&name("velocity_m_s"), &self.velocity_m_s, columns)?
            .rows(
                &name("relative_displacement_m"),
                &self.relative_displacement_m,
                columns,
            )?
            .rows(&name("voltage_v"), &self.voltage_v, columns)?
            .rows(&name("force_n"), &self.force_n, columns)?
            .array(&name("time_s"), self.time_s)
    }
}
