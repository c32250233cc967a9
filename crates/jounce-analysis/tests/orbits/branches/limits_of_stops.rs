//! Stops at the limits: closed, preloaded, never reached, very stiff, touched at the start.

use crate::harvesters::{bench, bench_with_keys, branches};
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::{Branch, BranchKind, Model, OrbitMethodKind, Termination};

/// A stop that touches at rest, and one that is pressed at rest: the first point is the steady
/// state of a long integration.
#[test]
fn closed_and_preloaded_gaps_have_the_power_of_integration() {
    for gap in ["\"0 mm\"", "\"-0.2 mm\""] {
        let file = bench_with_keys(&[
            ("stop.tip.gap", gap),
            ("drive.shaker.frequency", "\"13 Hz\""),
        ]);
        let branches_found = branches(&file, (13.0, 14.0), OrbitMethodKind::Shooting, 0);
        let first = branches_found
            .iter()
            .flat_map(|branch| &branch.points)
            .find(|point| point.parameter == 13.0)
            .unwrap();
        let kernel = Model::new(file.spec().unwrap()).unwrap().kernel;
        let plan = RunPlan {
            duration_s: 400.0,
            average_over_s: 13.0,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let run = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        eprintln!(
            "gap {gap}: {:.9e} W, integrated {:.9e} W",
            first.orbit.mean_power_w, run.mean_power_w
        );
        assert!(
            (first.orbit.mean_power_w / run.mean_power_w - 1.0).abs() < 1e-5
                && first.orbit.contacts > 0
        );
    }
}

/// With a stop out of reach the response is linear and stable everywhere.
#[test]
fn a_stop_that_is_never_reached_leaves_the_linear_response() {
    let file = bench_with_keys(&[("stop.tip.gap", "\"500 mm\"")]);
    let branches_found = branches(&file, (10.5, 14.0), OrbitMethodKind::Shooting, 0);
    assert!(
        branches_found.len() == 1
            && branches_found[0].bifurcations.is_empty()
            && branches_found[0].endings == [Termination::Range]
    );
    let base = Model::new(file.spec().unwrap()).unwrap();
    for point in &branches_found[0].points {
        let mut drives = base.kernel.plant.system.drives.clone();
        drives[0].frequency_hz = point.parameter;
        let plant = base.kernel.plant.with_drives(drives).unwrap();
        let voltage: f64 = plant
            .steady_output(&plant.voltage_row(0))
            .iter()
            .map(|v| v.norm())
            .sum();
        let exact_w = 0.5 * voltage * voltage / plant.system.loads[0].resistance_ohm;
        assert!(
            (point.orbit.mean_power_w / exact_w - 1.0).abs() < 1e-7
                && point.orbit.is_stable()
                && point.orbit.contacts == 0
        );
    }
}

/// Continuation starts exactly where the orbit touches the stop.
#[test]
fn grazing_at_the_start_is_an_ordinary_start() {
    let first = branches(&bench(), (12.5, 14.0), OrbitMethodKind::Shooting, 0);
    let grazing = first
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .find(|label| label.kind == BranchKind::Grazing)
        .unwrap();
    let start_hz = grazing.at.parameter;
    let branches_found = branches(&bench(), (start_hz, 14.0), OrbitMethodKind::Shooting, 0);
    let goes_on = |branch: &Branch| {
        let first = &branch.points[0];
        let same = (first.orbit.mean_power_w / grazing.at.orbit.mean_power_w - 1.0).abs() < 1e-6;
        first.parameter == start_hz && same && branch.endings == [Termination::Range]
    };
    eprintln!(
        "{:?}",
        branches_found
            .iter()
            .map(|branch| (branch.period_cycles, &branch.endings))
            .collect::<Vec<_>>()
    );
    assert!(branches_found.iter().any(goes_on));
}

/// A very stiff stop: the branch turns at its grazing more sharply than any step can follow, and
/// the error reports this.
#[test]
fn a_stop_of_1e10_ends_the_low_branch_at_its_grazing() {
    let file = bench_with_keys(&[("stop.tip.stiffness", "\"1e10 N/m^1.5\"")]);
    let branches_found = branches(&file, (13.0, 14.0), OrbitMethodKind::Shooting, 0);
    let grazes = |branch: &Branch| {
        branch
            .endings
            .iter()
            .any(|ending| matches!(ending, Termination::Grazing { parameter, .. } if (parameter - 13.340_123).abs() < 1e-5))
    };
    eprintln!(
        "{:?}",
        branches_found
            .iter()
            .map(|branch| &branch.endings)
            .collect::<Vec<_>>()
    );
    assert!(branches_found.iter().any(grazes));
}

/// Harmonic balance ends there too with an error, instead of reversing along the orbits that never
/// touch.
#[test]
fn a_stop_of_1e10_ends_harmonic_balance_at_the_same_grazing() {
    let file = bench_with_keys(&[("stop.tip.stiffness", "\"1e10 N/m^1.5\"")]);
    let branches_found = branches(
        &file,
        (13.0, 14.0),
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
        0,
    );
    let low = branches_found
        .iter()
        .find(|branch| branch.points[0].parameter == 14.0)
        .unwrap();
    eprintln!("{:?}, {} labels", low.endings, low.bifurcations.len());
    let [Termination::Grazing { parameter, .. } | Termination::Failed { parameter, .. }] =
        low.endings[..]
    else {
        panic!("{:?}", low.endings)
    };
    assert!(
        (parameter - 13.340_123).abs() < 1e-5
            && low.points.iter().all(|point| point.parameter <= 14.0)
    );
    // A reversed branch would pass every orbit again.
    let untouched = low.points.iter().filter(|point| point.orbit.contacts == 0);
    assert!(
        untouched
            .map(|point| point.parameter)
            .is_sorted_by(|a, b| a > b)
    );
}

/// Grazings are found where the number of harmonics changes or where Newton fails near their kink.
/// There a point is known to the accuracy of the orbits, a millionth of the motion, which moves a
/// tangency by up to 8e-5 Hz; elsewhere by 2e-8 Hz.
#[test]
fn a_closed_gap_has_the_same_grazings_by_both_methods() {
    let file = bench_with_keys(&[("stop.tip.gap", "\"0 mm\"")]);
    let grazings = [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 64 },
    ]
    .map(|method| {
        let branch = branches(&file, (4.0, 7.0), method, 0).remove(0);
        let grazes = branch
            .bifurcations
            .iter()
            .filter(|label| label.kind == BranchKind::Grazing);
        let mut grazings_hz: Vec<f64> = grazes.map(|label| label.at.parameter).collect();
        grazings_hz.sort_by(f64::total_cmp);
        grazings_hz
    });
    eprintln!("{grazings:?}");
    assert!(grazings[0].len() == 3 && grazings[1].len() == 3);
    assert!(
        grazings[0]
            .iter()
            .zip(&grazings[1])
            .all(|(a, b)| (a - b).abs() < 1e-4)
    );
}
