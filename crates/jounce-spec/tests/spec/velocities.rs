//! Initial velocities of masses: which masses may have one.

use jounce_spec::Spec;

const BALL: &str = "[mass.ball]\non = \"nothing\"\nmass = \"1 g\"\nvelocity = \"-2 m/s\"\n[gravity]\nacceleration = \"-1 g\"\n";

#[test]
fn a_velocity_comes_back_from_its_print() {
    let spec = Spec::from_toml(BALL).unwrap();
    assert_eq!(spec.mass["ball"].velocity_m_s, Some(-2.0));
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
}

#[test]
fn a_velocity_that_makes_no_sense_is_refused() {
    let beam = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"10 mm\"\nthickness = \"1 mm\"\n";
    let damping = "[damping]\nbeyond = 0.01\n";
    for (text, message) in [
        (
            format!(
                "{beam}{damping}[mass.m]\non = \"b.end\"\nmass = \"1 g\"\nvelocity = \"1 m/s\"\n"
            ),
            "mass.m.velocity does not apply to a mass that is fixed to its support",
        ),
        (
            format!("{beam}root = \"ball\"\n{damping}{BALL}"),
            "mass.ball.velocity is that of the mass alone, but the root of beam \"b\" is clamped to the mass",
        ),
        (
            format!("{BALL}[run]\nstart = \"state.json\"\n"),
            "mass.ball.velocity has no effect: the state file of run.start contains the velocities",
        ),
        (BALL.replace("-2 m/s", "-2 m"), "expected a speed"),
    ] {
        let fault = Spec::from_toml(&text).unwrap_err().to_string();
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{text}\n-> {fault}"
        );
    }
}
