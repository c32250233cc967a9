//! Structs, cells, axes and integers of MAT files.

use super::containers::{all, names, ramp, sine};
use super::through_a_file::{kinds, one, read};
use super::writers::mat::{Value, column, file, one as fields};
use jounce_data::recording::{IssueKind, Over};

/// A typical laboratory layout: `data.time`, `data.signal(1).values` with names and units next to
/// them.
fn nested() -> Value {
    let signal = |name, unit, phase| {
        vec![
            column(&sine(200, phase)),
            Value::Text(name),
            Value::Text(unit),
        ]
    };
    let signals = Value::Structs(
        vec!["values", "label", "unit"],
        vec![signal("tip", "g", 0.0), signal("drive", "mV", 1.0)],
    );
    fields(vec![
        ("time", column(&ramp(200, 1e-3))),
        ("signal", signals),
        ("comment", Value::Text("run 3")),
        ("gain", column(&[3.0])),
    ])
}

#[test]
fn structs_and_cells_of_any_depth_are_read() {
    for compressed in [false, true] {
        let recording = one("a.mat", &file(&[("data", nested())], compressed), None);
        assert_eq!(
            names(&recording),
            [("tip", "m/s^2"), ("drive", "V")],
            "{compressed}"
        );
        assert!((recording.rate() - 1000.0).abs() < 1e-9);
        assert_eq!(
            recording.channels[0].values,
            sine(200, 0.0)
                .iter()
                .map(|x| x * 9.806_65)
                .collect::<Vec<f64>>()
        );
        let deep = (0..30).fold(nested(), |inside, _| {
            Value::Cell(vec![fields(vec![("x", inside)])])
        });
        let recording = one("a.mat", &file(&[("deep", deep)], compressed), None);
        assert_eq!(names(&recording), [("tip", "m/s^2"), ("drive", "V")]);
        let cell = Value::Cell(vec![column(&ramp(50, 0.5)), column(&sine(50, 0.0))]);
        let recording = one(
            "a.mat",
            &file(
                &[("c", cell), ("time", column(&ramp(50, 0.01)))],
                compressed,
            ),
            None,
        );
        assert_eq!(names(&recording), [("c{1}", ""), ("c{2}", "")]);
    }
    let too_deep = (0..200).fold(nested(), |inside, _| Value::Cell(vec![inside]));
    let message = read("a.mat", &file(&[("deep", too_deep)], false), None)
        .expect_err("too deep")
        .to_string();
    assert!(message.contains("more than 100 structs"), "{message}");
}

/// Each array is assigned to the nearest time or frequency of its length; equal times form one
/// recording.
#[test]
fn several_grids_in_one_file_are_several_recordings() {
    let run = |count, step, phase| {
        fields(vec![
            ("t", column(&ramp(count, step))),
            ("acc", column(&sine(count, phase))),
        ])
    };
    let response = Value::Complex(vec![100, 2, 2], sine(400, 0.0), sine(400, 1.0));
    let bytes = file(
        &[
            ("run1", run(200, 1e-3, 0.0)),
            ("run2", run(200, 2e-3, 1.0)),
            ("run3", run(200, 1e-3, 2.0)),
            (
                "frf",
                fields(vec![("freq", column(&ramp(100, 0.25))), ("h", response)]),
            ),
            ("odd", column(&ramp(77, 1.0))),
        ],
        true,
    );
    let contents = all("a.mat", &bytes);
    let summary: Vec<_> = contents
        .recordings
        .iter()
        .map(|one| (one.over, names(one)))
        .collect();
    let h = ["frf.h(1,1)", "frf.h(2,1)", "frf.h(1,2)", "frf.h(2,2)"].map(|name| (name, ""));
    let expected = [
        (Over::Time, vec![("run1.acc", ""), ("run3.acc", "")]),
        (Over::Time, vec![("run2.acc", "")]),
        (Over::Frequency, h.to_vec()),
    ];
    assert_eq!(summary, expected);
    assert_eq!(contents.recordings[1].channels[0].values, sine(200, 1.0));
    let h12 = &contents.recordings[2].channels[2];
    assert_eq!(h12.values, sine(400, 0.0)[200..300]);
    assert_eq!(h12.imaginary.as_deref(), Some(&sine(400, 1.0)[200..300]));
    let about: Vec<String> = contents.issues.iter().map(ToString::to_string).collect();
    assert!(
        about
            .iter()
            .any(|about| about.contains("odd has 77 samples")),
        "{about:?}"
    );
    assert!(
        contents.recordings[0].name.ends_with("1: run1"),
        "{}",
        contents.recordings[0].name
    );
}

/// Exports of Simcenter Testlab: a start, a step and the quantity of each axis.
#[test]
fn an_axis_may_be_specified_by_numbers() {
    let axis = |step, unit| {
        let quantity = fields(vec![("label", Value::Text(unit))]);
        fields(vec![
            ("start_value", column(&[0.5])),
            ("increment", column(&[step])),
            ("quantity", quantity),
        ])
    };
    let signal = |step, axis_unit, unit| {
        let y = fields(vec![
            ("values", column(&sine(90, 0.0))),
            ("quantity", fields(vec![("label", Value::Text(unit))])),
        ]);
        fields(vec![("x_values", axis(step, axis_unit)), ("y_values", y)])
    };
    let contents = all(
        "a.mat",
        &file(
            &[
                ("Signal", signal(1e-3, "s", "g")),
                ("PSD", signal(0.25, "Hz", "V")),
            ],
            true,
        ),
    );
    let summary: Vec<_> = contents
        .recordings
        .iter()
        .map(|one| (one.over, one.grid.at(0), one.grid.at(89), names(one)))
        .collect();
    assert_eq!(
        summary[0],
        (
            Over::Time,
            0.5,
            0.5 + 89.0 * 1e-3,
            vec![("Signal.y_values.values", "m/s^2")]
        )
    );
    assert_eq!(
        summary[1],
        (
            Over::Frequency,
            0.5,
            0.5 + 89.0 * 0.25,
            vec![("PSD.y_values.values", "V")]
        )
    );
}

#[test]
fn integers_and_objects_in_matlab_files() {
    let short: Vec<i16> = (-20..20).map(|k| k * 7 % 40 * 800).collect();
    let recording = one(
        "a.mat",
        &file(
            &[("x", Value::Short(short.clone())), ("fs", column(&[100.0]))],
            false,
        ),
        None,
    );
    assert!(
        recording.channels[0]
            .values
            .iter()
            .zip(&short)
            .all(|(a, b)| *a == f64::from(*b))
    );
    assert!(kinds(&recording).contains(&IssueKind::RawCounts));
}
