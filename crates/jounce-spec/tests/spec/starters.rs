//! Starters of new specs.

use jounce_spec::SpecFile;
use jounce_spec::starter::{STARTERS, Starter};

#[test]
fn every_starter_is_a_spec_that_explains_each_of_its_keys_once() {
    for starter in STARTERS {
        let file = SpecFile::from_text(starter.spec);
        assert!(file.spec().is_ok(), "{}: {:?}", starter.kind, file.spec());
        assert!(
            starter.spec.starts_with("# ") && starter.spec.ends_with('\n'),
            "{}",
            starter.kind
        );
        let mut explained: Vec<&str> = Vec::new();
        for line in starter
            .spec
            .lines()
            .filter(|line| !line.starts_with(['#', '[']))
        {
            let Some((key, rest)) = line.split_once(" = ") else {
                continue;
            };
            assert!(
                rest.contains(" # ") || explained.contains(&key),
                "{}: nothing explains {line}",
                starter.kind
            );
            explained.push(key);
        }
    }
}

/// A name stands for one thing: a point, a mass or a stop. Only a stop and the point that strikes it may
/// share a name, as in the examples.
#[test]
fn the_points_masses_and_stops_of_a_starter_have_different_names() {
    for starter in STARTERS {
        let spec = SpecFile::from_text(starter.spec).spec().unwrap();
        let beams = spec.beam.values().flat_map(|beam| beam.point.keys());
        let plates = spec.plate.values().flat_map(|plate| plate.point.keys());
        let stops = spec.stop.iter();
        let stops = stops.filter(|(name, stop)| !stop.at.ends_with(&format!(".{name}")));
        let others = spec.mass.keys().chain(stops.map(|(name, _)| name));
        let mut names: Vec<&String> = beams.chain(plates).chain(others).collect();
        names.sort();
        let all = names.len();
        names.dedup();
        assert_eq!(names.len(), all, "{}: {names:?}", starter.kind);
    }
}

#[test]
fn unknown_kind_error_suggests_the_nearest() {
    assert_eq!(Starter::of("ball").unwrap().kind, "ball");
    let message = Starter::of("two-beam").unwrap_err().to_string();
    assert!(
        message.contains("did you mean \"two-beams\"") && message.contains("random-base"),
        "{message}"
    );
    assert_eq!(
        Starter::of("bimorph").unwrap_err().nearest,
        Some("bimorph-with-rectifier")
    );
    assert_eq!(Starter::of("violin").unwrap_err().nearest, None);
}
