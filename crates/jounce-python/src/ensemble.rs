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
        let why = format!(
            "members is {members} and relative_width {width}; members must be from 1 to {MAX_MEMBERS}, relative_width between 0 and 1"
        );
        let details = serde_json::json!({ "members": members, "relative_width": relative_width, "least_members": 1, "most_members": MAX_MEMBERS });
        return Err(Failure::new("ArgumentError", why).with(details).raised(py));
    }
    if spectrum && members < 2 {
        let why = "spectrum needs at least two members to estimate the scatter of the density";
        let details = serde_json::json!({ "members": members, "least_members": 2 });
        return Err(Failure::new("ArgumentError", why).with(details).raised(py));
    }
    let own = spec.with_tolerance(tolerance)?;
    let spec = own.as_ref().unwrap_or(spec);
    let found = cancellable(py, progress.as_ref(), |control| {
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
    to_python_result(py, found, |answer| into_python(py, &answer, manifest))
}

fn into_python<'py>(
    py: Python<'py>,
    found: &EnsembleResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let all: &[Member] = &found.members;
    let over = if found.power_w.interval == IntervalOver::Members {
        "members"
    } else {
        "batches"
    };
    let answer = PythonDict::new(py)
        .with("mean_power_w", found.power_w.mean)?
        .with("mean_power_half_width_w", found.power_w.half_width)?
        .with("interval_over", over)?
        .with("reached", found.reached)?
        .with("contact_rate_hz", found.contact_rate_hz.mean)?
        .with(
            "contact_rate_half_width_hz",
            found.contact_rate_hz.half_width,
        )?
        .with("mean_impact_velocity_m_s", found.mean_impact_velocity_m_s)?
        .with("max_impact_velocity_m_s", found.max_impact_velocity_m_s)?
        .with("mean_contact_duration_s", found.mean_contact_duration_s)?
        .each("member", all, |m| m.index as i64)?
        .each("member_power_w", all, |m| m.mean_power_w)?
        .each("member_contacts", all, |m| m.contacts as i64)?
        .each("member_contact_rate_hz", all, |m| m.contact_rate_hz)?
        .each("member_mean_impact_velocity_m_s", all, |m| {
            m.mean_impact_velocity_m_s
        })?
        .each("member_max_impact_velocity_m_s", all, |m| {
            m.max_impact_velocity_m_s
        })?
        .each("member_mean_contact_duration_s", all, |m| {
            m.mean_contact_duration_s
        })?
        .each("member_max_penetration_m", all, |m| m.max_penetration_m)?
        .each("member_energy_residual_relative", all, |m| {
            m.energy_residual_relative
        })?
        .with("warnings", warnings(all))?
        .with("manifest", manifest)?;
    spectra(stops(answer, &found.stops)?, &found.spectra).map(PythonDict::dict)
}

/// Names of a mean and of its half width, and the estimate.
type Named = (&'static str, &'static str, fn(&StopEstimates) -> &Estimate);

/// Adds the contacts of each stop.
fn stops<'py>(answer: PythonDict<'py>, stops: &[StopEstimates]) -> PyResult<PythonDict<'py>> {
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
    let answer = estimates
        .into_iter()
        .try_fold(answer, |answer, (mean, half_width, of)| {
            answer
                .each(mean, stops, |stop| of(stop).mean)?
                .each(half_width, stops, |stop| of(stop).half_width)
        })?;
    answer
        .with(
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
fn spectra<'py>(answer: PythonDict<'py>, spectra: &[VoltageSpectrum]) -> PyResult<PythonDict<'py>> {
    let frequency_hz = spectra
        .first()
        .map_or_else(Vec::new, |first| first.frequency_hz.clone());
    let rows = |of: fn(&Estimate) -> f64| {
        spectra
            .iter()
            .map(|own| own.density.iter().map(of).collect())
            .collect::<Vec<Vec<f64>>>()
    };
    let bins = frequency_hz.len();
    answer
        .with(
            "patch",
            spectra
                .iter()
                .map(|own| own.patch.as_str())
                .collect::<Vec<_>>(),
        )?
        .array("frequency_hz", frequency_hz)?
        .rows("voltage_psd_v2_hz", &rows(|bin| bin.mean), bins)?
        .rows(
            "voltage_psd_half_width_v2_hz",
            &rows(|bin| bin.half_width),
            bins,
        )?
        .each("bandwidth_hz", spectra, |own| own.bandwidth_hz.mean)?
        .each("bandwidth_half_width_hz", spectra, |own| {
            own.bandwidth_hz.half_width
        })
}

/// Returns warnings about exceeded limits of patches in members.
fn warnings(all: &[Member]) -> Vec<String> {
    let passed: Vec<&[ExceededLimit]> = all
        .iter()
        .map(|member| member.exceeded.as_slice())
        .collect();
    WorstExcess::messages(&passed, "members", |place| {
        format!("member {}", all[place].index)
    })
}
