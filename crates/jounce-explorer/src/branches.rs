//! Response over a key: first the branches near those of the previous design, then all branches
//! that `jounce branch` finds.

use crate::cancellation::Cancellation;
use crate::design::{Design, DesignFault};
use crate::frame::Frame;
use crate::request::KeySpan;
use crate::responses::{Origin, StoredResponse};
use crate::session::Session;
use jounce_core::analysis::{
    BandwidthSearch, Bifurcation, Branch, BranchPoint, BranchSearch, BranchUpdate, KnownOrbit,
    OrbitMethodKind, WarmStart,
};
use jounce_core::analysis::{Extrapolation, Model, Parameter, settled_orbit};
use jounce_core::continuation::StepControl;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Integration tolerance of the coarse response.
const COARSE_TOLERANCE: f64 = 1e-6;
/// Relative corrections of updated points below this are omitted: curves are accurate to a
/// thousandth of their height.
const MIN_CORRECTION: f64 = 5e-4;
/// Largest deviation of the drawn curve due to omitted points, relative to its height.
const SIMPLIFY_SHARE: f64 = 1e-3;
/// Largest last step in the location of bifurcations, a two-hundredth of the range; the remaining
/// error is of second order in it.
const MAX_LAST_MOVE: f64 = 0.1;
/// Largest fraction of points that an update of branches may lose.
const MAX_LOST_SHARE: f64 = 0.3;
/// Integration tolerance of the fine response.
const FINE_TOLERANCE: f64 = 1e-9;
/// Values across the range at which the fine response searches for isolated branches.
const START_VALUES: usize = 6;
/// Longest period of the fine response, drive cycles.
const MAX_PERIOD_CYCLES: u32 = 8;
/// Time without slider movement before the fine response begins.
const SLIDER_REST: Duration = Duration::from_millis(120);

/// Long steps for the coarse response.
const LONG_STEPS: StepControl = StepControl {
    first: 0.1,
    longest: 1.2,
    shortest: 1e-6,
    turn: 0.45,
    stray: 0.25,
    most_evaluations: 6,
};

/// Sends the coarse and the fine response, then peaks and bandwidths.
///
/// # Errors
/// [`DesignFault`]: faults of the design, of the range, or of the harvester.
pub fn respond(
    session: &Session,
    id: u64,
    design: Design,
    span: &KeySpan,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let key = design.range(&span.over, span.from, span.to)?;
    let range = (span.from, span.to);
    let base = session.model(&design.spec, cancellation)?;
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let start_time = Instant::now();
    let (coarse_result, linear) = rayon::join(
        || coarse_branches(session, &design, &base, &parameter, range),
        || session.linear.curve(&design.spec, &parameter, range),
    );
    let send = |stage: &str, branches: Vec<Branch>, origin: Option<Origin>, start_time: Instant| {
        let mut frame = Frame::new(id, "response", stage);
        frame
            .put("over", key.path())
            .put("unit", key.unit())
            .put("ms", 1e3 * start_time.elapsed().as_secs_f64());
        linear.put(&mut frame);
        put_branches(&mut frame, &branches);
        if !cancellation.is_stopped() {
            let (spec, branches) = (design.spec.clone(), Arc::new(branches));
            let response = StoredResponse {
                id,
                spec,
                key: key.clone(),
                range,
                branches,
                origin,
            };
            session.responses.store(response);
        }
        session.send(cancellation, frame);
    };
    let (branches, origin) = coarse_result;
    send("coarse", branches, origin, start_time);

    let (rest_start, poll_interval) = (Instant::now(), Duration::from_millis(5));
    while rest_start.elapsed() < SLIDER_REST && !cancellation.is_stopped() {
        std::thread::sleep(poll_interval);
    }
    if cancellation.is_stopped() {
        return Ok(());
    }
    let start_time = Instant::now();
    let (method, seeds, longest_period) =
        (OrbitMethodKind::Shooting, START_VALUES, MAX_PERIOD_CYCLES);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance: FINE_TOLERANCE,
        seeds,
        longest_period,
    };
    let branches = search.run()?;
    send("fine", branches.clone(), None, start_time);
    if !cancellation.is_stopped() && !branches.is_empty() {
        let width = BandwidthSearch {
            base: &base,
            parameter: &parameter,
            range,
            tolerance: FINE_TOLERANCE,
        };
        let widths = width.run(&branches);
        let mut frame = Frame::new(id, "response", "widths");
        if let Some(together) = &widths.together {
            frame
                .put("peak", json!(together.peak))
                .put("intervals", json!(together.intervals))
                .put("width", together.width);
        }
        session.send(cancellation, frame);
    }
    Ok(())
}

/// Returns the branches near those of the previous design. They are updated point by point, or
/// continued again if that loses points or the range has changed. Without known branches,
/// continuation starts from settled orbits.
fn coarse_branches(
    session: &Session,
    design: &Design,
    base: &Model,
    parameter: &Parameter,
    range: (f64, f64),
) -> (Vec<Branch>, Option<Origin>) {
    let kernel = &base.kernel;
    let last = session.responses.last(parameter.key().path());
    if let Some(last) = last.as_ref().filter(|last| last.range == range) {
        // A fine response has more points than a curve needs; an updated one retains its points, so
        // that their changes can be extrapolated.
        let stored_branches = match last.origin {
            Some(_) => Arc::clone(&last.branches),
            None => Arc::new(
                last.branches
                    .iter()
                    .map(|branch| branch.thinned(SIMPLIFY_SHARE))
                    .collect(),
            ),
        };
        let trend = last.origin.as_ref().and_then(|(spec, branches)| {
            Some(Extrapolation {
                before: branches,
                reach: design.change_ratio(spec, &last.spec)?,
            })
        });
        let update = BranchUpdate {
            harvester: parameter,
            kernel,
            range,
            tolerance: COARSE_TOLERANCE,
            accuracy: MIN_CORRECTION,
            resolution: MAX_LAST_MOVE,
            trend,
        };
        let updated = update.run(&stored_branches);
        let points: usize = stored_branches
            .iter()
            .map(|branch| branch.points.len())
            .sum();
        if (updated.lost as f64) <= MAX_LOST_SHARE * points as f64 {
            return (updated.branches, Some((last.spec.clone(), stored_branches)));
        }
    }
    let warm_start = WarmStart {
        harvester: parameter,
        kernel,
        range,
        tolerance: COARSE_TOLERANCE,
        control: LONG_STEPS,
        resolution: MAX_LAST_MOVE,
    };
    let branches = last
        .map(|last| warm_start.run(&last.orbits()).unwrap_or_default())
        .unwrap_or_default();
    if !branches.is_empty() || kernel.control.is_stopped() {
        return (branches, None);
    }
    (
        warm_start
            .run(&settled_orbits(parameter, base, range))
            .unwrap_or_default(),
        None,
    )
}

/// Returns the orbits on which an integration from rest and from the steady state settles at both
/// ends of the range.
fn settled_orbits(harvester: &Parameter, base: &Model, range: (f64, f64)) -> Vec<KnownOrbit> {
    let plant = &base.kernel.plant;
    let rest = vec![0.0; plant.len()];
    let steady = plant.to_physical(&rest, 0.0);
    let (low, high) = range;
    let jobs = [(low, &steady), (high, &steady), (low, &rest), (high, &rest)];
    let settle = |(parameter, start): (f64, &Vec<f64>)| {
        let orbit = settled_orbit(harvester, parameter, start, COARSE_TOLERANCE, 1e-6)?;
        Some(KnownOrbit {
            period_cycles: orbit.period_cycles,
            state: orbit.start().to_vec(),
            parameter,
        })
    };
    let ([a, b], [c, d]) = ([jobs[0], jobs[1]], [jobs[2], jobs[3]]);
    let pair = |one, two| rayon::join(|| settle(one), || settle(two));
    let (first, second) = (pair(a, b), pair(c, d));
    [first.0, first.1, second.0, second.1]
        .into_iter()
        .flatten()
        .collect()
}

fn put_branches(frame: &mut Frame, branches: &[Branch]) {
    let (mut branch_entries, mut bifurcation_entries) = (Vec::new(), Vec::new());
    for (index, branch) in branches.iter().enumerate() {
        branch_entries.push(json!({ "period": branch.period_cycles, "endings": branch.endings }));
        let mut array = |name: &str, value: fn(&BranchPoint) -> f64| {
            frame.array(&format!("{index}.{name}"), branch.points.iter().map(value));
        };
        array("x", |point| point.parameter);
        array("power", |point| point.orbit.mean_power_w);
        array("voltage", |point| point.orbit.voltage_rms_v);
        array("penetration", |point| point.orbit.max_penetration_m);
        array("floquet", |point| point.orbit.floquet_max_abs());
        array("contacts", |point| point.orbit.contacts as f64);
        bifurcation_entries.extend(
            branch
                .bifurcations
                .iter()
                .map(|bifurcation| bifurcation_entry(index, bifurcation)),
        );
    }
    frame
        .put("branches", branch_entries)
        .put("bifurcations", bifurcation_entries);
}

fn bifurcation_entry(branch: usize, bifurcation: &Bifurcation) -> Value {
    let orbit = &bifurcation.at.orbit;
    json!({
        "branch": branch, "kind": bifurcation.kind.name(), "x": bifurcation.at.parameter, "power": orbit.mean_power_w,
        "voltage": orbit.voltage_rms_v, "penetration": orbit.max_penetration_m, "floquet": orbit.floquet_max_abs(),
        "contacts": orbit.contacts,
    })
}
