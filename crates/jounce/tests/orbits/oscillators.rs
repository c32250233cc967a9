//! `examples/bouncing-and-impact-oscillators`: every row of its `expected.toml`.

use crate::backbones::phase_resonance;
use crate::rows;
use jounce::plant::System;
use jounce::spec::SpecFile;
use jounce::study::{BranchKind, BranchSearch, Method, Parameter, Prepared, settled_orbit};

/// The folder of the specs.
const EXAMPLE: &str = "bouncing-and-impact-oscillators";

fn meets(found: f64, row: &str) {
    rows::check_row(EXAMPLE, row, found);
}

fn impact() -> SpecFile {
    SpecFile::from_text(include_str!("../../../../examples/bouncing-and-impact-oscillators/impact.toml"))
}

fn bifurcations(file: &SpecFile, key: &str, range: (f64, f64), kind: BranchKind) -> Vec<f64> {
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(key).unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search =
        BranchSearch { base: &base, parameter: &parameter, range, method: Method::Shooting, tolerance: 1e-10, seeds: 0, longest_period: 1 };
    let found = search.run().unwrap();
    let all = found.iter().flat_map(|branch| &branch.bifurcations);
    all.filter(|found| found.kind == kind).map(|found| found.at.parameter).collect()
}

#[test]
fn impact_oscillator() {
    let file = impact();
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("stop.wall.gap").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let orbit = settled_orbit(&parameter, 1.0, &[0.0, 0.0], 1e-11, 1e-10).unwrap();
    meets(orbit.floquet_max_abs(), "impact_largest_multiplier");
    let doublings = bifurcations(&file, "stop.wall.gap", (1.5, 2.2), BranchKind::PeriodDoubling);
    eprintln!("doublings {doublings:?}");
    meets(doublings[0], "impact_doubling_gap_m");
}

#[test]
fn bilinear() {
    let file = SpecFile::from_text(include_str!("../../../../examples/bouncing-and-impact-oscillators/bilinear.toml"));
    let spec = file.spec().unwrap();
    let modes = jounce::structure::modes(&spec).unwrap();
    let system = System::assemble(&spec, modes).unwrap();
    let driven = |frequency_hz: f64| {
        let mut system = system.clone();
        system.drives[0].frequency_hz = frequency_hz;
        system
    };
    let (resonance_hz, away_m) = phase_resonance(driven, &[-1.0, 0.0], 1.5, 1.0);
    eprintln!("swings {away_m} m to the free side");
    meets(resonance_hz, "bilinear_resonance_hz");
}

#[test]
fn duffing() {
    let file = SpecFile::from_text(include_str!("../../../../examples/bouncing-and-impact-oscillators/duffing.toml"));
    let mut folds = bifurcations(&file, "drive.shaker.frequency", (0.95, 1.4), BranchKind::Fold);
    folds.sort_by(f64::total_cmp);
    assert_eq!(folds.len(), 2, "{folds:?}");
    meets(folds[1], "duffing_upper_fold_hz");
    meets(folds[0], "duffing_lower_fold_hz");
}
