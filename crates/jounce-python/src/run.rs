//! One run.

use crate::arrays::PythonDict;
use crate::cancellable::{to_python_result, visited};
use crate::failure::Failure;
use crate::history::History;
use crate::spec::Spec;
use jounce_core::integrate::{Control, Energies, RectifiedEnergies};
use jounce_core::run::{
    ChargeResult, RectifiedResult, RunPlan, RunResult, StartState, StopResult, VoltagePeaks,
    Warning, charges, simulate, voltage_peaks,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Result of a call, if there is one, and the error that ended it early.
pub type PythonResult<'py> = PyResult<(Option<Bound<'py, PyDict>>, Option<PyErr>)>;

/// Maximum number of samples of a record.
const MAX_SAMPLES: f64 = 1e8;

/// Options of a run.
struct RunOptions {
    tolerance: Option<f64>,
    start: Option<String>,
    record_s: f64,
    sample_rate_hz: f64,
}

/// Data of a run.
struct RunData {
    plan: RunPlan,
    answer: RunResult,
    history: Option<History>,
    /// Names of the patches.
    patch: Vec<String>,
    peaks: VoltagePeaks,
    /// Charge balance of each circuit whose diodes feed a capacitor.
    charges: Vec<ChargeResult>,
    /// Warnings about the result.
    warnings: Vec<String>,
}

/// Integrates one run; `start` is a state as JSON.
#[pyfunction]
pub fn run<'py>(
    py: Python<'py>,
    spec: &Spec,
    tolerance: Option<f64>,
    start: Option<String>,
    record_s: f64,
    sample_rate_hz: f64,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let own = spec.with_tolerance(tolerance)?;
    let options = RunOptions {
        tolerance,
        start,
        record_s,
        sample_rate_hz,
    };
    let found = visited(py, progress.as_ref(), |control| {
        marched(spec, &options, control)
    });
    to_python_result(py, found, |marched| {
        into_python(py, own.as_ref().unwrap_or(spec), marched)
    })
}

fn marched(spec: &Spec, options: &RunOptions, control: &Control) -> Result<RunData, Failure> {
    let prepared = spec.prepared(control)?;
    let start = match &options.start {
        Some(json) => serde_json::from_str::<StartState>(json).map_err(|error| {
            Failure::new("StartError", format!("the start state is not one that a run has saved: {error}; give the `end` of another run"))
        })?,
        None => prepared.start(&spec.folder())?,
    };
    let kernel = prepared.from_state(&start)?;
    let run = &prepared.spec.run;
    let plan = RunPlan {
        tolerance: options.tolerance.unwrap_or(run.tolerance),
        ..RunPlan::of(run, options.record_s)
    };
    if options.record_s > run.duration_s {
        let why = format!(
            "record is {} s; it must not be longer than run.duration = {} s",
            options.record_s, run.duration_s
        );
        let details = serde_json::json!({ "record_s": options.record_s, "most_s": run.duration_s });
        return Err(Failure::new("ArgumentError", why).with(details));
    }
    let samples = options.record_s * options.sample_rate_hz;
    if samples > MAX_SAMPLES {
        let why = format!(
            "record times sample_rate makes {samples:e} samples; at most {MAX_SAMPLES:e} are allowed"
        );
        return Err(Failure::new("ArgumentError", why)
            .with(serde_json::json!({ "samples": samples, "most": MAX_SAMPLES })));
    }
    // The same options as the command line, so that both return equal bits.
    let watching = plan
        .clone()
        .watching(&prepared.spec, &kernel.plant)
        .balancing(&kernel.plant);
    control.expect_run(watching.duration_s);
    let answer = simulate(&kernel, &start, &watching)?;
    control.report_progress(watching.duration_s);
    let history = (options.record_s > 0.0)
        .then(|| History::new(&kernel, &answer, &plan, options.sample_rate_hz));
    let warnings = Warning::of(&prepared.spec, &kernel, &watching, &answer)
        .iter()
        .map(ToString::to_string)
        .collect();
    let patch = kernel.plant.system.modes.patch.keys().cloned().collect();
    let peaks = voltage_peaks(&kernel, &answer, &watching);
    let charges = charges(&kernel, &answer, &watching);
    Ok(RunData {
        plan,
        answer,
        history,
        patch,
        peaks,
        charges,
        warnings,
    })
}

fn into_python<'py>(
    py: Python<'py>,
    spec: &Spec,
    marched: RunData,
) -> PyResult<Bound<'py, PyDict>> {
    let state = serde_json::to_string(&marched.answer.end)
        .map_err(|error| Failure::new("JounceError", error))?;
    let work = serde_json::to_string(&marched.answer.work)
        .map_err(|error| Failure::new("JounceError", error))?;
    let answer = voltages(PythonDict::new(py), &marched)?;
    let answer = rectified(answer, &marched.answer.rectified, &marched.charges)?;
    let answer = contacts(answer, &marched.answer)?;
    let answer = trust(answer, &marched)?
        .with("energies_j", flows(py, &marched.answer.energies)?)?
        .with("end", state)?
        .with("work", work)?
        .with(
            "history",
            marched
                .history
                .map(|history| history.dict(py))
                .transpose()?,
        )?
        .with("manifest", spec.manifest("run", &[]))?;
    Ok(answer.dict())
}

/// Adds powers, and voltages of loads and patches.
fn voltages<'py>(answer: PythonDict<'py>, marched: &RunData) -> PyResult<PythonDict<'py>> {
    let RunData {
        answer: found,
        patch,
        peaks,
        ..
    } = marched;
    let (loads, leaks) = (&found.loads, &found.leaks);
    answer
        .with("mean_power_w", found.mean_power_w)?
        .with(
            "load",
            loads
                .iter()
                .map(|load| load.name.clone())
                .collect::<Vec<_>>(),
        )?
        .each("load_power_w", loads, |load| load.mean_power_w)?
        .each("load_voltage_rms_v", loads, |load| load.voltage_rms_v)?
        .each("load_voltage_peak_v", &peaks.loads_v, |peak_v| *peak_v)?
        .with("patch", patch)?
        .each("patch_voltage_peak_v", &peaks.patches_v, |peak_v| *peak_v)?
        .with(
            "leak",
            leaks
                .iter()
                .map(|leak| leak.patch.clone())
                .collect::<Vec<_>>(),
        )?
        .each("leak_power_w", leaks, |leak| leak.mean_power_w)
}

/// Adds the results of the rectifiers.
fn rectified<'py>(
    answer: PythonDict<'py>,
    rectified: &[RectifiedResult],
    charges: &[ChargeResult],
) -> PyResult<PythonDict<'py>> {
    let charge = |circuit: &RectifiedResult, of: fn(&ChargeResult) -> f64| {
        charges
            .iter()
            .find(|charge| charge.name == circuit.name)
            .map_or(f64::NAN, of)
    };
    answer
        .with(
            "rectified",
            rectified
                .iter()
                .map(|circuit| circuit.name.clone())
                .collect::<Vec<_>>(),
        )?
        .each("rectified_power_w", rectified, |circuit| {
            circuit.mean_power_w
        })?
        .each("rectified_voltage_rms_v", rectified, |circuit| {
            circuit.voltage_rms_v
        })?
        .each("rectified_current_a", rectified, |circuit| {
            circuit.mean_current_a
        })?
        .each("rectified_storage_w", rectified, |circuit| {
            circuit.storage_w
        })?
        .each("rectified_diode_loss_w", rectified, |circuit| {
            circuit.diode_loss_w
        })?
        .each("rectified_switch_loss_w", rectified, |circuit| {
            circuit.switch_loss_w
        })?
        .each("rectified_leakage_w", rectified, |circuit| {
            circuit.leakage_w
        })?
        .each("rectified_charge_passed_c", rectified, |circuit| {
            charge(circuit, |own| own.passed_c)
        })?
        .each("rectified_charge_load_c", rectified, |circuit| {
            charge(circuit, |own| own.load_c)
        })?
        .each("rectified_charge_leakage_c", rectified, |circuit| {
            charge(circuit, |own| own.leakage_c)
        })?
        .each("rectified_charge_storage_c", rectified, |circuit| {
            charge(circuit, |own| own.storage_c)
        })?
        .each("rectified_charge_residual_relative", rectified, |circuit| {
            charge(circuit, |own| own.residual_relative)
        })
}

/// Adds the results of the stops.
fn contacts<'py>(answer: PythonDict<'py>, found: &RunResult) -> PyResult<PythonDict<'py>> {
    let stops: &[StopResult] = &found.stops;
    answer
        .with(
            "stop",
            stops
                .iter()
                .map(|stop| stop.name.clone())
                .collect::<Vec<_>>(),
        )?
        .each("stop_contacts", stops, |stop| stop.contacts as i64)?
        .each("stop_contact_rate_hz", stops, |stop| stop.contact_rate_hz)?
        .each("stop_mean_impact_velocity_m_s", stops, |stop| {
            stop.mean_impact_velocity_m_s
        })?
        .each("stop_max_impact_velocity_m_s", stops, |stop| {
            stop.max_impact_velocity_m_s
        })?
        .each("stop_mean_contact_duration_s", stops, |stop| {
            stop.mean_contact_duration_s
        })?
        .each("stop_max_contact_duration_s", stops, |stop| {
            stop.max_contact_duration_s
        })?
        .each("stop_contact_duty", stops, |stop| stop.contact_duty)?
        .each("stop_max_penetration_m", stops, |stop| {
            stop.max_penetration_m
        })?
        .each("stop_max_contact_force_n", stops, |stop| {
            stop.max_contact_force_n
        })?
        .each("stop_impulse_n_s", stops, |stop| stop.impulse_n_s)?
        .with("max_penetration_m", found.max_penetration_m)?
        .with("max_contact_force_n", found.max_contact_force_n)?
        .with("contacts", found.contacts)?
        .with("contact_duty", found.contact_duty)
}

/// Adds settling, energy balance and the requested record.
fn trust<'py>(
    answer: PythonDict<'py>,
    RunData {
        plan,
        answer: found,
        warnings,
        ..
    }: &RunData,
) -> PyResult<PythonDict<'py>> {
    let settlement = found.settlement;
    answer
        .with("settled", settlement.map(|found| found.settled))?
        .with("period_cycles", settlement.map(|found| found.period_cycles))?
        .with(
            "periodicity_change",
            settlement.map_or(f64::NAN, |found| found.change),
        )?
        .with(
            "distance_to_orbit",
            settlement.map_or(f64::NAN, |found| found.distance),
        )?
        .with("warnings", warnings)?
        .with(
            "energy_residual_relative",
            found.energies.residual_relative(),
        )?
        .with("is_trivial", found.is_trivial())?
        .with("duration_s", plan.duration_s)?
        .with("average_over_s", plan.average_over_s)?
        .with("tolerance", plan.tolerance)?
        .with("wall_time_s", found.wall_time_s)
}

/// Adds the energies of the complete run, J.
fn flows<'py>(py: Python<'py>, energies: &Energies) -> PyResult<Bound<'py, PyDict>> {
    let rectified =
        |of: fn(&RectifiedEnergies) -> f64| energies.rectified.iter().map(of).sum::<f64>();
    let flows = PythonDict::new(py)
        .with("input_j", energies.input_j)?
        .with("loads_j", energies.loads_j.iter().sum::<f64>())?
        .with("rectified_j", rectified(|own| own.load_j + own.battery_j))?
        .with(
            "rectified_loss_j",
            rectified(|own| own.diodes_j + own.switch_j + own.leakage_j),
        )?
        .with("leaks_j", energies.leaks_j.iter().sum::<f64>())?
        .with("damping_j", energies.damping_j)?
        .with("contact_loss_j", energies.contact_loss_j)?
        .with("stored_j", energies.stored_j)?;
    Ok(flows.dict())
}
