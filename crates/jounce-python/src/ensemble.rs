//! Ensembles of realisations of noise.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{
    Ensemble, EnsembleResult, Estimate, IntervalOver, Member, StopEstimates, VoltageSpectrum,
};
use jounce_core::run::{ExceededLimit, WorstExcess};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Maximum number of members of a round.
const MAX_MEMBERS: usize = 1_000_000;

/// Maximum number of rounds of members; then the interval is reported even if it is wider than
/// required.
const MAX_ROUNDS: usize = 100;

/// Integrates realisations of the noise, in rounds until the interval is narrow enough where a
/// width is required.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn ensemble<'py>(
    py: Python<'py>,
    spec: &Spec,
    members: usize,
    seed: u64,
    relative_width: Option<f64>,
    spectrum: bool,
    tolerance: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    if !(1..=MAX_MEMBERS).contains(&members)
        || relative_width.is_some_and(|width| !(width > 0.0 && width < 1.0))
    {
        let width = relative_width.map_or_else(|| "None".to_owned(), |width| width.to_string());
        let reason = format!(
            "members is {members} and relative_width {width}; members must be from 1 to {MAX_MEMBERS}, relative_width between 0 and 1"
        );
        let details = serde_json::json!({ "members": members, "relative_width": relative_width, "least_members": 1, "most_members": MAX_MEMBERS });
        return Err(Failure::new("ArgumentError", reason)
            .with(details)
            .into_exception(py));
    }
    if spectrum && members < 2 {
        let reason = "spectrum needs at least two members to estimate the scatter of the density";
        let details = serde_json::json!({ "members": members, "least_members": 2 });
        return Err(Failure::new("ArgumentError", reason)
            .with(details)
            .into_exception(py));
    }
    let tightened = spec.with_tolerance(tolerance)?;
    let spec = tightened.as_ref().unwrap_or(spec);
    let outcome = cancellable(py, progress.as_ref(), |control| {
        let base = spec.model(control)?;
        let start = base.start(&spec.folder())?;
        let most_rounds = if relative_width.is_some() {
            MAX_ROUNDS
        } else {
            1
        };
        let study = Ensemble {
            base: &base,
            start,
            members,
            seed,
            relative_width,
            most_rounds,
            with_spectrum: spectrum,
        };
        on_threads(threads, || Ok(study.run(&|_| ())?))
    });
    let options = [
        ("members", members.to_string()),
        ("seed", seed.to_string()),
        ("spectrum", spectrum.to_string()),
    ];
    let manifest = spec.manifest("ensemble", &options);
    to_python_result(py, outcome, |result| into_python(py, &result, manifest))
}

fn into_python<'py>(
    py: Python<'py>,
    result: &EnsembleResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let members: &[Member] = &result.members;
    let interval_text = if result.power_w.interval == IntervalOver::Members {
        "members"
    } else {
        "batches"
    };
    let dict = PythonDict::new(py)
        .with("mean_power_w", result.power_w.mean)?
        .with("mean_power_half_width_w", result.power_w.half_width)?
        .with("interval_over", interval_text)?
        .with("reached", result.reached)?
        .with("contact_rate_hz", result.contact_rate_hz.mean)?
        .with(
            "contact_rate_half_width_hz",
            result.contact_rate_hz.half_width,
        )?
        .with("mean_impact_velocity_m_s", result.mean_impact_velocity_m_s)?
        .with("max_impact_velocity_m_s", result.max_impact_velocity_m_s)?
        .with("mean_contact_duration_s", result.mean_contact_duration_s)?
        .each("member", members, |m| m.index as i64)?
        .each("member_power_w", members, |m| m.mean_power_w)?
        .each("member_contacts", members, |m| m.contacts as i64)?
        .each("member_contact_rate_hz", members, |m| m.contact_rate_hz)?
        .each("member_mean_impact_velocity_m_s", members, |m| {
            m.mean_impact_velocity_m_s
        })?
        .each("member_max_impact_velocity_m_s", members, |m| {
            m.max_impact_velocity_m_s
        })?
        .each("member_mean_contact_duration_s", members, |m| {
            m.mean_contact_duration_s
        })?
        .each("member_max_penetration_m", members, |m| m.max_penetration_m)?
        .each("member_energy_residual_relative", members, |m| {
            m.energy_residual_relative
        })?
        .with("warnings", warnings(members))?
        .with("manifest", manifest)?;
    spectra(stops(dict, &result.stops)?, &result.spectra).map(PythonDict::dict)
}

/// Names of a mean and of its half width, and the estimate.
type Named = (&'static str, &'static str, fn(&StopEstimates) -> &Estimate);

/// Adds the contacts of each stop.
fn stops<'py>(dict: PythonDict<'py>, stops: &[StopEstimates]) -> PyResult<PythonDict<'py>> {
    let estimates: [Named; 4] = [
        (
            "stop_contact_rate_hz",
            "stop_contact_rate_half_width_hz",
            |stop| &stop.contact_rate_hz,
        ),
        (
            "stop_mean_impact_velocity_m_s",
            "stop_mean_impact_velocity_half_width_m_s",
            |stop| &stop.mean_impact_velocity_m_s,
        ),
        (
            "stop_mean_contact_duration_s",
            "stop_mean_contact_duration_half_width_s",
            |stop| &stop.mean_contact_duration_s,
        ),
        (
            "stop_contact_duty",
            "stop_contact_duty_half_width",
            |stop| &stop.contact_duty,
        ),
    ];
    let dict = estimates
        .into_iter()
        .try_fold(dict, |dict, (mean, half_width, estimate)| {
            dict.each(mean, stops, |stop| estimate(stop).mean)?
                .each(half_width, stops, |stop| estimate(stop).half_width)
        })?;
    dict.with(
        "stop",
        stops
            .iter()
            .map(|stop| stop.name.as_str())
            .collect::<Vec<_>>(),
    )?
    .each("stop_max_impact_velocity_m_s", stops, |stop| {
        stop.max_impact_velocity_m_s
    })?
    .each("stop_max_contact_duration_s", stops, |stop| {
        stop.max_contact_duration_s
    })?
    .each("stop_max_contact_force_n", stops, |stop| {
        stop.max_contact_force_n
    })?
    .each("stop_max_penetration_m", stops, |stop| {
        stop.max_penetration_m
    })
}

/// Adds the densities of the voltages, a row for each patch.
fn spectra<'py>(dict: PythonDict<'py>, spectra: &[VoltageSpectrum]) -> PyResult<PythonDict<'py>> {
    let frequency_hz = spectra
        .first()
        .map_or_else(Vec::new, |first| first.frequency_hz.clone());
    let rows = |estimate: fn(&Estimate) -> f64| {
        spectra
            .iter()
            .map(|spectrum| spectrum.density.iter().map(estimate).collect())
            .collect::<Vec<Vec<f64>>>()
    };
    let bins = frequency_hz.len();
    dict.with(
        "patch",
        spectra
            .iter()
            .map(|spectrum| spectrum.patch.as_str())
            .collect::<Vec<_>>(),
    )?
    .array("frequency_hz", frequency_hz)?
    .rows("voltage_psd_v2_hz", &rows(|bin| bin.mean), bins)?
    .rows(
        "voltage_psd_half_width_v2_hz",
        &rows(|bin| bin.half_width),
        bins,
    )?
    .each("bandwidth_hz", spectra, |spectrum| {
        spectrum.bandwidth_hz.mean
    })?
    .each("bandwidth_half_width_hz", spectra, |spectrum| {
        spectrum.bandwidth_hz.half_width
    })
}

/// Returns warnings about exceeded limits of patches in members.
fn warnings(members: &[Member]) -> Vec<String> {
    let exceeded: Vec<&[ExceededLimit]> = members
        .iter()
        .map(|member| member.exceeded.as_slice())
        .collect();
    WorstExcess::messages(&exceeded, "members", |index| {
        format!("member {}", members[index].index)
    })
}
