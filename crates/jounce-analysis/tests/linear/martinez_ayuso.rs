//! `examples/porous-patch-martinez-ayuso`: constants of its patch from those of the dense ceramic,
//! and the results of its paper on the load and off-resonance drive, for our dimensions.

use crate::expected::{check, plant, spec};
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_dynamics::Kernel;
use jounce_model::contact::Law;
use jounce_model::linear::steady_power_w;
use jounce_model::plant::Plant;
use jounce_spec::material::Ceramic;
use jounce_spec::material::porous::{PZT_5A, PoreGeometry, PorosityScheme};
use std::f64::consts::TAU;

const EXAMPLE: &str = "porous-patch-martinez-ayuso";

/// Name and value of a row of `expected.toml`.
type Row = (&'static str, f64);

#[test]
fn every_expected_row_is_met() {
    let spec = spec(EXAMPLE, &[]);
    let patch = &spec.patch["porous"];
    let in_spec = [
        ("modulus_in_spec_gpa", patch.youngs_modulus_pa / 1e9),
        (
            "permittivity_in_spec_nf_m",
            patch.permittivity_f_m.unwrap() * 1e9,
        ),
    ];
    check(
        EXAMPLE,
        &[&rows_of_materials()[..], &rows_of_runs(), &in_spec].concat(),
    );
    let porous = porous_ceramic();
    assert!(
        (patch.permittivity_f_m.unwrap() / porous.clamped_permittivity_f_m() - 1.0).abs() < 1e-3
    );
    assert!((patch.d31_m_per_v.unwrap() / porous.d31_m_per_v - 1.0).abs() < 1e-3);
}

/// The ceramic of the patch, 30 % porous.
fn porous_ceramic() -> Ceramic {
    PZT_5A
        .porous(
            0.3,
            PoreGeometry::Spheroids(1.0),
            PorosityScheme::MoriTanaka,
        )
        .unwrap()
        .ceramic()
}

/// Constants of porous ceramics.
fn rows_of_materials() -> [Row; 9] {
    let half = PZT_5A
        .porous(
            0.5,
            PoreGeometry::Spheroids(1.0),
            PorosityScheme::MoriTanaka,
        )
        .unwrap();
    let [half_d31, _, half_permittivity] = half.free();
    let porous = porous_ceramic();
    let cylinders = PZT_5A
        .porous(0.3, PoreGeometry::Cylinders, PorosityScheme::MoriTanaka)
        .unwrap()
        .ceramic();
    [
        ("youngs_modulus_gpa", porous.youngs_modulus_pa() / 1e9),
        ("d31_pc_per_n", porous.d31_m_per_v * 1e12),
        (
            "relative_permittivity_at_constant_stress",
            porous.relative_permittivity,
        ),
        (
            "cylinder_d31_over_dense",
            cylinders.d31_m_per_v / PZT_5A.ceramic().d31_m_per_v,
        ),
        (
            "half_porous_youngs_modulus_gpa",
            half.ceramic().youngs_modulus_pa() / 1e9,
        ),
        ("half_porous_d31_pc_per_n", half_d31 * 1e12),
        (
            "half_porous_relative_permittivity",
            half_permittivity / PERMITTIVITY_OF_VACUUM_F_M,
        ),
        (
            "self_consistent_youngs_modulus_gpa",
            modulus_gpa(
                0.3,
                PoreGeometry::Spheroids(1.0),
                PorosityScheme::SelfConsistent,
            ),
        ),
        (
            "cylinders_youngs_modulus_gpa",
            modulus_gpa(0.3, PoreGeometry::Cylinders, PorosityScheme::MoriTanaka),
        ),
    ]
}

/// Powers and impacts of runs over the load, and the gain by the stop over the frequency.
fn rows_of_runs() -> [Row; 9] {
    let load = |resistance| run_to_steady_state(&[("circuit.load.resistance", resistance)]);
    let (small, best, large) = (load("1 kohm"), load("600 kohm"), load("1 Mohm"));
    let ratio_to_unstopped = |frequency| {
        let settings = [("drive.shaker.frequency", frequency)];
        run_to_steady_state(&settings).mean_power_w
            / steady_power_w(&plant(
                EXAMPLE,
                &[&settings[..], &[("stop.tip.gap", "1 m")]].concat(),
            ))
    };
    [
        ("power_at_1_kohm_uw", small.mean_power_w * 1e6),
        ("power_at_600_kohm_uw", best.mean_power_w * 1e6),
        ("power_at_1_mohm_uw", large.mean_power_w * 1e6),
        (
            "strike_at_1_mohm_over_1_kohm",
            large.stops[0].mean_impact_velocity_m_s / small.stops[0].mean_impact_velocity_m_s,
        ),
        ("stop_gain_at_20_hz", ratio_to_unstopped("20 Hz")),
        ("stop_gain_at_25_hz", ratio_to_unstopped("25 Hz")),
        ("stop_gain_at_28_hz", ratio_to_unstopped("28 Hz")),
        ("stop_gain_at_30_hz", ratio_to_unstopped("30 Hz")),
        ("stop_gain_at_32_hz", ratio_to_unstopped("32 Hz")),
    ]
}

/// Permittivity of vacuum, F/m.
const PERMITTIVITY_OF_VACUUM_F_M: f64 = 8.854_187_812_8e-12;

fn modulus_gpa(porosity: f64, pores: PoreGeometry, scheme: PorosityScheme) -> f64 {
    PZT_5A
        .porous(porosity, pores, scheme)
        .unwrap()
        .ceramic()
        .youngs_modulus_pa()
        / 1e9
}

fn kernel(settings: &[(&str, &str)]) -> Kernel {
    Kernel::new(plant(EXAMPLE, settings)).unwrap()
}

/// Run as in the spec: 20 s from rest, mean over the last 10.
fn run_to_steady_state(settings: &[(&str, &str)]) -> RunResult {
    let run = spec(EXAMPLE, settings).run;
    let kernel = kernel(settings);
    simulate(
        &kernel,
        &StartState::rest(&kernel.plant),
        &RunPlan::of(&run, run.duration_s),
    )
    .unwrap()
}

/// Mean power over the last second of two from rest, by the Runge-Kutta method on the equations
/// `q'' + 2 zeta w q' + w^2 q - theta V = phi (F - N(phi q - g))`, `C V' + theta q' = -V / R`, with
/// 20 000 steps a second.
fn plain_power_w(plant: &Plant) -> f64 {
    let (modes, drive, stop) = (
        &plant.system.modes,
        &plant.system.drives[0],
        &plant.system.stops[0],
    );
    let (patch, n) = (&modes.patch["porous"], modes.len());
    let Law::Hertz(law) = &stop.law else {
        panic!("a Hertz stop")
    };
    let resistance_ohm = plant.system.loads[0].resistance_ohm;
    let push_n = |deep_m: f64| law.stiffness * deep_m.max(0.0).powf(law.exponent);
    let rates = |t: f64, x: &[f64]| -> Vec<f64> {
        let tip_m: f64 = stop.shape.iter().zip(x).map(|(shape, q)| shape * q).sum();
        let contact_n = push_n(tip_m - stop.gap_m);
        let shaker_n = drive.amplitude_n * (TAU * drive.frequency_hz * t + drive.phase_rad).sin();
        let mut rates = x[n..2 * n].to_vec();
        let mut current_a = -x[2 * n] / resistance_ohm;
        for k in 0..n {
            let (w, theta) = (modes.frequency_rad_s[k], patch.coupling_n_per_v[k]);
            let elastic = w * w * x[k] + 2.0 * modes.damping_ratio[k] * w * x[n + k];
            rates.push(
                theta * x[2 * n] - elastic + drive.shape[k] * shaker_n - stop.shape[k] * contact_n,
            );
            current_a -= theta * x[n + k];
        }
        rates.push(current_a / patch.capacitance_f);
        rates
    };
    let (mut x, h, mut energy_j) = (vec![0.0; 2 * n + 1], 5e-5, 0.0);
    let power_w = |x: &[f64]| x[2 * n].powi(2) / resistance_ohm;
    for step in 0..40_000 {
        let t = f64::from(step) * h;
        let add =
            |k: &[f64], f: f64| -> Vec<f64> { x.iter().zip(k).map(|(x, k)| x + f * k).collect() };
        let a = rates(t, &x);
        let b = rates(t + 0.5 * h, &add(&a, 0.5 * h));
        let c = rates(t + 0.5 * h, &add(&b, 0.5 * h));
        let d = rates(t + h, &add(&c, h));
        let next: Vec<f64> = (0..x.len())
            .map(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
            .collect();
        if step >= 20_000 {
            energy_j += 0.5 * h * (power_w(&x) + power_w(&next));
        }
        x = next;
    }
    energy_j
}

/// At the rows of the example on load and frequency: integration against Runge-Kutta. Measured:
/// 1.4e-7.
#[test]
fn powers_with_the_stop_are_those_of_a_plain_integrator() {
    for settings in [
        [
            ("circuit.load.resistance", "10 kohm"),
            ("drive.shaker.frequency", "20 Hz"),
        ],
        [
            ("circuit.load.resistance", "1 Mohm"),
            ("drive.shaker.frequency", "20 Hz"),
        ],
        [
            ("circuit.load.resistance", "100 kohm"),
            ("drive.shaker.frequency", "28 Hz"),
        ],
        [
            ("circuit.load.resistance", "100 kohm"),
            ("drive.shaker.frequency", "32 Hz"),
        ],
    ] {
        let kernel = kernel(&settings);
        let plan = RunPlan {
            duration_s: 2.0,
            average_over_s: 1.0,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        let plain_w = plain_power_w(&kernel.plant);
        let error = result.mean_power_w / plain_w - 1.0;
        eprintln!(
            "{settings:?}: {:e} W against {plain_w:e}: {error:.1e}, {} contacts",
            result.mean_power_w, result.contacts
        );
        assert!(
            error.abs() < 1e-5 && result.contacts > 10,
            "{settings:?}: {error:e}"
        );
    }
}
