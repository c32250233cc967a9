//! `examples/ball-umeda-1996`: Umeda, Nakamura and Uehara, Jpn. J. Appl. Phys. 35 (1996) 3267.

use crate::example::{integrator, kernel, motion, relative, run, system};
use crate::rows::check;
use jounce_analysis::run::StartState;
use jounce_model::contact::{Law, Rigid};
use jounce_model::reference::Impulse;

const EXAMPLE: &str = "ball-umeda-1996";
const DISC_KG: f64 = 0.4e-3;
const BALL_KG: f64 = 5.5e-3;
const FALL_M: f64 = 20e-3;
const G_M_S2: f64 = 9.81;
const CAPACITANCE_F: f64 = 10e-9;
const DISC_RAD_S: f64 = std::f64::consts::TAU * 4000.0;

/// Fraction of the energy of a blow that reaches the resistor, by integration.
fn load_fraction(impulse: &Impulse) -> f64 {
    let coupling = impulse.coupling_squared.sqrt() * DISC_RAD_S * CAPACITANCE_F.sqrt();
    let resistance = impulse.alpha / (DISC_RAD_S * CAPACITANCE_F);
    let settings = [
        (
            "modal.disc.damping_ratio",
            format!("[{}]", impulse.damping_ratio),
        ),
        (
            "modal.disc.patch.ceramic.coupling_n_per_v",
            format!("[{coupling}]"),
        ),
        ("circuit.load.resistance", format!("{resistance} ohm")),
        // Until the remainder is 1e-11 of the blow.
        (
            "run.duration",
            format!("{} s", 13.0 / (impulse.damping_ratio * DISC_RAD_S)),
        ),
        ("run.average_over", "1 ms".to_owned()),
    ];
    let settings: Vec<(&str, &str)> = settings
        .iter()
        .map(|(key, value)| (*key, value.as_str()))
        .collect();
    let (_, result) = run(EXAMPLE, "impulse.toml", &settings);
    assert!(
        relative(result.energies.input_j, 0.5 * DISC_KG * 0.25) < 1e-12,
        "{:?}",
        result.energies
    );
    result.energies.loads_j[0] / result.energies.input_j
}

fn impulse(damping_ratio: f64, coupling_squared: f64, alpha: f64) -> Impulse {
    Impulse {
        alpha,
        coupling_squared,
        damping_ratio,
    }
}

/// Measured: 2e-14.
#[test]
fn share_of_a_blow_is_the_closed_form() {
    for (damping_ratio, coupling_squared) in [(0.01, 0.1), (0.005, 0.02), (0.02, 0.3), (0.01, 0.05)]
    {
        for alpha in [0.1, 0.5, 1.0, 4.0] {
            let impulse = impulse(damping_ratio, coupling_squared, alpha);
            let error = relative(load_fraction(&impulse), impulse.efficiency());
            eprintln!("{impulse:?}: {error:.1e}");
            assert!(error < 1e-6, "{impulse:?}: {error:e}");
        }
    }
}

/// Load of the largest fraction, by the vertex of a parabola through three loads in geometric
/// spacing.
fn best_alpha(start: &Impulse) -> f64 {
    let step = 0.01_f64;
    let at = |k: f64| {
        load_fraction(&Impulse {
            alpha: start.best_alpha() * (k * step).exp(),
            ..*start
        })
    };
    let [low, middle, high] = [-1.0, 0.0, 1.0].map(at);
    assert!(low < middle && high < middle);
    start.best_alpha() * (0.5 * step * (low - high) / (low - 2.0 * middle + high)).exp()
}

/// The fraction increases with the quality factor and the coupling, and decreases where the ceramic
/// conducts.
#[test]
fn trends_of_the_efficiency() {
    let rising = |values: &[f64]| values.windows(2).all(|pair| pair[0] < pair[1]);
    assert!(rising(&[0.04, 0.02, 0.01, 0.005].map(|damping_ratio| {
        load_fraction(&impulse(damping_ratio, 0.05, 1.0))
    })));
    assert!(rising(&[0.01, 0.03, 0.1, 0.3].map(|coupling_squared| {
        load_fraction(&impulse(0.01, coupling_squared, 1.0))
    })));
    // A lossy dielectric is a resistor parallel to the load; the fraction is that of the pair.
    let load = 1.0;
    let with_leak = |leak: f64| {
        load_fraction(&impulse(0.01, 0.05, load * leak / (load + leak))) * leak / (load + leak)
    };
    let shares = [1.0, 10.0, 100.0, 1e6].map(with_leak);
    eprintln!("with a leak of 1, 10, 100, 1e6 times the load: {shares:?}");
    assert!(rising(&shares) && relative(shares[3], impulse(0.01, 0.05, load).efficiency()) < 1e-5);
}

/// A ball that does not bounce moves with the disc: momentum, energy, and the common velocity.
fn merge() -> [f64; 2] {
    let mut system = system(EXAMPLE, "harvester.toml", &[]);
    system.stops[0].law = Law::Rigid(Rigid { restitution: 0.0 });
    let kernel = kernel(system);
    let start = StartState::linear(&kernel.plant);
    let mut integrator = integrator(&kernel, &start.physical(), 1e-10);
    let sag_m = motion(&integrator, &kernel, "disc.centre")[0];
    let impact_s = (2.0 * (FALL_M - sag_m) / G_M_S2).sqrt();
    let (speed, load_fraction) = (G_M_S2 * impact_s, BALL_KG / (BALL_KG + DISC_KG));
    integrator.advance_to(impact_s * (1.0 - 1e-9)).unwrap();
    assert_eq!(integrator.statistics().contacts, 0);
    integrator.advance_to(impact_s * (1.0 + 1e-9)).unwrap();
    let [ball, disc] = ["ball", "disc.centre"].map(|point| motion(&integrator, &kernel, point)[1]);
    let statistics = integrator.statistics();
    let reduced_kg = load_fraction * DISC_KG;
    let errors = [
        relative(-ball, load_fraction * speed),
        relative(-disc, load_fraction * speed),
        relative(statistics.max_impact_velocity_m_s, speed),
        relative(statistics.impulse_n_s, reduced_kg * speed),
        relative(
            integrator.energies().contact_loss_j,
            0.5 * reduced_kg * speed * speed,
        ),
    ];
    eprintln!("merge: velocities, strike, impulse, loss {errors:?}");
    assert!(errors.iter().all(|error| *error < 1e-6), "{errors:?}");
    [-ball, integrator.energies().contact_loss_j]
}

#[test]
fn every_expected_row_is_met() {
    let start = impulse(0.01, 0.05, 1.0);
    let [common_m_s, loss_j] = merge();
    check(
        EXAMPLE,
        &[
            ("share_strong", load_fraction(&impulse(0.01, 0.1, 1.0))),
            ("share_weak", load_fraction(&impulse(0.005, 0.02, 0.5))),
            (
                "best_resistance_ohm",
                best_alpha(&start) / (DISC_RAD_S * CAPACITANCE_F),
            ),
            ("merge_velocity_m_s", common_m_s),
            ("merge_loss_j", loss_j),
            ("drop_share", drop_share()),
        ],
    );
}

/// Energy in the load over that of the fall, for all bounces in half a second; the balance must
/// close.
fn drop_share() -> f64 {
    let (_, result) = run(EXAMPLE, "harvester.toml", &[]);
    let residual = result.energies.residual_relative();
    eprintln!("residual {residual:.1e}, {} contacts", result.contacts);
    assert!(residual.abs() < 1e-8 && result.contacts > 3);
    result.energies.loads_j[0] / (BALL_KG * G_M_S2 * FALL_M)
}
