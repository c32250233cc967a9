//! Errors of specs on bases, each with its key and a suggestion.

use jounce_model::linear::Random;
use jounce_spec::Spec;

fn fault_of(drive: &str) -> String {
    let body = "[mass.mass]\non = \"head\"\nmass = \"1 kg\"\nfrequency = \"6 Hz\"\ndamping_ratio = 0.1\n[mass.free]\non = \"nothing\"\n\
        mass = \"1 kg\"\n[stop.s]\nat = \"free\"\nframe = \"mass\"\ngap = \"1 mm\"\nlaw = \"rigid\"\nrestitution = 0.5\n\
        [drive.head]\nkind = \"base-acceleration\"\nat = \"head\"\namplitude = \"1 m/s^2\"\nfrequency = \"5 Hz\"\n";
    Spec::from_toml(&format!("{body}{drive}"))
        .map_or_else(|faults| faults.to_string(), |_| String::new())
}

#[test]
fn every_fault_of_a_base_is_reported() {
    assert_eq!(fault_of(""), "");
    let sine = "amplitude = \"1 mm\"\nfrequency = \"5 Hz\"\n";
    let chirp = "signal = \"chirp\"\namplitude = \"1 mm\"\nfrom = \"5 Hz\"\nto = \"9 Hz\"\nduration = \"1 s\"\n";
    let cases = [
        (
            format!("at = \"free\"\n{sine}"),
            ["drive.x.at", "a mass, which only a force moves"],
        ),
        (
            format!("at = \"head.end\"\n{sine}"),
            ["drive.x.at", "not the name of a base"],
        ),
        (
            format!("at = \"haed\"\n{sine}"),
            ["drive.x.at", "a base that supports nothing"],
        ),
        (
            format!("at = \"head\"\n{chirp}phase = \"90 deg\"\n"),
            ["drive.x.phase", "omit `phase`"],
        ),
        (
            "at = \"head\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nhigh = \"9 Hz\"\n".to_owned(),
            ["drive.x.kind", "give the acceleration"],
        ),
    ];
    for (text, expected) in cases {
        let fault = fault_of(&format!("[drive.x]\nkind = \"base-displacement\"\n{text}"));
        assert!(
            expected.iter().all(|part| fault.contains(part)),
            "{text}: {fault}"
        );
    }
    let unknown_base = Spec::from_toml(
        "[beam.b]\nroot = \"head\"\nlength = \"1 m\"\nwidth = \"1 cm\"\nthickness = \"1 mm\"\nmaterial = \"steel\"\n",
    );
    assert!(
        unknown_base
            .unwrap_err()
            .to_string()
            .contains("beam.b.root")
    );
}

/// The double integral of noise grows without bound, so a gap between the base that it moves and
/// the ground has no contact rate. Where both sides are on the same base there is a rate, equal to
/// that of the same harvester on the ground.
#[test]
fn a_gap_that_noise_carries_away_has_no_rate() {
    let text = |base: &str, frame: &str| {
        format!(
            "[mass.mass]\non = \"{base}\"\nmass = \"1 kg\"\nfrequency = \"6 Hz\"\ndamping_ratio = 0.1\n\
             [stop.s]\nat = \"mass\"\nframe = \"{frame}\"\ngap = \"1 mm\"\nlaw = \"rigid\"\nrestitution = 0.5\n\
             [drive.shaker]\nkind = \"base-acceleration\"\nat = \"{base}\"\nsignal = \"noise\"\npsd = \"0.1 (m/s^2)^2/Hz\"\nhigh = \"40 Hz\"\n"
        )
    };
    let stop = |base: &str, frame: &str| {
        let spec = Spec::from_toml(&text(base, frame)).unwrap_or_else(|faults| panic!("{faults}"));
        Random::new(&spec)
            .unwrap()
            .response()
            .unwrap()
            .stops
            .remove(0)
    };
    let noise_apart = stop("head", "ground");
    assert_eq!(
        (
            noise_apart.reached_hz,
            noise_apart.share_beyond,
            noise_apart.carried_by.as_deref()
        ),
        (None, None, Some("shaker"))
    );
    let (together, grounded) = (stop("head", "head"), stop("ground", "ground"));
    assert!(
        grounded.reached_hz.unwrap() > 0.0
            && together.carried_by.is_none()
            && together.reached_hz == grounded.reached_hz
    );
}
