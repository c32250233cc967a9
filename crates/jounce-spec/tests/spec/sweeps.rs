//! Ranges of numeric keys, and repeated changes of numbers.

use jounce_spec::{NumericKey, Spec, SpecFile};

use crate::paper;

fn values(assignment: &str) -> Result<Vec<f64>, String> {
    let range = SpecFile::from_text(paper())
        .range(assignment)
        .map_err(|faults| faults.to_string())?;
    Ok(range.values().to_vec())
}

#[test]
fn all_faults_of_a_range_are_reported_at_once() {
    let message = values("drive.shaker.frequency=4mm:20kg:0x").unwrap_err();
    for part in [
        "\"4mm\" is a length",
        "\"20kg\" is a mass",
        "\"0\" is not a number of points",
    ] {
        assert!(message.contains(part), "{message}");
    }
    let message = values("drive.shaker.frequency=4mm,20Hz,3kg").unwrap_err();
    assert!(
        message.contains("is a length") && message.contains("is a mass"),
        "{message}"
    );
}

#[test]
fn steps_hit_the_decimal_values() {
    let points = values("drive.shaker.frequency=4Hz:20Hz:0.1Hz").unwrap();
    assert_eq!(points.len(), 161);
    for (index, point) in points.iter().enumerate() {
        let literal: f64 = format!("{}.{}", 4 + index / 10, index % 10)
            .parse()
            .unwrap();
        assert_eq!(point.to_bits(), literal.to_bits());
    }
    assert_eq!(
        values("stop.tip.gap=-1mm:1mm:500um").unwrap(),
        [-1e-3, -0.5e-3, 0.0, 0.5e-3, 1e-3]
    );
    assert_eq!(
        values("run.duration=1min:3min:1min").unwrap(),
        [60.0, 120.0, 180.0]
    );
    assert_eq!(
        values("mass.table.damping_ratio=0.1:0.35:0.1").unwrap(),
        [0.1, 0.2, 0.3]
    );
    assert_eq!(
        values("damping.ratios.7=0.1:0.35:0.1").unwrap(),
        [0.1, 0.2, 0.3]
    );
    assert_eq!(values("reduction.modes=1:3:1").unwrap(), [1.0, 2.0, 3.0]);
}

#[test]
fn counts_and_lists_hit_their_ends() {
    assert_eq!(
        values("drive.shaker.frequency = 4 Hz : 20 Hz : 5x").unwrap(),
        [4.0, 8.0, 12.0, 16.0, 20.0]
    );
    let points = values("circuit.load.resistance=1kohm:10Mohm:5log").unwrap();
    assert_eq!((points[0], points[4], points.len()), (1e3, 1e7, 5));
    assert!((points[2] / 1e5 - 1.0).abs() < 1e-14, "{}", points[2]);
    assert_eq!(
        values("drive.shaker.frequency=6Hz,4Hz,8Hz").unwrap(),
        [6.0, 4.0, 8.0]
    );
    assert_eq!(values("beam.beam.point.tip=300mm").unwrap(), [0.3]);
}

/// Range, and a part of the refusal.
const WRONG_RANGES: [(&str, &str); 24] = [
    (
        "drive.shaker.frequency=4Hz:20Hz:0.1mm",
        "\"0.1mm\" is a length; expected a frequency",
    ),
    (
        "drive.shaker.frequency=4:20:0.1",
        "4 has no unit; expected a frequency in Hz, kHz, 1/min",
    ),
    ("drive.shaker.frequency=20Hz:4Hz:0.1Hz", "is reversed"),
    (
        "drive.shaker.frequency=4Hz:20Hz:17Hz",
        "the step is larger than the range; make it smaller, or give one value",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz:0Hz",
        "the step is 0Hz; it must be greater than 0",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz:-1Hz",
        "the step is -1Hz; it must be greater than 0",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz:1uHz",
        "the range has more than 1000000 points; make the step larger",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz:1e-30Hz",
        "the range has more than 1000000 points; make the step larger",
    ),
    // Both ends are the same double.
    (
        "drive.shaker.frequency=10Hz:10.00000000000000001Hz:1e-29Hz",
        "the range has more than 1000000 points; make the step larger",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz:1x",
        "is not a number of points; give 2 to 1000000",
    ),
    (
        "drive.shaker.frequency=4Hz:20Hz",
        "is not a range; write FROM:TO:STEP",
    ),
    ("drive.shaker.frequency=", "does not start with a number"),
    ("drive.shaker.frequency", "expected KEY=FROM:TO:STEP"),
    (
        "drive.shaker.frequency=0Hz:20Hz:1Hz",
        "is 0; it must be from 1 uHz to 1 MHz",
    ),
    (
        "stop.tip.gap=-1mm:1mm:5log",
        "a logarithmic range must start above 0",
    ),
    (
        "reduction.modes=1:3:0.5",
        "is 1.5; it must be a whole number",
    ),
    (
        "drive.shaker.fequency=1Hz",
        "the nearest key here is `drive.shaker.frequency`",
    ),
    (
        "stop.tip.law=1Hz",
        "stop.tip.law is a name, not a number; give a key with a number",
    ),
    (
        "stop.tip.gap=1mm,2mm,1000um,2mm,3mm",
        "\"1mm,2mm,1000um,2mm,3mm\" has 1 mm, 2 mm more than once; give each value once",
    ),
    (
        "drive.shaker.frequency=10Hz:10Hz:3x",
        "\"10Hz:10Hz:3x\" has 10 Hz more than once",
    ),
    ("stop.tip.exponent=1:2:0.1", "cannot be varied alone"),
    (
        "damping.ratios=0.1:0.3:0.1",
        "this is a list; write one of damping.ratios.1 to damping.ratios.7",
    ),
    (
        "damping.ratios.9=0.1:0.3:0.1",
        "damping.ratios holds 7 numbers; write one of damping.ratios.1 to damping.ratios.7",
    ),
    (
        "damping.ratios.2=0.1:0.3:abc",
        "\"abc\" is not a plain number; expected a plain number",
    ),
];

#[test]
fn wrong_ranges_are_refused() {
    for (assignment, message) in WRONG_RANGES {
        let refusal = values(assignment).unwrap_err();
        assert!(refusal.contains(message), "{assignment}: {refusal}");
    }
}

#[test]
fn setting_a_number_is_editing_the_file() {
    for (key, si, text) in [
        ("beam.beam.length", 0.4, "400 mm"),
        ("beam.beam.point.tip", 0.3, "300 mm"),
        ("patch.mfc.d31", -1e-10, "-100 pC/N"),
        ("mass.table.mass", 10.0, "10 kg"),
        ("mass.table.frequency", 2.0, "2 Hz"),
        ("stop.tip.gap", -1e-3, "-1 mm"),
        ("stop.tip.stiffness", 2e3, "2 kN/m^1.5"),
        ("reduction.modes", 3.0, "3"),
        ("damping.ratios.3", 0.05, "0.05"),
        ("run.tolerance", 1e-9, "1e-9"),
    ] {
        let mut file = SpecFile::from_text(paper());
        let mut spec = file.spec().unwrap();
        file.numeric_key(key).unwrap().set(&mut spec, si).unwrap();
        file.set(key, text).unwrap();
        assert_eq!(spec, file.spec().unwrap(), "{key}");
    }
}

#[test]
fn a_refused_number_does_not_change_the_spec() {
    let before = Spec::from_toml(&paper()).unwrap();
    let mut spec = before.clone();
    for (key, value, message) in [
        (
            "patch.mfc.length",
            0.4,
            "patch.mfc.length = 400 mm: patch.mfc.length: the patch ends 409 mm from the root",
        ),
        (
            "beam.beam.length",
            0.3,
            "beam.beam.length = 300 mm: beam.beam.point.tip is 305 mm from the root",
        ),
        (
            "circuit.load.resistance",
            0.0,
            "is 0; it must be greater than 0",
        ),
        (
            "circuit.load.resistance",
            f64::NAN,
            "it must be greater than 0",
        ),
        (
            "reduction.modes",
            9.0,
            "damping.ratios has 7 numbers, but 9 modes are retained (1 of them damped by [mass] or [modal]), so 8 are required",
        ),
        ("reduction.modes", 1e300, "it must be from 1 to 200"),
        (
            "stop.tip.gap",
            1e300,
            "it must be 0 or have a magnitude from 1e-30 to 1e30 in SI units",
        ),
        (
            "circuit.load.resistance",
            1e-300,
            "it must be 0 or have a magnitude from 1e-30 to 1e30 in SI units",
        ),
        ("stop.tip.damping", 1.0, "no key with a number"),
        ("damping.ratios.8", 1.0, "damping.ratios holds 7 numbers"),
        (
            "damping.ratios.2",
            11.0,
            "damping.ratios.2 is 11; it must be from 0 to 10",
        ),
    ] {
        let fault = spec.set_si(key, value).unwrap_err().to_string();
        assert!(fault.contains(message), "{fault}");
        assert_eq!(spec, before);
    }
}

#[test]
fn the_last_of_many_set_numbers_holds() {
    let mut spec = Spec::from_toml(&paper()).unwrap();
    let key = NumericKey::find(&spec, "drive.shaker.frequency").unwrap();
    for index in 0..1_000 {
        key.set(&mut spec, 4.0 + 1e-5 * f64::from(index)).unwrap();
    }
    assert_eq!(key.get(&spec).unwrap(), 4.0 + 1e-5 * 999.0);
}

/// Differences and quotients of the ends are no doubles.
#[test]
fn ranges_over_all_doubles_are_finite() {
    let range = |text: &str| jounce_spec::quantity_range(jounce_spec::Quantity::Force, text);
    let values = range("-1e308 N:1e308 N:3x").expect("a range");
    assert_eq!(values, [-1e308, 0.0, 1e308]);
    let values = range("1e-300 N:1e300 N:3log").expect("a range");
    assert_eq!((values[0], values[2]), (1e-300, 1e300));
    assert!((values[1] - 1.0).abs() < 1e-12, "{values:?}");
}
