//! `examples/bouncing-and-impact-oscillators`: every row of its `expected.toml`.

use super::backbones::phase_resonance;
use crate::rows;
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::{BranchKind, BranchSearch, Model, OrbitMethodKind, Parameter, settled_orbit};
use jounce_dynamics::Kernel;
use jounce_model::plant::System;
use jounce_model::reference::{BouncingBall, BouncingTable};
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

/// Folder of the specs.
const EXAMPLE: &str = "bouncing-and-impact-oscillators";

fn check_row(value: f64, row: &str) {
    rows::check_row(EXAMPLE, row, value);
}

fn impact() -> SpecFile {
    SpecFile::from_text(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/impact.toml"
    ))
}

fn bifurcations(file: &SpecFile, key: &str, range: (f64, f64), kind: BranchKind) -> Vec<f64> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(key).unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-10,
        seeds: 0,
        longest_period: 1,
    };
    let branches_found = search.run().unwrap();
    let all = branches_found
        .iter()
        .flat_map(|branch| &branch.bifurcations);
    all.filter(|label| label.kind == kind)
        .map(|label| label.at.parameter)
        .collect()
}

#[test]
fn impact_oscillator() {
    let file = impact();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("stop.wall.gap").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let orbit = settled_orbit(&parameter, 1.0, &[0.0, 0.0], 1e-11, 1e-10).unwrap();
    check_row(orbit.floquet_max_abs(), "impact_largest_multiplier");
    let doublings = bifurcations(
        &file,
        "stop.wall.gap",
        (1.5, 2.2),
        BranchKind::PeriodDoubling,
    );
    eprintln!("doublings {doublings:?}");
    check_row(doublings[0], "impact_doubling_gap_m");
}

#[test]
fn bilinear() {
    let file = SpecFile::from_text(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/bilinear.toml"
    ));
    let spec = file.spec().unwrap();
    let modes = jounce_model::structure::modes(&spec).unwrap();
    let system = System::assemble(&spec, modes).unwrap();
    let driven = |frequency_hz: f64| {
        let mut system = system.clone();
        system.drives[0].frequency_hz = frequency_hz;
        system
    };
    let (resonance_hz, away_m) = phase_resonance(driven, &[-1.0, 0.0], 1.5, 1.0);
    eprintln!("swings {away_m} m to the free side");
    check_row(resonance_hz, "bilinear_resonance_hz");
}

#[test]
fn duffing() {
    let file = SpecFile::from_text(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/duffing.toml"
    ));
    let mut folds = bifurcations(
        &file,
        "drive.shaker.frequency",
        (0.95, 1.4),
        BranchKind::Fold,
    );
    folds.sort_by(f64::total_cmp);
    assert_eq!(folds.len(), 2, "{folds:?}");
    check_row(folds[1], "duffing_upper_fold_hz");
    check_row(folds[0], "duffing_lower_fold_hz");
}

fn kernel(text: &str) -> Kernel {
    Model::new(SpecFile::from_text(text).spec().unwrap())
        .unwrap()
        .kernel
}

/// The last bounces are too small to resolve and count as rest: 5e-7 s early.
#[test]
fn ball_on_a_floor() {
    let kernel = kernel(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/ball.toml"
    ));
    let plan = RunPlan {
        duration_s: 10.0,
        average_over_s: 10.0,
        tolerance: 1e-9,
        record_s: 10.0,
    };
    let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
    check_row(
        10.0 - result.stops[0].max_contact_duration_s,
        "ball_time_to_rest_s",
    );
    let ball = BouncingBall {
        height_m: 1.0,
        gravity_m_s2: 9.81,
        restitution: 0.8,
    };
    let even = (0..=50_000).map(|k| f64::from(k) * 1e-4);
    let mut times_s: Vec<f64> = even
        .chain((0..60).map(|bounce| ball.bounce_s(bounce)))
        .collect();
    times_s.sort_by(f64::total_cmp);
    let shape = kernel.plant.system.modes.shape["ball"][0];
    let heights = result
        .trajectory
        .at(&kernel, &times_s)
        .into_iter()
        .map(|at| shape * kernel.plant.to_physical(&at.state, at.time_s)[0]);
    let (path_m, last_m) = heights.fold((0.0, 0.0_f64), |(path, before), height| {
        (path + (height - before).abs(), height)
    });
    assert!((last_m + 1.0).abs() < 1e-12, "{last_m}");
    check_row(path_m, "ball_way_to_rest_m");
    let weight_n_s = result.stops[0].impulse_n_s;
    assert!(
        (weight_n_s / (0.01 * 9.81 * 10.0) - 1.0).abs() < 1e-9,
        "{weight_n_s}"
    );
}

/// The orbit with one bounce per cycle, integrated from its closed form for 20 cycles; its
/// doubling, as `jounce branch` finds it.
#[test]
fn ball_on_a_table() {
    let text = include_str!("../../../../../examples/bouncing-and-impact-oscillators/table.toml");
    let kernel = kernel(text);
    let (drive, gravity_m_s2) = (&kernel.plant.system.drives[0], 9.81);
    let (w, amplitude_m) = (TAU * drive.frequency_hz, 3.230373e-3);
    let orbit = BouncingTable {
        restitution: 0.5,
        acceleration_ratio: amplitude_m * w * w / gravity_m_s2,
    }
    .orbit(1)
    .unwrap();
    // Half a cycle of flight ends at the bounce; the drive starts before it.
    let (bounce_s, period_s) = (orbit.angle_rad / w, TAU / w);
    let falling_m_s = -0.5 * gravity_m_s2 * period_s + gravity_m_s2 * bounce_s;
    let height_m =
        amplitude_m * orbit.angle_rad.sin() + 0.5 * gravity_m_s2 * bounce_s * (period_s - bounce_s);
    let shape = kernel.plant.system.modes.shape["ball"][0];
    let mut start = StartState::rest(&kernel.plant);
    (start.displacement[0], start.velocity[0]) =
        (height_m / shape, (falling_m_s - amplitude_m * w) / shape);
    let plan = RunPlan {
        duration_s: 20.0 * period_s,
        average_over_s: 20.0 * period_s,
        tolerance: 1e-10,
        record_s: 0.0,
    };
    let result = simulate(&kernel, &start, &plan).unwrap();
    assert_eq!(result.contacts, 20);
    check_row(
        result.stops[0].mean_impact_velocity_m_s,
        "table_impact_velocity_m_s",
    );
    let doublings = bifurcations(
        &SpecFile::from_text(text),
        "drive.table.amplitude",
        (3e-3, 4.2e-3),
        BranchKind::PeriodDoubling,
    );
    eprintln!("doublings {doublings:?}");
    check_row(doublings[0] * 1e3, "table_doubling_amplitude_mm");
}
