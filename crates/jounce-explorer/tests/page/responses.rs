//! Responses of the server, compared with results of the library.

use crate::client::{TestServer, paper};
use jounce::live::{Design, KeySpan, LiveAnalysis, ResponseOptions};
use jounce::{BasinsOptions, Control, Harvester};
use jounce_explorer::{ServerLimits, Source};
use serde_json::json;
use std::path::PathBuf;
use std::time::{Duration, Instant};

#[tokio::test]
async fn a_design_has_a_drawing_and_controls() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    page.send_request("design", json!({ "set": [["stop.tip.gap", "0.5 mm"]] }))
        .await;
    let response = page.receive_until("design", "done").await;
    assert!(
        response.head["drawing"]["svg"]
            .as_str()
            .unwrap()
            .contains("gap 0.5 mm")
    );
    let grips = response.head["drawing"]["grips"].as_array().unwrap();
    let keys: Vec<_> = grips
        .iter()
        .map(|grip| {
            (
                grip["kind"].as_str().unwrap(),
                grip["key"].as_str().unwrap(),
            )
        })
        .collect();
    let expected = [
        ("start", "patch.mfc.start"),
        ("end", "patch.mfc.length"),
        ("place", "beam.beam.point.tip"),
        ("gap", "stop.tip.gap"),
    ];
    assert_eq!(keys, expected);
    let gap = response.head["controls"]
        .as_array()
        .unwrap()
        .iter()
        .find(|control| control["key"] == "stop.tip.gap")
        .unwrap();
    assert_eq!(
        (
            gap["value"].as_f64(),
            gap["unit"].as_str(),
            gap["factor"].as_f64()
        ),
        (Some(0.5e-3), Some("mm"), Some(1e-3))
    );
}

/// Fault messages equal those of the command line.
#[tokio::test]
async fn a_wrong_value_is_reported_with_its_key() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    page.send_request(
        "design",
        json!({ "set": [["circuit.load.resistance", "-1 ohm"]] }),
    )
    .await;
    let response = page.receive_until("design", "fault").await;
    let mut harvester = Harvester::read(paper()).unwrap();
    let error = harvester.set("circuit.load.resistance", "-1 ohm");
    let expected = error.unwrap_err().to_string();
    assert_eq!(
        response.head["faults"][0]["message"].as_str(),
        Some(expected.as_str())
    );
    assert_eq!(response.head["faults"][0]["key"], "circuit.load.resistance");
}

/// The fine response equals that of the library number by number; the coarse one agrees at the ends.
#[tokio::test]
async fn a_response_equals_that_of_the_library() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let range = json!({ "over": "drive.shaker.frequency", "from": 12.6, "to": 13.0 });
    let id = page.send_request("response", range.clone()).await;
    let coarse = page.receive_until("response", "coarse").await;
    let fine = page.receive_until("response", "fine").await;
    let design = Design::new(&Harvester::read(paper()).unwrap(), &[]).unwrap();
    let span: KeySpan = serde_json::from_value(range).unwrap();
    let (options, control) = (ResponseOptions::default(), Control::default());
    let expected = LiveAnalysis::default()
        .fine_response(1, &design, &span, &options, &control)
        .unwrap();
    assert_eq!(
        fine.head["branches"].as_array().unwrap().len(),
        expected.branches.len()
    );
    for (k, branch) in expected.branches.iter().enumerate() {
        assert_eq!(fine.array(&format!("{k}.power")), branch.mean_power_w);
    }
    // The first coarse branch ends at the edges of the range, with the power of the fine one (relative difference 8e-6).
    let ends = |response: &crate::client::Response| {
        (response.array("0.x")[0], response.array("0.power")[0])
    };
    let (coarse_end, fine_end) = (ends(&coarse), ends(&fine));
    assert_eq!(coarse_end.0, fine_end.0);
    assert!(
        (coarse_end.1 / fine_end.1 - 1.0).abs() < 1e-4,
        "{coarse_end:?} {fine_end:?}"
    );

    page.send_request("orbit", json!({ "response": id, "branch": 0, "point": 0 }))
        .await;
    let orbit = page.receive_until("orbit", "done").await;
    assert!((orbit.head["mean_power_w"].as_f64().unwrap() / fine_end.1 - 1.0).abs() < 1e-6);
    let (motion, positions) = (orbit.array("motion.beam"), orbit.array("place.beam"));
    assert_eq!(
        motion.len(),
        positions.len() * orbit.head["pictures"].as_u64().unwrap() as usize
    );
    // The striking point has the same displacement in the beam motion (nearest position 305 mm) and in the history of the port.
    let index = positions
        .iter()
        .position(|position| (position - 0.305).abs() < 0.0035)
        .unwrap();
    let (frame_displacement, history_displacement) =
        (motion[index], orbit.array("displacement.0")[0]);
    assert!(
        (frame_displacement / history_displacement - 1.0).abs() < 0.05,
        "{frame_displacement} {history_displacement}"
    );
    // Half the peak-to-peak of the sampled displacement against that of the response.
    let displacement = orbit.array("displacement.0");
    let extreme = |pick: fn(f64, f64) -> f64| displacement.iter().copied().reduce(pick).unwrap();
    let half = 0.5 * (extreme(f64::max) - extreme(f64::min));
    let peak = fine.array("0.displacement")[0];
    assert!((half / peak - 1.0).abs() < 1e-3, "{half} {peak}");
    // RMS of the sampled voltage against the exact value of the flow.
    let voltage = orbit.array("voltage");
    let rms = (voltage.iter().map(|v| v * v).sum::<f64>() / voltage.len() as f64).sqrt();
    assert!(
        (rms / orbit.head["voltage_rms_v"].as_f64().unwrap() - 1.0).abs() < 1e-3,
        "{rms}"
    );
}

/// The basins of a plane of starts equal those of the library.
#[tokio::test]
async fn basins_equal_those_of_the_library() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let options = BasinsOptions {
        starts: 17,
        tolerance: 1e-6,
        ..Default::default()
    };
    let request = json!({ "starts": options.starts, "tolerance": options.tolerance });
    page.send_request("basins", request).await;
    let response = page.receive_until("basins", "done").await;
    let design = Design::new(&Harvester::read(paper()).unwrap(), &[]).unwrap();
    let plane = design.in_plane(&options).unwrap();
    let expected = design.harvester().basins(&plane).unwrap();
    assert_eq!(response.head["starts"], 16);
    assert_eq!(response.head["attractors"], json!(expected.attractors));
    let displacements: Vec<f64> = expected
        .points
        .iter()
        .map(|own| own.displacement_m)
        .collect();
    assert_eq!(response.array("displacement_m"), displacements);
    assert_eq!(response.array("attractor").len(), 16);
    page.send_request("basins", json!({ "starts": 3 })).await;
    let fault = page.receive_until("basins", "fault").await;
    let message = fault.head["faults"][0]["message"].as_str().unwrap();
    assert!(message.contains("starts is 3"), "{message}");
}

#[tokio::test]
async fn a_new_position_stops_the_old_computation() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    for k in 0..30 {
        let set = json!([["stop.tip.gap", format!("{} mm", 0.9 + 0.005 * f64::from(k))]]);
        page.send_request(
            "response",
            json!({ "set": set, "over": "drive.shaker.frequency", "from": 4.0, "to": 20.0 }),
        )
        .await;
    }
    page.send_request(
        "sweep",
        json!({ "over": "drive.shaker.frequency", "from": 4.0, "to": 20.0, "points": 400 }),
    )
    .await;
    page.send_request("stop", json!({ "what": "sweep" })).await;
    let request_time = Instant::now();
    let last = page
        .send_request(
            "response",
            json!({ "over": "drive.shaker.frequency", "from": 12.9, "to": 13.0 }),
        )
        .await;
    let response = page.receive_until("response", "coarse").await;
    assert_eq!(
        response.head["id"].as_u64(),
        Some(last),
        "responses to older positions are not sent"
    );
    assert!(request_time.elapsed() < Duration::from_secs(60));
}

#[tokio::test]
async fn the_page_follows_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("harvester.toml");
    let text = std::fs::read_to_string(paper()).unwrap();
    std::fs::write(&path, &text).unwrap();
    let server = TestServer::new(&path, ServerLimits::default());
    let mut page = server.page().await;
    std::fs::write(&path, text.replace("gap = \"1 mm\"", "gap = \"oops\"")).unwrap();
    page.receive_until("file", "done").await;
    page.send_request("design", json!({})).await;
    let response = page.receive_until("design", "fault").await;
    assert_eq!(
        (
            &response.head["faults"][0]["key"],
            response.head["faults"][0]["line"].as_u64()
        ),
        (&json!("stop.tip.gap"), Some(36))
    );
    std::fs::write(&path, text).unwrap();
    page.receive_until("file", "done").await;
    page.send_request("design", json!({})).await;
    page.receive_until("design", "done").await;
}

#[tokio::test]
async fn exported_text_is_the_design() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let set = json!([["stop.tip.gap", "0.5 mm"]]);
    page.send_request(
        "export",
        json!({ "set": set, "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0 }),
    )
    .await;
    let response = page.receive_until("export", "done").await;
    let text = response.head["spec"].as_str().unwrap();
    let harvester = Harvester::from_text(text, ".").unwrap();
    assert_eq!(harvester.get("stop.tip.gap").unwrap().value_si, 0.5e-3);
    let shell = response.head["shell"].as_str().unwrap();
    assert!(
        shell.ends_with("--over 'drive.shaker.frequency=12 Hz:13 Hz' --set 'stop.tip.gap=0.5 mm'"),
        "{shell}"
    );
}

/// A spec without a file takes the name under which the page would save it, and saves no address.
#[tokio::test]
async fn a_spec_without_a_file_is_served() {
    let state_folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(paper())
        .unwrap()
        .replace("gap = \"1 mm\"", "gap = \"2 mm\"");
    let source = Source::Text {
        text: text.clone(),
        folder: PathBuf::new(),
    };
    let server = TestServer::from_source(
        source,
        ServerLimits::default(),
        Some(state_folder.path().to_path_buf()),
    );
    let mut page = server.page().await;
    page.send_request("design", json!({})).await;
    page.receive_until("design", "done").await;
    page.send_request(
        "export",
        json!({ "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0 }),
    )
    .await;
    let response = page.receive_until("export", "done").await;
    assert_eq!(response.head["spec"].as_str(), Some(text.as_str()));
    assert!(
        response.head["python"]
            .as_str()
            .unwrap()
            .contains("jounce.read(\"harvester.toml\")")
    );
    assert!(
        response.head["shell"]
            .as_str()
            .unwrap()
            .starts_with("jounce branch harvester.toml ")
    );
    assert_eq!(std::fs::read_dir(state_folder.path()).unwrap().count(), 0);
}

/// The next server of a spec reuses the address of the previous one; a second server at the same time has another.
#[tokio::test]
async fn a_page_reconnects_to_the_next_server() {
    let folder = tempfile::tempdir().unwrap();
    let serve = || {
        TestServer::with_state_folder(
            &paper(),
            ServerLimits::default(),
            Some(folder.path().to_path_buf()),
        )
    };
    let first = serve();
    let (host, token) = (first.host.clone(), first.token.clone());
    let other = serve();
    assert!(other.host != host && other.token != token);
    drop((other, first));
    let latest = serve();
    let (host, token) = (latest.host.clone(), latest.token.clone());
    drop(latest);
    let next_server = serve();
    assert_eq!((&next_server.host, &next_server.token), (&host, &token));
    next_server.page().await;
}

#[tokio::test]
async fn numbers_are_saved_to_the_file_that_the_page_has_compared() {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("harvester.toml");
    std::fs::copy(paper(), &spec).unwrap();
    let server = TestServer::new(&spec, ServerLimits::default());
    let mut page = server.page().await;
    let set = json!([["stop.tip.gap", "0.7 mm"]]);
    let range = json!({ "set": set, "over": "drive.shaker.frequency", "from": 12.0, "to": 14.0 });
    page.send_request("export", range).await;
    let response = page.receive_until("export", "done").await;
    let before = response.head["file"].as_str().unwrap().to_owned();
    page.send_request("save", json!({ "set": set, "before": "another text" }))
        .await;
    let fault = page.receive_until("save", "fault").await;
    let message = fault.head["faults"][0]["message"].as_str().unwrap();
    assert!(message.contains("has changed meanwhile"), "{message}");
    assert_eq!(std::fs::read_to_string(&spec).unwrap(), before);
    page.send_request("save", json!({ "set": set, "before": before }))
        .await;
    page.receive_until("save", "done").await;
    let expected = before.replace(r#"gap = "1 mm""#, r#"gap = "0.7 mm""#);
    assert_eq!(std::fs::read_to_string(&spec).unwrap(), expected);
}
