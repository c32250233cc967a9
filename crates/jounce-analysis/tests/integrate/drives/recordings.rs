//! Recordings as drives, against the exact recurrence and RK4.

use super::oscillator::{oscillator, pseudo_random, with_signal, with_stop};
use crate::plants::{integrate, kernel, physical};
use jounce_model::contact::{Hertz, Law};
use jounce_model::drive::Wave;

/// Exact recurrence for piecewise linear forces (N. Nigam, P. Jennings, Bull. Seism. Soc. Am. 59
/// (1969) 909). The coefficients come from the power series of the flow of `(w x, x', u, h u')`,
/// because their closed form loses digits on short steps.
fn nigam_jennings(w: f64, zeta: f64, h: f64, force: &[f64]) -> [f64; 2] {
    let rate = |y: [f64; 4]| {
        [
            w * h * y[1],
            h * (y[2] - w * y[0] - 2.0 * zeta * w * y[1]),
            y[3],
            0.0,
        ]
    };
    force.windows(2).fold([0.0; 2], |[x, v], p| {
        let start = [w * x, v, p[0], p[1] - p[0]];
        let (mut term, mut sum) = (start, start);
        for n in 1..40 {
            term = rate(term).map(|t| t / f64::from(n));
            sum = std::array::from_fn(|i| sum[i] + term[i]);
        }
        [sum[0] / w, sum[1]]
    })
}

/// 3000 samples; measured 4e-14 of the largest displacement and velocity.
#[test]
fn a_recording_moves_an_oscillator_by_the_exact_recurrence() {
    for (w, zeta, step_s) in [
        (60.0, 0.02, 1.0 / 3000.0),
        (2000.0, 0.3, 1.0 / 3000.0),
        (6.0, 0.001, 0.01),
    ] {
        let force = pseudo_random(3001);
        let [x, v] = nigam_jennings(w, zeta, step_s, &force);
        let wave = Wave::Sampled {
            start_s: 0.0,
            step_s,
            sizes: force.into(),
        };
        let kernel = kernel(with_signal(oscillator(w, zeta), wave));
        let integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 3000.0 * step_s, 1e-12);
        let state = physical(&integrator, &kernel);
        let size = x.abs().max(v.abs() / w);
        let errors = [
            (state[0] - x).abs() / size,
            (state[1] - v).abs() / (w * size),
        ];
        let residual = integrator.energies().residual_relative();
        eprintln!("w {w}: {errors:?}, energy {residual:.1e}");
        assert!(
            errors.iter().all(|e| *e < 1e-12) && residual.abs() < 1e-12,
            "w {w}: {errors:?} {residual:e}"
        );
    }
}

/// A recording drives an oscillator onto a Hertz stop: fourth-order Runge-Kutta with 5 us steps,
/// halved once for its error.
#[test]
fn a_recording_with_contacts_agrees_with_brute_force() {
    let (w, zeta, gap_m, stiffness, step_s) = (60.0, 0.02, 1e-3, 1e5, 1.0 / 500.0);
    let force: Vec<f64> = pseudo_random(501).iter().map(|x| 4.0 * x).collect();
    let brute = |lines: usize| {
        let h = step_s / lines as f64;
        let pull = |x: f64| stiffness * (x - gap_m).max(0.0).powf(1.5);
        let rate = |[x, v]: [f64; 2], f: f64| [v, f - 2.0 * zeta * w * v - w * w * x - pull(x)];
        let mut y = [0.0; 2];
        for pair in force.windows(2) {
            for k in 0..lines {
                let at = |x: f64| pair[0] + (pair[1] - pair[0]) * (k as f64 + x) / lines as f64;
                let ahead = |y: [f64; 2], d: [f64; 2], s: f64| [y[0] + s * d[0], y[1] + s * d[1]];
                let a = rate(y, at(0.0));
                let b = rate(ahead(y, a, 0.5 * h), at(0.5));
                let c = rate(ahead(y, b, 0.5 * h), at(0.5));
                let d = rate(ahead(y, c, h), at(1.0));
                y = std::array::from_fn(|i| {
                    y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i])
                });
            }
        }
        y
    };
    let (coarse, fine) = (brute(400), brute(800));
    let system = with_signal(
        oscillator(w, zeta),
        Wave::Sampled {
            start_s: 0.0,
            step_s,
            sizes: force.clone().into(),
        },
    );
    let kernel = kernel(with_stop(
        system,
        gap_m,
        Law::Hertz(Hertz {
            stiffness,
            exponent: 1.5,
        }),
    ));
    let integrator = integrate(&kernel, &[0.0, 0.0], 0.0, 1.0, 1e-11);
    let state = physical(&integrator, &kernel);
    let size = fine[0].hypot(fine[1] / w);
    let off = |a: &[f64], b: &[f64]| (a[0] - b[0]).hypot((a[1] - b[1]) / w) / size;
    let (reference_error, error) = (off(&coarse, &fine), off(&state, &fine));
    eprintln!(
        "{} contacts: {error:.1e}, brute force by itself {reference_error:.1e}",
        integrator.statistics().contacts
    );
    assert!(
        integrator.statistics().contacts > 5 && reference_error < 1e-7 && error < 1e-7,
        "{error:e} {reference_error:e}"
    );
}
