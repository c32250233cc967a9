//! A harvester between two stops: integrated, continued, its attractors.

use crate::{PLANT, assert_keys, jounce};
use serde_json::Value;

/// The plant between its stop and another behind it.
fn write_two_sided_spec(folder: &tempfile::TempDir) -> String {
    let negative_stop = "[stop.behind]\nat = \"harvester.tip\"\nframe = \"ground\"\nside = \"negative\"\nlaw = \"hertz\"\ngap = \"1.5 mm\"\nstiffness = \"2000 N/m^1.5\"\n";
    let path = folder.path().join("between.toml");
    std::fs::write(
        &path,
        format!(
            "{}\n{negative_stop}",
            std::fs::read_to_string(PLANT).unwrap()
        ),
    )
    .unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_run_between_two_stops_lists_both() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_two_sided_spec(&folder);
    let (code, json, text) = jounce(&[
        "run",
        &spec,
        "--json",
        "--set",
        "run.duration=4 s",
        "--set",
        "run.average_over=2 s",
    ]);
    assert_eq!(code, 0, "{text}");
    let stops = json["stops"].as_array().unwrap();
    stops.iter().for_each(|stop| {
        assert_keys(
            stop,
            &[
                "name",
                "contacts",
                "contact_duty",
                "max_penetration_m",
                "max_contact_force_n",
            ],
        )
    });
    assert_eq!(
        (&stops[0]["name"], &stops[1]["name"]),
        (&Value::from("behind"), &Value::from("tip"))
    );
    let count = |value: &Value| value["contacts"].as_u64().unwrap();
    assert!(
        count(&stops[0]) > 0
            && count(&stops[1]) > 0
            && count(&stops[0]) + count(&stops[1]) == count(&json),
        "{json}"
    );
    assert!(
        json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-6,
        "{json}"
    );
}

#[test]
fn a_branch_between_two_stops_is_the_same_by_both_methods() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_two_sided_spec(&folder);
    let branch = [
        "branch",
        &spec,
        "--over",
        "drive.shaker.frequency=11Hz:12Hz",
        "--seeds",
        "0",
        "--json",
    ];
    let (code, json, text) = jounce(&branch);
    assert_eq!(code, 0, "{text}");
    let points = json["branches"][0]["points"].as_array().unwrap();
    assert!(
        points
            .iter()
            .any(|point| point["contacts_per_period"].as_u64().unwrap() >= 2),
        "{json}"
    );
    let (code, balance_json, text) =
        jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert_eq!(code, 0, "{text}");
    let power = |json: &Value| {
        json["branches"][0]["points"][0]["mean_power_w"]
            .as_f64()
            .unwrap()
    };
    assert!(
        (power(&balance_json) / power(&json) - 1.0).abs() < 1e-5,
        "{} {}",
        power(&balance_json),
        power(&json)
    );
}

#[test]
fn basins_between_two_stops_have_attractors() {
    let folder = tempfile::tempdir().unwrap();
    let spec = write_two_sided_spec(&folder);
    let (code, json, text) = jounce(&["basins", &spec, "--starts", "6", "--seed", "3", "--json"]);
    assert!(
        code == 0 && !json["attractors"].as_array().unwrap().is_empty(),
        "{text}"
    );
}
