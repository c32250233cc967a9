//! Periodic orbits with a stop at rest, by both methods, against the orbit of the force-driven
//! harvester.

use jounce_analysis::{Model, Parameter, settled_orbit};
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_orbits::{HarmonicBalance, Orbit, OrbitMethod, Shooting};
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

const DRIVE_HZ: f64 = 7.0;

fn file(on: &str, drive: &str) -> SpecFile {
    SpecFile::from_text(format!(
        "[mass.mass]\non = \"{on}\"\nmass = \"1 kg\"\nfrequency = \"6 Hz\"\ndamping_ratio = 0.05\n\
         [stop.wall]\nat = \"mass\"\nframe = \"ground\"\ngap = \"1 mm\"\nlaw = \"hertz\"\nstiffness = \"1e5 N/m^1.5\"\n\
         [drive.d]\n{drive}frequency = \"{DRIVE_HZ} Hz\"\n"
    ))
}

/// Displacement in space at the start of a period.
fn start_m(file: &SpecFile, x_m: f64, balance: bool) -> (Orbit, f64) {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.d.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let settled = settled_orbit(
        &parameter,
        DRIVE_HZ,
        &vec![0.0; base.kernel.plant.len()],
        1e-11,
        1e-11,
    )
    .unwrap();
    let orbit = if balance {
        let method = HarmonicBalance::new(
            Shooting::new(&parameter, &base.kernel, 1, 1e-10),
            &base.kernel,
            128,
            3e-8,
        )
        .unwrap();
        let position = Position {
            unknown: method.unknown_of(settled.start(), DRIVE_HZ).unwrap(),
            parameter: DRIVE_HZ,
        };
        let solution = correct_at(
            &method,
            &Corrector {
                goal: 1e-10,
                most: 20,
            },
            &Metric::at(&position, 1.0),
            position,
        )
        .unwrap();
        method.orbit(&solution.local, solution.error).unwrap()
    } else {
        settled
    };
    let shape = base.kernel.plant.system.modes.shape["mass"][0];
    let displacement = base.kernel.plant.to_physical(orbit.start(), 0.0)[0] * shape;
    (orbit, displacement + x_m)
}

#[test]
fn both_methods_find_the_orbit_of_the_other_frame() {
    let (amplitude_m, w) = (0.6e-3, TAU * DRIVE_HZ);
    let (k, c) = ((TAU * 6.0_f64).powi(2), 2.0 * 0.05 * TAU * 6.0);
    let (size, turn) = (amplitude_m * k.hypot(c * w), (c * w).atan2(k));
    let moving = file(
        "head",
        &format!(
            "kind = \"base-displacement\"\nat = \"head\"\namplitude = \"{amplitude_m:.17e} m\"\n"
        ),
    );
    let fixed = file(
        "ground",
        &format!("at = \"mass\"\namplitude = \"{size:.17e} N\"\nphase = \"{turn:.17} rad\"\n"),
    );
    let (fixed_orbit, fixed_m) = start_m(&fixed, 0.0, false);
    for balance in [false, true] {
        let (orbit, moving_m) = start_m(&moving, 0.0, balance);
        let error = (moving_m / fixed_m - 1.0).abs();
        let multiplier = (orbit.floquet_max_abs() / fixed_orbit.floquet_max_abs() - 1.0).abs();
        let allowed = 2.0 * (orbit.error_estimate + fixed_orbit.error_estimate).max(1e-10);
        eprintln!(
            "balance {balance}: {} contacts, apart by {error:.1e}, multipliers by {multiplier:.1e}, allowed {allowed:.1e}",
            orbit.contacts
        );
        assert!(
            orbit.contacts == 1
                && fixed_orbit.contacts == 1
                && error < allowed
                && multiplier < 1e-6,
            "{error:e} {multiplier:e}"
        );
    }
}
