//! Attractors at the operating point, with the peaks and warnings of their orbits.

use crate::client::{TestServer, paper};
use jounce::{Harvester, RunOptions};
use jounce_explorer::{ServerLimits, ServerOptions, Source};
use serde_json::{Value, json};

/// Strain limit, a key that the spec of the paper lacks.
const STRAIN_LIMIT: [&str; 2] = ["patch.mfc.strain_limit", "600 ppm"];

/// The peaks are those of `jounce run`, which integrates until the motion has settled.
#[tokio::test]
async fn the_peaks_and_warnings_are_those_of_a_run() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let changes = [STRAIN_LIMIT, ["drive.shaker.frequency", "13 Hz"]];
    page.send_request("operating-point", json!({ "set": changes, "starts": 10 }))
        .await;
    let response = page.receive_until("operating-point", "done").await;
    let harvester = Harvester::read(paper()).unwrap();
    let harvester = harvester.changed(changes.map(Into::into)).unwrap();
    let run = harvester.run(&RunOptions::default()).unwrap();
    let (peaks, patch) = (&response.head["peaks"][0], &run.patches[0]);
    for (found, expected) in [
        (&peaks["strain_peak"], patch.strain_peak),
        (&peaks["voltage_peak_v"], patch.voltage_peak_v),
    ] {
        let (found, expected) = (found.as_f64().unwrap(), expected.unwrap());
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
    assert_eq!(response.head["stops"], 1);
    let strain = &peaks["limits"][0];
    assert_eq!(strain["quantity"], "strain");
    assert_eq!(strain["limits"], json!([-600e-6, 600e-6]));
    let expected: Vec<String> = run.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(peaks["warnings"].as_array().unwrap().len(), expected.len());
}

/// Each attractor has the warning of its own orbit: here the beam deflects too far for the linear
/// model.
#[tokio::test]
async fn every_attractor_has_its_warnings() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let set = json!([["drive.shaker.frequency", "12.56 Hz"]]);
    page.send_request("operating-point", json!({ "set": set, "starts": 20 }))
        .await;
    let response = page.receive_until("operating-point", "done").await;
    let (attractors, peaks) = (&response.head["attractors"], &response.head["peaks"]);
    let count = attractors.as_array().unwrap().len();
    assert_eq!((count > 1, peaks.as_array().unwrap().len()), (true, count));
    let first = peaks[0]["warnings"][0].as_str().unwrap();
    assert!(first.contains("its deflection reaches"), "{first}");
}

/// A key that the spec lacks is set by `--set` and by the page; no path can be set.
#[tokio::test]
async fn a_number_that_the_spec_lacks_can_be_set() {
    let server = TestServer::with_options(ServerOptions {
        spec: Source::File(paper()),
        set: vec![STRAIN_LIMIT.map(str::to_owned).into()],
        view: None,
        page: Vec::new(),
        listen: None,
        proxy: None,
        frames: false,
        state_folder: None,
        limits: ServerLimits::default(),
    });
    let origin = format!("http://{}", server.host);
    let mut page = server.open(&server.token, Some(&origin)).await.unwrap();
    let hello = page.receive().await.unwrap().head;
    page.send_request("design", json!({ "set": hello["set"] }))
        .await;
    let design = page.receive_until("design", "done").await;
    let controls = design.head["controls"].as_array().unwrap();
    let control = controls.iter().find(|own| own["key"] == STRAIN_LIMIT[0]);
    assert_eq!(control.map(|own| &own["value"]), Some(&json!(600e-6)));
    assert_eq!(design.head["optional"], json!([]));
    page.send_request("design", json!({})).await;
    let unset = page.receive_until("design", "done").await;
    assert_eq!(unset.head["optional"][0]["key"], STRAIN_LIMIT[0]);
    for (key, value) in [
        ("patch.mfc.strain_limit", "-5"),
        ("patch.mfc.strain_limits", "600 ppm"),
        ("patch.mfc.material", "/etc/passwd"),
        ("drive.shaker.recording", "/etc/passwd"),
    ] {
        page.send_request("design", json!({ "set": [[key, value]] }))
            .await;
        let fault = page.receive_until("design", "fault").await.head;
        assert_ne!(fault["faults"][0]["message"], Value::Null, "{key}: {fault}");
    }
}
