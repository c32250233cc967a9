//! Bifurcation diagrams.

use crate::arrays::PythonDict;
use crate::branch::{checked_tolerance, json, one};
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::cloud::CloudOptions;
use crate::driven;
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{
    AttractorTracks, Branch, BranchSearch, Diagram, DiagramOrder, DiagramPoint, OrbitMethodKind,
    Parameter, SectionPoint,
};
use jounce_core::integrate::Control;
use jounce_core::spec::KeyRange;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Number of values at which branches of the diagram are sought by integration.
const DEFAULT_START_VALUES: usize = 4;

/// Default number of starts at each value.
const STARTS: usize = 20;

/// Longest period of a continued branch, drive cycles.
const DEFAULT_MAX_PERIOD: u32 = 4;

/// Attractor number of a run without an attractor.
const NOWHERE: i64 = -1;

/// Options of a diagram other than the spec and its key.
struct DiagramOptions {
    order: DiagramOrder,
    cycles: u32,
    tolerance: f64,
    branches: bool,
    longest_period: u32,
    threads: Option<usize>,
}

struct DiagramResult {
    visits: Vec<DiagramPoint>,
    history: Option<AttractorTracks>,
    branches: Vec<Branch>,
}

/// Computes the state at the start of each drive cycle, over a key.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn diagram<'py>(
    py: Python<'py>,
    spec: &Spec,
    key: &str,
    values: &str,
    direction: &str,
    starts: Option<usize>,
    seed: Option<u64>,
    spread: Option<f64>,
    cycles: u32,
    tolerance: f64,
    branches: bool,
    longest_period: Option<u32>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    if let Some(longest_period) = longest_period.filter(|_| !branches) {
        let why = format!(
            "longest_period is {longest_period}, and there are no continued branches: leave it or branches=False out"
        );
        return Err(Failure::new("ArgumentError", why)
            .with(serde_json::json!({ "longest_period": longest_period }))
            .raised(py));
    }
    let order = order_of(
        direction,
        CloudOptions {
            starts,
            seed,
            spread,
        },
    )?;
    let longest_period = longest_period.unwrap_or(DEFAULT_MAX_PERIOD);
    if !(1..=100_000).contains(&cycles) {
        let why = format!("cycles is {cycles}; it must be from 1 to 100000");
        let details = serde_json::json!({ "cycles": cycles, "least": 1, "most": 100_000 });
        return Err(Failure::new("ArgumentError", why).with(details).raised(py));
    }
    let options = DiagramOptions {
        order,
        cycles,
        tolerance: checked_tolerance(tolerance)?,
        branches,
        longest_period,
        threads,
    };
    let range = spec.range(key, values)?;
    if range.values().windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(Failure::new(
            "ArgumentError",
            format!("{key}: the values of a diagram must increase"),
        )
        .raised(py));
    }
    let found = cancellable(py, progress.as_ref(), |control| {
        marched(spec, &range, &options, control)
    });
    let mut told_options = vec![
        ("over", format!("{key}={values}")),
        ("direction", direction.to_owned()),
    ];
    if let DiagramOrder::Starts(cloud) = order {
        told_options.push(("seed", cloud.seed.to_string()));
    }
    let manifest = spec.manifest("diagram", &told_options);
    to_python_result(py, found, |found| {
        into_python(py, (key, range.key().unit(), manifest), &found)
    })
}

fn order_of(direction: &str, cloud: CloudOptions) -> Result<DiagramOrder, Failure> {
    let order = match direction {
        "up" => DiagramOrder::Up,
        "down" => DiagramOrder::Down,
        "both" => DiagramOrder::Both,
        "starts" => return Ok(DiagramOrder::Starts(cloud.cloud(STARTS)?)),
        _ => {
            let why = format!(
                "direction is \"{direction}\"; it must be \"up\", \"down\", \"both\" or \"starts\""
            );
            return Err(Failure::new("ArgumentError", why));
        }
    };
    cloud.refuse("add direction=\"starts\"")?;
    Ok(order)
}

fn marched(
    spec: &Spec,
    range: &KeyRange,
    options: &DiagramOptions,
    control: &Control,
) -> Result<DiagramResult, Failure> {
    let base = spec.model(control)?;
    driven::check(&base.kernel.plant, "a diagram")?;
    let values = range.values();
    let (low, high) = (values[0], values[values.len() - 1]);
    let width = if high > low {
        high - low
    } else {
        high.abs().max(1e-12)
    };
    let parameter = Parameter::new(&base, range.key(), width);
    let &DiagramOptions {
        order,
        cycles,
        tolerance,
        longest_period,
        ..
    } = options;
    let study = Diagram {
        base: &base,
        parameter: &parameter,
        values,
        order,
        cycles,
        tolerance,
    };
    let (method, range) = (OrbitMethodKind::Shooting, (low, high));
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds: DEFAULT_START_VALUES,
        longest_period,
    };
    on_threads(options.threads, || {
        let visits = study.run(None, &|_| ())?;
        let matched = matches!(order, DiagramOrder::Starts(_)) && !control.is_stopped();
        let history = if matched {
            Some(study.history(&visits)?)
        } else {
            None
        };
        let followed = options.branches && high > low && !control.is_stopped();
        let branches = if followed { search.run()? } else { Vec::new() };
        // A history of interrupted runs is incomplete.
        Ok(DiagramResult {
            visits,
            history: history.filter(|_| !control.is_stopped()),
            branches,
        })
    })
}

fn into_python<'py>(
    py: Python<'py>,
    (key, unit, manifest): (&str, String, String),
    found: &DiagramResult,
) -> PyResult<Bound<'py, PyDict>> {
    let visits: &[DiagramPoint] = &found.visits;
    let section: Vec<(i64, &SectionPoint)> = visits
        .iter()
        .enumerate()
        .flat_map(|(k, visit)| visit.section.iter().map(move |point| (k as i64, point)))
        .collect();
    let homes = match &found.history {
        Some(history) => history
            .homes
            .iter()
            .map(|home| home.map_or(NOWHERE, |home| home as i64))
            .collect(),
        None => vec![NOWHERE; visits.len()],
    };
    let branches = found
        .branches
        .iter()
        .map(|branch| one(py, branch, None))
        .collect::<PyResult<Vec<_>>>()?;
    let attractors = found.history.as_ref().map(|history| &history.attractors);
    let answer = PythonDict::new(py)
        .with("key", key)?
        .with("unit", unit)?
        .each("parameter", visits, |v| v.parameter)?
        .with(
            "direction",
            visits
                .iter()
                .map(|v| v.direction.name())
                .collect::<Vec<_>>(),
        )?
        .each("start", visits, |v| v.start as i64)?
        .with(
            "motion",
            visits.iter().map(|v| v.motion.name()).collect::<Vec<_>>(),
        )?
        .each("period_cycles", visits, |v| i64::from(v.period_cycles))?
        .each("contacts_per_period", visits, |v| {
            v.contacts_per_period as i64
        })?
        .each("mean_power_w", visits, |v| v.mean_power_w)?
        .array("attractor_number", homes)?
        .each("section_visit", &section, |(visit, _)| *visit)?
        .each("section_displacement_m", &section, |(_, point)| {
            point.displacement_m
        })?
        .each("section_velocity_m_s", &section, |(_, point)| {
            point.velocity_m_per_s
        })?
        .each("section_voltage_v", &section, |(_, point)| point.voltage_v)?
        .with("attractors", json(&attractors)?)?
        .with("branches", branches)?
        .with("manifest", manifest)?;
    Ok(answer.dict())
}
