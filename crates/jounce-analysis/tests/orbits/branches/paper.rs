//! The paper's plant: power, multipliers and folds against other programs.

use crate::harvesters::{bench, branches};
use jounce_analysis::{Branch, BranchKind, OrbitMethodKind};

fn folds(branch: &Branch) -> Vec<(f64, f64)> {
    let folds = branch
        .bifurcations
        .iter()
        .filter(|label| label.kind == BranchKind::Fold);
    folds
        .map(|label| (label.at.parameter, label.at.orbit.mean_power_w))
        .collect()
}

#[test]
fn published_points_and_folds_lie_on_the_branch() {
    let file = bench();
    let branches_found = branches(&file, (10.5, 14.0), OrbitMethodKind::Shooting, 0);
    let branch = &branches_found[0];
    let first = &branch.points[0];
    eprintln!(
        "10.5 Hz: {:.9e} W, {:.6}",
        first.orbit.mean_power_w,
        first.orbit.floquet_max_abs()
    );
    assert_eq!(first.parameter, 10.5);
    // The published plant was computed on elements of 5 mm: its second frequency is lower by 1.6e-7.
    assert!(
        (first.orbit.mean_power_w / 3.279858e-5 - 1.0).abs() < 2e-6
            && (first.orbit.floquet_max_abs() - 0.9853).abs() < 1e-4
    );
    let folds = folds(branch);
    eprintln!("folds {folds:?}");
    assert!(
        (folds[0].0 - 12.3218).abs() < 1e-4 && (folds[0].1 / 1.68e-3 - 1.0).abs() < 2e-3,
        "{folds:?}"
    );
    // AUTO-07p has folds at 12.322 and 11.651 Hz.
    assert!((folds[1].0 - 11.651).abs() < 1e-3, "{folds:?}");
}

#[test]
fn the_stable_point_below_the_fold_is_the_published_one() {
    let file = bench();
    let branches_found = branches(&file, (10.5, 12.30122), OrbitMethodKind::Shooting, 0);
    let last = branches_found[0].points.last().unwrap();
    eprintln!(
        "{} Hz: {:.9e} W, stable {}",
        last.parameter,
        last.orbit.mean_power_w,
        last.orbit.is_stable()
    );
    assert!(last.parameter == 12.30122 && last.orbit.is_stable());
    assert!((last.orbit.mean_power_w / 1.751276e-3 - 1.0).abs() < 1e-6);
}

/// The low branch is the linear response; it grazes where the steady amplitude equals the gap.
#[test]
fn low_branch_ends_where_the_steady_amplitude_reaches_the_gap() {
    let file = bench();
    let plant = jounce_analysis::Model::new(file.spec().unwrap())
        .unwrap()
        .kernel
        .plant;
    let excess = |frequency_hz: f64| {
        let mut drives = plant.system.drives.clone();
        drives[0].frequency_hz = frequency_hz;
        plant.with_drives(drives).unwrap().ports[0].steady_m[0].norm() - 1e-3
    };
    let (mut low, mut high) = (13.0, 14.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    let branches_found = branches(&file, (10.5, 14.0), OrbitMethodKind::Shooting, 0);
    let grazing = branches_found[0]
        .bifurcations
        .iter()
        .find(|b| b.kind == BranchKind::Grazing)
        .unwrap();
    eprintln!(
        "grazing at {:.9} Hz, in closed form {low:.9} Hz",
        grazing.at.parameter
    );
    assert!((grazing.at.parameter - low).abs() < 1e-6);
}
