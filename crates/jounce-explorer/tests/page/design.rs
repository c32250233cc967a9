//! Search for a design and the band of the power, compared with the library.

use crate::client::{TestServer, paper};
use jounce::live::DesignFields;
use jounce::{DesignOptions, Harvester};
use jounce_explorer::ServerLimits;
use serde_json::{Value, json};

const LOAD: &str = "circuit.load.resistance";

fn fields(evaluations: u32) -> Value {
    json!({
        "free": [[LOAD, "10 kohm:3 Mohm:log"]], "maximise": "expected-power", "starts": "4",
        "limits": [["patch.mfc.strain", "600 ppm"]], "evaluations": evaluations.to_string(),
    })
}

/// The result is that of the library, and the better designs lead to it.
#[tokio::test]
async fn a_search_sends_better_designs_and_the_result_of_the_library() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    page.send_request("design-search", fields(40)).await;
    let file = page.receive_until("design-search", "file").await;
    let better = page.receive_until("design-search", "better").await;
    let done = page.receive_until("design-search", "done").await;
    let fields: DesignFields = serde_json::from_value(fields(40)).unwrap();
    assert_eq!(file.head["file"], fields.text(Some("harvester.toml")));
    let design = Harvester::read(paper()).unwrap();
    let design = design.design(&fields.text(None)).unwrap();
    let expected = design.run(&DesignOptions::default()).unwrap().outcome;
    assert_eq!(done.head["best"], json!(expected.best));
    assert_eq!(done.head["limits"], json!(expected.limits));
    assert_eq!(better.head["goal"], json!(expected.trace[0].goal));
    assert_eq!(better.head["limits"][0]["name"], "patch.mfc.strain");
    let (key, text) = (&done.head["shown"][0][0], &done.head["shown"][0][1]);
    assert_eq!(key, LOAD);
    assert!(text.as_str().unwrap().ends_with(" Mohm"), "{text}");
}

#[tokio::test]
async fn faults_have_the_table_and_the_key_of_their_field() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    page.send_request("design-offer", json!({})).await;
    let offer = page.receive_until("design-offer", "done").await;
    let limits = offer.head["limits"].as_array().unwrap();
    let strain = limits.iter().find(|one| one["name"] == "patch.mfc.strain");
    let expected =
        json!({ "name": "patch.mfc.strain", "example": "600 ppm", "unit": "ppm", "factor": 1e-6 });
    assert_eq!(strain, Some(&expected));
    let mut wrong = fields(40);
    wrong["free"][0][1] = "3 Mohm:1 Mohm".into();
    page.send_request("design-search", wrong).await;
    let fault = page.receive_until("design-search", "fault").await;
    let first = &fault.head["faults"][0];
    assert_eq!(
        (&first["table"], &first["key"]),
        (&json!("free"), &json!(LOAD))
    );
    assert!(first["message"].as_str().unwrap().contains("is no range"));
}

/// A stopped search makes room for the next one.
#[tokio::test]
async fn a_search_can_be_stopped() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let mut long = fields(100_000);
    long["free"] = json!([
        [LOAD, "10 kohm:3 Mohm:log"],
        ["stop.tip.gap", "0.2 mm:3 mm"]
    ]);
    long["starts"] = "1000".into();
    page.send_request("design-search", long).await;
    page.receive_until("design-search", "progress").await;
    page.send_request("stop", json!({ "what": "design-search" }))
        .await;
    let id = page.send_request("design-search", fields(4)).await;
    let done = page.receive_until("design-search", "done").await;
    assert_eq!(done.head["id"], id);
}

/// A band lies about the response of the operating point.
#[tokio::test]
async fn a_band_is_sent_for_a_point_of_a_response() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let range = json!({ "over": "drive.shaker.frequency", "from": 12.9, "to": 13.1 });
    let response = page.send_request("response", range).await;
    let fine = page.receive_until("response", "fine").await;
    let (x, power) = (fine.array("0.x"), fine.array("0.power"));
    let request = |tolerance: &str| json!({ "response": response, "branch": 0, "point": 0, "tolerance": [["stop.tip.gap", tolerance]] });
    page.send_request("band", request("0.05 mm")).await;
    let band = page.receive_until("band", "done").await;
    assert_eq!(
        (band.head["draws"].as_u64(), band.array("x").len()),
        (Some(64), 61)
    );
    assert!(band.array("share").iter().all(|share| *share == 1.0));
    for (k, at) in band.array("x").iter().enumerate() {
        let next = x.iter().position(|own| own >= at).unwrap().max(1);
        let part = (at - x[next - 1]) / (x[next] - x[next - 1]);
        let here = power[next - 1] + part * (power[next] - power[next - 1]);
        assert!(band.array("low")[k] < here && here < band.array("high")[k]);
    }
    page.send_request("band", request("-1 mm")).await;
    let fault = page.receive_until("band", "fault").await;
    assert_eq!(fault.head["faults"][0]["table"], "tolerance");
}
