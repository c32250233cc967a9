//! Hard cases, each with a definite result.

use crate::harvesters::{bench, branches};
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::{
    AnalysisError, Branch, BranchKind, BranchOptions, BranchSearch, Model, OrbitMethodKind,
    Parameter, Termination,
};
use jounce_continuation::{
    Continuation, Corrector, Direction, Linearization, Position, Problem, StepControl,
};
use jounce_model::plant::PlantError;
use jounce_model::reference::ImpactOscillator;
use jounce_orbits::{OrbitError, ParametricModel, Shooting};
use jounce_spec::SpecFile;

fn spec_with(changes: &[(&str, &str)]) -> SpecFile {
    let mut file = bench();
    changes
        .iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file
}

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

/// A stop that touches at rest, and one that is pressed at rest: the first point is the steady
/// state of a long integration.
#[test]
fn closed_and_preloaded_gaps_have_the_power_of_integration() {
    for gap in ["\"0 mm\"", "\"-0.2 mm\""] {
        let file = spec_with(&[
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
    let file = spec_with(&[("stop.tip.gap", "\"500 mm\"")]);
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
    let harvester = crate::harvesters::Systems(without_damping);
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

/// A very stiff stop: the branch turns at its grazing more sharply than any step can follow, and
/// the error reports this.
#[test]
fn a_stop_of_1e10_ends_the_low_branch_at_its_grazing() {
    let file = spec_with(&[("stop.tip.stiffness", "\"1e10 N/m^1.5\"")]);
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
    let file = spec_with(&[("stop.tip.stiffness", "\"1e10 N/m^1.5\"")]);
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

/// Where its resonance is sharp the branch is far from the chords between its points; the orbits at
/// both ends still lie on one branch.
#[test]
fn a_sharp_resonance_is_one_branch() {
    let file = spec_with(&[("stop.tip.gap", "\"1 m\"")]);
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

/// Grazings are found where the number of harmonics changes or where Newton fails near their kink.
/// There a point is known to the accuracy of the orbits, a millionth of the motion, which moves a
/// tangency by up to 8e-5 Hz; elsewhere by 2e-8 Hz.
#[test]
fn a_closed_gap_has_the_same_grazings_by_both_methods() {
    let file = spec_with(&[("stop.tip.gap", "\"0 mm\"")]);
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

/// A circle whose problem is not defined below parameter zero: steps become shorter before
/// continuation ends.
#[test]
fn a_step_into_nothing_is_made_shorter() {
    let at = |angle: f64| Position {
        unknown: vec![1.5 + angle.cos()],
        parameter: 1.0 + angle.sin(),
    };
    let tangent = |angle: f64| Direction {
        unknown: vec![-angle.sin()],
        parameter: angle.cos(),
    };
    let angle = -0.9;
    // The circle touches zero at its lowest point.
    let start_direction = Direction {
        unknown: vec![-tangent(angle).unknown[0]],
        parameter: -tangent(angle).parameter,
    };
    let continuation = Continuation::new(
        &Circle,
        Corrector {
            goal: 1e-12,
            most: 8,
        },
        StepControl {
            first: 0.3,
            ..StepControl::default()
        },
        1.0,
        at(angle),
        start_direction,
    );
    let last = continuation
        .take(200)
        .map(|step| step.map(|step| step.position))
        .take_while(|step| step.as_ref().is_ok_and(|at| at.parameter < 1.0))
        .last();
    let last = last.unwrap().unwrap();
    assert!(last.unknown[0] < 1.0, "{last:?}");
}

/// `(u - 1.5)^2 + (p - 1)^2 = 1`, for positive `p` only.
struct Circle;

struct Place {
    residual: [f64; 1],
    slopes: [f64; 2],
}

impl Problem for Circle {
    type Evaluation = Place;
    type Error = String;

    fn at(&self, unknown: &[f64], parameter: f64) -> Result<Place, String> {
        let (x, y) = (unknown[0] - 1.5, parameter - 1.0);
        if parameter < 0.0 {
            Err(format!("{parameter}"))
        } else {
            Ok(Place {
                residual: [x * x + y * y - 1.0],
                slopes: [2.0 * x, 2.0 * y],
            })
        }
    }
}

impl Linearization for Place {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let [a, b] = self.slopes;
        let below = a * corner - b * row[0];
        (below != 0.0).then(|| {
            (
                vec![(right[0] * corner - b * last) / below],
                (a * last - row[0] * right[0]) / below,
            )
        })
    }
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
    let file = spec_with(&[("drive.shaker.amplitude", "\"0 N\"")]);
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
    let spec_with = |budget: usize| {
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
    let (cut, full) = (spec_with(10), spec_with(50_000));
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
