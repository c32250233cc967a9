//! Masses with an initial velocity.

use jounce_analysis::Model;
use jounce_analysis::run::{RunPlan, simulate};
use jounce_spec::Spec;
use std::f64::consts::TAU;
use std::path::Path;

fn run(text: &str) -> (Model, jounce_analysis::run::RunResult) {
    let prepared = Model::new(Spec::from_toml(text).unwrap()).unwrap();
    let start = prepared.start(Path::new(".")).unwrap();
    let result = simulate(
        &prepared.kernel,
        &start,
        &RunPlan::of(&prepared.spec.run, 0.0),
    )
    .unwrap();
    (prepared, result)
}

fn speed_m_s(prepared: &Model, result: &jounce_analysis::run::RunResult, body: &str) -> f64 {
    prepared.kernel.plant.system.modes.shape[body]
        .iter()
        .zip(&result.end.velocity)
        .map(|(shape, q)| shape * q)
        .sum()
}

/// Newton's law of restitution: `v1' = v (m1 - e m2) / M`, `v2' = v (1 + e) m1 / M`. Measured:
/// exact to the last digit, 1e-15.
#[test]
fn a_thrown_mass_strikes_another() {
    let (prepared, result) = run(
        "[mass.a]\non = \"nothing\"\nmass = \"1 g\"\nvelocity = \"2 m/s\"\n[mass.b]\non = \"nothing\"\nmass = \"3 g\"\n\
         [stop.s]\nat = \"a\"\nframe = \"b\"\nlaw = \"rigid\"\nrestitution = 0.6\ngap = \"1 mm\"\n\
         [run]\nduration = \"20 ms\"\naverage_over = \"20 ms\"\n",
    );
    let (a, b) = (
        speed_m_s(&prepared, &result, "a"),
        speed_m_s(&prepared, &result, "b"),
    );
    assert_eq!(result.contacts, 1);
    assert!(
        (a - 2.0 * (1.0 - 0.6 * 3.0) / 4.0).abs() < 1e-12 && (b - 2.0 * 1.6 / 4.0).abs() < 1e-12,
        "{a} {b}"
    );
    assert!((result.stops[0].max_impact_velocity_m_s - 2.0).abs() < 1e-12);
}

/// `v(t) = v cos w t` without damping, after 7.3 cycles, for a mass that carries another one.
/// Measured 1e-13.
#[test]
fn a_thrown_mass_swings_on_its_spring() {
    let (prepared, result) = run(
        "[mass.a]\nmass = \"3 g\"\nstiffness = \"40 N/m\"\ndamping_ratio = 0\nvelocity = \"0.5 m/s\"\n[mass.top]\non = \"a\"\nmass = \"1 g\"\n\
         [run]\nduration = \"0.4586725274 s\"\naverage_over = \"0.1 s\"\n",
    );
    let w = (40.0_f64 / 4e-3).sqrt();
    assert!((w * prepared.spec.run.duration_s / TAU - 7.3).abs() < 1e-3);
    let exact = 0.5 * (w * prepared.spec.run.duration_s).cos();
    for body in ["a", "top"] {
        let speed = speed_m_s(&prepared, &result, body);
        assert!((speed - exact).abs() < 1e-10, "{body}: {speed} {exact}");
    }
}
