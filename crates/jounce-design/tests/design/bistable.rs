//! The bistable harvester of HarvesterOpt in its boxes of two and of four variables.
//!
//! ```text
//! x'' + 2 xi x' - x (1 - x^2) / 2 - chi v = f cos(W t),   v' + lambda v + kappa x' = 0
//! ```
//!
//! is a mode of 1 kg and 1 rad/s with a cubic law, `-1.5 N/m` and `0.5 N/m^3`, on both sides of it,
//! the coupling `chi`, the capacitance `chi / kappa` and the resistance `kappa / (lambda chi)`. The
//! power `lambda v^2` of the source is the electric one times `kappa / chi`.
//!
//! A voltage of `kappa / sqrt(chi kappa)` units has the coupling `sqrt(chi kappa)`, the capacitance
//! 1 F and the resistance `1 / lambda`: the four variables are three keys. In the source's box a
//! product `chi kappa` of at least 0.075 has the largest `kappa / chi` with `kappa = 1.5`.
//!
//! Source: A. Cunha, arXiv:2105.13459; the numbers of evaluations are those of its published runs.

use super::outcome_of;
use jounce_analysis::{Basins, Cloud, InitialStates, Model, Recognition};
use jounce_design::DesignOutcome;
use jounce_spec::Spec;
use std::f64::consts::TAU;

/// Returns the spec with a coupling, a capacitance and a load, under a force at an angular
/// frequency.
fn spec(xi: f64, [coupling, capacitance_f, load_ohm]: [f64; 3], [force_n, w]: [f64; 2]) -> String {
    let drive_hz = w / TAU;
    format!(
        "[modal.m]\nfrequency_hz = [0.15915494309189535]\ndamping_ratio = [{xi:?}]\n[modal.m.point]\ntip = [1.0]\n\
        [modal.m.patch.p]\ncoupling_n_per_v = [{coupling:?}]\ncapacitance = \"{capacitance_f:?} F\"\n\
        [stop.well]\nat = \"m.tip\"\nlaw = \"cubic\"\ngap = \"0 m\"\nstiffness = \"-1.5 N/m\"\ncubic_stiffness = \"0.5 N/m^3\"\n\
        [circuit.load]\npatch = \"m.p\"\nresistance = \"{load_ohm:?} ohm\"\n\
        [drive.d]\nat = \"m.tip\"\nkind = \"force\"\namplitude = \"{force_n:?} N\"\nfrequency = \"{drive_hz:?} Hz\"\n\
        [run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n"
    )
}

/// `kappa / chi` in the box of two variables.
const POWER_SCALE: f64 = 10.0;

/// Returns the spec of the published optimum, 0.0172 at 0.0999 and 0.7786, and the box of two
/// variables.
pub fn two_variables_spec() -> (String, String) {
    let spec = spec(0.01, [0.05, 0.1, 200.0], [0.0999, 0.7786]);
    let [low_hz, high_hz] = [0.75, 0.85].map(|w| w / TAU);
    let free = format!(
        "[free]\n\"drive.d.amplitude\" = \"0.08N:0.10N\"\n\"drive.d.frequency\" = \"{low_hz}Hz:{high_hz}Hz\"\n"
    );
    (spec, free)
}

/// Designs in the box of two variables.
fn two_variables(goal: &str, evaluations: usize) -> DesignOutcome {
    let (spec, free) = two_variables_spec();
    let goal = format!("[goal]\nmaximise = \"{goal}\"\nstarts = 40\n");
    outcome_of(&spec, &format!("evaluations = {evaluations}\n{free}{goal}"))
}

/// The shortest published search takes 475 evaluations to 0.0171.
#[test]
fn the_best_orbit_has_more_power_than_the_published_optimum() {
    let found = two_variables("stable-power", 47);
    let power = POWER_SCALE * found.best.mean_power_w;
    assert!(found.best.stable && power > 0.0172, "{power} {found:?}");
}

/// Over the same starts, the published optimum has less expected power. The search of the source with
/// the most samples takes 2800 evaluations.
#[test]
#[ignore = "long: runs with ./test --long"]
fn the_best_expected_power_is_above_that_of_the_published_optimum() {
    let found = two_variables("expected-power", 280);
    let [power, published] = [found.best.expected_power_w, found.before.expected_power_w];
    assert!(power > 1.05 * published, "{power} {published} {found:?}");
}

/// Evaluations of the box of four variables: a tenth of the 2075 of the published search that found
/// 0.1619.
const FOUR_EVALUATIONS: usize = 207;

/// Largest `kappa`, and the smallest product `chi kappa` that has it.
const KAPPA: f64 = 1.5;
const SMALLEST_PRODUCT: f64 = 0.075;

/// Returns the number of a key of a design.
fn number(found: &DesignOutcome, key: &str) -> f64 {
    let text = &found.best.set[key];
    text.split(' ').next().unwrap().parse().unwrap()
}

/// The variables of the source at a design of the three keys.
fn variables(found: &DesignOutcome) -> Bistable {
    let product = number(found, "modal.m.patch.p.coupling_n_per_v.1").powi(2);
    assert!(product >= SMALLEST_PRODUCT);
    Bistable {
        xi: number(found, "modal.m.damping_ratio.1"),
        chi: product / KAPPA,
        lambda: 1.0 / number(found, "circuit.load.resistance"),
        kappa: KAPPA,
    }
}

#[derive(Debug)]
struct Bistable {
    xi: f64,
    chi: f64,
    lambda: f64,
    kappa: f64,
}

impl Bistable {
    /// Returns the mean of `lambda v^2` over the second half of a run of the source's length, by the
    /// classical Runge-Kutta method with 100 steps a cycle.
    fn power(&self, [force, w]: [f64; 2], [x, velocity]: [f64; 2]) -> f64 {
        const STEPS: usize = 100;
        let h = TAU / w / STEPS as f64;
        let slope = |drive: f64, [x, u, v]: [f64; 3]| {
            let spring = 0.5 * x * (1.0 - x * x);
            let acceleration = spring - 2.0 * self.xi * u + self.chi * v + force * drive;
            [u, acceleration, -self.lambda * v - self.kappa * u]
        };
        let along = |y: [f64; 3], step: f64, k: [f64; 3]| [0, 1, 2].map(|i| y[i] + step * k[i]);
        let cosines: Vec<f64> = (0..2 * STEPS)
            .map(|half| (0.5 * h * w * half as f64).cos())
            .collect();
        let drive = |half: usize| cosines[half % (2 * STEPS)];
        let (mut y, mut sum) = ([x, velocity, 0.0], 0.0);
        let steps = (2500.0 / h) as usize;
        for step in 0..steps {
            let half = 2 * step;
            let a = slope(drive(half), y);
            let b = slope(drive(half + 1), along(y, 0.5 * h, a));
            let c = slope(drive(half + 1), along(y, 0.5 * h, b));
            let d = slope(drive(half + 2), along(y, h, c));
            y = [0, 1, 2].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
            if step >= steps / 2 {
                sum += self.lambda * y[2] * y[2];
            }
        }
        sum / (steps - steps / 2) as f64
    }
}

/// Designs of the three keys.
fn four_variables(goal: &str, force_n: f64, coupling: &str, given: [f64; 3]) -> DesignOutcome {
    let [xi, coupling_n_per_v, load_ohm] = given;
    let spec = spec(xi, [coupling_n_per_v, 1.0, load_ohm], [force_n, 0.8]);
    let text = format!(
        "evaluations = {FOUR_EVALUATIONS}\n[free]\n\"modal.m.damping_ratio.1\" = \"0.01:0.05\"\n\
         \"modal.m.patch.p.coupling_n_per_v.1\" = \"{coupling}\"\n\"circuit.load.resistance\" = \"5ohm:20ohm\"\n\
         [goal]\nmaximise = \"{goal}\"\nstarts = 40\n"
    );
    outcome_of(&spec, &text)
}

/// `sqrt(chi kappa)` from the smallest product with the largest `kappa` to the largest product.
const COUPLINGS: &str = "0.27386127875258304:0.5477225575051661";

/// The published optima are 0.1619 (cross-entropy, force 0.115) and 0.1365 (65,536 points of a grid,
/// force 0.083), each from one start. The electric power has its largest value at another place of
/// the box than `lambda v^2`; the orbits found have more than the published power in that measure too
/// (0.453 and 0.207), and the Runge-Kutta method reaches them from one of 441 starts.
#[test]
fn four_variables_have_an_orbit_with_more_than_the_published_power() {
    for (force, published) in [(0.115, 0.1619), (0.083, 0.1365)] {
        let found = four_variables("stable-power", force, COUPLINGS, [0.02, 0.4, 10.0]);
        let variables = variables(&found);
        let power = found.best.mean_power_w * variables.kappa / variables.chi;
        assert!(
            found.best.stable && power > 1.25 * published,
            "{power} {variables:?} {found:?}"
        );
        let starts = (0..441).map(|k| {
            let (row, column) = (f64::from(k / 21), f64::from(k % 21));
            [-2.0 + 0.2 * row, -1.5 + 0.15 * column]
        });
        let mut powers = starts.map(|start| variables.power([force, 0.8], start));
        let near = powers.find(|other| (other / power - 1.0).abs() < 1e-3);
        eprintln!("{power} and {near:?} at {variables:?}, published {published}");
        assert!(near.is_some(), "{power} {variables:?}");
        assert!(found.evaluations <= FOUR_EVALUATIONS);
    }
}

/// Expected electric power of the published optimum at a force of 0.115, each start integrated until
/// its attractor is proved.
fn published_expected_w() -> f64 {
    let (coupling, load_ohm) = ((0.1062 * 1.4924_f64).sqrt(), 1.0 / 0.1955);
    let text = spec(0.0227, [coupling, 1.0, load_ohm], [0.115, 0.8]);
    let study = Basins {
        base: &Model::new(Spec::from_toml(&text).unwrap()).unwrap(),
        starts: InitialStates::Cloud(Cloud {
            starts: 40,
            seed: 1,
            spread: 10.0,
        }),
        recognition: Recognition::at(1e-8),
    };
    study.run().unwrap().expected_power_w
}

/// At the smallest coupling with the largest `kappa`, `lambda v^2` is proportional to the electric
/// power, and the best values of the other two variables have more expected power over the same
/// starts.
#[test]
fn four_variables_have_more_expected_power_than_the_published_optimum() {
    let smallest = SMALLEST_PRODUCT.sqrt();
    let range = format!("{smallest}:{}", 1.0001 * smallest);
    let found = four_variables("expected-power", 0.115, &range, [0.02, smallest, 10.0]);
    let variables = variables(&found);
    let power = found.best.expected_power_w * variables.kappa / variables.chi;
    let published = published_expected_w() * 1.4924 / 0.1062;
    eprintln!("expected {power}, published {published}");
    assert!(power > 1.5 * published, "{power} {published}");
}
