//! `jounce rerun` on files that were changed, damaged, or have no record.

use crate::rerun::{call, folder, rerun, write};
use serde_json::Value;

#[test]
fn a_change_by_hand_is_found_in_every_format() {
    let folder = folder();
    write(folder.path(), "modes a.toml");
    let out = folder.path().join("out");
    let (_, modes, _) = call(folder.path(), &["modes", "a.toml", "--json"]);
    let frequency_hz = modes["modes"][0]["frequency_hz"].as_f64().unwrap();
    for name in ["modes.csv", "modes.json"] {
        let path = out.join(name);
        let text = std::fs::read_to_string(&path).unwrap();
        let digits = frequency_hz.to_string();
        let (before, last) = digits.split_at(digits.len() - 1);
        let other = if last == "1" { "2" } else { "1" };
        assert!(text.contains(&digits), "{text}");
        std::fs::write(
            &path,
            text.replacen(&digits, &format!("{before}{other}"), 1),
        )
        .unwrap();
        let (code, json, text) = rerun(folder.path(), &format!("out/{name}"));
        assert_eq!(code, 1, "{name}: {text}");
        assert_eq!(json["difference"]["what"], "value", "{json}");
        let expected = format!(
            "different: column frequency_hz, row 1: the file has {before}{other}, computed {digits}"
        );
        assert!(text.contains(&expected), "{text}");
    }
    let path = out.join("modes.parquet");
    let mut bytes = std::fs::read(&path).unwrap();
    let is_value = |window: &[u8]| window == frequency_hz.to_le_bytes();
    let places: Vec<usize> = (0..bytes.len() - 8)
        .filter(|&at| is_value(&bytes[at..at + 8]))
        .collect();
    assert!(!places.is_empty());
    places.iter().for_each(|&at| bytes[at] ^= 1);
    std::fs::write(&path, &bytes).unwrap();
    let (code, json, text) = rerun(folder.path(), "out/modes.parquet");
    assert_eq!(
        (code, json["difference"]["row"].as_u64()),
        (1, Some(1)),
        "{text}"
    );
    let length = bytes.len();
    bytes[length - 5] ^= 1;
    std::fs::write(&path, &bytes).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.parquet");
    assert!(code == 4 && text.contains("modes.parquet"), "{text}");
}

#[test]
fn a_change_of_a_picture_is_found() {
    let folder = folder();
    write(folder.path(), "modes a.toml");
    let path = folder.path().join("out/modes-beam.svg");
    let svg = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, svg.replacen("<title>", "<title>My ", 1)).unwrap();
    let (code, json, text) = rerun(folder.path(), "out/modes-beam.svg");
    let place = json["difference"]["place"].as_str();
    assert_eq!((code, place), (1, Some("line 2")), "{text}");
    let expected = "different: line 2: the file has <title>My ";
    assert!(text.contains(expected), "{text}");
    let start = svg.find("<metadata>").unwrap();
    std::fs::write(&path, format!("{}</svg>\n", &svg[..start])).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes-beam.svg");
    let expected = "no record of its command";
    assert!(code == 4 && text.contains(expected), "{text}");
    let path = folder.path().join("out/modes-beam.png");
    let png = std::fs::read(&path).unwrap();
    std::fs::write(&path, &png[..png.len() / 2]).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes-beam.png");
    assert!(code == 4 && text.contains("modes-beam.png"), "{text}");
    let path = folder.path().join("out/modes-beam.pdf");
    let pdf = std::fs::read(&path).unwrap();
    let scale = pdf.windows(6).position(|part| part == b"-0.75 ").unwrap();
    let mut changed = pdf.clone();
    changed[scale + 4] = b'6';
    std::fs::write(&path, &changed).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes-beam.pdf");
    let expected = "the file has 0.75 0 0 -0.76 0 ";
    assert!(code == 1 && text.contains(expected), "{text}");
    std::fs::write(&path, &pdf[..pdf.len() - 9]).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes-beam.pdf");
    assert!(code == 4 && text.contains("modes-beam.pdf"), "{text}");
}

#[test]
fn files_without_a_record_and_of_other_versions_are_named() {
    let folder = folder();
    write(folder.path(), "modes a.toml");
    let notes = folder.path().join("out/modes.manifest.json");
    let mut manifest: Value = serde_json::from_slice(&std::fs::read(&notes).unwrap()).unwrap();
    manifest["manifest"]["version"] = "0.0.9".into();
    std::fs::write(&notes, manifest.to_string()).unwrap();
    let (code, json, _) = rerun(folder.path(), "out/modes.csv");
    assert_eq!((code, json["stored_version"].as_str()), (0, Some("0.0.9")));
    let mut edited = manifest.clone();
    edited["manifest"]["record"]["inputs"][0]["text"] = "[mass.a]\n".into();
    std::fs::write(&notes, edited.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(text.contains("changed by hand"), "{text}");
    let mut other = manifest.clone();
    other["manifest"]["record"]["arguments"] = vec!["explore", "a.toml"].into();
    std::fs::write(&notes, other.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(
        text.contains("its record names the command \"explore\""),
        "{text}"
    );
    manifest["manifest"]
        .as_object_mut()
        .unwrap()
        .remove("record");
    std::fs::write(&notes, manifest.to_string()).unwrap();
    let (code, _, text) = rerun(folder.path(), "out/modes.csv");
    assert_eq!(code, 4);
    assert!(
        text.contains("has no record of its command (command \"modes\", jounce 0.0.9)"),
        "{text}"
    );
    std::fs::remove_file(&notes).unwrap();
    for (file, expected) in [
        ("out/modes.csv", "its notes"),
        ("a.toml", "only tables and pictures have a record"),
        ("out/no.csv", "no.csv"),
    ] {
        let (code, _, text) = rerun(folder.path(), file);
        assert_eq!(code, 4, "{file}");
        assert!(text.contains(expected), "{file}: {text}");
    }
}
