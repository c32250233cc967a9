//! Contact stiffness from the two bodies: closed forms, sweeps, overrides and invalid combinations.

use jounce_spec::{NumericKey, Spec, SpecFile, StopLaw};

fn text(keys: &str) -> String {
    format!(
        "[mass.ball]\nmass = \"4 g\"\nfrequency = \"10 Hz\"\ndamping_ratio = 0.01\n\
         [stop.s]\nat = \"ball\"\nlaw = \"hertz\"\ngap = \"1 mm\"\n{keys}\n"
    )
}

fn stiffness(spec: &Spec) -> f64 {
    match spec.stop["s"].law {
        StopLaw::Hertz { stiffness, .. } | StopLaw::HuntCrossley { stiffness, .. } => stiffness,
        ref law => panic!("{law:?}"),
    }
}

fn of(keys: &str) -> f64 {
    stiffness(&Spec::from_toml(&text(keys)).unwrap())
}

fn assert_close(value: f64, exact: f64) {
    assert!((value / exact - 1.0).abs() < 1e-12, "{value:e} {exact:e}");
}

fn faults(keys: &str) -> String {
    Spec::from_toml(&text(keys)).unwrap_err().to_string()
}

const ON_BRASS: &str = "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"brass\"";

#[test]
fn balls_and_planes_have_the_closed_form_of_hertz() {
    let modulus_pa = |bodies: [(f64, f64); 2]| {
        let [a, b] = bodies.map(|(e, nu): (f64, f64)| (1.0 - nu.powi(2)) / e);
        1.0 / (a + b)
    };
    let (steel, brass) = ((200e9, 0.29), (110e9, 0.35));
    let exact = |bodies, radius_m: f64| 4.0 / 3.0 * modulus_pa(bodies) * radius_m.sqrt();
    assert_close(of(ON_BRASS), exact([steel, brass], 5e-3));
    let balls = "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_radius = \"5 mm\"\nstop_material = \"steel\"";
    assert_close(of(balls), exact([steel, steel], 2.5e-3));
    let seat = format!("{ON_BRASS}\nstop_radius = \"-6 mm\"");
    assert_close(of(&seat), exact([steel, brass], 30e-3));
    let own = "radius = \"5 mm\"\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.22\nstop_material = \"steel\"\nstop_youngs_modulus = \"210 GPa\"";
    assert_close(of(own), exact([(70e9, 0.22), (210e9, 0.29)], 5e-3));
}

/// Equal cylinders crossed at a right angle touch in a circle, like a sphere on a plane.
#[test]
fn crossed_cylinders_are_a_ball_on_a_plane() {
    let crossed = "shape = \"cylinder\"\nstop_radius = \"5 mm\"\nstop_shape = \"cylinder\"\ncrossing_angle = \"90 deg\"";
    assert_close(of(&format!("{ON_BRASS}\n{crossed}")), of(ON_BRASS));
    let round = "shape = \"ellipsoid\"\ncross_radius = \"5 mm\"";
    assert_close(of(&format!("{ON_BRASS}\n{round}")), of(ON_BRASS));
    // A barrel on a plane: between the spheres of its two radii.
    let barrel = of(&format!(
        "{ON_BRASS}\nshape = \"ellipsoid\"\ncross_radius = \"20 mm\""
    ));
    assert!(barrel > of(ON_BRASS) && barrel < 2.0 * of(ON_BRASS));
}

#[test]
fn every_number_of_the_bodies_is_swept_with_the_stiffness() {
    let mut spec = Spec::from_toml(&text(ON_BRASS)).unwrap();
    let before = stiffness(&spec);
    let radius = NumericKey::find(&spec, "stop.s.radius").unwrap();
    radius.set(&mut spec, 20e-3).unwrap();
    assert_close(stiffness(&spec), 2.0 * before);
    assert_eq!(spec, Spec::from_toml(&spec.to_toml()).unwrap());
    let printed = spec.to_toml();
    let stop = printed.split("[stop.s]").nth(1).unwrap();
    assert!(
        !stop.contains("stiffness") && stop.contains("radius = \"20 mm\""),
        "{stop}"
    );
    for key in [
        "youngs_modulus",
        "stop_youngs_modulus",
        "poisson_ratio",
        "stop_poisson_ratio",
    ] {
        let key = NumericKey::find(&spec, &format!("stop.s.{key}")).unwrap();
        let (value, before) = (key.get(&spec).unwrap(), stiffness(&spec));
        key.set(&mut spec, 1.1 * value).unwrap();
        assert!(stiffness(&spec) > before, "{}", key.path());
    }
    let fault = NumericKey::find(&spec, "stop.s.stiffness").unwrap_err();
    assert!(
        fault.to_string().contains("follows from the bodies"),
        "{fault}"
    );
}

#[test]
fn an_override_of_the_radius_replaces_the_stiffness() {
    let given = text("stiffness = \"1e9 N/m^1.5\"\n");
    let mut file = SpecFile::from_text(given);
    for (key, value) in [
        ("radius", "5 mm"),
        ("material", "steel"),
        ("stop_material", "brass"),
    ] {
        file.set(&format!("stop.s.{key}"), value).unwrap();
    }
    assert_close(stiffness(&file.spec().unwrap()), of(ON_BRASS));
}

/// Keys of the stop, and a part of each line of the faults.
const INVALID: &[(&str, &[&str])] = &[
    ("", &["one of `stiffness` or `radius` is missing"]),
    (
        "radius = \"5 mm\"\nstiffness = \"1e9 N/m^1.5\"",
        &[
            "`radius` is given too",
            "stop.s.material is missing",
            "stop.s.stop_material is missing",
        ],
    ),
    (
        "stiffness = \"1e9 N/m^1.5\"\nmaterial = \"steel\"\nstop_radius = \"1 mm\"",
        &[
            "stop.s.material is given without `radius`",
            "stop.s.stop_radius is given without `radius`",
        ],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"",
        &["stop.s.stop_material is missing"],
    ),
    (
        "radius = \"5 mm\"\nyoungs_modulus = \"1 GPa\"\nstop_poisson_ratio = 0.3",
        &[
            "stop.s.poisson_ratio is missing",
            "stop.s.stop_youngs_modulus is missing",
        ],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"PZT-5A\"\nstop_material = \"silicon\"",
        &["\"PZT-5A\" is not known", "\"silicon\" is not known"],
    ),
    (
        "radius = \"-5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"",
        &["must be greater than 0"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\npoisson_ratio = 0.6",
        &["at most 0.5"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nexponent = 2",
        &["stop.s.exponent is 2, but two smooth bodies have 1.5"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nstop_radius = \"-4 mm\"",
        &["stop.s.stop_radius is -4 mm: a concave seat must have a larger radius"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nstop_radius = \"-5 mm\"",
        &["a concave seat must have a larger radius"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nshape = \"cylinder\"",
        &["stop.s.shape is that of a contact along a line"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nshape = \"ellipsoid\"",
        &["`cross_radius` is missing"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nshape = \"ellipsoid\"\ncross_radius = \"-50 mm\"",
        &["stop.s.radius is too large for the other radii"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nstop_radius = \"0 mm\"",
        &["stop.s.stop_radius is 0; give a radius other than 0"],
    ),
    (
        "radius = \"5 mm\"\nmaterial = \"steel\"\nstop_material = \"steel\"\nstop_shape = \"cylinder\"\ncrossing_angle = \"90 deg\"",
        &[
            "stop.s.stop_shape has no effect on a flat body",
            "stop.s.crossing_angle has no effect",
        ],
    ),
];

#[test]
fn invalid_bodies_are_reported() {
    for (keys, messages) in INVALID {
        let found = faults(keys);
        for message in *messages {
            assert!(found.contains(message), "{keys}\n{found}");
        }
        assert_eq!(found.lines().count(), messages.len(), "{keys}\n{found}");
    }
    let other_law = text(ON_BRASS).replace("hertz", "spring");
    let found = Spec::from_toml(&other_law).unwrap_err().to_string();
    assert!(
        found.contains(
            "radius does not apply with law = \"spring\", only with hertz, hunt-crossley"
        ),
        "{found}"
    );
}
