//! Harmonic balance with several stops, under gravity and with an open patch: against shooting,
//! mirror images and shifted stops.

use super::{norm, parameter_change_error, refined, state_difference};
use crate::harvesters::{bench, branches};
use jounce_analysis::{AnalysisError, Model, OrbitMethodKind, Parameter, settled_orbit};
use jounce_continuation::{Linearization, Problem};
use jounce_orbits::{HarmonicBalance, Orbit, OrbitError, OrbitMethod, Shooting};
use jounce_spec::SpecFile;

const FREQUENCY: &str = "drive.shaker.frequency";

/// The plant of the bench with more stops.
fn bench_with(stops: &str) -> SpecFile {
    SpecFile::from_text(format!(
        "{}\n{stops}",
        include_str!("../../../../../bench/plant.toml")
    ))
}

/// A stop at the tip with the contact law of the bench.
fn tip_stop(name: &str, side: &str, gap: &str, stiffness: &str) -> String {
    let stop_keys = format!("at = \"harvester.tip\"\nframe = \"ground\"\nside = \"{side}\"");
    format!(
        "[stop.{name}]\n{stop_keys}\nlaw = \"hertz\"\ngap = \"{gap}\"\nstiffness = \"{stiffness} N/m^1.5\"\n"
    )
}

/// The beam of the paper with a second stop, of another law, at mid-length.
fn stops_at_two_points() -> SpecFile {
    let text = include_str!("../../../../../examples/impact-harvester-2019/harvester.toml");
    let beam = text.replace(
        "hammer = \"15 mm\"",
        "hammer = \"15 mm\"\nmiddle = \"190 mm\"",
    );
    let stop = "\n[stop.middle]\nat = \"beam.middle\"\nframe = \"ground\"\nside = \"negative\"\nlaw = \"hunt-crossley\"\ngap = \"0.3 mm\"\n\
        stiffness = \"3000 N/m^1.5\"\ndamping = \"0.2 s/m\"\n";
    let mut file = SpecFile::from_text(format!("{beam}{stop}"));
    file.set("drive.shaker.amplitude", "\"50 N\"").unwrap();
    file
}

/// Orbit near a state, with as many harmonics as the accuracy needs.
fn orbit_by_balance(file: &SpecFile, start: &[f64], frequency_hz: f64) -> Orbit {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(FREQUENCY).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let method = HarmonicBalance::new(
        Shooting::new(&parameter, &base.kernel, 1, 1e-10),
        &base.kernel,
        64,
        3e-8,
    )
    .unwrap();
    let (method, solution) = refined(method, start, frequency_hz);
    method.orbit(&solution.local, solution.error).unwrap()
}

/// Orbit that a run from rest reaches.
fn orbit_by_integration(file: &SpecFile, frequency_hz: f64) -> Orbit {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(FREQUENCY).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    settled_orbit(
        &parameter,
        frequency_hz,
        &vec![0.0; base.kernel.plant.len()],
        1e-10,
        1e-10,
    )
    .unwrap()
}

/// Along the branch that shooting follows, stable or not, states and mean powers lie within the sum
/// of both estimates; returns the most contacts.
fn agrees_along(file: &SpecFile, range: (f64, f64), every: usize) -> u64 {
    let curve = &branches(file, range, OrbitMethodKind::Shooting, 0)[0];
    let (mut most, mut unstable) = (0, 0);
    for point in curve.points.iter().step_by(every) {
        let orbit = orbit_by_balance(file, point.orbit.start(), point.parameter);
        let power_error = (orbit.mean_power_w / point.orbit.mean_power_w - 1.0).abs();
        let state = state_difference(&orbit, &point.orbit) / orbit.size();
        let allowed = orbit.error_estimate + point.orbit.error_estimate;
        let (at, contacts) = (point.parameter, orbit.contacts);
        eprintln!(
            "{at:.6} Hz, {contacts} contacts: power apart by {power_error:.1e}, state by {state:.1e}, estimates {allowed:.1e}"
        );
        assert!(
            state < allowed && power_error < allowed && allowed < 3e-6,
            "{at} Hz: {state:e}, {power_error:e} > {allowed:e}"
        );
        assert_eq!(contacts, point.orbit.contacts);
        most = most.max(contacts);
        unstable += usize::from(!orbit.is_stable());
    }
    eprintln!("at most {most} contacts, {unstable} unstable orbits");
    most
}

#[test]
fn two_stops_about_the_tip_agree_with_shooting() {
    let file = bench_with(&tip_stop("behind", "negative", "1.5 mm", "2000"));
    assert!(agrees_along(&file, (11.0, 12.0), 6) >= 2);
}

#[test]
fn two_stops_at_two_places_of_the_beam_agree_with_shooting() {
    assert!(agrees_along(&stops_at_two_points(), (11.0, 12.5), 6) >= 2);
}

/// Mirrored, `x(t + T / 2) -> -x(t)`, the harvester with exchanged gaps and stiffnesses has equal
/// power.
#[test]
fn a_mirror_image_has_the_same_power() {
    let mirrored = |gap: &str, stiffness: &str, behind: &str, other: &str| {
        let mut file = bench_with(&tip_stop("behind", "negative", behind, other));
        file.set("stop.tip.gap", &format!("\"{gap}\"")).unwrap();
        file.set("stop.tip.stiffness", &format!("\"{stiffness} N/m^1.5\""))
            .unwrap();
        let orbit = orbit_by_integration(&file, 11.3);
        orbit_by_balance(&file, orbit.start(), 11.3)
    };
    let (one, two) = (
        mirrored("1 mm", "1000", "1.5 mm", "2000"),
        mirrored("1.5 mm", "2000", "1 mm", "1000"),
    );
    let (power, state) = (
        (one.mean_power_w / two.mean_power_w - 1.0).abs(),
        one.size(),
    );
    let state_error = state_difference(&one, &two) / state;
    eprintln!(
        "power apart by {power:.1e}, states at the same time by {state_error:.1e}, {} contacts",
        one.contacts
    );
    assert!(
        power < 1e-7 && one.contacts == two.contacts && one.contacts >= 2 && state_error > 1e-3
    );
}

/// Two stops of half the stiffness at one point are equivalent to one: both are in contact at the
/// same times.
#[test]
fn two_halves_of_a_stop_are_one_stop() {
    let single = orbit_by_integration(&bench(), 11.0);
    let one = orbit_by_balance(&bench(), single.start(), 11.0);
    let mut halves = bench_with(&tip_stop("other", "positive", "1 mm", "500"));
    halves.set("stop.tip.stiffness", "\"500 N/m^1.5\"").unwrap();
    let two = orbit_by_balance(&halves, single.start(), 11.0);
    let power_error = (one.mean_power_w / two.mean_power_w - 1.0).abs();
    let state = state_difference(&one, &two) / one.size();
    eprintln!("power apart by {power_error:.1e}, state by {state:.1e}");
    assert!(power_error < 1e-9 && state < 1e-9 && two.contacts == 2 * one.contacts);
}

/// Newton's system reproduces a difference of the residual, and its column the difference along the
/// parameter.
#[test]
fn the_derivative_over_two_stops_is_that_of_differences() {
    for mut file in [
        bench_with(&tip_stop("behind", "negative", "1.5 mm", "2000")),
        stops_at_two_points(),
    ] {
        file.set(FREQUENCY, "\"11.3 Hz\"").unwrap();
        let start = orbit_by_integration(&file, 11.3);
        let base = Model::new(file.spec().unwrap()).unwrap();
        for (name, value) in [(FREQUENCY, 11.3), ("drive.shaker.amplitude", 50.0)] {
            let key = file.numeric_key(name).unwrap();
            let parameter = Parameter::new(&base, &key, value);
            let method = HarmonicBalance::new(
                Shooting::new(&parameter, &base.kernel, 1, 1e-10),
                &base.kernel,
                64,
                1e-8,
            )
            .unwrap();
            let unknown = method.unknown_of(start.start(), value).unwrap();
            let (none, size) = (vec![0.0; unknown.len()], norm(&mut unknown.iter().copied()));
            let variation: Vec<f64> = (0..unknown.len())
                .map(|i| (1.7 * i as f64).sin() / (1.0 + i as f64 % 129.0).powi(2))
                .collect();
            let step = 1e-6 * size / norm(&mut variation.iter().copied());
            let residual = |side: f64| {
                let shifted: Vec<f64> = unknown
                    .iter()
                    .zip(&variation)
                    .map(|(u, d)| u + side * step * d)
                    .collect();
                method.at(&shifted, value).unwrap().residual().to_vec()
            };
            let change: Vec<f64> = residual(1.0)
                .iter()
                .zip(&residual(-1.0))
                .map(|(a, b)| (a - b) / (2.0 * step))
                .collect();
            let local = method.at(&unknown, value).unwrap();
            let (direction, _) = local.bordered(&none, 1.0, &change, 0.0).unwrap();
            let direction_error = norm(&mut direction.iter().zip(&variation).map(|(a, b)| a - b))
                / norm(&mut variation.iter().copied());
            let column = parameter_change_error(&method, &unknown, value);
            eprintln!(
                "{name}, {} nodes: direction off by {direction_error:.1e}, parameter by {column:.1e}",
                local.nodes()
            );
            assert!(
                local.nodes() > 60 && direction_error < 1e-5 && column < 1e-5,
                "{name}: {direction_error:e} {column:e}"
            );
        }
    }
}

/// A mass on a spring between two stops.
fn mass(gravity: &str, gaps_mm: [f64; 2]) -> SpecFile {
    let stop = |name: &str, side: &str, gap_mm: f64| {
        format!(
            "[stop.{name}]\nat = \"m\"\nframe = \"ground\"\nside = \"{side}\"\nlaw = \"hertz\"\ngap = \"{gap_mm} mm\"\nstiffness = \"4e4 N/m^1.5\"\n"
        )
    };
    SpecFile::from_text(format!(
        "[mass.m]\non = \"ground\"\nmass = \"100 g\"\nstiffness = \"1 kN/m\"\ndamping_ratio = 0.02\n{}{}{gravity}\
         [drive.shaker]\nkind = \"force\"\nat = \"m\"\namplitude = \"0.8 N\"\nfrequency = \"18 Hz\"\n",
        stop("above", "positive", gaps_mm[0]),
        stop("below", "negative", gaps_mm[1]),
    ))
}

/// A weight sags by `m g / k`. Relative to this position each stop has moved the other way, without
/// further change.
#[test]
fn gravity_moves_the_stops_by_the_sag() {
    let heavy = mass("[gravity]\nacceleration = \"-5 m/s^2\"\n", [1.0, 2.0]);
    let shifted = mass("", [1.5, 1.5]);
    let exact = orbit_by_integration(&shifted, 18.0);
    let one = orbit_by_balance(&shifted, exact.start(), 18.0);
    let by_shooting = orbit_by_integration(&heavy, 18.0);
    let two = orbit_by_balance(&heavy, by_shooting.start(), 18.0);
    // Energy coordinates: `w q` and `q'` of a mode of mass one.
    let sag = 1e4_f64.sqrt() * 0.1_f64.sqrt() * 0.5e-3;
    let (first_state, second_state, size) = (one.start(), two.start(), one.size());
    let errors = [
        (second_state[0] - (first_state[0] - sag)).abs() / size,
        (second_state[1] - first_state[1]).abs() / size,
    ];
    eprintln!(
        "place and speed apart by {errors:?}, {} contacts",
        one.contacts
    );
    assert!(errors[0] < 1e-8 && errors[1] < 1e-8 && one.contacts == 2 && two.contacts == 2);
}

/// The charge of an open patch, which is constant, does not contribute to the compliance of the
/// stop.
#[test]
fn an_open_patch_agrees_with_shooting() {
    let mut spec = bench();
    let text = spec.text().to_owned();
    let (before, after) = (
        text.find("[circuit.load]").unwrap(),
        text.find("[drive.shaker]").unwrap(),
    );
    let open = text[..before].replace("capacitance =", "electrodes = \"open\"\ncapacitance =");
    spec = SpecFile::from_text(format!("{open}{}", &text[after..]));
    let exact = orbit_by_integration(&spec, 11.0);
    let orbit = orbit_by_balance(&spec, exact.start(), 11.0);
    let state = state_difference(&orbit, &exact) / orbit.size();
    eprintln!(
        "state apart by {state:.1e}, estimates {:.1e}",
        orbit.error_estimate + exact.error_estimate
    );
    assert!(state < orbit.error_estimate + exact.error_estimate && orbit.contacts == 1);
}

/// Only gravity returns a ball to its table, so its static compliance is infinite.
#[test]
fn a_free_body_is_refused_with_the_other_method_named() {
    let ball = "[mass.ball]\non = \"nothing\"\nmass = \"1 g\"\n[stop.table]\nat = \"ball\"\nside = \"negative\"\nframe = \"ground\"\nlaw = \"spring\"\n\
        gap = \"0 mm\"\nstiffness = \"1 kN/m\"\n[gravity]\nacceleration = \"-1 g\"\n\
        [drive.shaker]\nkind = \"base-acceleration\"\namplitude = \"0.9 g\"\nfrequency = \"10 Hz\"\n[reduction]\nmodes = 1\n";
    let file = SpecFile::from_text(ball);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(FREQUENCY).unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let refused: OrbitError<AnalysisError> = HarmonicBalance::new(
        Shooting::new(&parameter, &base.kernel, 1, 1e-9),
        &base.kernel,
        64,
        1e-7,
    )
    .err()
    .unwrap();
    assert!(
        matches!(refused, OrbitError::Free) && refused.to_string().contains("shooting"),
        "{refused}"
    );
}
