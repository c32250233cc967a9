//! Tables of force over penetration: reading, sweeps, static penetration and invalid points.

use jounce_spec::{NumericKey, Spec, SpecFile, StopLaw};

fn text(keys: &str) -> String {
    format!(
        "[mass.ball]\nmass = \"4 g\"\nfrequency = \"10 Hz\"\ndamping_ratio = 0.01\n\
         [stop.s]\nat = \"ball\"\nlaw = \"table\"\ngap = \"1 mm\"\n{keys}\n"
    )
}

#[test]
fn a_table_is_read_printed_and_swept() {
    let mut spec = Spec::from_toml(&text(
        "penetration_m = [0, 1e-5, 3e-5]\nforce_n = [0, 2, 8.5]\n",
    ))
    .unwrap();
    assert_eq!(spec.stop["s"].law, StopLaw::Table { damping_s_m: 0.0 });
    let curve = spec.stop["s"].table.curve().unwrap();
    assert_eq!([1e-5, 3e-5].map(|at| curve.force_n(at)), [2.0, 8.5]);
    let short = Spec::from_toml(&text(
        "penetration_m = [1e-5, 3e-5]\nforce_n = [2, 8.5]\ndamping = \"0 s/m\"\n",
    ))
    .unwrap();
    assert_eq!(short.stop["s"].table.curve().unwrap(), curve);
    assert_eq!(Spec::from_toml(&spec.to_toml()).unwrap(), spec);

    let pressed_m = |spec: &Spec| spec.stop["s"].static_penetration_m(2.0).unwrap();
    assert!((pressed_m(&spec) - 1e-5).abs() < 1e-18);
    let force = NumericKey::find(&spec, "stop.s.force_n.2").unwrap();
    force.set(&mut spec, 4.0).unwrap();
    assert!(pressed_m(&spec) < 1e-5);
    let fault = force.set(&mut spec, 9.0).unwrap_err().to_string();
    assert!(
        fault.contains("after 9 N; each number must be at least"),
        "{fault}"
    );
    let damping = NumericKey::find(&spec, "stop.s.damping").unwrap();
    damping.set(&mut spec, 0.3).unwrap();
    assert_eq!(spec.stop["s"].law, StopLaw::Table { damping_s_m: 0.3 });
}

#[test]
fn points_with_units_are_those_in_si() {
    let si = Spec::from_toml(&text("penetration_m = [1e-5, 3e-5]\nforce_n = [2, 8.5]")).unwrap();
    let keys = "penetration = [\"10 um\", \"0.03 mm\"]\nforce = [\"2 N\", \"8500 mN\"]";
    let with_units = Spec::from_toml(&text(keys)).unwrap();
    assert_eq!(with_units, si);
    let mixed = "penetration = [\"10 um\", \"0.03 mm\"]\nforce_n = [2, 8.5]";
    assert_eq!(Spec::from_toml(&text(mixed)).unwrap(), si);

    let mut file = SpecFile::from_text(text(keys));
    file.set("stop.s.force.2", "9 N").unwrap();
    assert_eq!(file.spec().unwrap().stop["s"].table.force_n, [2.0, 9.0]);
    let key = file.numeric_key("stop.s.penetration.1").unwrap();
    assert_eq!(
        (key.unit().as_str(), key.show(1e-5)),
        ("m", "10 um".to_owned())
    );
    assert_eq!(file.numeric_keys("stop.s.penetration").unwrap().len(), 2);
    file.set("stop.s.penetration_m", "[1e-5, 4e-5]").unwrap();
    assert_eq!(
        file.spec().unwrap().stop["s"].table.penetration_m,
        [1e-5, 4e-5]
    );
}

fn with_file(name: &str, contents: &str) -> Result<Spec, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), contents).unwrap();
    let file = SpecFile::from_text(text("file = \"contact.csv\"")).in_folder(folder.path());
    file.spec().map_err(|faults| faults.to_string())
}

#[test]
fn points_in_a_file_are_those_in_the_spec() {
    let si = Spec::from_toml(&text(
        "penetration_m = [0, 1e-5, 2e-5, 3e-5]\nforce_n = [0, 2, 5, 8.5]",
    ))
    .unwrap();
    for contents in [
        "penetration [um],force [N]\n0,0\n10,2\n20,5\n30,8.5\n",
        "penetration_m,force_n\n0,0\n1e-5,2\n2e-5,5\n3e-5,8.5\n",
        "F (mN);x (mm)\n0;0\n2000;0.01\n5000;0.02\n8500;0.03\n",
        "point,penetration [um],temperature [degC],force [N]\n1,0,20,0\n2,10,20,2\n3,20,20,5\n4,30,20,8.5\n",
    ] {
        let mut read = with_file("contact.csv", contents).unwrap();
        if contents.starts_with("penetration_m") {
            assert_eq!(read.hash_hex(), si.hash_hex());
        }
        // A factor from the unit of a file may round the last bit.
        let table = &mut read.stop.get_mut("s").unwrap().table;
        let expected = &si.stop["s"].table;
        for (values, expected) in [
            (&mut table.penetration_m, &expected.penetration_m),
            (&mut table.force_n, &expected.force_n),
        ] {
            for (value, expected) in values.iter_mut().zip(expected) {
                assert!((*value - expected).abs() <= 3e-16 * expected, "{contents}");
                *value = *expected;
            }
        }
        assert_eq!(read, si, "{contents}");
    }
    // A column that counts 1, 2, 3 is a penetration where it has a unit of length.
    let contents = "penetration [um],force [N]\n0,0\n1,2\n2,5\n3,8.5\n";
    let read = with_file("contact.csv", contents).unwrap();
    assert_eq!(
        read.stop["s"].table.penetration_m,
        [0, 1, 2, 3].map(|k| f64::from(k) * 1e-6)
    );
}

/// Before a file both lists give way, and before a list the file, which has the other list too.
#[test]
fn a_file_that_is_set_replaces_both_lists_of_points() {
    let folder = tempfile::tempdir().unwrap();
    let points = "penetration_m,force_n\n1e-5,1\n2e-5,3\n";
    std::fs::write(folder.path().join("contact.csv"), points).unwrap();
    for lists in [
        "penetration_m = [1e-5, 3e-5]\nforce_n = [2, 8.5]",
        "penetration = [\"10 um\"]\nforce = [\"2 N\"]",
    ] {
        let mut file = SpecFile::from_text(text(lists)).in_folder(folder.path());
        file.set("stop.s.file", "contact.csv").unwrap();
        for file in [&file, &file.written()] {
            let table = &file.spec().unwrap().stop["s"].table;
            let read = (&table.penetration_m[..], &table.force_n[..]);
            assert_eq!(read, (&[1e-5, 2e-5][..], &[1.0, 3.0][..]));
        }
        file.set("stop.s.force_n", "[2, 9]").unwrap();
        let fault = file.spec().unwrap_err().to_string();
        assert!(
            fault.contains("one of `penetration_m` or `penetration` or `file` is missing"),
            "{fault}"
        );
    }
}

#[test]
fn files_without_a_force_table_are_reported() {
    let cases = [
        ("other.csv", "a,b\n1,2\n", "stop.s.file: "),
        ("other.csv", "a,b\n1,2\n", "contact.csv"),
        ("contact.csv", "", "it is empty"),
        (
            "contact.csv",
            "a,b\n1,2\n2,3\n3,5\n",
            "contact.csv: no column is in a unit of length; the columns are a, b; write the unit in the header, as in length [mm]",
        ),
        (
            "contact.csv",
            "x [mm],u [V]\n1,2\n2,3\n3,5\n",
            "no column is in a unit of force; the columns are x (m), u (V)",
        ),
        (
            "contact.csv",
            "x [mm],y [mm],F [N]\n1,2,1\n2,3,2\n3,5,4\n",
            "several columns are in a unit of length: x (m), y (m)",
        ),
        (
            "contact.csv",
            "x [mm],F [N]\n0,1\n2,3\n3,5\n",
            "column F has 1 N at zero penetration",
        ),
        (
            "contact.csv",
            "x [mm],F [N]\n0,0\n2,3\n3,2\n4,7\n",
            "column F has 2 N as number 3, after 3 N; each number must be at least the one before it; smooth a measured table first",
        ),
        (
            "contact.csv",
            "x [mm],F [N]\n0,0\n2,3\n1,4\n4,7\n",
            "column x has 0.001 m as number 3, after 0.002 m; each number must be larger",
        ),
        (
            "contact.csv",
            "x [mm],F [N]\n-1,0\n2,3\n4,7\n",
            "column x has -0.001 m as number 1; it must be at least 0",
        ),
    ];
    for (name, contents, message) in cases {
        let found = with_file(name, contents).unwrap_err();
        assert!(found.contains(message), "{contents}\n{found}");
        assert!(found.contains("stop.s.file"), "{found}");
    }
    let keys = "file = \"contact.csv\"\nforce_n = [1, 2]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    assert!(
        found.contains("give exactly one of `force_n` or `force` or `file`"),
        "{found}"
    );
}

fn check_faults(cases: &[(&str, &str)]) {
    for (keys, message) in cases {
        let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
        assert!(found.contains(message), "{keys}\n{found}");
    }
}

#[test]
fn invalid_lists_are_reported() {
    check_faults(&[
        (
            "",
            "one of `penetration_m` or `penetration` or `file` is missing",
        ),
        ("", "one of `force_n` or `force` or `file` is missing"),
        (
            "penetration = [0.01, 0.03]\nforce_n = [1, 2]",
            "stop.s.penetration: number 1: 0.01 has no unit; expected a length in quotes with a unit",
        ),
        (
            "penetration = [\"10 um\", \"1 V\"]\nforce = [\"1 N\", \"2 N\"]",
            "number 2: \"1 V\" is a voltage",
        ),
        (
            "penetration = \"10 um, 30 um\"\nforce_n = [1, 2]",
            "expected a list of texts, each a length with a unit (mm, um, cm, m), such as [\"1 mm\", \"2 mm\"]",
        ),
        (
            "penetration = [\"10 um\"]\npenetration_m = [1e-5]\nforce_n = [1]",
            "give exactly one of `penetration_m` or `penetration` or `file`",
        ),
        (
            "penetration = [\"-1 um\"]\nforce_n = [1]",
            "number 1 is -1 um; it must be at least 0",
        ),
        ("penetration_m = [1e-5]\nforce_n = []", "the list is empty"),
        (
            "penetration_m = [\"1 mm\"]\nforce_n = [2]",
            "expected a plain number",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [2]\nstiffness = \"1 N/m\"",
            "stiffness does not apply with law = \"table\"",
        ),
    ]);
}

#[test]
fn invalid_points_are_reported() {
    check_faults(&[
        (
            "penetration_m = [1e-5]\nforce_n = [1, 2]",
            "stop.s.force_n has 2 numbers, but penetration_m has 1",
        ),
        (
            "penetration_m = [2e-5, 1e-5]\nforce_n = [1, 2]",
            "stop.s.penetration_m has 0.00001 m as number 2, after 0.00002 m; each number must be larger",
        ),
        (
            "penetration_m = [1e-5, 2e-5]\nforce_n = [2, 1]",
            "stop.s.force_n has 1 N as number 2, after 2 N; each number must be at least the one before it",
        ),
        (
            "penetration_m = [1e-5, 2e-5]\nforce_n = [2, 2]",
            "stop.s.force_n has 2 N at the last point, no more than the force before it",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [0]",
            "stop.s.force_n has 0 N at the last point",
        ),
        (
            "penetration_m = [0]\nforce_n = [0]",
            "has only the point at 0",
        ),
        (
            "penetration_m = [0, 1e-5]\nforce_n = [1, 2]",
            "has 1 N at zero penetration",
        ),
        (
            "penetration_m = [1e-5]\nforce_n = [-2]",
            "must be at least 0",
        ),
    ]);
}

#[test]
fn a_fault_is_placed_at_the_key_that_was_written() {
    let keys = "penetration = [\"20 um\", \"10 um\"]\nforce = [\"2 N\", \"1 N\"]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    for message in [
        "line 9, column 15: stop.s.penetration has 0.00001 m as number 2, after 0.00002 m",
        "line 10, column 9: stop.s.force has 1 N as number 2, after 2 N",
    ] {
        assert!(found.contains(message), "{message}\n{found}");
    }
}

#[test]
fn all_faults_of_a_table_are_reported() {
    let keys = "penetration_m = [0, 2e-5, 1e-5, 3e-5]\nforce_n = [1, 3, 2, 2]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    for message in [
        "stop.s.force_n has 1 N at zero penetration",
        "stop.s.penetration_m has 0.00001 m as number 3",
        "stop.s.force_n has 2 N as number 3, after 3 N",
        "stop.s.force_n has 2 N at the last point",
    ] {
        assert!(found.contains(message), "{message}\n{found}");
    }
    let keys = "penetration_m = [3e-5, 2e-5, 1e-5]\nforce_n = [3, 2, 4, 5]";
    let found = Spec::from_toml(&text(keys)).unwrap_err().to_string();
    assert!(
        found.contains("has 4 numbers")
            && found.contains("as number 2, after 0.00003 m")
            && found.contains("as number 3, after 0.00002 m"),
        "{found}"
    );
}
