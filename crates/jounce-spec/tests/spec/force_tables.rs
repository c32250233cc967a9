//! Tables of force over penetration: reading, sweeps, static penetration and invalid points.

use jounce_spec::{NumericKey, Spec, StopLaw};

fn text(keys: &str) -> String {
    format!(
        "[mass.ball]\nmass = \"4 g\"\nfrequency = \"10 Hz\"\ndamping_ratio = 0.01\n\
         [stop.s]\nat = \"ball\"\nlaw = \"table\"\ngap = \"1 mm\"\n{keys}\n"
    )
}

#[test]
fn a_table_is_read_printed_and_swept() {
    let mut spec = Spec::from_toml(&text(
        "penetration_m = [0, 1e-5, 3e-5]\nforce_n = [0, 2, 8.5]\n",
    ))
    .unwrap();
    assert_eq!(spec.stop["s"].law, StopLaw::Table { damping_s_m: 0.0 });
    let curve = spec.stop["s"].table.curve().unwrap();
    assert_eq!([1e-5, 3e-5].map(|at| curve.force_n(at)), [2.0, 8.5]);
    let short = Spec::from_toml(&text(
        "penetration_m = [1e-5, 3e-5]\nforce_n = [2, 8.5]\ndamping = \"0 s/m\"\n",
    ))
    .unwrap();
    assert_eq!(short.stop["s"].table.curve().unwrap(), curve);
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);

    let pressed_m = |spec: &Spec| spec.stop["s"].static_penetration_m(2.0).unwrap();
    assert!((pressed_m(&spec) - 1e-5).abs() < 1e-18);
    let force = NumericKey::find(&spec, "stop.s.force_n.2").unwrap();
    force.set(&mut spec, 4.0).unwrap();
    assert!(pressed_m(&spec) < 1e-5);
    let fault = force.set(&mut spec, 9.0).unwrap_err().to_string();
    assert!(
        fault.contains("after 9 N; each number must be at least"),
        "{fault}"
    );
    let damping = NumericKey::find(&spec, "stop.s.damping").unwrap();
    damping.set(&mut spec, 0.3).unwrap();
    assert_eq!(spec.stop["s"].law, StopLaw::Table { damping_s_m: 0.3 });
}

#[test]
fn invalid_tables_are_reported() {
    for (keys, message) in [
        ("", "`penetration_m` is missing"),
        ("penetration_m = [1e-5]\nforce_n = []", "the list is empty"),
        (
            "penetration_m = [1e-5]\nforce_n = [1, 2]",
            "stop.s.force_n has 2 numbers, but penetration_m has 1",
        ),
        (
            "penetration_m = [2e-5, 1e-5]\nforce_n = [1, 2]",
            "stop.s.penetration_m has 0.00001 m as number 2, after 0.00002 m; each number must be larger",
        ),
        (
            "penetration_m = [1e-5, 2e-5]\nforce_n = [2, 1]",
            "stop.s.force_n has 1 N as number 2, after 2 N; each number must be at least the one before it",
        ),
        (
            "penetration_m = [1e-5, 2e-5]\nforce_n = [2, 2]",
            "stop.s.force_n has 2 N at the last point, no more than the force before it",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [0]",
            "stop.s.force_n has 0 N at the last point",
        ),
        (
            "penetration_m = [0]\nforce_n = [0]",
            "has only the point at 0",
        ),
        (
            "penetration_m = [0, 1e-5]\nforce_n = [1, 2]",
            "has 1 N at zero penetration",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [-2]",
            "must be at least 0",
        ),
        (
            "penetration_m = [\"1 mm\"]\nforce_n = [2]",
            "expected a plain number",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [2]\nstiffness = \"1 N/m\"",
            "stiffness does not apply with law = \"table\"",
        ),
    ] {
        let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
        assert!(found.contains(message), "{keys}\n{found}");
    }
}

#[test]
fn all_faults_of_a_table_are_reported() {
    let keys = "penetration_m = [0, 2e-5, 1e-5, 3e-5]\nforce_n = [1, 3, 2, 2]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    for message in [
        "stop.s.force_n has 1 N at zero penetration",
        "stop.s.penetration_m has 0.00001 m as number 3",
        "stop.s.force_n has 2 N as number 3, after 3 N",
        "stop.s.force_n has 2 N at the last point",
    ] {
        assert!(found.contains(message), "{message}\n{found}");
    }
    let keys = "penetration_m = [3e-5, 2e-5, 1e-5]\nforce_n = [3, 2, 4, 5]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    assert!(
        found.contains("has 4 numbers")
            && found.contains("as number 2, after 0.00003 m")
            && found.contains("as number 3, after 0.00002 m"),
        "{found}"
    );
}
