//! A link of one server opens the same design on another.

use crate::client::{TestServer, paper};
use jounce::live::KeySpan;
use jounce_explorer::{Link, ServerLimits, ServerOptions, Source};
use serde_json::json;

#[tokio::test]
async fn the_link_of_the_export_serves_the_same_page() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    let set = json!([["stop.tip.gap", "0.5 mm"]]);
    let range = json!({ "set": set, "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0, "page": [["tab", "load"]] });
    page.send_request("export", range).await;
    let response = page.receive_until("export", "done").await;
    let text = response.head["link"].as_str().unwrap();
    assert!(!text.contains(&server.token), "{text}");
    let link = Link::parse(text).unwrap();
    let span = KeySpan {
        over: "drive.shaker.frequency".to_owned(),
        from: 12.0,
        to: 13.0,
    };
    assert_eq!(link.view, Some(span));
    let spec = std::fs::read_to_string(paper()).unwrap();
    assert_eq!(link.spec.as_deref(), Some(spec.as_str()));

    let other = TestServer::with_options(ServerOptions {
        spec: Source::Text {
            text: link.spec.unwrap(),
            folder: std::env::temp_dir(),
        },
        set: link.set,
        view: link.view,
        page: link.page,
        listen: None,
        proxy: None,
        frames: false,
        state_folder: None,
        limits: ServerLimits::default(),
    });
    let origin = format!("http://{}", other.host);
    let mut page = other.open(&other.token, Some(&origin)).await.unwrap();
    let hello = page.receive().await.unwrap().head;
    assert_eq!(hello["set"], set);
    assert_eq!(
        hello["view"],
        json!({ "over": "drive.shaker.frequency", "from": 12.0, "to": 13.0 })
    );
    assert_eq!(hello["page"], json!([["tab", "load"]]));
}
