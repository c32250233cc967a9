//! Orbits under gravity.

use crate::jounce;

/// A ball on a vibrating table, restitution 0.8: period one from `pi / 9` g to 1.070836468 g. Slow balls come to rest on it.
const TABLE: &str = "[mass.ball]\non = \"nothing\"\nmass = \"1 g\"\n\
    [stop.t]\nat = \"ball\"\nside = \"negative\"\nlaw = \"rigid\"\ngap = \"0 mm\"\nrestitution = 0.8\n\
    [gravity]\nacceleration = \"-1 g\"\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"0.9 g\"\nfrequency = \"10 Hz\"\n[reduction]\nmodes = 1\n";

#[test]
fn the_ball_on_a_table_is_followed_by_shooting() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.toml");
    std::fs::write(&path, TABLE).unwrap();
    let branch = ["branch", path.to_str().unwrap(), "--over", "drive.b.amplitude=0.85g:0.9g", "--seeds", "0", "--json"];
    let (code, json, text) = jounce(&branch);
    assert_eq!(code, 0, "{text}");
    let points = json["branches"][0]["points"].as_array().unwrap();
    // A complex pair of determinant `e^2` has the modulus `e`.
    let modulus = |point: &serde_json::Value| point["floquet_max_abs"].as_f64().unwrap();
    assert!(points.iter().all(|point| point["contacts_per_period"] == 1 && (modulus(point) - 0.8).abs() < 1e-9), "{json}");
    // A ball without a patch delivers no power of which there could be a half.
    assert!(json["half_power_bandwidth"].is_null(), "{json}");
    let (code, _, text) = jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert!(code == 4 && text.contains("rigid"), "{code} {text}");
    let soft = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, soft.replace("law = \"rigid\"", "law = \"spring\"").replace("restitution = 0.8", "stiffness = \"1 kN/m\""))
        .unwrap();
    let (code, _, text) = jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert!(code == 4 && text.contains("gravity; use the method shooting"), "{code} {text}");
}
