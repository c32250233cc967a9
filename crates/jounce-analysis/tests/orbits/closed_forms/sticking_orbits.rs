//! A ball on a shaken table: sticking to a rigid stop is an attractor, unless the table throws the
//! ball.

use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_analysis::{
    Basins, BasinsResult, BranchKind, BranchSearch, Cloud, InitialStates, Model, OrbitMethodKind,
    Parameter, Recognition,
};
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes;
use jounce_orbits::ParametricModel;
use jounce_spec::{Spec, SpecFile};

const TABLE: &str = r#"
[mass.ball]
on = "nothing"
mass = "10 g"
[stop.table]
at = "ball"
side = "negative"
gap = "1 mm"
law = "rigid"
restitution = 0.5
[gravity]
acceleration = "-1 g"
[drive.base]
kind = "base-acceleration"
amplitude = "0.5 g"
frequency = "20 Hz"
"#;

/// A disc of 20 g in its first mode, with a patch, under a ball of 10 g.
const DISC: &str = r#"
[modal.disc]
frequency_hz = [400.0]
damping_ratio = [0.02]
participation_sqrt_kg = [0.12]
[modal.disc.point]
centre = [7.0710678118654755]
[modal.disc.patch.p]
coupling_n_per_v = [2e-2]
capacitance = "10 nF"
[circuit.load]
patch = "disc.p"
resistance = "50 kohm"
[mass.ball]
on = "nothing"
mass = "10 g"
[stop.table]
at = "ball"
frame = "disc.centre"
side = "negative"
gap = "1 mm"
law = "rigid"
restitution = 0.3
[gravity]
acceleration = "-1 g"
[drive.base]
kind = "base-acceleration"
amplitude = "0.3 g"
frequency = "60 Hz"
"#;

fn basins(text: &str, amplitude: &str, starts: usize) -> BasinsResult {
    let mut file = SpecFile::from_text(text);
    file.set("drive.base.amplitude", amplitude).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let starts = InitialStates::Cloud(Cloud {
        starts,
        seed: 1,
        spread: 10.0,
    });
    Basins {
        base: &base,
        starts,
        recognition: Recognition::at(1e-8),
    }
    .run()
    .unwrap()
}

/// The ball leaves the table where the table falls faster, `a sin(w t) > g`, and so never below 1
/// g.
#[test]
fn below_one_g_every_start_comes_to_rest_and_above_none_stays_there() {
    for amplitude in ["0.1 g", "0.5 g", "0.99 g"] {
        let result = basins(TABLE, amplitude, 6);
        let [rest] = &result.attractors[..] else {
            panic!("{amplitude}: {result:?}")
        };
        assert!(
            result.lost.is_empty() && rest.starts.len() == 6,
            "{amplitude}: {result:?}"
        );
        assert_eq!(
            (
                rest.id.as_str(),
                rest.period_cycles,
                rest.contacts_per_period,
                rest.mean_power_w
            ),
            ("1a", 1, 0, 0.0)
        );
        let orbit = rest.orbit().unwrap();
        eprintln!("{amplitude}: closes to {:e}", orbit.error_estimate);
        assert!(orbit.is_stable() && orbit.multipliers.is_empty() && orbit.error_estimate < 1e-8);
    }
    let result = basins(TABLE, "1.01 g", 6);
    assert!(
        result.lost.is_empty()
            && result
                .attractors
                .iter()
                .all(|orbit| orbit.period_cycles > 0 && orbit.contacts_per_period > 0),
        "{result:?}"
    );
}

/// A ball that sticks to a disc forms one body with it, again with one mode. Its power is that of
/// the frequency response of a disc with the added mass of the ball. Measured: 6e-12.
#[test]
fn a_ball_at_rest_loads_its_disc_by_its_mass() {
    let result = basins(DISC, "0.3 g", 4);
    let [rest] = &result.attractors[..] else {
        panic!("{result:?}")
    };
    assert!(
        result.lost.is_empty() && rest.period_cycles == 1 && rest.contacts_per_period == 0,
        "{result:?}"
    );
    // (M + m) x'' + 2 zeta w M x' + M w^2 x = -(participation / shape + m) a
    let (shape, participation, ball_kg) = (50_f64.sqrt(), 0.12, 0.01);
    let disc_kg = 1.0 / (shape * shape);
    let heavier = (disc_kg + ball_kg) / disc_kg;
    let mut spec: Spec = SpecFile::from_text(DISC).spec().unwrap();
    let disc = spec.modal.get_mut("disc").unwrap();
    disc.frequency_hz[0] /= heavier.sqrt();
    disc.damping_ratio[0] /= heavier.sqrt();
    disc.participation_sqrt_kg[0] = (participation / shape + ball_kg) / (disc_kg + ball_kg).sqrt();
    disc.point.get_mut("centre").unwrap()[0] /= heavier.sqrt();
    disc.patch.get_mut("p").unwrap().coupling_n_per_v[0] /= heavier.sqrt();
    (spec.mass, spec.stop, spec.drive) = Default::default();
    let plant = Plant::new(System::assemble(&spec, modes(&spec).unwrap()).unwrap()).unwrap();
    let voltage = frf(
        &plant,
        &FrfInput::BaseAcceleration,
        &[FrfOutput::LoadVoltage("load".into())],
        &[60.0],
    )
    .unwrap()[0]
        .value[0]
        .norm();
    let exact_w = 0.5 * (voltage * 0.3 * 9.80665).powi(2) / 5e4;
    let error = rest.mean_power_w / exact_w - 1.0;
    eprintln!(
        "{:e} W, {exact_w:e} W exactly: {error:e}",
        rest.mean_power_w
    );
    assert!(error.abs() < 1e-9);
}

/// A branch ends where impacts become an infinite sequence: runs on one side of the end stick to
/// the wall in every cycle, those on the other never.
#[test]
fn a_branch_ends_where_a_point_begins_to_stick() {
    let mut file = SpecFile::from_text(include_str!(
        "../../../../../examples/bouncing-and-impact-oscillators/impact.toml"
    ));
    // 0.6 rad/s.
    file.set("drive.force.frequency", "\"0.09549296585513721 Hz\"")
        .unwrap();
    file.set("stop.wall.restitution", "0.02").unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("stop.wall.gap").unwrap();
    let (range, method, tolerance) = ((0.84, 0.86), OrbitMethodKind::Shooting, 1e-10);
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds: 6,
        longest_period: 1,
    };
    let branches_found = search.run().unwrap();
    let labels = branches_found
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|label| label.kind == BranchKind::Sticking);
    let [label] = labels.collect::<Vec<_>>()[..] else {
        panic!("{branches_found:?}")
    };
    assert_eq!(label.stop.as_deref(), Some("wall"));
    eprintln!("{} m", label.at.parameter);
    let duty = |gap_m: f64| {
        let kernel = parameter.at(gap_m).unwrap().kernel;
        let plan = RunPlan {
            duration_s: 2000.0,
            average_over_s: 1000.0,
            tolerance,
            record_s: 0.0,
        };
        simulate(&kernel, &StartState::rest(&kernel.plant), &plan)
            .unwrap()
            .stops[0]
            .contact_duty
    };
    assert_eq!(duty(label.at.parameter + 1e-4), 0.0);
    assert!(duty(label.at.parameter - 1e-4) > 1e-4);
}
