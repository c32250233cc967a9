//! The response over a key: first the branches near those of the design before, then all that `jounce branch` finds.

use crate::answers::Answered;
use crate::design::{Design, Wrong};
use crate::frame::Frame;
use crate::halt::{Halt, Haltable};
use crate::request::Over;
use crate::session::Session;
use jounce::continuation::StepControl;
use jounce::linear::steady_power_w;
use jounce::orbit::Harvester;
use jounce::study::{BandwidthSearch, Bifurcation, Branch, BranchChase, BranchPoint, BranchSearch, KnownOrbit, Method};
use jounce::study::{Parameter, Prepared, settled_orbit};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Tolerance of the marches of the first answer: curves are right to a thousandth of their height.
const COARSE: f64 = 1e-6;
/// Tolerance of the second.
const FINE: f64 = 1e-8;
/// Values across the range at which the second one looks for branches that stand alone.
const SEEDS: usize = 6;
/// Longest period that it follows, drive cycles.
const LONGEST_PERIOD: u32 = 8;
/// Points of the linear curve.
const LINEAR_POINTS: usize = 161;
/// A slider must rest that long before the second answer begins.
const REST: Duration = Duration::from_millis(120);

/// Long steps for the first answer.
const LONG_STEPS: StepControl = StepControl { first: 0.1, longest: 1.2, shortest: 1e-6, turn: 0.45, stray: 0.25, most_evaluations: 6 };

/// Answers twice; a third time with peaks and widths.
///
/// # Errors
/// [`Wrong`]: faults of the design, of the range, or of the harvester.
pub fn respond(session: &Session, id: u64, design: Design, over: &Over, halt: &Halt) -> Result<(), Wrong> {
    let key = design.range(&over.over, over.from, over.to)?;
    let range = (over.from, over.to);
    let base = session.prepared(&design.spec)?;
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let family = Haltable { inner: &parameter, halt: halt.clone() };
    let send = |stage: &str, branches: Vec<Branch>, began: Instant| {
        let mut frame = Frame::new(id, "response", stage);
        frame.put("over", key.path()).put("unit", key.unit()).put("ms", 1e3 * began.elapsed().as_secs_f64());
        put_linear(&mut frame, &parameter, range);
        put_branches(&mut frame, &branches);
        if !halt.is_stopped() {
            let answered = Answered { id, spec: design.spec.clone(), key: key.clone(), range, branches };
            session.answers.keep(answered);
        }
        session.send(halt, frame);
    };

    let began = Instant::now();
    let chase = BranchChase { harvester: &family, kernel: &base.kernel, range, tolerance: COARSE, control: LONG_STEPS };
    let mut found = chase.run(&session.answers.known(key.path())).unwrap_or_default();
    if found.is_empty() && !halt.is_stopped() {
        found = chase.run(&settled(&family, &base, range)).unwrap_or_default();
    }
    send("coarse", found, began);

    let (rested, look) = (Instant::now(), Duration::from_millis(5));
    while rested.elapsed() < REST && !halt.is_stopped() {
        std::thread::sleep(look);
    }
    if halt.is_stopped() {
        return Ok(());
    }
    let began = Instant::now();
    let (method, seeds, longest_period) = (Method::Shooting, SEEDS, LONGEST_PERIOD);
    let search = BranchSearch { base: &base, parameter: &family, range, method, tolerance: FINE, seeds, longest_period };
    let branches = search.run()?;
    send("fine", branches.clone(), began);
    if !halt.is_stopped() && !branches.is_empty() {
        let width = BandwidthSearch { base: &base, parameter: &parameter, range, tolerance: FINE };
        let widths = width.run(&branches);
        let mut frame = Frame::new(id, "response", "widths");
        if let Some(together) = &widths.together {
            frame.put("peak", json!(together.peak)).put("intervals", json!(together.intervals)).put("width", together.width);
        }
        session.send(halt, frame);
    }
    Ok(())
}

/// Orbits on which a march from rest and from the steady state settles at both ends of the range.
fn settled<H: Harvester>(family: &H, base: &Prepared, range: (f64, f64)) -> Vec<KnownOrbit> {
    let plant = &base.kernel.plant;
    let rest = vec![0.0; plant.len()];
    let steady = plant.to_physical(&rest, 0.0);
    let (low, high) = range;
    let jobs = [(low, &steady), (high, &steady), (low, &rest), (high, &rest)];
    let known = |(parameter, start): (f64, &Vec<f64>)| {
        let orbit = settled_orbit(family, parameter, start, COARSE, 1e-6)?;
        Some(KnownOrbit { period_cycles: orbit.period_cycles, state: orbit.start().to_vec(), parameter })
    };
    let ([a, b], [c, d]) = ([jobs[0], jobs[1]], [jobs[2], jobs[3]]);
    let pair = |one, two| rayon::join(|| known(one), || known(two));
    let (first, second) = (pair(a, b), pair(c, d));
    [first.0, first.1, second.0, second.1].into_iter().flatten().collect()
}

/// The harvester that never touches its stop.
fn put_linear(frame: &mut Frame, parameter: &Parameter, (low, high): (f64, f64)) {
    let value = |k: usize| low + (high - low) * k as f64 / (LINEAR_POINTS - 1) as f64;
    let power = |k: usize| parameter.at(value(k)).map_or(f64::NAN, |setting| steady_power_w(&setting.kernel.plant));
    frame.array("linear.x", (0..LINEAR_POINTS).map(value)).array("linear.power", (0..LINEAR_POINTS).map(power));
}

fn put_branches(frame: &mut Frame, branches: &[Branch]) {
    let (mut listed, mut marks) = (Vec::new(), Vec::new());
    for (index, branch) in branches.iter().enumerate() {
        listed.push(json!({ "period": branch.period_cycles, "endings": branch.endings }));
        let mut array = |name: &str, value: fn(&BranchPoint) -> f64| {
            frame.array(&format!("{index}.{name}"), branch.points.iter().map(value));
        };
        array("x", |point| point.parameter);
        array("power", |point| point.orbit.mean_power_w);
        array("voltage", |point| point.orbit.voltage_rms_v);
        array("penetration", |point| point.orbit.max_penetration_m);
        array("floquet", |point| point.orbit.floquet_max_abs());
        array("contacts", |point| point.orbit.contacts as f64);
        marks.extend(branch.bifurcations.iter().map(|found| mark(index, found)));
    }
    frame.put("branches", listed).put("bifurcations", marks);
}

fn mark(branch: usize, found: &Bifurcation) -> Value {
    let orbit = &found.at.orbit;
    json!({
        "branch": branch, "kind": found.kind.name(), "x": found.at.parameter, "power": orbit.mean_power_w,
        "voltage": orbit.voltage_rms_v, "penetration": orbit.max_penetration_m, "floquet": orbit.floquet_max_abs(),
        "contacts": orbit.contacts,
    })
}
