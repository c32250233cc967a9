//! Mean power of a recorded voltage.

use super::recording::{RecordingInput, findings};
use crate::arrays::PythonDict;
use crate::branch::json;
use crate::cancellable::{detached, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use jounce_core::signal::{OrderLine, Window};
use jounce_measure::recording::{Issue, Quantity};
use jounce_measure::spectral::{MeanPower, mean_power, signal};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Result of one recording.
struct PowerData {
    channel: String,
    power: MeanPower,
    /// Mean square of the base acceleration about its mean, m^2/s^4; NaN where not requested.
    mean_square: f64,
    orders: Vec<OrderLine>,
    spectrum: jounce_core::signal::Spectrum,
    findings: Vec<Issue>,
}

/// Computes mean power in a resistance with its interval, amplitudes at multiples of a drive, and
/// the voltage spectrum.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python function, which passes them by name"
)]
pub fn measured_power<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    resistance_ohm: f64,
    voltage: Option<String>,
    base: Option<String>,
    drive_hz: Option<f64>,
    orders: Vec<f64>,
    remove_mean: bool,
) -> PythonResult<'py> {
    let record = recording.even()?;
    let outcome = detached(py, move |control| {
        let voltage = record.choose(voltage.as_deref(), Quantity::Voltage)?;
        let samples = signal(voltage, record.rate())?;
        let mean_square = match &base {
            None => f64::NAN,
            Some(name) => {
                let base = signal(
                    record.choose(Some(name), Quantity::Acceleration)?,
                    record.rate(),
                )?;
                base.rms().powi(2) - base.mean().powi(2)
            }
        };
        let resolved_orders = |drive_hz: f64| {
            orders
                .iter()
                .copied()
                .filter(|order| order * drive_hz < 0.5 * record.rate())
                .collect::<Vec<_>>()
        };
        Failure::unless_stopped(control, ())?;
        let orders = match drive_hz {
            None => Vec::new(),
            Some(drive_hz) => samples.orders(drive_hz, &resolved_orders(drive_hz))?.lines,
        };
        Failure::unless_stopped(control, ())?;
        let power = mean_power(&samples, resistance_ohm, remove_mean)?;
        Failure::unless_stopped(control, ())?;
        let spectrum = samples.spectrum(Window::Hann);
        Ok::<_, Failure>(PowerData {
            channel: voltage.name.clone(),
            power,
            mean_square,
            orders,
            spectrum,
            findings: record.findings.clone(),
        })
    });
    to_python_result(py, outcome, |result| into_python(py, result))
}

fn into_python<'py>(py: Python<'py>, result: PowerData) -> PyResult<Bound<'py, PyDict>> {
    let dict = PythonDict::new(py)
        .with("channel", result.channel)?
        .with("power", json(&result.power)?)?
        .with("mean_square_base_acceleration_m2_s4", result.mean_square)?
        .each("order", &result.orders, |line| line.order)?
        .each("order_frequency_hz", &result.orders, |line| {
            line.frequency_hz
        })?
        .each("order_amplitude_peak_v", &result.orders, |line| {
            line.amplitude_peak
        })?
        .array("frequency_hz", result.spectrum.frequency_hz)?
        .array("amplitude_peak", result.spectrum.amplitude_peak)?
        .with("findings", findings(&result.findings)?)?;
    Ok(dict.dict())
}
