//! Plates on the page: plan view, mode shapes, and the motion of an orbit.

use crate::client::{Response, TestServer};
use jounce_explorer::ServerLimits;
use serde_json::{Value, json};
use std::path::Path;

fn server() -> TestServer {
    let spec =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plate-de-marqui-2009/stop.toml");
    TestServer::new(&spec, ServerLimits::default())
}

/// The area of the plan view holds a corner of the patch and of the plate.
#[tokio::test]
async fn a_design_has_the_plan_view_of_its_plate() {
    let server = server();
    let mut page = server.page().await;
    page.send_request("design", json!({})).await;
    let design = page.receive_until("design", "done").await;
    let drawing = &design.head["drawing"];
    let plans = drawing["plans"].as_array().unwrap();
    assert_eq!(plans.len(), 1);
    let area: Vec<f64> = serde_json::from_value(plans[0].clone()).unwrap();
    let svg = drawing["svg"].as_str().unwrap();
    let text = svg
        .lines()
        .find(|line| line.contains("plate, seen from above"))
        .unwrap();
    let number = |name: &str| -> f64 {
        let value = text.split(&format!(" {name}=\"")).nth(1).unwrap();
        value.split('"').next().unwrap().parse().unwrap()
    };
    // The drawing rounds to a hundredth.
    let (x, y) = (number("x"), number("y"));
    assert!(
        x >= area[0] - 0.01 && x < area[0] + area[2] && y > area[1] && y < area[1] + area[3],
        "{x} {y} {area:?}"
    );
    assert!(svg.contains("corner: stop corner"));
}

/// The page gets the figure of the library, not one of its own.
#[tokio::test]
async fn the_mode_shapes_are_the_figures_of_the_library() {
    let server = server();
    let mut page = server.page().await;
    let set = json!([["plate.plate.thickness", "0.6 mm"]]);
    page.send_request("modes", json!({ "set": set })).await;
    let modes = page.receive_until("modes", "done").await;
    let spec =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plate-de-marqui-2009/stop.toml");
    let mut harvester = jounce::Harvester::read(spec).unwrap();
    harvester.set("plate.plate.thickness", "0.6 mm").unwrap();
    let figures = harvester.modes(&Default::default()).unwrap().figures();
    let (name, figure) = &figures[0];
    assert_eq!(modes.head["figures"].as_array().unwrap().len(), 1);
    assert_eq!(
        modes.head["figures"][0]["name"].as_str(),
        Some(name.as_str())
    );
    let svg = figure.to_svg().unwrap();
    assert_eq!(modes.head["figures"][0]["svg"].as_str(), Some(svg.as_str()));
}

async fn orbit() -> Response {
    let server = server();
    let mut page = server.page().await;
    let range = json!({ "over": "drive.shaker.frequency", "from": 54.0, "to": 55.0 });
    let id = page.send_request("response", range).await;
    page.receive_until("response", "fine").await;
    page.send_request("orbit", json!({ "response": id, "branch": 0, "point": 0 }))
        .await;
    page.receive_until("orbit", "done").await
}

#[tokio::test]
async fn an_orbit_has_the_motion_of_the_plate_and_of_no_beam() {
    let orbit = orbit().await;
    assert_eq!(orbit.head["beams"], json!([]));
    let plates = orbit.head["plates"].as_array().unwrap();
    assert_eq!((plates.len(), &plates[0]["name"]), (1, &json!("plate")));
    let pictures: Vec<&str> = plates[0]["pictures"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(Value::as_str)
        .collect();
    assert_eq!(pictures.len(), 24);
    assert!(pictures.windows(2).all(|pair| pair[0] != pair[1]));
    // Another corner may move further than the one that strikes.
    let largest_m = plates[0]["largest"].as_f64().unwrap();
    let corner = orbit.array("displacement.0").iter();
    let corner_m = corner.fold(0.0_f64, |max, x| max.max(x.abs()));
    assert!(
        largest_m > 0.9 * corner_m && largest_m < 3.0 * corner_m,
        "{largest_m} {corner_m}"
    );
}
