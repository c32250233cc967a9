//! Errors of impact harvesters, one clear message each.

use jounce_analysis::run::{RunError, RunPlan, StartState, simulate};
use jounce_spec::Spec;

use crate::example::kernel;
use jounce_model::plant::System;
use jounce_model::structure::modes;

const BALL: &str = "[mass.ball]\non = \"nothing\"\nmass = \"5 g\"\n[beam.plate]\nmaterial = \"steel\"\nlength = \"50 mm\"\nwidth = \"9 mm\"\nthickness = \"1 mm\"\n[damping]\nbeyond = 0.01\n";

fn contact(gap: &str, more: &str) -> String {
    format!(
        "[stop.contact]\nat = \"ball\"\nframe = \"plate.end\"\nside = \"negative\"\nlaw = \"hertz\"\ngap = \"{gap}\"\nstiffness = \"1e8 N/m^1.5\"\n{more}"
    )
}

#[test]
fn each_fault_is_reported_once() {
    let gravity = "[gravity]\nacceleration = \"-9.81 m/s^2\"\n";
    assert!(Spec::from_toml(&format!("{BALL}{}", contact("20 mm", gravity))).is_ok());
    // A ball may rest on a plate with the penetration of its weight: (0.049 N / 1e8 N/m^1.5)^(2/3)
    // = 0.62 um.
    assert!(Spec::from_toml(&format!("{BALL}{}", contact("-0.6 um", gravity))).is_ok());
    assert!(Spec::from_toml(&format!("{BALL}{}", contact("-0.7 um", gravity))).is_err());
    for (text, message) in [
        (
            BALL.to_owned(),
            "mass.ball.on is \"nothing\", so the mass would drift without bound; add [gravity] or a [stop.NAME] that it strikes",
        ),
        (
            format!("{BALL}{}", contact("-1 um", "")),
            "stop.contact.gap is -1 um: at rest the free mass \"ball\" would penetrate the stop; give at least 0",
        ),
        (
            BALL.replace("\"nothing\"", "\"plate.end\"")
                .replace("[damping]", "root = \"ball\"\n[damping]"),
            "these support each other in a loop: plate on ball on plate; put one of them on the ground",
        ),
        (
            format!(
                "{BALL}{}",
                contact(
                    "20 mm",
                    "[circuit.load]\npatch = \"disc\"\nresistance = \"1 kohm\"\n"
                )
            ),
            "there is no patch \"disc\"",
        ),
    ] {
        let fault = Spec::from_toml(&text).unwrap_err().to_string();
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{text}\n-> {fault}"
        );
    }
}

/// A mass on a spring may be pressed against a rigid stop, but cannot start inside it.
#[test]
fn a_run_that_starts_inside_a_rigid_stop_is_refused() {
    let text = "[mass.m]\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.01\n\
                [stop.wall]\nat = \"m\"\nlaw = \"rigid\"\ngap = \"-1 mm\"\nrestitution = 0.5\n";
    assert!(
        Spec::from_toml(text)
            .unwrap_err()
            .to_string()
            .contains("at rest \"m\" would lie inside the rigid stop")
    );
    let spec = Spec::from_toml(&format!("{text}[run]\nstart = \"linear\"\n")).unwrap();
    let kernel = kernel(System::assemble(&spec, modes(&spec).unwrap()).unwrap());
    let plan = RunPlan {
        duration_s: 1.0,
        average_over_s: 1.0,
        tolerance: 1e-7,
        record_s: 0.0,
    };
    let mut start = StartState::rest(&kernel.plant);
    let error = simulate(&kernel, &start, &plan).unwrap_err();
    assert!(
        matches!(&error, RunError::StartsInside { stop, depth_m } if stop == "wall" && *depth_m == 1e-3),
        "{error}"
    );
    start.displacement[0] = -1e-3;
    let result = simulate(&kernel, &start, &plan).unwrap();
    assert!(
        result.stops[0].contact_duty > 1.0 - 1e-9,
        "it rests on the stop: {:?}",
        result.stops
    );
}
