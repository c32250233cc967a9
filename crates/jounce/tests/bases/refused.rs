//! What a spec may not say of bases, each told with its key and what to do.

use jounce::spec::Spec;

fn told(drive: &str) -> String {
    let body = "[mass.mass]\non = \"head\"\nmass = \"1 kg\"\nfrequency = \"6 Hz\"\ndamping_ratio = 0.1\n[mass.free]\non = \"nothing\"\n\
        mass = \"1 kg\"\n[stop.s]\nat = \"free\"\nframe = \"mass\"\ngap = \"1 mm\"\nlaw = \"rigid\"\nrestitution = 0.5\n\
        [drive.head]\nkind = \"base-acceleration\"\nat = \"head\"\namplitude = \"1 m/s^2\"\nfrequency = \"5 Hz\"\n";
    Spec::from_toml(&format!("{body}{drive}")).map_or_else(|faults| faults.to_string(), |_| String::new())
}

#[test]
fn every_fault_of_a_base_is_told() {
    assert_eq!(told(""), "");
    let sine = "amplitude = \"1 mm\"\nfrequency = \"5 Hz\"\n";
    let chirp = "signal = \"chirp\"\namplitude = \"1 mm\"\nfrom = \"5 Hz\"\nto = \"9 Hz\"\nduration = \"1 s\"\n";
    let cases = [
        (format!("at = \"free\"\n{sine}"), ["drive.x.at", "a mass, which a force moves"]),
        (format!("at = \"head.end\"\n{sine}"), ["drive.x.at", "no name of a base"]),
        (format!("at = \"haed\"\n{sine}"), ["drive.x.at", "a base that carries nothing"]),
        (format!("at = \"head\"\n{chirp}phase = \"90 deg\"\n"), ["drive.x.phase", "leave `phase` out"]),
        ("at = \"head\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nhigh = \"9 Hz\"\n".to_owned(), ["drive.x.kind", "give the acceleration"]),
    ];
    for (text, wanted) in cases {
        let found = told(&format!("[drive.x]\nkind = \"base-displacement\"\n{text}"));
        assert!(wanted.iter().all(|part| found.contains(part)), "{text}: {found}");
    }
    let lost =
        Spec::from_toml("[beam.b]\nroot = \"head\"\nlength = \"1 m\"\nwidth = \"1 cm\"\nthickness = \"1 mm\"\nmaterial = \"steel\"\n");
    assert!(lost.unwrap_err().to_string().contains("beam.b.root"));
}
