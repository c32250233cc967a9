//! Bifurcation diagrams.

use crate::arrays::Answer;
use crate::branch::{checked_tolerance, json, one};
use crate::cloud::GivenCloud;
use crate::driven;
use crate::failure::Failure;
use crate::run::Handed;
use crate::spec::Spec;
use crate::watched::{handed, on_threads, watched};
use jounce::march::Watch;
use jounce::spec::KeyRange;
use jounce::study::{Branch, BranchSearch, Diagram, History, Method, Order, Parameter, SectionPoint, Visit};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Values at which branches beside the diagram are sought by marching.
const SEEDS: usize = 4;

/// Starts at each value that are meant if nothing else is said.
const STARTS: usize = 20;

/// Longest period of a continued branch, drive cycles.
const LONGEST_PERIOD: u32 = 4;

/// Number of the attractor of a march that has none.
const NOWHERE: i64 = -1;

/// What is asked for beside the spec and its key.
struct Options {
    order: Order,
    cycles: u32,
    tolerance: f64,
    branches: bool,
    longest_period: u32,
    threads: Option<usize>,
}

struct Found {
    visits: Vec<Visit>,
    history: Option<History>,
    branches: Vec<Branch>,
}

/// Where the motion is at the start of each drive cycle, over a key.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one argument per option of the Python method, which calls by name")]
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
) -> Handed<'py> {
    if let Some(longest_period) = longest_period.filter(|_| !branches) {
        let why = format!("longest_period is {longest_period}, and there are no continued branches: leave it or branches=False out");
        return Err(Failure::new("ArgumentError", why).with(serde_json::json!({ "longest_period": longest_period })).raised(py));
    }
    let order = order_of(direction, GivenCloud { starts, seed, spread })?;
    let longest_period = longest_period.unwrap_or(LONGEST_PERIOD);
    if !(1..=100_000).contains(&cycles) {
        let why = format!("cycles is {cycles}; it must be from 1 to 100000");
        let details = serde_json::json!({ "cycles": cycles, "least": 1, "most": 100_000 });
        return Err(Failure::new("ArgumentError", why).with(details).raised(py));
    }
    let options = Options { order, cycles, tolerance: checked_tolerance(tolerance)?, branches, longest_period, threads };
    let range = spec.range(key, values)?;
    if range.values().windows(2).any(|pair| pair[0] >= pair[1]) {
        return Err(Failure::new("ArgumentError", format!("{key}: the values of a diagram must rise")).raised(py));
    }
    let found = watched(py, progress.as_ref(), |watch| marched(spec, &range, &options, watch));
    let mut told_options = vec![("over", format!("{key}={values}")), ("direction", direction.to_owned())];
    if let Order::Starts(cloud) = order {
        told_options.push(("seed", cloud.seed.to_string()));
    }
    let manifest = spec.manifest("diagram", &told_options);
    handed(py, found, |found| told(py, (key, range.key().unit(), manifest), &found))
}

fn order_of(direction: &str, cloud: GivenCloud) -> Result<Order, Failure> {
    let order = match direction {
        "up" => Order::Up,
        "down" => Order::Down,
        "both" => Order::Both,
        "starts" => return Ok(Order::Starts(cloud.cloud(STARTS)?)),
        _ => {
            let why = format!("direction is \"{direction}\"; it must be \"up\", \"down\", \"both\" or \"starts\"");
            return Err(Failure::new("ArgumentError", why));
        }
    };
    cloud.refuse("add direction=\"starts\"")?;
    Ok(order)
}

fn marched(spec: &Spec, range: &KeyRange, options: &Options, watch: &Watch) -> Result<Found, Failure> {
    let base = spec.prepared(watch)?;
    driven::check(&base.kernel.plant, "a diagram")?;
    let values = range.values();
    let (low, high) = (values[0], values[values.len() - 1]);
    let width = if high > low { high - low } else { high.abs().max(1e-12) };
    let parameter = Parameter::new(&base, range.key(), width);
    let &Options { order, cycles, tolerance, longest_period, .. } = options;
    let study = Diagram { base: &base, parameter: &parameter, values, order, cycles, tolerance };
    let (method, range) = (Method::Shooting, (low, high));
    let search = BranchSearch { base: &base, parameter: &parameter, range, method, tolerance, seeds: SEEDS, longest_period };
    on_threads(options.threads, || {
        let visits = study.run(None, &|_| ())?;
        let matched = matches!(order, Order::Starts(_)) && !watch.is_stopped();
        let history = if matched { Some(study.history(&visits)?) } else { None };
        let followed = options.branches && high > low && !watch.is_stopped();
        let branches = if followed { search.run()? } else { Vec::new() };
        // A history whose marches were stopped says nothing.
        Ok(Found { visits, history: history.filter(|_| !watch.is_stopped()), branches })
    })
}

fn told<'py>(py: Python<'py>, (key, unit, manifest): (&str, String, String), found: &Found) -> PyResult<Bound<'py, PyDict>> {
    let visits: &[Visit] = &found.visits;
    let section: Vec<(i64, &SectionPoint)> =
        visits.iter().enumerate().flat_map(|(k, visit)| visit.section.iter().map(move |point| (k as i64, point))).collect();
    let homes = match &found.history {
        Some(history) => history.homes.iter().map(|home| home.map_or(NOWHERE, |home| home as i64)).collect(),
        None => vec![NOWHERE; visits.len()],
    };
    let branches = found.branches.iter().map(|branch| one(py, branch, None)).collect::<PyResult<Vec<_>>>()?;
    let attractors = found.history.as_ref().map(|history| &history.attractors);
    let answer = Answer::new(py)
        .with("key", key)?
        .with("unit", unit)?
        .each("parameter", visits, |v| v.parameter)?
        .with("direction", visits.iter().map(|v| v.direction.name()).collect::<Vec<_>>())?
        .each("start", visits, |v| v.start as i64)?
        .with("motion", visits.iter().map(|v| v.motion.name()).collect::<Vec<_>>())?
        .each("period_cycles", visits, |v| i64::from(v.period_cycles))?
        .each("contacts_per_period", visits, |v| v.contacts_per_period as i64)?
        .each("mean_power_w", visits, |v| v.mean_power_w)?
        .array("attractor_number", homes)?
        .each("section_visit", &section, |(visit, _)| *visit)?
        .each("section_displacement_m", &section, |(_, point)| point.displacement_m)?
        .each("section_velocity_m_s", &section, |(_, point)| point.velocity_m_per_s)?
        .each("section_voltage_v", &section, |(_, point)| point.voltage_v)?
        .with("attractors", json(&attractors)?)?
        .with("branches", branches)?
        .with("manifest", manifest)?;
    Ok(answer.dict())
}
