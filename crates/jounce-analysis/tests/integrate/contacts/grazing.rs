//! A stop at the very edge of the motion is neither missed nor falsely detected.

use crate::plants::{bench, kernel, relative};
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::Plant;
use jounce_model::plant::{Stop, System};
use jounce_model::reference::Harmonic;

/// A run in the steady state without contact, with the drive scaled so that the closest approach is
/// `reach` times the gap.
fn graze(mut system: System, reach: f64, duration_s: f64) -> RunResult {
    let peak_m = Plant::new(system.clone()).unwrap().ports[0].steady_m[0].norm();
    system.drives[0].amplitude_n *= reach * system.stops[0].gap_m / peak_m;
    let kernel = kernel(system);
    let plan = RunPlan {
        duration_s,
        average_over_s: duration_s,
        tolerance: 1e-7,
        record_s: 0.0,
    };
    simulate(&kernel, &StartState::linear(&kernel.plant), &plan).unwrap()
}

fn harmonic() -> System {
    let problem = Harmonic {
        mass_kg: 0.2,
        frequency_rad_s: 60.0,
        damping_ratio: 0.02,
        amplitude_n: 1.0,
        drive_hz: 7.0,
    };
    let mut system = problem.system();
    let gap_m = 0.5 * problem.amplitude_m();
    let law = Law::Hertz(Hertz {
        stiffness: 1e6,
        exponent: 1.5,
    });
    system.stops.push(Stop {
        name: "stop".into(),
        shape: system.drives[0].shape.clone(),
        gap_m,
        law,
        bases: Vec::new(),
    });
    system
}

#[test]
fn a_hair_over_the_grazing_amplitude_touches_and_a_hair_below_does_not() {
    for (name, system, cycles_s) in [
        ("one mode", harmonic(), 1.0 / 7.0),
        ("harvester", bench(50.0, 11.0), 1.0 / 11.0),
    ] {
        for excess in [1e-3, 1e-6, 1e-9, 1e-11] {
            let over = graze(system.clone(), 1.0 + excess, 5.0 * cycles_s);
            let under = graze(system.clone(), 1.0 - excess, 5.0 * cycles_s);
            eprintln!(
                "{name}, hair {excess:e}: {} contacts over, {} under",
                over.contacts, under.contacts
            );
            assert!(over.contacts >= 1, "{name} {excess:e}: missed");
            assert_eq!(under.contacts, 0, "{name} {excess:e}: invented");
        }
    }
}

/// A touch too soft to change the motion: once per cycle, to the depth of the sine past the gap.
#[test]
fn soft_stop_is_touched_once_per_cycle() {
    let mut system = harmonic();
    system.stops[0].law = Law::Hertz(Hertz {
        stiffness: 1e-9,
        exponent: 1.0,
    });
    for excess in [1e-2, 1e-4, 1e-6] {
        let result = graze(system.clone(), 1.0 + excess, 100.0 / 7.0);
        assert_eq!(result.contacts, 100, "{excess:e}");
        let depth_m = system.stops[0].gap_m * excess;
        assert!(
            relative(result.max_penetration_m, depth_m) < 1e-5,
            "{excess:e}: {} {depth_m}",
            result.max_penetration_m
        );
    }
}

/// Very weak contacts must not lengthen the steps until they skip entire cycles.
#[test]
fn grazing_for_long_loses_no_contact() {
    let result = graze(harmonic(), 1.0 + 1e-9, 200.0 / 7.0);
    assert_eq!(result.contacts, 200);
}
