//! Hard cases, each with a definite result.

use crate::harvesters::{Systems, bench, bench_with_keys, branches};
use jounce_analysis::{
    AnalysisError, Branch, BranchKind, BranchOptions, BranchSearch, Model, OrbitMethodKind,
    Parameter, Termination,
};
use jounce_continuation::Problem;
use jounce_model::plant::PlantError;
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::{OrbitError, ParametricModel, Shooting};
use jounce_spec::SpecFile;

fn branches_over(
    file: &SpecFile,
    key: &str,
    range: (f64, f64),
    tolerance: f64,
) -> Result<Vec<Branch>, OrbitError<AnalysisError>> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(key).unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method: OrbitMethodKind::Shooting,
        tolerance,
        seeds: 0,
        longest_period: 1,
    }
    .run()
}

#[test]
fn resonance_without_damping_is_reported() {
    let without_damping = |frequency_ratio: f64| {
        ImpactOscillator {
            frequency_ratio,
            damping_ratio: 0.0,
            restitution: 0.8,
            gap: 1.0,
        }
        .system(0.0)
    };
    let harvester = Systems(without_damping);
    let kernel = harvester.at(0.5).unwrap().kernel;
    let shooting = Shooting::new(&harvester, &kernel, 1, 1e-9);
    let refused = shooting.at(&[0.0, 0.0], 1.0).unwrap_err();
    assert!(
        matches!(
            refused,
            OrbitError::Harvester(PlantError::UndampedResonance { .. })
        ),
        "{refused}"
    );
    assert!(refused.to_string().contains("damping"), "{refused}");
}

/// Where its resonance is sharp the branch is far from the chords between its points; the orbits at
/// both ends still lie on one branch.
#[test]
fn a_sharp_resonance_is_one_branch() {
    let file = bench_with_keys(&[("stop.tip.gap", "\"1 m\"")]);
    for method in [
        OrbitMethodKind::Shooting,
        OrbitMethodKind::HarmonicBalance { harmonics: 16 },
    ] {
        let branches_found = branches(&file, (4.0, 20.0), method, 2);
        assert!(
            branches_found.len() == 1 && branches_found[0].endings == [Termination::Range],
            "{method:?}: {} branches",
            branches_found.len()
        );
    }
}

/// More harmonics move a point normal to the curve; one at the end of the range stays there.
#[test]
fn a_branch_by_harmonic_balance_keeps_to_its_range() {
    let file = bench();
    let (base, key) = (
        Model::new(file.spec().unwrap()).unwrap(),
        file.numeric_key("circuit.load.resistance").unwrap(),
    );
    let range = (100.0, 1e7);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let method = OrbitMethodKind::HarmonicBalance { harmonics: 16 };
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
    };
    let branches_found = search.run().unwrap();
    let points = || branches_found.iter().flat_map(|branch| &branch.points);
    assert!(
        points().all(|point| (range.0..=range.1).contains(&point.parameter))
            && points().any(|point| point.parameter == range.0)
    );
}

/// A tolerance below roundoff: a result with its actual error, or an error, but no endless search.
#[test]
fn a_tolerance_out_of_reach_ends() {
    match branches_over(&bench(), "drive.shaker.frequency", (10.5, 10.6), 1e-17) {
        Ok(found) => {
            let worst = found
                .iter()
                .flat_map(|branch| &branch.points)
                .map(|point| point.orbit.error_estimate)
                .fold(0.0, f64::max);
            eprintln!("{} branches, error estimate {worst:e}", found.len());
            assert!(worst < 1e-6);
        }
        Err(refused) => eprintln!("{refused}"),
    }
}

#[test]
fn without_a_drive_there_is_no_orbit() {
    let file = bench_with_keys(&[("drive.shaker.amplitude", "\"0 N\"")]);
    let mut spec = file.spec().unwrap();
    spec.drive.clear();
    let base = Model::new(spec).unwrap();
    let key = file.numeric_key("stop.tip.gap").unwrap();
    let parameter = Parameter::new(&base, &key, 1e-3);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: (5e-4, 1e-3),
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
    };
    let refused = search.run().unwrap_err();
    assert!(
        matches!(refused, OrbitError::Frequencies { frequencies: 0 }),
        "{refused}"
    );
}

/// Any numeric key works: the orbit at the value in the spec does not depend on the key.
#[test]
fn every_kind_of_key_leads_through_the_same_orbit() {
    let file = bench();
    let spec = file.spec().unwrap();
    let mut powers = Vec::new();
    for name in [
        "drive.shaker.frequency",
        "drive.shaker.amplitude",
        "stop.tip.gap",
        "stop.tip.stiffness",
        "circuit.load.resistance",
        "modal.harvester.patch.mfc.capacitance",
    ] {
        let value = file.numeric_key(name).unwrap().get(&spec).unwrap();
        let branches_found = branches_over(&file, name, (value, 1.02 * value), 1e-10).unwrap();
        let first = branches_found[0]
            .points
            .iter()
            .find(|point| point.parameter == value)
            .unwrap();
        eprintln!("{name}: {:.10e} W", first.orbit.mean_power_w);
        powers.push(first.orbit.mean_power_w);
    }
    assert!(
        powers
            .iter()
            .all(|power_w| (power_w / powers[0] - 1.0).abs() < 1e-8),
        "{powers:?}"
    );
}

/// A budget of ten orbits: branches are listed up to the point where the budget ends, and the
/// remainder is counted.
#[test]
fn a_budget_ends_the_search_and_counts_the_remaining_work() {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let range = (5.0, 20.0);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let (method, tolerance, seeds, longest_period) = (OrbitMethodKind::Shooting, 1e-8, 2, 2);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds,
        longest_period,
    };
    let within = |budget: usize| {
        search
            .run_with(&BranchOptions {
                budget,
                ..BranchOptions::default()
            })
            .unwrap()
    };
    let work = |branches: &[Branch]| {
        branches
            .iter()
            .map(|branch| branch.points.len() * branch.period_cycles as usize)
            .sum::<usize>()
    };
    let (cut, full) = (within(10), within(50_000));
    assert!(
        work(&full) > 100
            && full
                .iter()
                .all(|branch| branch.is_complete() && branch.not_followed == 0)
    );
    let doublings = full
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == BranchKind::PeriodDoubling)
        .count();
    assert!(doublings > 0);
    // Both directions of the first branch may use the budget, and each remaining start is a
    // separate point.
    assert!(
        work(&cut) < 40
            && cut
                .iter()
                .any(|branch| branch.endings.contains(&Termination::Points)),
        "{}",
        work(&cut)
    );
}
