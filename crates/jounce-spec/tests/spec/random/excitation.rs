//! Random stops, drives and runs.

use jounce_spec::*;
use proptest::prelude::*;

use super::value::{any_number, positive};

fn law() -> impl Strategy<Value = StopLaw> {
    let exponent = prop_oneof![Just(1.0), Just(1.5), 1.0..10.0f64];
    prop_oneof![
        (positive(), exponent.clone()).prop_map(|(stiffness, exponent)| StopLaw::Hertz {
            stiffness,
            exponent
        }),
        positive().prop_map(|stiffness_n_m| StopLaw::Spring { stiffness_n_m }),
        (positive(), positive()).prop_map(|(stiffness_n_m, damping_n_s_m)| StopLaw::KelvinVoigt {
            stiffness_n_m,
            damping_n_s_m
        }),
        (positive(), exponent, positive()).prop_map(|(stiffness, exponent, damping_s_m)| {
            StopLaw::HuntCrossley {
                stiffness,
                exponent,
                damping_s_m,
            }
        }),
        (any_number(), any_number()).prop_map(|(stiffness_n_m, cubic_stiffness_n_m3)| {
            StopLaw::Cubic {
                stiffness_n_m,
                cubic_stiffness_n_m3,
            }
        }),
        (0.0..=1.0f64).prop_map(|restitution| StopLaw::Rigid { restitution }),
    ]
}

pub fn stop(points: Vec<String>) -> impl Strategy<Value = Stop> {
    let side = prop_oneof![Just(Side::Positive), Just(Side::Negative)];
    let frames: Vec<String> = points
        .iter()
        .cloned()
        .chain(["ground".to_owned()])
        .collect();
    (
        prop::sample::select(points),
        prop::sample::select(frames),
        side,
        any_number(),
        law(),
    )
        .prop_map(|(at, frame, side, gap_m, law)| {
            let frame = if frame == at {
                "ground".to_owned()
            } else {
                frame
            };
            Stop {
                at,
                frame,
                side,
                gap_m,
                law,
            }
        })
}

pub fn drive(points: Vec<String>) -> impl Strategy<Value = Drive> {
    (
        prop::sample::select(points),
        positive(),
        1e-6..1e6f64,
        any_number(),
    )
        .prop_map(|(at, amplitude, frequency_hz, phase_rad)| Drive {
            at,
            kind: DriveKind::Force,
            signal: DriveSignal::Sine {
                amplitude,
                frequency_hz,
                phase_rad,
            },
        })
}

pub fn run() -> impl Strategy<Value = Run> {
    let start = prop_oneof![
        Just(Start::Rest),
        Just(Start::Linear),
        "[a-z \"\\\\\u{e9}]{0,8}[a-z]\\.json".prop_map(Start::State)
    ];
    (start, positive(), 0.001..=1.0f64, -12.0..-1.0f64).prop_map(
        |(start, duration_s, part, digits)| Run {
            start,
            duration_s,
            average_over_s: part * duration_s,
            tolerance: 10f64.powf(digits),
        },
    )
}
