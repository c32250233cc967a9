//! Invariances: the start time, the positive side, the units, and interruptions of the integration.

use crate::plants::{bench, distance, from_rest, integrate, kernel, physical, relative, springs};
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_dynamics::Integrator;
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{Drive, Stop};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const TOLERANCE: f64 = 1e-10;

#[test]
fn the_clock_may_start_later() {
    let (early, mut shifted) = (bench(50.0, 11.0), bench(50.0, 11.0));
    let later_s = 0.123;
    shifted.drives[0].phase_rad -= TAU * 11.0 * later_s;
    let (early, shifted) = (kernel(early), kernel(shifted));
    let rest = StartState::rest(&early.plant).physical();
    let one = integrate(&early, &rest, 0.0, 2.0, TOLERANCE);
    let other = integrate(&shifted, &rest, later_s, 2.0 + later_s, TOLERANCE);
    let error = distance(&early, &physical(&other, &shifted), &physical(&one, &early));
    eprintln!("time shift {error:.1e}");
    assert!(one.statistics().contacts > 10 && error < 1e-8, "{error:e}");
    assert!(relative(other.energies().loads_j[0], one.energies().loads_j[0]) < 1e-8);
}

#[test]
fn the_other_side_is_the_mirror_image() {
    let (right, mut mirrored_bench) = (bench(50.0, 11.0), bench(50.0, 11.0));
    mirrored_bench.stops[0]
        .shape
        .iter_mut()
        .for_each(|s| *s = -*s);
    mirrored_bench.drives[0].phase_rad += PI;
    let (right, mirrored_bench) = (kernel(right), kernel(mirrored_bench));
    let rest = StartState::rest(&right.plant).physical();
    let one = integrate(&right, &rest, 0.0, 2.0, TOLERANCE);
    let other = integrate(&mirrored_bench, &rest, 0.0, 2.0, TOLERANCE);
    let mirrored: Vec<f64> = physical(&other, &mirrored_bench)
        .iter()
        .map(|x| -x)
        .collect();
    let error = distance(&right, &mirrored, &physical(&one, &right));
    eprintln!("mirror {error:.1e}");
    assert!(error < 1e-8, "{error:e}");
}

/// `x -> c x` with `gap -> c gap`, `F -> c F`, `k -> c^(1-n) k`: energies grow as `c^2`.
#[test]
fn lengths_scale_with_the_force() {
    let mut scaled = bench(50.0, 11.0);
    let c: f64 = 3.7;
    scaled.drives[0].amplitude_n *= c;
    scaled.stops[0].gap_m *= c;
    scaled.stops[0].law = Law::Hertz(Hertz {
        stiffness: 1000.0 / c.sqrt(),
        exponent: 1.5,
    });
    let one = from_rest(&kernel(bench(50.0, 11.0)), 4.0, TOLERANCE);
    let other = from_rest(&kernel(scaled), 4.0, TOLERANCE);
    let error = relative(other.mean_power_w, c * c * one.mean_power_w);
    eprintln!("scaling {error:.1e}");
    assert!(error < 1e-8 && other.contacts == one.contacts, "{error:e}");
}

/// Twice as fast: frequencies, conductances and forces scale together; powers scale with the cube
/// of the rate times the square of the length, with the length unchanged here.
#[test]
fn time_scales_with_the_frequencies() {
    let rate = 2.0;
    let mut fast = bench(50.0, 22.0);
    Arc::make_mut(&mut fast.modes)
        .frequency_rad_s
        .iter_mut()
        .for_each(|w| *w *= rate);
    // q'' scales by rate^2, and so do forces; theta V scales like q'' and C V like theta q: theta
    // -> rate theta leaves V unchanged.
    Arc::make_mut(&mut fast.modes)
        .patch
        .values_mut()
        .for_each(|patch| {
            patch
                .coupling_n_per_v
                .iter_mut()
                .for_each(|theta| *theta *= rate)
        });
    fast.loads[0].resistance_ohm /= rate;
    fast.drives[0].amplitude_n *= rate * rate;
    fast.stops[0].law = Law::Hertz(Hertz {
        stiffness: 1000.0 * rate * rate,
        exponent: 1.5,
    });
    let one = from_rest(&kernel(bench(50.0, 11.0)), 4.0, TOLERANCE);
    let other = from_rest(&kernel(fast), 4.0 / rate, TOLERANCE);
    let error = relative(other.mean_power_w, rate.powi(3) * one.mean_power_w);
    eprintln!("time scaling {error:.1e}");
    assert!(error < 1e-8 && other.contacts == one.contacts, "{error:e}");
}

#[test]
fn intermediate_stops_give_the_same_result() {
    let kernel = kernel(bench(50.0, 11.0));
    let rest = StartState::rest(&kernel.plant).physical();
    let single_step = integrate(&kernel, &rest, 0.0, 2.0, TOLERANCE);
    for pieces in [7, 613, 20_011] {
        let y = kernel.plant.from_physical(&rest, 0.0);
        let mut in_pieces = Integrator::new(&kernel, &y, 0.0, TOLERANCE).unwrap();
        for k in 1..=pieces {
            in_pieces
                .advance_to(2.0 * f64::from(k) / f64::from(pieces))
                .unwrap();
        }
        let error = distance(
            &kernel,
            &physical(&in_pieces, &kernel),
            &physical(&single_step, &kernel),
        );
        eprintln!("{pieces} pieces: {error:.1e}");
        assert!(error < 1e-8, "{pieces}: {error:e}");
        assert_eq!(
            in_pieces.statistics().contacts,
            single_step.statistics().contacts,
            "{pieces}"
        );
        assert!(
            relative(
                in_pieces.energies().loads_j[0],
                single_step.energies().loads_j[0]
            ) < 1e-8,
            "{pieces}"
        );
    }
}

#[test]
fn a_run_continues_from_its_end() {
    let complete = from_rest(&kernel(bench(50.0, 11.0)), 3.0, TOLERANCE);
    let first_kernel = kernel(bench(50.0, 11.0));
    let first = from_rest(&first_kernel, 1.37, TOLERANCE);
    let mut onward = bench(50.0, 11.0);
    onward.drives[0].phase_rad = first.end.drive_angle_rad[0];
    let onward = kernel(onward);
    let plan = RunPlan {
        duration_s: 3.0 - 1.37,
        average_over_s: 1.5,
        tolerance: TOLERANCE,
        record_s: 0.0,
    };
    let rest = simulate(&onward, &first.end, &plan).unwrap();
    let error = distance(&onward, &rest.end.physical(), &complete.end.physical());
    eprintln!("gone on {error:.1e}");
    assert!(
        error < 1e-8 && relative(rest.mean_power_w, complete.mean_power_w) < 1e-8,
        "{error:e}"
    );
}

/// One mass on equal Hertz stops at one point. Three stops give the result of one with three times
/// the stiffness, with equal statistics, although roundoff opens and closes them at the instant of
/// impact.
#[test]
fn equal_stops_at_one_point_have_equal_statistics() {
    let stopped = |count: usize| {
        let mut system = springs(&[30.0], 0.02);
        let shape = vec![10.0];
        let drive = Drive {
            name: "x".into(),
            shape: shape.clone(),
            amplitude_n: 2.0,
            frequency_hz: 20.0,
            phase_rad: 0.0,
            base: None,
        };
        system.drives.push(drive);
        let law = Law::Hertz(Hertz {
            stiffness: 3e5 / count as f64,
            exponent: 1.5,
        });
        system.stops = (0..count)
            .map(|i| Stop {
                name: format!("{i}"),
                shape: shape.clone(),
                gap_m: 1e-3,
                law,
                bases: Vec::new(),
            })
            .collect();
        from_rest(&kernel(system), 1.0, 1e-11)
    };
    let (one, three) = (stopped(1), stopped(3));
    let counts: Vec<u64> = three.stops.iter().map(|stop| stop.contacts).collect();
    let contact_duration_s: Vec<f64> = three
        .stops
        .iter()
        .map(|stop| stop.mean_contact_duration_s)
        .collect();
    eprintln!(
        "{} {counts:?}, {:e} {contact_duration_s:?}",
        one.contacts, one.stops[0].mean_contact_duration_s
    );
    assert!(one.contacts > 10 && counts == [one.contacts; 3]);
    assert!(
        contact_duration_s
            .iter()
            .all(|duration_s| relative(*duration_s, one.stops[0].mean_contact_duration_s) < 1e-6),
        "{contact_duration_s:?}"
    );
}
