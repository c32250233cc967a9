//! Units, quantities and labels of channels, decibels.

use super::through_a_file::{kinds, one};
use crate::samples::lvm;
use jounce_data::recording::{IssueKind, Quantity};
use jounce_identification::modal::{Band, ModalSettings, identify};
use jounce_identification::response::MeasuredResponses;
use std::f64::consts::TAU;

#[test]
fn the_unit_of_a_response_gives_its_quantity() {
    let (w0, zeta) = (TAU * 20.0, 0.01);
    for (unit, si, scale, acceleration) in [
        ("mm/kN", "m/N", 1e6, false),
        ("(g)/(lbf)", "m/s^2/N", 4.448_221_615_260_5 / 9.80665, true),
    ] {
        let mut text = format!("frequency [Hz];H [{unit}]\n");
        for k in 1..400 {
            let w = TAU * 0.1 * f64::from(k);
            let (a, b) = (w0 * w0 - w * w, 2.0 * zeta * w0 * w);
            let size = scale * if acceleration { -w * w } else { 1.0 } / (a * a + b * b);
            text.push_str(&format!(
                "{};({:e}{:+e}j)\n",
                0.1 * f64::from(k),
                a * size,
                -b * size
            ));
        }
        let recording = one("h.csv", text.as_bytes(), None);
        assert_eq!(
            (
                recording.channels[0].quantity,
                recording.channels[0].unit.as_str()
            ),
            (Quantity::Response, si)
        );
        let responses = MeasuredResponses::from_functions(&[recording]).expect("responses");
        let band = Band::of(&responses, (10.0, 30.0)).expect("a band");
        let modes = identify(&band, ModalSettings { order: 10 })
            .expect("modes")
            .modes;
        assert_eq!(modes.len(), 1, "{unit}");
        let (f, damping) = (
            modes[0].frequency_hz / 20.0 - 1.0,
            modes[0].damping_ratio / zeta - 1.0,
        );
        eprintln!("{unit}: frequency off by {f:.1e}, damping by {damping:.1e}");
        assert!(
            f.abs() < 1e-9 && damping.abs() < 1e-7,
            "{unit}: {f:e} {damping:e}"
        );
    }
}

/// An unknown unit in round brackets is reported, like one in square brackets; a place in them
/// belongs to the name.
#[test]
fn an_unknown_unit_in_brackets_of_any_kind_is_reported() {
    for head in [
        "U (furlong)",
        "U [furlong]",
        "U (pC)",
        "U (mA)",
        "U (dBm)",
        "U [dBm]",
        "U (dB re 1 furlong)",
    ] {
        let recording = one(
            "a.csv",
            format!("t (s),{head}\n0,1\n1,20\n2,3\n").as_bytes(),
            None,
        );
        assert_eq!(
            (kinds(&recording), recording.channels[0].name.as_str()),
            (vec![IssueKind::UnknownUnit], "U"),
            "{head}"
        );
        assert_eq!(
            (
                recording.channels[0].quantity,
                &recording.channels[0].values[..]
            ),
            (Quantity::Unknown, &[1.0, 20.0, 3.0][..]),
            "{head}"
        );
    }
    for head in ["sensor (top)", "channel (1)", "a (ch2)"] {
        let recording = one(
            "a.csv",
            format!("t (s),{head}\n0,1\n1,20\n2,3\n").as_bytes(),
            None,
        );
        assert_eq!(
            (
                kinds(&recording),
                recording.channels[0].name.as_str(),
                recording.channels[0].unit.as_str()
            ),
            (Vec::new(), head, "")
        );
    }
    let named = one("a.csv", b"t/s,a/g\n0,1\n1,2\n2,3\n", None);
    assert_eq!(
        (named.channels[0].name.as_str(), named.channels[0].values[1]),
        ("a", 2.0 * 9.80665)
    );
}

/// One letter in brackets behind a sensor or channel may be a label or a unit. The interpretation
/// is reported, unless notes specify it. An LVM file has a line of units, so its headers are names.
#[test]
fn a_letter_that_may_be_a_label_is_reported() {
    let text = b"t (s),sensor (A),channel (V),channel (B)\n0,1,2,3\n1,20,2.5,3.5\n2,3,2,3\n";
    let recording = one("a.csv", text, None);
    let names: Vec<(&str, &str)> = recording
        .channels
        .iter()
        .map(|channel| (channel.name.as_str(), channel.unit.as_str()))
        .collect();
    assert_eq!(
        names,
        [("sensor (A)", ""), ("channel", "V"), ("channel (B)", "")]
    );
    let issues: Vec<String> = recording.issues.iter().map(ToString::to_string).collect();
    assert!(
        kinds(&recording) == [IssueKind::Assumed; 2]
            && issues[0].contains("as a label")
            && issues[1].contains("as the unit V"),
        "{issues:?}"
    );
    let notes = "[channel.\"sensor (A)\"]\nname = \"sensor A\"\n[channel.channel]\nunit = \"V\"\n";
    assert_eq!(kinds(&one("a.csv", text, Some(notes))), []);
    let labelled = one(
        "a.lvm",
        lvm()
            .replace("X_Value\tVoltage\t", "X_Value\tsensor (A)\t")
            .as_bytes(),
        None,
    );
    assert_eq!(
        (
            labelled.channels[0].name.as_str(),
            labelled.channels[0].unit.as_str()
        ),
        ("sensor (A)", "V")
    );
}

/// 20 dB is ten times an amplitude, and a hundred times a density.
#[test]
fn decibels_are_converted_with_their_reference() {
    let cases = [
        ("a (dB re 1 m/s^2)", 10.0, "m/s^2"),
        ("a (dB re 1 g)", 98.0665, "m/s^2"),
        ("a (dB g)", 98.0665, "m/s^2"),
        ("a [dB rel. 1 m/s^2]", 10.0, "m/s^2"),
        ("p (dB re 20 uPa)", 2e-4, "Pa"),
        ("a (dB re 1e-6 m/s^2)", 1e-5, "m/s^2"),
        ("a (dB re 1e-6)", 1e-5, ""),
        ("a (dB)", 10.0, ""),
        (
            "S (dB re 1 g^2/Hz)",
            100.0 * 9.80665 * 9.80665,
            "(m/s^2)^2/Hz",
        ),
    ];
    for (head, expected, unit) in cases {
        let recording = one(
            "a.csv",
            format!("t (s),{head}\n0,0\n1,20\n2,3\n").as_bytes(),
            None,
        );
        let value = recording.channels[0].values[1];
        assert!((value / expected - 1.0).abs() < 1e-13, "{head}: {value}");
        assert_eq!(recording.channels[0].unit, unit, "{head}");
        assert!(kinds(&recording).contains(&IssueKind::Decibels), "{head}");
    }
}
