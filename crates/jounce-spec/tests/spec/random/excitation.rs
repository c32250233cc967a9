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

/// Bodies with a material of the library or their own, and any convex shape.
fn bodies() -> impl Strategy<Value = ContactBodies> {
    let shape = prop_oneof![Just(BodyShape::Sphere), Just(BodyShape::Ellipsoid)];
    let body = (shape, 1e-4..1.0f64, 1e-4..1.0f64, 1e6..1e12f64, 0.0..0.5f64).prop_map(
        |(shape, radius_m, cross_radius_m, youngs_modulus_pa, poisson_ratio)| ContactBody {
            shape,
            radius_m: Some(radius_m),
            cross_radius_m: (shape == BodyShape::Ellipsoid).then_some(cross_radius_m),
            material: String::new(),
            youngs_modulus_pa: Some(youngs_modulus_pa),
            poisson_ratio: Some(poisson_ratio),
        },
    );
    let flat = body.clone().prop_map(|body| ContactBody {
        shape: BodyShape::Sphere,
        radius_m: None,
        cross_radius_m: None,
        ..body
    });
    let curved = (body.clone(), prop::option::of(0.0..3.0f64));
    let stop = prop_oneof![flat.prop_map(|body| (body, None)), curved];
    (body, stop).prop_map(|(striking, (stop, crossing_angle_rad))| ContactBodies {
        striking,
        stop,
        crossing_angle_rad,
    })
}

/// A law with measured points.
fn table() -> impl Strategy<Value = (StopLaw, ForceTable)> {
    let steps = prop::collection::vec((1e-6..1e-2f64, 1e-3..1e3f64), 1..6);
    let damping = prop_oneof![Just(0.0), 1e-6..1e6f64];
    (steps, damping).prop_map(|(steps, damping_s_m)| {
        let sums = |part: fn(&(f64, f64)) -> f64| {
            let add = |sum: &mut f64, step| {
                *sum += part(step);
                Some(*sum)
            };
            steps.iter().scan(0.0, add).collect()
        };
        let table = ForceTable {
            penetration_m: sums(|step| step.0),
            force_n: sums(|step| step.1),
            file: String::new(),
        };
        (StopLaw::Table { damping_s_m }, table)
    })
}

/// A law, and the bodies from which its stiffness follows or its points.
fn law_with_data() -> impl Strategy<Value = (StopLaw, Option<ContactBodies>, ForceTable)> {
    let of_bodies = (bodies(), prop::option::of(positive())).prop_map(|(bodies, damping)| {
        let (stiffness, exponent) = (bodies.stiffness().unwrap(), 1.5);
        let law = match damping {
            None => StopLaw::Hertz {
                stiffness,
                exponent,
            },
            Some(damping_s_m) => StopLaw::HuntCrossley {
                stiffness,
                exponent,
                damping_s_m,
            },
        };
        (law, Some(bodies), ForceTable::default())
    });
    prop_oneof![
        4 => law().prop_map(|law| (law, None, ForceTable::default())),
        1 => of_bodies,
        1 => table().prop_map(|(law, table)| (law, None, table)),
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
        law_with_data(),
    )
        .prop_map(|(at, frame, side, gap_m, (law, bodies, table))| {
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
                bodies,
                table,
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
