//! Conversion of identified modes for Python.

use crate::arrays::PythonDict;
use crate::branch::json;
use crate::failure::Failure;
use jounce_measure::modal::{Identification, Mode, mac_matrix};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;

/// Checks the largest order.
pub fn check_order(order: usize) -> Result<(), Failure> {
    match (2..=400).contains(&order) {
        true => Ok(()),
        false => {
            let details = serde_json::json!({ "order": order, "least": 2, "most": 400 });
            Err(Failure::new(
                "ArgumentError",
                format!("order is {order}; it must be from 2 to 400"),
            )
            .with(details))
        }
    }
}

/// Converts modes at outputs with the functions they were identified from: responses of a hammer
/// test, or decays, one or more for each output. References are named where there are several.
pub fn identification_dict<'py>(
    py: Python<'py>,
    (outputs, references): (&[String], &[String]),
    functions: &[String],
    identification: &Identification,
) -> PyResult<PythonDict<'py>> {
    let (modes, diagram) = (&identification.modes, &identification.diagram);
    let rows = |rows: &[Vec<Complex64>]| {
        rows.iter()
            .map(|row| PyArray1::from_slice(py, row))
            .collect::<Vec<_>>()
    };
    let stable: Vec<String> = diagram
        .iter()
        .map(|pole| Ok(json(&pole.stable)?.trim_matches('"').to_owned()))
        .collect::<PyResult<_>>()?;
    PythonDict::new(py)
        .each("frequency_hz", modes, |mode| mode.frequency_hz)?
        .each("frequency_deviation_hz", modes, |mode| {
            mode.frequency_deviation_hz
        })?
        .each("damping_ratio", modes, |mode| mode.damping_ratio)?
        .each("damping_deviation", modes, |mode| mode.damping_deviation)?
        .with(
            "doubtful",
            modes.iter().map(Mode::is_doubtful).collect::<Vec<_>>(),
        )?
        .each("quantile_95", modes, |mode| mode.quantile_95)?
        .with("response", outputs)?
        .with("function", functions)?
        .with(
            "shape",
            modes
                .iter()
                .map(|mode| PyArray1::from_vec(py, mode.shape()))
                .collect::<Vec<_>>(),
        )?
        .with("reference", references)?
        .with(
            "participation",
            modes
                .iter()
                .map(|mode| PyArray1::from_slice(py, &mode.participation[..references.len()]))
                .collect::<Vec<_>>(),
        )?
        .rows("mac", &mac_matrix(modes), modes.len())?
        .with("misfit", identification.misfit)?
        .each("unexplained_hz", &identification.unexplained, |peak| {
            peak.frequency_hz
        })?
        .each("pole_order", diagram, |pole| pole.order as i64)?
        .each("pole_frequency_hz", diagram, |pole| pole.pole.frequency_hz)?
        .each("pole_damping_ratio", diagram, |pole| {
            pole.pole.damping_ratio
        })?
        .with("pole_stable", stable)?
        .array("line_hz", identification.frequency_hz.clone())?
        .with("measured", rows(&identification.measured))?
        .with("model", rows(&identification.model))
}
