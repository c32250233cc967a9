//! Strain limits as plain numbers and with units.

use jounce_spec::{Spec, SpecFile};

fn text(limit: &str) -> String {
    format!(
        "[beam.b]\nmaterial = \"brass\"\nlength = \"50 mm\"\nwidth = \"30 mm\"\nthickness = \"0.5 mm\"\n\
         [damping]\nbeyond = 0.02\n\
         [patch.p]\non = \"b\"\nmaterial = \"PZT-5A\"\nstart = \"0 mm\"\nlength = \"20 mm\"\nwidth = \"30 mm\"\n\
         thickness = \"0.2 mm\"\nelectrodes = \"open\"\nstrain_limit = {limit}\n"
    )
}

#[test]
fn a_strain_limit_is_a_number_or_has_a_unit() {
    let expected = Spec::from_toml(&text("4e-4")).unwrap();
    assert_eq!(expected.patch["p"].strain_limit, Some(4e-4));
    for limit in [
        "0.0004",
        "\"400 ppm\"",
        "\"400 ustrain\"",
        "\"0.04 %\"",
        "\"0.4 mm/m\"",
        "\"4e-4 strain\"",
    ] {
        assert_eq!(Spec::from_toml(&text(limit)).unwrap(), expected, "{limit}");
    }
    assert_eq!(Spec::from_toml(&expected.to_toml()).unwrap(), expected);
}

#[test]
fn strain_limits_are_overridden_and_swept_in_both_forms() {
    let mut file = SpecFile::from_text(text("4e-4"));
    for (value, expected) in [("500 ppm", 5e-4), ("6e-4", 6e-4), ("0.07%", 7e-4)] {
        file.set("patch.p.strain_limit", value).unwrap();
        assert_eq!(file.spec().unwrap().patch["p"].strain_limit, Some(expected));
    }
    for range in [
        "400ppm:600ppm:100ppm",
        "4e-4:6e-4:1e-4",
        "4e-4,500ppm,0.06%",
    ] {
        let range = file
            .range(&format!("patch.p.strain_limit={range}"))
            .unwrap();
        assert_eq!(range.values(), [4e-4, 5e-4, 6e-4]);
    }
}

#[test]
fn wrong_strain_limits_are_reported() {
    for (limit, message) in [
        (
            "\"400\"",
            "400 has no unit; expected a strain in ppm, ustrain, %, um/m",
        ),
        ("\"400 mm\"", "is a length"),
        (
            "true",
            "expected a plain number without quotes, or a strain in quotes with a unit: ppm, ustrain, %, um/m; found",
        ),
        ("\"-4 ppm\"", "is -4 ppm; it must be greater than 0"),
        ("0", "must be greater than 0"),
    ] {
        let found = Spec::from_toml(&text(limit)).unwrap_err().to_string();
        assert!(found.contains(message), "{limit}: {found}");
    }
}
