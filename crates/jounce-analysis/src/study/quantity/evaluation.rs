//! One quantity at one point.

use super::devices;
use super::key_quantities::{bifurcations, diagram, sweep};
use crate::run::{RunPlan, simulate};
use crate::study::{Quantity, StudyError};
use crate::{
    AnalysisError, BandwidthSearch, Basins, BranchSearch, Cloud, Ensemble, InitialStates, Model,
    OrbitMethodKind, Parameter, Recognition,
};
use jounce_model::linear::{
    self, FrfInput, FrfOutput, Random, RandomError, RandomLoad, RandomStop,
};
use jounce_spec::{DriveKind, NumericKey, Spec};
use std::f64::consts::TAU;
use std::path::Path;

/// Evaluates a quantity: its numbers, in the order of its measures.
///
/// # Errors
/// The reason as text: a failed point is a row of the table.
pub(in crate::study) fn evaluate(
    quantity: &Quantity,
    model: &Model,
    folder: &Path,
) -> Result<Vec<f64>, String> {
    match quantity {
        Quantity::Run => run(model, folder).map_err(|error| error.to_string()),
        Quantity::Modes { count } => Ok(modes(model, *count)),
        Quantity::Frf {
            range_hz, points, ..
        } => frf(model, *range_hz, *points),
        Quantity::Sweep {
            over,
            values,
            direction,
            fixed_duration,
        } => sweep(model, (over, values), (*direction, *fixed_duration), folder),
        Quantity::Diagram {
            over,
            values,
            order,
            tolerance,
        } => diagram(model, (over, values), *order, *tolerance),
        Quantity::Bifurcations {
            keys,
            ranges,
            seeds,
            longest_period,
            tolerance,
        } => bifurcations(model, keys, *ranges, (*seeds, *longest_period, *tolerance)),
        Quantity::Basins {
            starts,
            seed,
            spread,
            recognition,
        } => {
            let cloud = Cloud {
                starts: *starts,
                seed: *seed,
                spread: *spread,
            };
            basins(model, cloud, *recognition).map_err(|error| error.to_string())
        }
        Quantity::Branch {
            over,
            range,
            seeds,
            longest_period,
            tolerance,
        } => {
            let key = NumericKey::find(&model.spec, over).map_err(|fault| fault.to_string())?;
            branch(model, &key, (*range, *seeds, *longest_period, *tolerance))
        }
        Quantity::Ensemble { members, seed } => {
            ensemble(model, (*members, *seed), folder).map_err(|error| error.to_string())
        }
        Quantity::Noise => noise(model).map_err(|error| error.to_string()),
    }
}

/// Checks that a drive is periodic, for a study of basins.
fn check_drive(model: &Model) -> Result<(), StudyError> {
    let drives = &model.spec.drive;
    match drives.values().any(|drive| drive.frequency_hz().is_some()) {
        true => Ok(()),
        false => {
            let drive = drives.keys().next().cloned().unwrap_or_default();
            let part = format!("drive `{drive}`");
            Err(AnalysisError::Aperiodic { part }.into())
        }
    }
}

/// Returns the excitation of a harvester: its first force, or else its base.
pub(super) fn default_excitation(spec: &Spec) -> Option<FrfInput> {
    let force = spec
        .drive
        .values()
        .find(|drive| drive.kind == DriveKind::Force)
        .map(|drive| FrfInput::Force(drive.at.clone()));
    force.or_else(|| {
        spec.drive
            .values()
            .next()
            .map(|_| FrfInput::BaseAcceleration)
    })
}

/// Returns the largest voltage of the frequency response, and its frequency.
fn frf(model: &Model, (low_hz, high_hz): (f64, f64), points: usize) -> Result<Vec<f64>, String> {
    let plant = &model.kernel.plant;
    if let Some(bridge) = plant.system.bridges.first() {
        return Err(format!(
            "circuit.{}.interface is not linear, so that it has no frequency response",
            bridge.name
        ));
    }
    let load = plant
        .system
        .loads
        .first()
        .map(|load| FrfOutput::LoadVoltage(load.name.clone()));
    let patch = || {
        plant
            .system
            .modes
            .patch
            .keys()
            .next()
            .map(|patch| FrfOutput::Voltage(patch.clone()))
    };
    let response = load
        .or_else(patch)
        .ok_or("the harvester has no patch, so that there is no voltage")?;
    let input = default_excitation(&model.spec)
        .ok_or("the harvester has no drive, so that nothing shakes it")?;
    let ratio = (high_hz / low_hz).ln() / (points - 1) as f64;
    let frequency_hz: Vec<f64> = (0..points)
        .map(|k| (low_hz * (ratio * k as f64).exp()).min(high_hz))
        .collect();
    let results = linear::frf(plant, &input, &[response], &frequency_hz)
        .map_err(|error| error.to_string())?;
    let sizes = results[0].value.iter().map(|value| value.norm());
    let highest = sizes.zip(&frequency_hz).max_by(|a, b| a.0.total_cmp(&b.0));
    Ok(highest.map_or_else(Vec::new, |(size, peak_hz)| vec![size, *peak_hz]))
}

fn run(model: &Model, folder: &Path) -> Result<Vec<f64>, AnalysisError> {
    let run = &model.spec.run;
    let start = model.start(folder)?;
    let plan = RunPlan::of(run, 0.0);
    let kernel = model.from_state(&start)?;
    let result = simulate(&kernel, &start, &plan)?;
    let own = vec![
        result.mean_power_w,
        result.voltage_rms_v().unwrap_or(f64::NAN),
        result.max_penetration_m,
        result.max_contact_force_n,
        result.contacts as f64 / plan.average_over_s,
        result.contact_duty,
        f64::from(u8::from(
            result.settlement.is_some_and(|found| found.settled),
        )),
        result
            .settlement
            .map_or(0.0, |found| f64::from(found.period_cycles)),
        result.energies.residual_relative(),
    ];
    Ok([own, devices::of_run(&result.devices)].concat())
}

fn modes(model: &Model, count: usize) -> Vec<f64> {
    let modes = &model.kernel.plant.system.modes;
    let each = |values: &[f64], mode: usize| values.get(mode).copied().unwrap_or(f64::NAN);
    (0..count)
        .flat_map(|mode| {
            [
                each(&modes.frequency_rad_s, mode) / TAU,
                each(&modes.damping_ratio, mode),
            ]
        })
        .collect()
}

fn basins(model: &Model, cloud: Cloud, recognition: Recognition) -> Result<Vec<f64>, StudyError> {
    check_drive(model)?;
    let study = Basins {
        base: model,
        starts: InitialStates::Cloud(cloud),
        recognition,
    };
    let result = study.run()?;
    let (undecided, attractors): (Vec<_>, Vec<_>) =
        result.attractors.iter().partition(|one| one.is_undecided());
    let highest = attractors
        .iter()
        .max_by(|a, b| a.mean_power_w.total_cmp(&b.mean_power_w));
    Ok(vec![
        result.expected_power_w,
        result.expected_power_low_w,
        result.expected_power_high_w,
        attractors.len() as f64,
        highest.map_or(f64::NAN, |one| one.mean_power_w),
        highest.map_or(f64::NAN, |one| one.share.fraction),
        undecided.iter().map(|one| one.share.fraction).sum(),
        result.lost.len() as f64,
    ])
}

fn branch(
    model: &Model,
    key: &NumericKey,
    (range, seeds, longest_period, tolerance): ((f64, f64), usize, u32, f64),
) -> Result<Vec<f64>, String> {
    let parameter = Parameter::new(model, key, range.1 - range.0);
    let method = OrbitMethodKind::Shooting;
    let search = BranchSearch {
        base: model,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds,
        longest_period,
    };
    let branches = search.run().map_err(|error| error.to_string())?;
    if branches.is_empty() {
        return Err("no periodic orbit was found".to_owned());
    }
    let bandwidths = BandwidthSearch {
        base: model,
        parameter: &parameter,
        range,
        tolerance,
    }
    .run(&branches)
    .together;
    let of = |value: fn(&crate::Bandwidth) -> f64| bandwidths.as_ref().map_or(f64::NAN, value);
    let bifurcations: usize = branches
        .iter()
        .map(|branch| branch.bifurcations.len())
        .sum();
    Ok(vec![
        of(|found| found.peak.mean_power_w),
        of(|found| found.peak.parameter),
        of(|found| found.width),
        branches.len() as f64,
        bifurcations as f64,
    ])
}

fn ensemble(
    model: &Model,
    (members, seed): (usize, u64),
    folder: &Path,
) -> Result<Vec<f64>, AnalysisError> {
    let start = model.start(folder)?;
    let result = Ensemble {
        base: model,
        start,
        members,
        seed,
        relative_width: None,
        most_rounds: 1,
        with_spectrum: false,
    }
    .run()?;
    let residual = result.members.iter().fold(0.0_f64, |worst, member| {
        worst.max(member.energy_residual_relative.abs())
    });
    let own = vec![
        result.power_w.mean,
        result.power_w.half_width,
        result.contact_rate_hz.mean,
        result.max_impact_velocity_m_s,
        residual,
    ];
    Ok([own, devices::of_ensemble(&result.devices, members)].concat())
}

/// Evaluates the noise response at the first load and the first stop; NaN if there is none.
fn noise(model: &Model) -> Result<Vec<f64>, RandomError> {
    let response = Random::new(&model.spec)?.response()?;
    let of_load = |value: fn(&RandomLoad) -> f64| response.loads.first().map_or(f64::NAN, value);
    let of_stop = |value: fn(&RandomStop) -> f64| response.stops.first().map_or(f64::NAN, value);
    Ok(vec![
        response.mean_power_w,
        of_load(|load| load.voltage_rms_v),
        of_load(|load| load.statistical_bandwidth_hz),
        of_stop(|stop| stop.reached_hz.unwrap_or(f64::NAN)),
        of_stop(|stop| stop.share_beyond.unwrap_or(f64::NAN)),
    ])
}
