//! Attractors and the share of starts that reach each.

use crate::arrays::PythonDict;
use crate::branch::checked_tolerance;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::cloud::CloudOptions;
use crate::driven;
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{
    Attractor, Basins, BasinsResult, Grid, InitialStates, Parameter, Recognition, SectionPoint,
};
use jounce_core::plant::Plant;
use jounce_core::run::{ExceededLimit, WorstExcess};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Default number of starts of the cloud.
const STARTS: usize = 200;

/// Attractor number of a start without an attractor.
const NOWHERE: i64 = -1;

/// Integrates a cloud or a grid of starts until each is classified.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn basins<'py>(
    py: Python<'py>,
    spec: &Spec,
    starts: Option<usize>,
    seed: Option<u64>,
    spread: Option<f64>,
    grid: Vec<String>,
    tolerance: f64,
    longest_period: Option<u32>,
    max_cycles: Option<u32>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let given = Recognition::at(checked_tolerance(tolerance)?);
    let recognition = Recognition {
        longest_period: longest_period.unwrap_or(given.longest_period).max(1),
        max_cycles: max_cycles.unwrap_or(given.max_cycles).max(1),
        ..given
    };
    let cloud = CloudOptions {
        starts,
        seed,
        spread,
    };
    let (key, value) = driven::frequency(spec, "a basin")?;
    let (starts, options) = if grid.is_empty() {
        let cloud = cloud.cloud(STARTS)?;
        let told = vec![
            ("starts", cloud.starts.to_string()),
            ("seed", cloud.seed.to_string()),
            ("spread", cloud.spread.to_string()),
        ];
        (InitialStates::Cloud(cloud), told)
    } else {
        cloud.refuse("leave the grid")?;
        let read = Grid::read(&grid, spec.spec().stop.len());
        let read = read.map_err(|error| {
            Failure::new("ArgumentError", error).with(serde_json::json!({ "grid": grid }))
        })?;
        (InitialStates::Grid(read), vec![("grid", grid.join(" "))])
    };
    let found = cancellable(py, progress.as_ref(), |control| {
        let base = spec.model(control)?;
        driven::check(&base.kernel.plant, "a basin")?;
        let parameter = Parameter::new(&base, &key, value);
        let study = Basins {
            base: &base,
            parameter: &parameter,
            value,
            starts,
            recognition,
        };
        // Computed before the runs, so that a stopped call needs no further work.
        let places = places(&base.kernel.plant, &study.starts);
        Ok((on_threads(threads, || Ok(study.run(&|| ())?))?, places))
    });
    let manifest = spec.manifest("basins", &options);
    to_python_result(py, found, |(answer, places)| {
        into_python(py, &answer, &places, manifest)
    })
}

/// Returns the coordinates of every start.
fn places(plant: &Plant, starts: &InitialStates) -> Vec<SectionPoint> {
    (0..starts.len())
        .map(|index| SectionPoint::of(&plant.system, &starts.start(plant, index)))
        .collect()
}

fn into_python<'py>(
    py: Python<'py>,
    found: &BasinsResult,
    places: &[SectionPoint],
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let mut ends_in = vec![NOWHERE; places.len()];
    for (number, attractor) in found.attractors.iter().enumerate() {
        attractor
            .starts
            .iter()
            .for_each(|start| ends_in[*start] = number as i64);
    }
    let all: &[Attractor] = &found.attractors;
    let answer = PythonDict::new(py)
        .with(
            "attractor",
            all.iter().map(|a| a.id.clone()).collect::<Vec<_>>(),
        )?
        .each("period_cycles", all, |a| i64::from(a.period_cycles))?
        .each("chaotic", all, |a| a.is_chaotic())?
        .each("mean_power_w", all, |a| a.mean_power_w)?
        .each("contacts_per_period", all, |a| a.contacts_per_period as i64)?
        .with(
            "mirror_of",
            all.iter().map(|a| a.mirror_of.clone()).collect::<Vec<_>>(),
        )?
        .each("fraction", all, |a| a.share.fraction)?
        .each("fraction_low", all, |a| a.share.low)?
        .each("fraction_high", all, |a| a.share.high)?
        .each("lyapunov_per_s", all, |a| {
            a.lyapunov.map_or(f64::NAN, |(exponent, _)| exponent)
        })?
        .each("lyapunov_error_per_s", all, |a| {
            a.lyapunov.map_or(f64::NAN, |(_, error)| error)
        })?
        .with("expected_power_w", found.expected_power_w)?
        .with("expected_power_low_w", found.expected_power_low_w)?
        .with("expected_power_high_w", found.expected_power_high_w)?
        .with("lost", &found.lost)?
        .with("warnings", warnings(all))?
        .array("ends_in", ends_in)?
        .each("start_displacement_m", places, |place| place.displacement_m)?
        .each("start_velocity_m_s", places, |place| place.velocity_m_per_s)?
        .each("start_voltage_v", places, |place| place.voltage_v)?
        .with("manifest", manifest)?;
    Ok(answer.dict())
}

/// Returns warnings about exceeded limits of patches on attractors.
fn warnings(all: &[Attractor]) -> Vec<String> {
    let passed: Vec<&[ExceededLimit]> = all
        .iter()
        .map(|attractor| attractor.exceeded.as_slice())
        .collect();
    WorstExcess::messages(&passed, "attractors", |place| {
        format!("attractor {}", all[place].id)
    })
}
