//! Orbits under gravity.

use crate::jounce;

/// A ball on a vibrating table, restitution 0.8: period one from `pi / 9` g to 1.070836468 g. Slow balls come to rest on it.
const TABLE: &str = "[mass.ball]\non = \"nothing\"\nmass = \"1 g\"\n\
    [stop.t]\nat = \"ball\"\nside = \"negative\"\nlaw = \"rigid\"\ngap = \"0 mm\"\nrestitution = 0.8\n\
    [gravity]\nacceleration = \"-1 g\"\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"0.9 g\"\nfrequency = \"10 Hz\"\n[reduction]\nmodes = 1\n";

#[test]
fn shooting_continues_the_ball_on_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.toml");
    std::fs::write(&path, TABLE).unwrap();
    let branch = [
        "branch",
        path.to_str().unwrap(),
        "--over",
        "drive.b.amplitude=0.85g:0.9g",
        "--seeds",
        "0",
        "--json",
    ];
    let (code, json, text) = jounce(&branch);
    assert_eq!(code, 0, "{text}");
    let points = json["branches"][0]["points"].as_array().unwrap();
    // A complex pair of determinant `e^2` has the modulus `e`.
    let modulus = |point: &serde_json::Value| point["floquet_max_abs"].as_f64().unwrap();
    assert!(
        points
            .iter()
            .all(|point| point["contacts_per_period"] == 1 && (modulus(point) - 0.8).abs() < 1e-9),
        "{json}"
    );
    // A ball without a patch delivers no power of which there could be a half.
    assert!(json["half_power_bandwidth"].is_null(), "{json}");
    let (code, _, text) = jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert!(code == 4 && text.contains("rigid"), "{code} {text}");
    let soft = std::fs::read_to_string(&path).unwrap();
    std::fs::write(
        &path,
        soft.replace("law = \"rigid\"", "law = \"spring\"")
            .replace("restitution = 0.8", "stiffness = \"1 kN/m\""),
    )
    .unwrap();
    let (code, _, text) = jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert!(
        code == 4 && text.contains("no stiffness") && text.contains("use the method shooting"),
        "{code} {text}"
    );
}

/// Without power the branch gives the flight height of the ball: of a period one with one impact that leaves at `v`, `T = 2 v / g`, it rises by
/// `g T^2 / 8` over the table, which moves little beside that.
#[test]
fn a_branch_without_power_prints_the_displacement() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.toml");
    std::fs::write(&path, TABLE).unwrap();
    let branch = [
        "branch",
        path.to_str().unwrap(),
        "--over",
        "drive.b.amplitude=0.85g:0.9g",
        "--seeds",
        "0",
    ];
    let (code, json, text) = jounce(&[&branch[..], &["--json"]].concat());
    assert_eq!(code, 0, "{text}");
    let points = json["branches"][0]["points"].as_array().unwrap();
    let rise_m = 9.80665 * 0.1_f64.powi(2) / 8.0;
    for point in points {
        let swing_m = 2.0 * point["displacement_peak_m"].as_f64().unwrap();
        assert!(
            (swing_m / rise_m - 1.0).abs() < 0.35,
            "{swing_m} m of {rise_m} m"
        );
        assert!(!point["mean_power_w"].as_f64().unwrap().is_sign_negative());
    }
    let (_, _, text) = jounce(&branch);
    assert!(!text.contains("-0.0"), "{text}");
    // Nothing to strike and nothing to harvest: the linear response.
    let spec_text = "[mass.m]\non = \"ground\"\nmass = \"1 g\"\nstiffness = \"1 N/m\"\ndamping_ratio = 0.02\n\
        [drive.b]\nkind = \"base-acceleration\"\namplitude = \"0.9 g\"\nfrequency = \"10 Hz\"\n";
    std::fs::write(&path, spec_text).unwrap();
    let (code, _, text) = jounce(&branch);
    assert!(
        code == 4 && text.contains("neither a stop nor a circuit"),
        "{code} {text}"
    );
}
