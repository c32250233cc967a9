//! What must not work.

use crate::client::{Served, paper};
use futures_util::SinkExt;
use jounce_explorer::ServerLimits;
use serde_json::json;
use std::time::Duration;
use tokio_tungstenite::tungstenite::Message;

#[test]
fn only_the_right_token_and_host_see_the_page() {
    let served = Served::new(&paper(), ServerLimits::default());
    let (token, port) = (
        &served.token,
        served.host.rsplit(':').next().unwrap().to_owned(),
    );
    let (status, page) = served.get(&format!("/{token}/"), "");
    assert_eq!(status, 200);
    assert!(
        page.contains("content-security-policy: default-src 'none'")
            && page.contains("<!doctype html>"),
        "{page}"
    );
    assert_eq!(served.get("/", "").0, 403);
    assert_eq!(served.get("/app.js", "").0, 403);
    assert_eq!(served.get(&format!("/{}/", "0".repeat(32)), "").0, 403);
    assert_eq!(served.get(&format!("/{}/", &token[..31]), "").0, 403);
    assert_eq!(
        served
            .get(&format!("/{}/app.js", token.to_uppercase()), "")
            .0,
        if token.chars().any(char::is_alphabetic) {
            403
        } else {
            200
        }
    );
    // A name that an attacker points at this machine.
    assert_eq!(
        served
            .get(&format!("/{token}/"), "Host: evil.example\r\n")
            .0,
        421
    );
    assert_eq!(
        served
            .get(
                &format!("/{token}/"),
                &format!("Host: evil.example:{port}\r\n")
            )
            .0,
        421
    );
    assert_eq!(
        served
            .get(
                &format!("/{token}/"),
                &format!("Host: localhost:{port}\r\n")
            )
            .0,
        200
    );
    assert_eq!(
        served
            .get(
                &format!("/{token}/app.js"),
                "Origin: http://evil.example\r\n"
            )
            .0,
        403
    );
}

#[test]
fn no_path_leads_out_of_the_page() {
    let served = Served::new(&paper(), ServerLimits::default());
    let token = &served.token;
    for path in [
        "../Cargo.toml",
        "..%2f..%2fCargo.toml",
        "%2e%2e/Cargo.toml",
        "/etc/passwd",
        "//etc/passwd",
        "app.js/../../x",
        "app.js%00",
        ".",
    ] {
        let (status, text) = served.get(&format!("/{token}/{path}"), "");
        assert!(status == 404 || status == 400, "{path}: {status}");
        assert!(
            !text.contains("root:") && !text.contains("[package]"),
            "{path}"
        );
    }
}

#[test]
fn bodies_and_other_methods_are_refused() {
    let served = Served::new(&paper(), ServerLimits::default());
    let (token, host) = (&served.token, &served.host);
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"] {
        let request = format!(
            "{method} /{token}/ HTTP/1.1\r\nHost: {host}\r\nContent-Length: 10000000000\r\nConnection: close\r\n\r\n"
        );
        let first = served.raw(&request).0;
        assert!(first.contains("405"), "{method}: {first}");
    }
    let long = format!(
        "GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nX: {}\r\n\r\n",
        "a".repeat(2_000_000)
    );
    let mut refused = String::new();
    if std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        refused = served.raw(&long).0
    }))
    .is_ok()
    {
        assert!(!refused.contains("200"), "{refused}");
    }
    assert_eq!(served.get(&format!("/{token}/"), "").0, 200);
}

#[tokio::test]
async fn sockets_need_token_and_origin() {
    let served = Served::new(&paper(), ServerLimits::default());
    let own = format!("http://{}", served.host);
    assert_eq!(served.open(&served.token, None).await.err(), Some(403));
    assert_eq!(
        served
            .open(&served.token, Some("http://evil.example"))
            .await
            .err(),
        Some(403)
    );
    assert_eq!(
        served.open(&served.token, Some("null")).await.err(),
        Some(403)
    );
    assert_eq!(
        served
            .open("0123456789abcdef0123456789abcdef", Some(&own))
            .await
            .err(),
        Some(403)
    );
    assert!(served.open(&served.token, Some(&own)).await.is_ok());
}

#[tokio::test]
async fn sockets_messages_and_times_are_limited() {
    let served = Served::new(
        &paper(),
        ServerLimits {
            sockets: 2,
            message_bytes: 20_000,
            longest: Duration::from_millis(20),
        },
    );
    let own = format!("http://{}", served.host);
    let (mut one, two) = (served.page().await, served.page().await);
    assert_eq!(
        served.open(&served.token, Some(&own)).await.err(),
        Some(503)
    );
    drop(two);
    let huge = json!({ "id": 1, "ask": "design", "set": [["a", "x".repeat(30_000)]] }).to_string();
    let _ = one.socket.send(Message::Text(huge.into())).await;
    assert!(
        one.hear().await.is_none(),
        "a message that is too large closes the socket"
    );
    // A place is free again, perhaps after a moment.
    let until = tokio::time::Instant::now() + Duration::from_secs(60);
    let mut late = loop {
        match served.open(&served.token, Some(&own)).await {
            Ok(page) => break page,
            Err(status) => assert!(
                tokio::time::Instant::now() < until,
                "no place became free: {status}"
            ),
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    };
    late.ask("basins", json!({ "side": 81 })).await;
    let heard = late.until("basins", "fault").await;
    assert!(
        heard.head["faults"][0]["message"]
            .as_str()
            .unwrap()
            .contains("took longer than"),
        "{}",
        heard.head
    );
}

#[tokio::test]
async fn a_page_sets_numbers_and_no_paths() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    for (key, value) in [
        ("run.start", "./secret.json"),
        ("drive.shaker.file", "/etc/passwd"),
        ("stop.tip.law", "rigid"),
    ] {
        page.ask("design", json!({ "set": [[key, value]] })).await;
        let heard = page.until("design", "fault").await;
        assert!(
            heard.head["faults"][0]["message"]
                .as_str()
                .unwrap()
                .contains("no key with a number"),
            "{}",
            heard.head
        );
    }
}

#[tokio::test]
async fn nonsense_is_told_and_harms_nothing() {
    let served = Served::new(&paper(), ServerLimits::default());
    let mut page = served.page().await;
    for text in [
        "",
        "{",
        "[]",
        "{\"id\": -1}",
        "{\"id\": 1, \"ask\": \"everything\"}",
        "\u{0}",
    ] {
        page.socket.send(Message::Text(text.into())).await.unwrap();
        let heard = page.until("request", "fault").await;
        assert!(
            heard.head["message"]
                .as_str()
                .unwrap()
                .contains("cannot be read")
        );
    }
    for gap in ["NaN mm", "1e999 mm", "", "0.5", "0.5 kg"] {
        page.ask("design", json!({ "set": [["stop.tip.gap", gap]] }))
            .await;
        let heard = page.until("design", "fault").await;
        assert_eq!(
            heard.head["faults"][0]["key"], "stop.tip.gap",
            "{gap}: {}",
            heard.head
        );
    }
    page.ask("design", json!({})).await;
    page.until("design", "done").await;
}
