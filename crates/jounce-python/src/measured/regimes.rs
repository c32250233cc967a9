//! A long record cut into stretches of one solution each.

use super::recording::{Given, findings};
use crate::arrays::Answer;
use crate::branch::json;
use crate::failure::Failure;
use jounce::signal::Samples;
use jounce_measure::recording::Quantity;
use jounce_measure::regime::regimes;
use jounce_measure::spectral::mean_power;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The stretches of a channel under a drive; the mean power of each where the channel is the voltage over a resistance.
#[pyfunction]
pub fn measured_regimes<'py>(
    py: Python<'py>,
    given: Given<'py>,
    drive_hz: f64,
    channel: Option<String>,
    resistance_ohm: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let record = given.even()?;
    let found = py.detach(|| {
        let channel = match &channel {
            // Any quantity can be cut; only a voltage has a power.
            Some(name) if resistance_ohm.is_none() => record.channel(name)?,
            wanted => record.choose(wanted.as_deref(), Quantity::Voltage)?,
        };
        let found = regimes(&Samples::new(&channel.values, record.rate())?, drive_hz)?;
        let mut powers = Vec::new();
        for stretch in found.stretches.iter().filter(|_| resistance_ohm.is_some()) {
            let part = Samples::new(&channel.values[stretch.start..stretch.end], record.rate())?;
            powers.push(mean_power(&part, resistance_ohm.unwrap_or(f64::NAN), false)?);
        }
        Ok::<_, Failure>((channel.clone(), found, powers))
    });
    let (channel, found, powers) = found.map_err(|failure| failure.raised(py))?;
    let answer = Answer::new(py)
        .with("channel", channel.name)?
        .with("unit", channel.unit)?
        .with("uncertainty_s", found.uncertainty_s)?
        .with("stretches", json(&found.stretches)?)?
        .with("powers", json(&powers)?)?
        .array("time_s", record.grid.places())?
        .array("values", channel.values)?
        .with("findings", findings(&record.findings)?)?;
    Ok(answer.dict())
}
