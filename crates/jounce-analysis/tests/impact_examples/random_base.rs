//! `examples/random-base`: noise against the harvester with and without its stop, and a ball on its
//! beam.

use crate::example::{run, spec};
use crate::rows::check;
use jounce_analysis::{Ensemble, Model};
use jounce_model::linear::{Random, steady_power_w};
use std::path::Path;

const EXAMPLE: &str = "random-base";
/// Strong noise above the resonance, with the stop on the table.
const ABOVE: &[(&str, &str)] = &[
    ("drive.shaker.low", "12 Hz"),
    ("drive.shaker.psd", "1000 N^2/Hz"),
    ("stop.tip.frame", "table"),
];

/// Mean power without and with the stop, W: in closed form, and over four members of 12 s.
fn powers_w(file: &str, settings: &[(&str, &str)]) -> [f64; 2] {
    let short = [("run.duration", "12 s"), ("run.average_over", "10 s")];
    let base = Model::new(spec(EXAMPLE, file, &[settings, &short].concat())).unwrap();
    let start = base.start(Path::new("")).unwrap();
    let linear = Random::new(&base.spec).unwrap().response().unwrap();
    assert!(
        linear
            .loads
            .iter()
            .all(|load| load.difference_relative.abs() < 1e-10),
        "{:?}",
        linear.loads
    );
    let study = Ensemble {
        base: &base,
        start,
        members: 4,
        seed: 1,
        relative_width: None,
        most_rounds: 1,
        with_spectrum: false,
    };
    let result = study.run().unwrap();
    let residual = result.members.iter().fold(0.0_f64, |max, member| {
        max.max(member.energy_residual_relative.abs())
    });
    eprintln!(
        "{file}: {:.4e} W, stop {:.3e} +- {:.1e} W, energy {residual:.1e}",
        linear.mean_power_w, result.power_w.mean, result.power_w.half_width
    );
    assert!(residual < 1e-6 && result.contact_rate_hz.mean > 1.0);
    [linear.mean_power_w, result.power_w.mean]
}

#[test]
fn every_expected_row_is_met() {
    let [linear_w, stop_w] = powers_w("shaker.toml", &[]);
    let [linear_above_w, stop_above_w] = powers_w("shaker.toml", ABOVE);
    let [linear_floor_w, stop_floor_w] = powers_w("harvester.toml", &[]);
    let (kernel, ball) = run(EXAMPLE, "ball.toml", &[]);
    let no_ball_w = steady_power_w(&kernel.plant);
    assert!(ball.energies.residual_relative().abs() < 1e-6 && ball.contacts > 100);
    // Claims of the page: a stop reduces power at resonance and increases it above it and past a
    // soft spring; a ball increases it above resonance.
    assert!(
        stop_w < 0.5 * linear_w
            && stop_above_w > 10.0 * linear_above_w
            && stop_floor_w > 50.0 * linear_floor_w
    );
    assert!(ball.mean_power_w > 1.5 * no_ball_w);
    check(
        EXAMPLE,
        &[
            ("linear_w", linear_w),
            ("stop_w", stop_w),
            ("linear_above_w", linear_above_w),
            ("stop_above_w", stop_above_w),
            ("linear_floor_w", linear_floor_w),
            ("stop_floor_w", stop_floor_w),
            ("no_ball_w", no_ball_w),
            ("ball_w", ball.mean_power_w),
        ],
    );
}
