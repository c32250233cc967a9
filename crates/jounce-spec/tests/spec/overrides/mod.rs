//! `--set KEY=VALUE`

mod faults;

use jounce_spec::{DriveSignal, ReadError, Spec, SpecFile, Start, StopLaw};

use crate::{MODAL, paper};

fn read_with(changes: &[(&str, &str)]) -> Result<Spec, String> {
    let mut file = SpecFile::from_text(paper());
    for (key, value) in changes {
        file.set(key, value).map_err(|fault| fault.to_string())?;
    }
    let spec = file.spec().map_err(|faults| faults.to_string())?;
    assert_eq!(
        Spec::from_toml(&file.text()).unwrap(),
        spec,
        "the text with the overrides says the same"
    );
    Ok(spec)
}

#[test]
fn values_come_bare_or_as_toml() {
    assert_eq!(
        read_with(&[("stop.tip.gap", "0.5 mm")]).unwrap().stop["tip"].gap_m,
        0.5e-3
    );
    assert_eq!(
        read_with(&[("stop.tip.gap", "\"0.5 mm\"")]).unwrap().stop["tip"].gap_m,
        0.5e-3
    );
    assert_eq!(
        read_with(&[("stop.tip.gap", "'0.5 mm'")]).unwrap().stop["tip"].gap_m,
        0.5e-3
    );
    assert_eq!(
        read_with(&[("mass.table.damping_ratio", "0.05")])
            .unwrap()
            .mass["table"]
            .damping_ratio,
        Some(0.05)
    );
    assert_eq!(
        read_with(&[("reduction.modes", "5")])
            .unwrap()
            .reduction
            .modes,
        5
    );
    assert_eq!(
        read_with(&[("stop.tip.frame", "table")]).unwrap().stop["tip"].frame,
        "table"
    );
    assert_eq!(
        read_with(&[("damping.ratios", "[0.1, 0.2, 3e-3, 0, 0, 0, 1]")])
            .unwrap()
            .damping
            .ratios[2],
        3e-3
    );
    assert_eq!(
        read_with(&[("run.start", "states/a.json")])
            .unwrap()
            .run
            .start,
        Start::State("states/a.json".to_owned())
    );
}

#[test]
fn a_number_of_a_list_is_a_key_counted_from_1() {
    let ratios = read_with(&[("damping.ratios.2", "0.05"), ("damping.ratios.7", "1")])
        .unwrap()
        .damping
        .ratios;
    let before = Spec::from_toml(&paper()).unwrap().damping.ratios;
    assert_eq!(
        (ratios[1], ratios[6], ratios.len()),
        (0.05, 1.0, before.len())
    );
    assert_eq!((ratios[0], &ratios[2..6]), (before[0], &before[2..6]));
    assert_eq!(
        read_with(&[
            ("damping.ratios", "[0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]"),
            ("damping.ratios.1", "0.2")
        ])
        .unwrap()
        .damping
        .ratios[0],
        0.2
    );
    let fault = read_with(&[("damping.ratios.8", "0.05")]).unwrap_err();
    let expected = "damping.ratios.8: damping.ratios holds 7 numbers; write one of damping.ratios.1 to damping.ratios.7";
    assert!(fault.ends_with(expected), "{fault}");
    assert!(
        read_with(&[("damping.ratios.0", "0.05")])
            .unwrap_err()
            .ends_with("to damping.ratios.7")
    );
    assert!(
        read_with(&[("damping.ratios.2", "11")])
            .unwrap_err()
            .contains("damping.ratios: number 2 is 11; it must be from 0 to 10")
    );
    let mut modal = SpecFile::from_text(MODAL);
    let (name, shape) = modal
        .spec()
        .unwrap()
        .modal
        .iter()
        .map(|(name, modal)| (name.clone(), modal.point.clone()))
        .next()
        .unwrap();
    let (point, shape) = shape.into_iter().next().unwrap();
    modal
        .set(
            &format!("modal.{name}.point.{point}.{}", shape.len()),
            "7.5",
        )
        .unwrap();
    for spec in [
        modal.spec().unwrap(),
        Spec::from_toml(&modal.text()).unwrap(),
    ] {
        assert_eq!(spec.modal[&name].point[&point].last(), Some(&7.5));
    }
}

#[test]
fn optional_keys_may_be_new_and_later_overrides_win() {
    assert_eq!(
        read_with(&[("run.tolerance", "1e-10")])
            .unwrap()
            .run
            .tolerance,
        1e-10
    );
    assert_eq!(
        read_with(&[("damping.beyond", "0.01")])
            .unwrap()
            .damping
            .beyond,
        Some(0.01)
    );
    assert_eq!(
        read_with(&[("beam.beam.point.sensor", "100 mm")])
            .unwrap()
            .beam["beam"]
            .point["sensor"],
        0.1
    );
    let phase = read_with(&[("drive.shaker.phase", "180 deg")])
        .unwrap()
        .drive["shaker"]
        .signal
        .clone();
    assert_eq!(
        phase,
        DriveSignal::Sine {
            amplitude: 200.0,
            frequency_hz: 13.0,
            phase_rad: std::f64::consts::PI
        }
    );
    assert_eq!(
        read_with(&[("run.duration", "30 s"), ("run.duration", "40 s")])
            .unwrap()
            .run
            .duration_s,
        40.0
    );
    let mut modal = SpecFile::from_text(MODAL);
    modal.set("run.duration", "5 min").unwrap();
    assert_eq!(modal.spec().unwrap().run.duration_s, 300.0);
    assert_eq!(
        Spec::from_toml(&modal.text()).unwrap().run.duration_s,
        300.0
    );
}

#[test]
fn laws_and_springs_can_be_exchanged() {
    let law = [
        ("stop.tip.law", "kelvin-voigt"),
        ("stop.tip.stiffness", "2 kN/mm"),
        ("stop.tip.damping", "10 N s/m"),
    ];
    assert_eq!(
        read_with(&law).unwrap().stop["tip"].law,
        StopLaw::KelvinVoigt {
            stiffness_n_m: 2e6,
            damping_n_s_m: 10.0
        }
    );
    assert_eq!(
        read_with(&[("mass.table.stiffness", "500 N/m")])
            .unwrap()
            .mass["table"]
            .stiffness_n_m,
        Some(500.0)
    );
}

#[test]
fn comments_survive_in_the_text() {
    let mut file = SpecFile::from_text(paper());
    file.set("mass.table.damping_ratio", "0.05").unwrap();
    assert!(
        file.text()
            .contains("damping_ratio = 0.05           # not given in the paper"),
        "{}",
        file.text()
    );
}

#[test]
fn inline_and_dotted_tables_are_overridden_too() {
    let text = "mass = { table = { mass = \"1 kg\", stiffness = \"1 N/m\", damping_ratio = 0.1 } }\nrun.duration = \"11 s\"\n";
    let mut file = SpecFile::from_text(text);
    for (key, value) in [
        ("mass.table.frequency", "2 Hz"),
        ("run.tolerance", "1e-9"),
        ("damping.beyond", "0.1"),
        ("mass.table.damping_ratio", "0.2"),
    ] {
        file.set(key, value).unwrap();
    }
    let spec = file.spec().unwrap();
    assert_eq!(
        (
            spec.mass["table"].damping_ratio,
            spec.run.tolerance,
            spec.damping.beyond
        ),
        (Some(0.2), 1e-9, Some(0.1))
    );
    assert_eq!(
        Spec::from_toml(&file.text()).unwrap(),
        spec,
        "{}",
        file.text()
    );
}

#[test]
fn files_that_cannot_be_read_have_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spec.toml");
    assert!(matches!(
        SpecFile::read(&path),
        Err(ReadError::Missing { .. })
    ));
    assert!(matches!(
        SpecFile::read(folder.path()),
        Err(ReadError::Folder { .. })
    ));
    std::fs::write(&path, b"[run]\nstart = \"\xff\xfe\"").unwrap();
    let Err(garbage) = SpecFile::read(&path) else {
        panic!("bytes that are no text were read")
    };
    assert!(
        garbage.to_string().ends_with(
            "spec.toml is not a text file: line 2, column 10: the byte 0xff is not UTF-8"
        ),
        "{garbage}"
    );
    std::fs::write(&path, vec![b'#'; (16 << 20) + 1]).unwrap();
    assert!(matches!(
        SpecFile::read(&path),
        Err(ReadError::TooLarge { .. })
    ));
}

#[test]
fn a_value_without_characters_removes_a_key() {
    let rigid = [
        ("stop.tip.law", "rigid"),
        ("stop.tip.restitution", "0.8"),
        ("stop.tip.stiffness", ""),
    ];
    assert!(matches!(
        read_with(&rigid).unwrap().stop["tip"].law,
        StopLaw::Rigid { .. }
    ));
    assert!(
        read_with(&rigid[..2])
            .unwrap_err()
            .contains("stop.tip.stiffness")
    );
    let default = read_with(&[("reduction.modes", " ")]).unwrap();
    assert_eq!(default.reduction.modes, Spec::default().reduction.modes);
    assert!(read_with(&[("stop.tip", "")]).unwrap().stop.is_empty());
    // An optional key that the file lacks, twice: nothing to remove.
    assert!(read_with(&[("patch.mfc.strain_limit", ""); 2]).is_ok());
    for (key, message) in [
        ("stop.tip.gapp", "unknown key"),
        ("stop.below", "this file has no [stop.below]; it has: tip"),
        ("damping.ratios.2", "set the complete list"),
        ("stop.tip.gap", "gap"),
    ] {
        let fault = read_with(&[(key, "")]).unwrap_err();
        assert!(fault.contains(message), "{key}: {fault}");
    }
}

#[test]
fn a_table_replaces_or_adds_an_element() {
    let below =
        r#"{at = "beam.tip", side = "negative", law = "rigid", gap = "2 mm", restitution = 0.5}"#;
    let spec = read_with(&[("stop.below", below), ("stop.below.gap", "3 mm")]).unwrap();
    assert_eq!((spec.stop.len(), spec.stop["below"].gap_m), (2, 3e-3));
    let replaced = read_with(&[("stop.tip", below)]).unwrap();
    assert!(matches!(replaced.stop["tip"].law, StopLaw::Rigid { .. }));
    let both = format!("{{tip = {below}, below = {below}}}");
    assert_eq!(read_with(&[("stop", &both)]).unwrap().stop.len(), 2);
    for (key, message) in [
        ("stop.tip.gap", "found a table"),
        ("stops.tip", "unknown key"),
        ("stop.tip.law.name", "has no keys"),
    ] {
        let fault = read_with(&[(key, "{a = 1}")]).unwrap_err();
        assert!(fault.contains(message), "{key}: {fault}");
    }
}

#[test]
fn a_replaced_table_has_its_header_and_its_comment() {
    let text = "# what the beam strikes\n[stop.tip]\nat = \"a.end\"\ngap = \"1 mm\"\n\n[run]\nduration = \"2 s\"\n";
    let mut file = SpecFile::from_text(text);
    file.set("stop.tip", "{at = \"a.end\", gap = \"2 mm\"}")
        .unwrap();
    file.set("stop.below", "{at = \"a.end\", gap = \"3 mm\"}")
        .unwrap();
    file.set("run.duration", "").unwrap();
    let expected = "# what the beam strikes\n[stop.tip]\nat = \"a.end\"\ngap = \"2 mm\"\n\n[stop.below]\nat = \"a.end\"\ngap = \"3 mm\"\n\n[run]\n";
    assert_eq!(file.text(), expected);
}
