//! Force pulses of a hammer and the contact laws fitted to them.

use super::recording::{RecordingInput, findings};
use crate::arrays::PythonDict;
use crate::branch::json;
use crate::failure::Failure;
use jounce_core::signal::Samples;
use jounce_measure::contact::fit;
use jounce_measure::draw::PulseFigure;
use jounce_measure::recording::Quantity;
use jounce_measure::spectral::{HitSearch, hits};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Returns every hit of a record with its fitted law, or the reason why no law could be fitted.
#[pyfunction]
pub fn measured_contact<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    force: Option<String>,
    mass_kg: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let record = recording.even()?;
    let analysis = py.detach(|| {
        let force = record.choose(force.as_deref(), Quantity::Force)?;
        let samples = Samples::new(&force.values, record.rate())?;
        let hits = hits(&samples, HitSearch::default())?;
        let fits: Vec<_> = hits.iter().map(|hit| fit(&samples, hit, mass_kg)).collect();
        let pulses: Vec<PulseFigure> = hits
            .iter()
            .zip(&fits)
            .map(|(hit, law)| PulseFigure::of(&samples, hit, law.as_ref().ok()))
            .collect();
        Ok::<_, Failure>((force.name.clone(), hits, fits, pulses))
    });
    let (channel, hits, fits, pulses) = analysis.map_err(|failure| failure.into_exception(py))?;
    let laws: Vec<_> = fits.iter().map(|law| law.as_ref().ok()).collect();
    let reasons: Vec<String> = fits
        .iter()
        .map(|law| {
            law.as_ref()
                .err()
                .map_or_else(String::new, ToString::to_string)
        })
        .collect();
    let row = |values: Vec<f64>| PyArray1::from_vec(py, values);
    let pulses: Vec<_> = pulses
        .into_iter()
        .map(|pulse| {
            (
                row(pulse.time_s),
                row(pulse.force_n),
                row(pulse.law.0),
                row(pulse.law.1),
            )
        })
        .collect();
    let dict = PythonDict::new(py)
        .with("channel", channel)?
        .with("rate_hz", record.rate())?
        .with("hits", json(&hits)?)?
        .with("laws", json(&laws)?)?
        .with("why", reasons)?
        .with("pulses", pulses)?
        .with("findings", findings(&record.findings)?)?;
    Ok(dict.dict())
}
