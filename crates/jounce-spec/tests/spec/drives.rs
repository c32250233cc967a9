//! Drives: valid combinations of keys, and errors of others.

use jounce_spec::{DriveKind, DriveSignal, Spec};

/// A harvester without a drive.
pub const BODY: &str = "[mass.m]\nmass = \"2 kg\"\nstiffness = \"7 kN/m\"\ndamping_ratio = 0.04\n";

fn faults(text: &str) -> String {
    Spec::from_toml(&format!("{BODY}{text}"))
        .unwrap_err()
        .to_string()
}

/// Addition to the body, and a part of the only fault.
const FAULTS: [(&str, &str); 15] = [
    (
        "[drive.d]\namplitude = \"1 N\"\nfrequency = \"7 Hz\"",
        "`at` is missing; expected the name of a point or mass",
    ),
    (
        "[drive.d]\nkind = \"base-acceleration\"\namplitude = \"1 N\"\nfrequency = \"7 Hz\"",
        "\"1 N\" is a force; expected an acceleration in m/s^2, g",
    ),
    (
        "[drive.d]\nkind = \"base-acceleration\"\nat = \"m\"\namplitude = \"1 g\"\nfrequency = \"7 Hz\"",
        "is \"m\", a mass, which only a force moves",
    ),
    (
        "[drive.d]\nkind = \"base-displacement\"\nsignal = \"velocity-step\"\nvelocity = \"1 m/s\"",
        "a velocity step is not a displacement signal",
    ),
    (
        "[drive.d]\nkind = \"base-displacement\"\nsignal = \"noise\"\npsd = \"1 m^2/Hz\"\nhigh = \"7 Hz\"",
        "give the acceleration",
    ),
    (
        "[drive.d]\nkind = \"base-displacement\"\nsignal = \"chirp\"\namplitude = \"1 mm\"\nfrom = \"7 Hz\"\nto = \"9 Hz\"\nduration = \"1 s\"\nphase = \"1 rad\"",
        "omit `phase`",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"velocity-step\"\nvelocity = \"1 m/s\"",
        "a velocity step moves a base",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"noise\"\npsd = \"-1 N^2/Hz\"\nhigh = \"7 Hz\"",
        "must be at least 0",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nlow = \"9 Hz\"\nhigh = \"7 Hz\"",
        "is 9 Hz; it must be below high = 7 Hz",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nhigh = \"7 Hz\"\nsample_rate = \"20 Hz\"",
        "at least four times high = 7 Hz",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nhigh = \"1 MHz\"",
        "has 2.0e8 samples",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"recording\"\nfile = \"not-there.csv\"",
        "drive.d.file: not-there.csv does not exist",
    ),
    (
        "[drive.d]\nat = \"m\"\nsignal = \"recordng\"",
        "did you mean `recording`?",
    ),
    (
        "[mass.ball]\nmass = \"1 g\"\non = \"nothing\"",
        "the mass would drift without bound",
    ),
    (
        "[modal.x]\nfrequency_hz = [1]\ndamping_ratio = [0.1]\n[gravity]\nacceleration = \"9.81 m/s^2\"",
        "gravity acts on the mass of each mode; give modal.x.participation_sqrt_kg",
    ),
];

#[test]
fn each_fault_of_a_drive_is_reported_once() {
    for (text, message) in FAULTS {
        let fault = faults(text);
        assert!(
            fault.contains(message) && fault.lines().count() == 1,
            "{text}\n-> {fault}"
        );
    }
}

#[test]
fn drives_of_every_kind_come_back_from_their_print() {
    let text = format!(
        "{BODY}[drive.a]\nkind = \"base-acceleration\"\nsignal = \"chirp\"\namplitude = \"0.3 g\"\nfrom = \"4 Hz\"\nto = \"20 Hz\"\nduration = \"3 s\"\nsweep = \"logarithmic\"\n\
         [drive.b]\nkind = \"base-displacement\"\namplitude = \"1 mm\"\nfrequency = \"9 Hz\"\nphase = \"0.3 rad\"\n\
         [drive.c]\nkind = \"base-acceleration\"\nsignal = \"velocity-step\"\nvelocity = \"-1 m/s\"\nstart = \"1 s\"\n\
         [drive.d]\nat = \"m\"\nsignal = \"noise\"\npsd = \"2 N^2/Hz\"\nhigh = \"40 Hz\"\nseed = 12\nsample_rate = \"1 kHz\"\n\
         [drive.e]\nat = \"m\"\nsignal = \"half-sine\"\namplitude = \"9 N\"\nduration = \"11 ms\"\n[gravity]\nacceleration = \"1 g\"\n"
    );
    let spec = Spec::from_toml(&text).unwrap();
    assert_eq!(spec.gravity.acceleration_m_s2, Some(9.80665));
    assert_eq!(
        (spec.drive["a"].kind, spec.drive["b"].kind),
        (DriveKind::BaseAcceleration, DriveKind::BaseDisplacement)
    );
    assert!(matches!(
        spec.drive["d"].signal,
        DriveSignal::Noise {
            seed: 12,
            sample_rate_hz: Some(1000.0),
            ..
        }
    ));
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);
}
