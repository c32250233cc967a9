//! Bifurcation diagrams.

use crate::arrays::PythonDict;
use crate::branch::{branch_dict, checked_tolerance, json};
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::cloud::CloudOptions;
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
    points: Vec<DiagramPoint>,
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
        let reason = format!(
            "longest_period is {longest_period}, and there are no continued branches: leave it or branches=False out"
        );
        return Err(Failure::new("ArgumentError", reason)
            .with(serde_json::json!({ "longest_period": longest_period }))
            .into_exception(py));
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
        let reason = format!("cycles is {cycles}; it must be from 1 to 100000");
        let details = serde_json::json!({ "cycles": cycles, "least": 1, "most": 100_000 });
        return Err(Failure::new("ArgumentError", reason)
            .with(details)
            .into_exception(py));
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
        .into_exception(py));
    }
    let outcome = cancellable(py, progress.as_ref(), |control| {
        integrate(spec, &range, &options, control)
    });
    let mut manifest_options = vec![
        ("over", format!("{key}={values}")),
        ("direction", direction.to_owned()),
    ];
    if let DiagramOrder::Starts(cloud) = order {
        manifest_options.push(("seed", cloud.seed.to_string()));
    }
    let manifest = spec.manifest("diagram", &manifest_options);
    to_python_result(py, outcome, |result| {
        into_python(py, (key, range.key().unit(), manifest), &result)
    })
}

fn order_of(direction: &str, cloud: CloudOptions) -> Result<DiagramOrder, Failure> {
    let order = match direction {
        "up" => DiagramOrder::Up,
        "down" => DiagramOrder::Down,
        "both" => DiagramOrder::Both,
        "starts" => return Ok(DiagramOrder::Starts(cloud.cloud(STARTS)?)),
        _ => {
            let reason = format!(
                "direction is \"{direction}\"; it must be \"up\", \"down\", \"both\" or \"starts\""
            );
            return Err(Failure::new("ArgumentError", reason));
        }
    };
    cloud.refuse_options("add direction=\"starts\"")?;
    Ok(order)
}

fn integrate(
    spec: &Spec,
    range: &KeyRange,
    options: &DiagramOptions,
    control: &Control,
) -> Result<DiagramResult, Failure> {
    let base = spec.model(control)?;
    jounce::check_drives(&base.kernel.plant, "a diagram")?;
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
        let points = study.run(None, &|_| ())?;
        let with_history = matches!(order, DiagramOrder::Starts(_)) && !control.is_stopped();
        let history = if with_history {
            Some(study.history(&points)?)
        } else {
            None
        };
        let with_branches = options.branches && high > low && !control.is_stopped();
        let branches = if with_branches {
            search.run()?
        } else {
            Vec::new()
        };
        // A history of interrupted runs is incomplete.
        Ok(DiagramResult {
            points,
            history: history.filter(|_| !control.is_stopped()),
            branches,
        })
    })
}

fn into_python<'py>(
    py: Python<'py>,
    (key, unit, manifest): (&str, String, String),
    result: &DiagramResult,
) -> PyResult<Bound<'py, PyDict>> {
    let points: &[DiagramPoint] = &result.points;
    let section: Vec<(i64, &SectionPoint)> = points
        .iter()
        .enumerate()
        .flat_map(|(k, point)| {
            point
                .section
                .iter()
                .map(move |section_point| (k as i64, section_point))
        })
        .collect();
    let attractor_indices = match &result.history {
        Some(history) => history
            .homes
            .iter()
            .map(|index| index.map_or(NOWHERE, |index| index as i64))
            .collect(),
        None => vec![NOWHERE; points.len()],
    };
    let branches = result
        .branches
        .iter()
        .map(|branch| branch_dict(py, branch, None))
        .collect::<PyResult<Vec<_>>>()?;
    let attractors = result.history.as_ref().map(|history| &history.attractors);
    let dict = PythonDict::new(py)
        .with("key", key)?
        .with("unit", unit)?
        .each("parameter", points, |v| v.parameter)?
        .with(
            "direction",
            points
                .iter()
                .map(|v| v.direction.name())
                .collect::<Vec<_>>(),
        )?
        .each("start", points, |v| v.start as i64)?
        .with(
            "motion",
            points.iter().map(|v| v.motion.name()).collect::<Vec<_>>(),
        )?
        .each("period_cycles", points, |v| i64::from(v.period_cycles))?
        .each("contacts_per_period", points, |v| {
            v.contacts_per_period as i64
        })?
        .each("mean_power_w", points, |v| v.mean_power_w)?
        .array("attractor_number", attractor_indices)?
        .each("section_visit", &section, |(index, _)| *index)?
        .each("section_displacement_m", &section, |(_, section_point)| {
            section_point.displacement_m
        })?
        .each("section_velocity_m_s", &section, |(_, section_point)| {
            section_point.velocity_m_per_s
        })?
        .each("section_voltage_v", &section, |(_, section_point)| {
            section_point.voltage_v
        })?
        .with("attractors", json(&attractors)?)?
        .with("branches", branches)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
