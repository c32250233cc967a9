//! Many pages of one server.

use crate::client::{Page, Response, TestServer, paper};
use jounce_explorer::ServerLimits;
use serde_json::{Value, json};

fn request() -> Value {
    json!({ "over": "drive.shaker.frequency", "from": 12.4, "to": 13.2, "longest_period": 2 })
}

fn curve(response: &Response) -> Vec<f64> {
    let names = ["0.x", "0.power", "0.floquet"];
    names.map(|name| response.array(name)).concat()
}

async fn orbit(page: &mut Page, response: &Response) -> Response {
    let place = json!({ "response": response.head["id"], "branch": 0, "point": 3 });
    page.send_request("orbit", place).await;
    page.receive_until("orbit", "done").await
}

/// A page that stops its search does not stop that of another page; both have the orbits of their
/// own response.
#[tokio::test]
async fn pages_share_a_search_and_each_can_leave_it() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let (mut leaving, mut staying) = (server.page().await, server.page().await);
    // The numbers of the requests differ between the pages.
    staying.send_request("design", json!({})).await;
    leaving.send_request("response", request()).await;
    staying.send_request("response", request()).await;
    leaving.receive_until("response", "coarse").await;
    let coarse = staying.receive_until("response", "coarse").await;
    orbit(&mut staying, &coarse).await;
    leaving
        .send_request("stop", json!({ "what": "response" }))
        .await;
    let fine = staying.receive_until("response", "fine").await;
    let expected = orbit(&mut staying, &fine).await;
    leaving.send_request("response", request()).await;
    let own = leaving.receive_until("response", "fine").await;
    assert_ne!(own.head["id"], fine.head["id"]);
    let power = |response: &Response| response.head["mean_power_w"].as_f64().unwrap();
    let found = orbit(&mut leaving, &own).await;
    assert!((power(&found) / power(&expected) - 1.0).abs() < 1e-6);
}

/// A page that opens later has the response of the page that is open, and its own design after a
/// move.
#[tokio::test]
async fn a_later_page_has_the_same_response() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let (mut first, mut second) = (server.page().await, server.page().await);
    first.send_request("response", request()).await;
    let expected = first.receive_until("response", "fine").await;
    second.send_request("response", request()).await;
    let response = second.receive_until("response", "fine").await;
    assert_eq!(curve(&response), curve(&expected));
    let mut moved = request();
    moved["set"] = json!([["stop.tip.gap", "0.9 mm"]]);
    second.send_request("response", moved).await;
    let moved = second.receive_until("response", "fine").await;
    assert_ne!(curve(&moved), curve(&expected));
    let starts = json!({ "starts": 12 });
    let mut points = Vec::new();
    for page in [&mut first, &mut second] {
        page.send_request("operating-point", starts.clone()).await;
        let mut point = page.receive_until("operating-point", "done").await;
        point.head["id"] = Value::Null;
        points.push(point.head);
    }
    assert_eq!(points[0], points[1]);
}
