//! Exact response to noise without contact.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::integrate::Control;
use jounce_core::linear::{Density, Random, RandomResponse};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::RangeInclusive;

/// Allowed numbers of frequencies of the densities.
const POINTS: RangeInclusive<usize> = 2..=1_000_000;

/// Response of a spec to its noises.
struct NoiseResult {
    response: RandomResponse,
    frequency_hz: Vec<f64>,
    densities: Vec<Density>,
}

/// Computes means and mean squares, and densities at a number of frequencies between two, Hz; by
/// default over the band of the noises.
#[pyfunction]
pub fn noise<'py>(
    py: Python<'py>,
    spec: &Spec,
    low_hz: Option<f64>,
    high_hz: Option<f64>,
    points: usize,
) -> PythonResult<'py> {
    let outcome = cancellable(py, None, |control| {
        compute(spec, low_hz, high_hz, points, control)
    });
    to_python_result(py, outcome, |result| {
        into_python(
            py,
            result,
            spec.manifest("noise", &[("points", points.to_string())]),
        )
    })
}

fn compute(
    spec: &Spec,
    low_hz: Option<f64>,
    high_hz: Option<f64>,
    points: usize,
    control: &Control,
) -> Result<NoiseResult, Failure> {
    let random = Random::new(spec.spec())?;
    let [low, high] = random.usual_band_hz();
    let (low, high) = (low_hz.unwrap_or(low), high_hz.unwrap_or(high));
    if !(low > 0.0 && low < high && high.is_finite() && POINTS.contains(&points)) {
        let (min_points, max_points) = POINTS.into_inner();
        let reason = format!(
            "low is {low} Hz, high {high} Hz and points {points}; low must be above 0 Hz and below high, points from {min_points} to {max_points}"
        );
        let details = serde_json::json!({ "low_hz": low, "high_hz": high, "points": points, "least_points": min_points, "most_points": max_points });
        return Err(Failure::new("ArgumentError", reason).with(details));
    }
    let frequency_hz = random.frequencies_hz(low, high, points);
    let response = random.response()?;
    let densities = random.densities_until(&frequency_hz, &|| control.is_stopped())?;
    Failure::unless_stopped(
        control,
        NoiseResult {
            response,
            densities,
            frequency_hz,
        },
    )
}

fn into_python<'py>(
    py: Python<'py>,
    result: NoiseResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let NoiseResult {
        response,
        frequency_hz,
        densities,
    } = result;
    let density_dict = PyDict::new(py);
    for density in densities {
        density_dict.set_item(
            density.name,
            (PyArray1::from_vec(py, density.value), density.unit),
        )?;
    }
    let RandomResponse {
        loads,
        patches,
        points,
        stops,
        ..
    } = &response;
    let bandwidths: Vec<Vec<f64>> = loads
        .iter()
        .map(|load| load.noise_bandwidth_hz.clone())
        .collect();
    let dict = PythonDict::new(py)
        .rows(
            "load_noise_bandwidth_hz",
            &bandwidths,
            response.drives.len(),
        )?
        .with("drive", &response.drives)?
        .with("left_out", &response.left_out)?
        .with("mean_power_w", response.mean_power_w)?
        .with(
            "load",
            loads
                .iter()
                .map(|load| load.name.as_str())
                .collect::<Vec<_>>(),
        )?
        .each("load_mean_power_w", loads, |load| load.mean_power_w)?
        .each("load_spectral_power_w", loads, |load| load.spectral_power_w)?
        .each("load_power_difference_relative", loads, |load| {
            load.difference_relative
        })?
        .each("load_voltage_rms_v", loads, |load| load.voltage_rms_v)?
        .each("load_statistical_bandwidth_hz", loads, |load| {
            load.statistical_bandwidth_hz
        })?
        .with(
            "patch",
            patches
                .iter()
                .map(|patch| patch.name.as_str())
                .collect::<Vec<_>>(),
        )?
        .each("patch_voltage_rms_v", patches, |patch| patch.voltage_rms_v)?
        .with(
            "point",
            points
                .iter()
                .map(|point| point.name.as_str())
                .collect::<Vec<_>>(),
        )?
        .each("point_displacement_rms_m", points, |point| {
            point.displacement_rms_m
        })?
        .each("point_velocity_rms_m_s", points, |point| {
            point.velocity_rms_m_s
        })?
        .with(
            "stop",
            stops
                .iter()
                .map(|stop| stop.name.as_str())
                .collect::<Vec<_>>(),
        )?
        .each("stop_gap_m", stops, |stop| stop.gap_m)?
        .each("stop_mean_m", stops, |stop| stop.mean_m)?
        .each("stop_displacement_rms_m", stops, |stop| {
            stop.displacement_rms_m
        })?
        .each("stop_reached_hz", stops, |stop| {
            stop.reached_hz.unwrap_or(f64::NAN)
        })?
        .each("stop_share_beyond", stops, |stop| {
            stop.share_beyond.unwrap_or(f64::NAN)
        })?
        .array("frequency_hz", frequency_hz)?
        .with("densities", density_dict)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
