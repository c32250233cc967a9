//! What is answered, and that it is what the library says.

use crate::client::{Served, paper};
use jounce_core::analysis::{BranchSearch, Model, OrbitMethodKind, Parameter};
use jounce_core::spec::SpecFile;
use jounce_explorer::{ServerLimits, Source};
use serde_json::json;
use std::path::PathBuf;
use std::time::{Duration, Instant};

#[tokio::test]
async fn a_design_has_a_drawing_and_controls() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    page.ask("design", json!({ "set": [["stop.tip.gap", "0.5 mm"]] }))
        .await;
    let heard = page.until("design", "done").await;
    assert!(
        heard.head["drawing"]["svg"]
            .as_str()
            .unwrap()
            .contains("gap 0.5 mm")
    );
    let grips = heard.head["drawing"]["grips"].as_array().unwrap();
    let keys: Vec<_> = grips
        .iter()
        .map(|grip| {
            (
                grip["kind"].as_str().unwrap(),
                grip["key"].as_str().unwrap(),
            )
        })
        .collect();
    let due = [
        ("start", "patch.mfc.start"),
        ("end", "patch.mfc.length"),
        ("place", "beam.beam.point.tip"),
        ("gap", "stop.tip.gap"),
    ];
    assert_eq!(keys, due);
    let gap = heard.head["controls"]
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

/// The words of a fault are those of the command line.
#[tokio::test]
async fn a_wrong_value_is_told_by_its_key() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    page.ask(
        "design",
        json!({ "set": [["circuit.load.resistance", "-1 ohm"]] }),
    )
    .await;
    let heard = page.until("design", "fault").await;
    let mut file = SpecFile::read(paper()).unwrap();
    file.set("circuit.load.resistance", "-1 ohm").unwrap();
    let due = file.spec().unwrap_err().to_string();
    assert_eq!(
        heard.head["faults"][0]["message"].as_str(),
        Some(due.as_str())
    );
    assert_eq!(heard.head["faults"][0]["key"], "circuit.load.resistance");
}

/// The fine answer is that of the library, number by number; the coarse one runs through it.
#[tokio::test]
async fn a_response_is_the_branch_of_the_library() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    let range = json!({ "over": "drive.shaker.frequency", "from": 12.6, "to": 13.0 });
    let id = page.ask("response", range.clone()).await;
    let coarse = page.until("response", "coarse").await;
    let fine = page.until("response", "fine").await;
    let file = SpecFile::read(paper()).unwrap();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 13.0 - 12.6);
    let (range, method) = ((12.6, 13.0), OrbitMethodKind::Shooting);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance: 1e-9,
        seeds: 6,
        longest_period: 8,
    };
    let due = search.run().unwrap();
    assert_eq!(fine.head["branches"].as_array().unwrap().len(), due.len());
    for (k, branch) in due.iter().enumerate() {
        let powers: Vec<f64> = branch
            .points
            .iter()
            .map(|point| point.orbit.mean_power_w)
            .collect();
        assert_eq!(fine.array(&format!("{k}.power")), powers);
    }
    // The ends of the first coarse branch lie on the edges of the range, with the power of the fine one there (8e-6 off).
    let ends = |heard: &crate::client::Heard| (heard.array("0.x")[0], heard.array("0.power")[0]);
    let (rough, exact) = (ends(&coarse), ends(&fine));
    assert_eq!(rough.0, exact.0);
    assert!(
        (rough.1 / exact.1 - 1.0).abs() < 1e-4,
        "{rough:?} {exact:?}"
    );

    page.ask("orbit", json!({ "answer": id, "branch": 0, "point": 0 }))
        .await;
    let orbit = page.until("orbit", "done").await;
    assert!((orbit.head["mean_power_w"].as_f64().unwrap() / exact.1 - 1.0).abs() < 1e-6);
    let (motion, places) = (orbit.array("motion.beam"), orbit.array("place.beam"));
    assert_eq!(
        motion.len(),
        places.len() * orbit.head["pictures"].as_u64().unwrap() as usize
    );
    // The point that strikes moves alike in the picture of the beam (nearest place 305 mm) and in the history of the port.
    let place = places
        .iter()
        .position(|place| (place - 0.305).abs() < 0.0035)
        .unwrap();
    let (drawn, marched) = (motion[place], orbit.array("displacement.0")[0]);
    assert!((drawn / marched - 1.0).abs() < 0.05, "{drawn} {marched}");
    // Mean square of the sampled voltage against the exact one of the flow.
    let voltage = orbit.array("voltage");
    let rms = (voltage.iter().map(|v| v * v).sum::<f64>() / voltage.len() as f64).sqrt();
    assert!(
        (rms / orbit.head["voltage_rms_v"].as_f64().unwrap() - 1.0).abs() < 1e-3,
        "{rms}"
    );
}

#[tokio::test]
async fn a_new_position_stops_the_old_computation() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    for k in 0..30 {
        let set = json!([["stop.tip.gap", format!("{} mm", 0.9 + 0.005 * f64::from(k))]]);
        page.ask(
            "response",
            json!({ "set": set, "over": "drive.shaker.frequency", "from": 4.0, "to": 20.0 }),
        )
        .await;
    }
    page.ask(
        "sweep",
        json!({ "over": "drive.shaker.frequency", "from": 4.0, "to": 20.0, "points": 400 }),
    )
    .await;
    page.ask("stop", json!({ "what": "sweep" })).await;
    let asked = Instant::now();
    let last = page
        .ask(
            "response",
            json!({ "over": "drive.shaker.frequency", "from": 12.9, "to": 13.0 }),
        )
        .await;
    let heard = page.until("response", "coarse").await;
    assert_eq!(
        heard.head["id"].as_u64(),
        Some(last),
        "answers to older positions are not sent"
    );
    assert!(asked.elapsed() < Duration::from_secs(60));
}

#[tokio::test]
async fn the_page_follows_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("harvester.toml");
    let text = std::fs::read_to_string(paper()).unwrap();
    std::fs::write(&path, &text).unwrap();
    let served = Served::new(&path, ServerLimits::default());
    let mut page = served.page().await;
    std::fs::write(&path, text.replace("gap = \"1 mm\"", "gap = \"oops\"")).unwrap();
    page.until("file", "done").await;
    page.ask("design", json!({})).await;
    let heard = page.until("design", "fault").await;
    assert_eq!(
        (
            &heard.head["faults"][0]["key"],
            heard.head["faults"][0]["line"].as_u64()
        ),
        (&json!("stop.tip.gap"), Some(36))
    );
    std::fs::write(&path, text).unwrap();
    page.until("file", "done").await;
    page.ask("design", json!({})).await;
    page.until("design", "done").await;
}

#[tokio::test]
async fn exported_text_is_the_design() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    let set = json!([["stop.tip.gap", "0.5 mm"]]);
    page.ask(
        "export",
        json!({ "set": set, "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0 }),
    )
    .await;
    let heard = page.until("export", "done").await;
    let spec = SpecFile::from_text(heard.head["spec"].as_str().unwrap())
        .spec()
        .unwrap();
    assert_eq!(spec.stop["tip"].gap_m, 0.5e-3);
    let shell = heard.head["shell"].as_str().unwrap();
    assert!(
        shell.ends_with("--over 'drive.shaker.frequency=12 Hz:13 Hz' --set 'stop.tip.gap=0.5 mm'"),
        "{shell}"
    );
}

/// A spec that no file holds is named after the file that the page would save it to, and leaves nothing behind.
#[tokio::test]
async fn a_spec_without_a_file_is_served() {
    let keep = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(paper())
        .unwrap()
        .replace("gap = \"1 mm\"", "gap = \"2 mm\"");
    let source = Source::Text {
        text: text.clone(),
        folder: PathBuf::new(),
    };
    let served = Served::of(
        source,
        ServerLimits::default(),
        Some(keep.path().to_path_buf()),
    );
    let mut page = served.page().await;
    page.ask("design", json!({})).await;
    page.until("design", "done").await;
    page.ask(
        "export",
        json!({ "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0 }),
    )
    .await;
    let heard = page.until("export", "done").await;
    assert_eq!(heard.head["spec"].as_str(), Some(text.as_str()));
    assert!(
        heard.head["python"]
            .as_str()
            .unwrap()
            .contains("jounce.read(\"harvester.toml\")")
    );
    assert!(
        heard.head["shell"]
            .as_str()
            .unwrap()
            .starts_with("jounce branch harvester.toml ")
    );
    assert_eq!(std::fs::read_dir(keep.path()).unwrap().count(), 0);
}

/// The next server of a spec has the address of the one before; one beside it has another.
#[tokio::test]
async fn a_page_comes_back_with_its_server() {
    let folder = tempfile::tempdir().unwrap();
    let serve = || {
        Served::kept(
            &paper(),
            ServerLimits::default(),
            Some(folder.path().to_path_buf()),
        )
    };
    let first = serve();
    let (host, token) = (first.host.clone(), first.token.clone());
    let beside = serve();
    assert!(beside.host != host && beside.token != token);
    drop((beside, first));
    let latest = serve();
    let (host, token) = (latest.host.clone(), latest.token.clone());
    drop(latest);
    let again = serve();
    assert_eq!((&again.host, &again.token), (&host, &token));
    again.page().await;
}
