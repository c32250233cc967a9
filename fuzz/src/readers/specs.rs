//! Specs, overrides, ranges of their keys, and force tables.

use super::{choice, quantities, text_of};
use crate::scratch;
use jounce_spec::{Fault, Spec, SpecFile};
use std::sync::LazyLock;

/// Specs of systems of several kinds.
pub static BASES: LazyLock<[SpecFile; 3]> = LazyLock::new(|| {
    [
        include_str!("../../../examples/bouncing-and-impact-oscillators/impact.toml"),
        include_str!("../../../examples/impact-harvester-2019/harvester.toml"),
        include_str!("../../../examples/rectified-shu-lien-2006/harvester.toml"),
    ]
    .map(|text| SpecFile::from_text(text).in_folder(scratch::folder()))
});

/// Each fault has a message and a place inside the text.
pub fn check_places<'f>(text: &str, faults: impl IntoIterator<Item = &'f Fault>) {
    let lines = text.split('\n').count();
    for fault in faults {
        assert!(!fault.message.is_empty());
        assert!(
            fault.line <= lines,
            "line {} of {lines}: {fault}",
            fault.line
        );
        let line = text.split('\n').nth(fault.line.saturating_sub(1));
        let end = line.map_or(0, |line| line.chars().count()) + 1;
        assert!(
            fault.line == 0 || (1..=end).contains(&fault.column),
            "column of {end}: {fault}"
        );
    }
}

/// A spec that was read is written as a text that reads back to the same spec.
pub fn spec(data: &[u8]) {
    let text = text_of(data);
    let file = SpecFile::from_text(text.as_str()).in_folder(scratch::folder());
    match file.spec() {
        Ok(spec) => check_written(&spec),
        Err(faults) => {
            assert!(!faults.as_slice().is_empty());
            check_places(&text, faults.as_slice());
        }
    }
}

fn check_written(spec: &Spec) {
    let written = spec.to_toml();
    let again = SpecFile::from_text(written.as_str())
        .in_folder(scratch::folder())
        .spec();
    let again = again.unwrap_or_else(|faults| panic!("{faults}\n{written}"));
    assert_eq!(again.to_toml(), written);
}

/// Lines `KEY=VALUE` set keys in turn. The text with the overrides is a spec with the same values, or with faults as well.
pub fn overrides(data: &[u8]) {
    let Some((base, rest)) = choice(data, BASES.len()) else {
        return;
    };
    let (mut file, text) = (BASES[base].clone(), text_of(rest));
    for line in text.lines().take(8) {
        let (key, value) = line.split_once('=').unwrap_or((line, ""));
        if let Err(fault) = file.set(key, value) {
            assert!(fault.line == 0 && !fault.message.is_empty());
        }
    }
    let written = file.written();
    match (file.spec(), written.spec()) {
        (Ok(spec), Ok(again)) => assert_eq!(spec.to_toml(), again.to_toml()),
        (Ok(_), Err(faults)) => panic!("{faults}\n{}", written.text()),
        (Err(faults), Ok(_)) => {
            panic!("the text with the overrides has no fault, but they have: {faults}")
        }
        (Err(_), Err(faults)) => check_places(&written.text(), faults.as_slice()),
    }
}

/// Ranges of keys of a spec.
pub fn sweep_range(data: &[u8]) {
    let Some((base, rest)) = choice(data, BASES.len()) else {
        return;
    };
    let text = text_of(rest);
    if let Ok(range) = BASES[base].range(&text) {
        let points = text.split_once('=').map_or("", |(_, points)| points);
        quantities::check(points, range.values(), |part| range.key().read(part).ok());
    }
}

/// A stop whose force is a table in a file.
pub fn force_table(data: &[u8]) {
    static SPEC: LazyLock<SpecFile> = LazyLock::new(|| {
        let text = "[mass.a]\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.1\n[stop.s]\nat = \"a\"\ngap = \"1 mm\"\nlaw = \"table\"\nfile = \"force.csv\"\n";
        SpecFile::from_text(text).in_folder(scratch::folder())
    });
    scratch::file("force.csv", data);
    if let Ok(spec) = SPEC.spec() {
        check_written(&spec);
    }
}
