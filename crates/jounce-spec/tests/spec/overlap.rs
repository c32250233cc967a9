//! Bodies that would overlap at rest.

use jounce_spec::Spec;

const SUPPORTED: &str =
    "[mass.held]\nmass = \"1 kg\"\nfrequency = \"10 Hz\"\ndamping_ratio = 0.1\n";
const DOWNWARD_GRAVITY: &str = "[gravity]\nacceleration = \"-10 m/s^2\"\n";

fn free_mass(name: &str) -> String {
    format!("[mass.{name}]\non = \"nothing\"\nmass = \"1 g\"\n")
}

fn stop(name: &str, [at, frame, side, gap]: [&str; 4], law: &str) -> String {
    format!(
        "[stop.{name}]\nat = \"{at}\"\nframe = \"{frame}\"\nside = \"{side}\"\ngap = \"{gap}\"\n{law}\n"
    )
}

const HERTZ: &str = "law = \"hertz\"\nstiffness = \"1e6 N/m^1.5\"";
const RIGID: &str = "law = \"rigid\"\nrestitution = 0.5";

#[test]
fn bodies_that_fall_together_do_not_overlap() {
    for law in [HERTZ, RIGID] {
        let pair = format!(
            "{}{}{}{DOWNWARD_GRAVITY}",
            free_mass("a"),
            free_mass("b"),
            stop("s", ["a", "b", "positive", "-1 mm"], law)
        );
        let fault = Spec::from_toml(&pair).unwrap_err().to_string();
        let message = "stop.s.gap is -1 mm: at rest the free mass \"a\" would penetrate the stop; give at least 0";
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{fault}"
        );
        assert!(Spec::from_toml(&pair.replace("-1 mm", "0 mm")).is_ok());
    }
}

/// The end of a cantilever in a rigid stop is reported with the stop; in a compliant stop it has a
/// penetration.
#[test]
fn a_beam_does_not_begin_inside_a_rigid_stop() {
    let beam = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n[damping]\nbeyond = 0.01\n";
    let between_stops = |gap: &str, law: &str| {
        format!(
            "{beam}{}",
            stop("s", ["b.end", "ground", "positive", gap], law)
        )
    };
    let fault = Spec::from_toml(&between_stops("-1 mm", RIGID))
        .unwrap_err()
        .to_string();
    assert!(
        fault.contains("stop.s.gap is -1 mm: at rest \"b.end\" would lie inside the rigid stop")
            && fault.lines().count() == 1,
        "{fault}"
    );
    assert!(
        Spec::from_toml(&between_stops("-1 mm", HERTZ)).is_ok()
            && Spec::from_toml(&between_stops("0 mm", RIGID)).is_ok()
    );
}

/// Weight of 1 g at 10 m/s^2: 0.01 N, which the stop supports at (0.01 / 1e6)^(2/3) m = 4.6416e-6
/// m.
#[test]
fn a_preload_under_gravity_goes_no_deeper_than_weight_presses() {
    let ball = |gap: &str, side: &str| {
        format!(
            "{}{}{DOWNWARD_GRAVITY}",
            free_mass("ball"),
            stop("s", ["ball", "ground", side, gap], HERTZ)
        )
    };
    assert!(Spec::from_toml(&ball("-4.6e-6 m", "negative")).is_ok());
    let fault = Spec::from_toml(&ball("-5e-6 m", "negative"))
        .unwrap_err()
        .to_string();
    assert!(
        fault.contains("deeper than weight allows; give at least -4.64 um"),
        "{fault}"
    );
    // A ceiling: the weight pulls the ball away from it.
    assert!(
        Spec::from_toml(&ball("-4.6e-6 m", "positive"))
            .unwrap_err()
            .to_string()
            .contains("give at least 0")
    );
    // A sagging beam may make room where the run starts from its steady state.
    assert!(
        Spec::from_toml(&format!(
            "{}[run]\nstart = \"linear\"\n",
            ball("-5e-6 m", "negative")
        ))
        .is_ok()
    );
    // Two balls stacked: the lower one carries both.
    let lower = stop("ground", ["a", "ground", "negative", "-7e-6 m"], HERTZ);
    let stack = format!(
        "{}{}{lower}{}{DOWNWARD_GRAVITY}",
        free_mass("a"),
        free_mass("b"),
        stop("s", ["b", "a", "negative", "-4e-6 m"], HERTZ)
    );
    assert!(
        Spec::from_toml(&stack).is_ok(),
        "{:?}",
        Spec::from_toml(&stack)
    );
}

#[test]
fn two_rigid_stops_leave_room_between_them() {
    let two_stops = |one: &str, other: &str, law: &str| {
        format!(
            "{SUPPORTED}{}{}",
            stop("a", ["held", "ground", "positive", one], law),
            stop("b", ["held", "ground", "negative", other], law)
        )
    };
    let fault = Spec::from_toml(&two_stops("1 mm", "-2 mm", RIGID))
        .unwrap_err()
        .to_string();
    assert!(
        fault.contains(
            "stop.a.gap is 1 mm: it overlaps the rigid stop \"b\" on the other side by 1 mm"
        ),
        "{fault}"
    );
    // The two stops hold it where they meet, 1 mm from its rest position: a run from rest cannot
    // begin there.
    let result = two_stops("1 mm", "-1 mm", RIGID);
    assert!(Spec::from_toml(&format!("{result}[run]\nstart = \"linear\"\n")).is_ok());
    let fault = Spec::from_toml(&result).unwrap_err().to_string();
    assert!(
        fault.contains(
            "stop.b.gap is -1 mm: at rest \"held\" would lie inside the rigid stop; give at least 0"
        ),
        "{fault}"
    );
    // Compliant stops may squeeze the body between them.
    assert!(Spec::from_toml(&two_stops("1 mm", "-2 mm", HERTZ)).is_ok());
}
