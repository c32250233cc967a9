//! Requests that the server must refuse.

use crate::client::{TestServer, paper};
use futures_util::SinkExt;
use jounce_explorer::{ProxyOrigin, ServerLimits, ServerOptions, Source};
use serde_json::json;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;
use tokio_tungstenite::tungstenite::Message;

#[test]
fn only_the_right_token_and_host_receive_the_page() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let (token, port) = (
        &server.token,
        server.host.rsplit(':').next().unwrap().to_owned(),
    );
    let (status, page) = server.get(&format!("/{token}/"), "");
    assert_eq!(status, 200);
    assert!(
        page.contains("content-security-policy: default-src 'none'")
            && page.contains("<!doctype html>"),
        "{page}"
    );
    assert!(
        page.contains("content-security-policy: frame-ancestors 'none'")
            && page.contains("x-frame-options: DENY"),
        "{page}"
    );
    let has_letter = token.chars().any(char::is_alphabetic);
    let cases = [
        ("/".to_owned(), String::new(), 403),
        ("/app.js".to_owned(), String::new(), 403),
        (format!("/{}/", "0".repeat(32)), String::new(), 403),
        (format!("/{}/", &token[..31]), String::new(), 403),
        (
            format!("/{}/app.js", token.to_uppercase()),
            String::new(),
            if has_letter { 403 } else { 200 },
        ),
        // A name that an attacker points at this machine.
        (
            format!("/{token}/"),
            "Host: evil.example\r\n".to_owned(),
            421,
        ),
        (
            format!("/{token}/"),
            format!("Host: evil.example:{port}\r\n"),
            421,
        ),
        (
            format!("/{token}/"),
            format!("Host: localhost:{port}\r\n"),
            200,
        ),
        (
            format!("/{token}/"),
            format!("Host: localhost:{port}\r\nHost: evil.example\r\n"),
            421,
        ),
        // An address that lost its last slash.
        (format!("/{token}"), String::new(), 308),
        (format!("/{}", "0".repeat(32)), String::new(), 403),
        (
            format!("/{token}/app.js"),
            "Origin: http://evil.example\r\n".to_owned(),
            403,
        ),
    ];
    for (path, headers, expected) in cases {
        assert_eq!(server.get(&path, &headers).0, expected, "{path} {headers}");
    }
}

#[test]
fn no_path_leads_out_of_the_page() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let token = &server.token;
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
        let (status, text) = server.get(&format!("/{token}/{path}"), "");
        assert!(status == 404 || status == 400, "{path}: {status}");
        assert!(
            !text.contains("root:") && !text.contains("[package]"),
            "{path}"
        );
    }
}

#[test]
fn bodies_and_other_methods_are_refused() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let (token, host) = (&server.token, &server.host);
    for method in ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"] {
        let request = format!(
            "{method} /{token}/ HTTP/1.1\r\nHost: {host}\r\nContent-Length: 10000000000\r\nConnection: close\r\n\r\n"
        );
        let first = server.raw(&request).0;
        assert!(first.contains("405"), "{method}: {first}");
    }
    let long = format!(
        "GET /{token}/ HTTP/1.1\r\nHost: {host}\r\nX: {}\r\n\r\n",
        "a".repeat(2_000_000)
    );
    let mut refused = String::new();
    if std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
        refused = server.raw(&long).0
    }))
    .is_ok()
    {
        assert!(!refused.contains("200"), "{refused}");
    }
    assert_eq!(server.get(&format!("/{token}/"), "").0, 200);
}

#[test]
fn a_connection_without_a_complete_request_is_closed() {
    let server = TestServer::new(
        &paper(),
        ServerLimits {
            max_header_time: Duration::from_millis(300),
            ..Default::default()
        },
    );
    let (token, host) = (&server.token, &server.host);
    for part in [
        String::new(),
        format!("GET /{token}/ HTTP/1.1\r\nHost: {host}\r\n"),
    ] {
        let mut stream = TcpStream::connect(host).unwrap();
        let longest = Some(Duration::from_secs(60));
        stream.set_read_timeout(longest).unwrap();
        stream.write_all(part.as_bytes()).unwrap();
        // Ends with the connection, or fails after the time of reading.
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
    }
    assert_eq!(server.get(&format!("/{token}/"), "").0, 200);
}

#[tokio::test]
async fn sockets_need_token_and_origin() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let expected_origin = format!("http://{}", server.host);
    assert_eq!(server.open(&server.token, None).await.err(), Some(403));
    assert_eq!(
        server
            .open(&server.token, Some("http://evil.example"))
            .await
            .err(),
        Some(403)
    );
    assert_eq!(
        server.open(&server.token, Some("null")).await.err(),
        Some(403)
    );
    assert_eq!(
        server
            .open("0123456789abcdef0123456789abcdef", Some(&expected_origin))
            .await
            .err(),
        Some(403)
    );
    assert!(
        server
            .open(&server.token, Some(&expected_origin))
            .await
            .is_ok()
    );
}

#[tokio::test]
async fn sockets_messages_and_times_are_limited() {
    let server = TestServer::new(
        &paper(),
        ServerLimits {
            sockets: 2,
            message_bytes: 20_000,
            max_computation_time: Duration::from_millis(20),
            ..Default::default()
        },
    );
    let expected_origin = format!("http://{}", server.host);
    let (mut first_page, second_page) = (server.page().await, server.page().await);
    assert_eq!(
        server
            .open(&server.token, Some(&expected_origin))
            .await
            .err(),
        Some(503)
    );
    drop(second_page);
    let long_message =
        json!({ "id": 1, "ask": "design", "set": [["a", "x".repeat(30_000)]] }).to_string();
    let _ = first_page
        .socket
        .send(Message::Text(long_message.into()))
        .await;
    assert!(
        first_page.receive().await.is_none(),
        "a message that is too large closes the socket"
    );
    // The socket is released after a short time.
    let deadline = tokio::time::Instant::now() + Duration::from_secs(60);
    let mut page = loop {
        match server.open(&server.token, Some(&expected_origin)).await {
            Ok(page) => break page,
            Err(status) => assert!(
                tokio::time::Instant::now() < deadline,
                "no socket became free: {status}"
            ),
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    };
    page.send_request("basins", json!({ "starts": 6561 })).await;
    let response = page.receive_until("basins", "fault").await;
    assert!(
        response.head["faults"][0]["message"]
            .as_str()
            .unwrap()
            .contains("took longer than"),
        "{}",
        response.head
    );
}

#[tokio::test]
async fn a_page_sets_numbers_and_no_paths() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    for (key, value) in [
        ("run.start", "./secret.json"),
        ("drive.shaker.file", "/etc/passwd"),
        ("stop.tip.law", "rigid"),
    ] {
        page.send_request("design", json!({ "set": [[key, value]] }))
            .await;
        let response = page.receive_until("design", "fault").await;
        assert!(
            response.head["faults"][0]["message"]
                .as_str()
                .unwrap()
                .contains("give a key with a number"),
            "{}",
            response.head
        );
    }
}

#[tokio::test]
async fn invalid_requests_are_reported_and_change_nothing() {
    let server = TestServer::new(&paper(), ServerLimits::default());
    let mut page = server.page().await;
    for text in [
        "",
        "{",
        "[]",
        "{\"id\": -1}",
        "{\"id\": 1, \"ask\": \"everything\"}",
        "\u{0}",
    ] {
        page.socket.send(Message::Text(text.into())).await.unwrap();
        let response = page.receive_until("request", "fault").await;
        assert!(
            response.head["message"]
                .as_str()
                .unwrap()
                .contains("cannot be read")
        );
    }
    for gap in ["NaN mm", "1e999 mm", "", "0.5", "0.5 kg"] {
        page.send_request("design", json!({ "set": [["stop.tip.gap", gap]] }))
            .await;
        let response = page.receive_until("design", "fault").await;
        assert_eq!(
            response.head["faults"][0]["key"], "stop.tip.gap",
            "{gap}: {}",
            response.head
        );
    }
    page.send_request("design", json!({})).await;
    page.receive_until("design", "done").await;
}

#[tokio::test]
async fn behind_a_proxy_only_its_pages_are_accepted_and_notebooks_may_embed_the_page() {
    let origin = "https://hub.example";
    let server = TestServer::with_options(ServerOptions {
        spec: Source::File(paper()),
        set: Vec::new(),
        view: None,
        page: Vec::new(),
        listen: None,
        proxy: ProxyOrigin::parse(origin),
        frames: true,
        state_folder: None,
        limits: ServerLimits::default(),
    });
    let token = &server.token;
    let get = |host: &str| server.get(&format!("/{token}/"), &format!("Host: {host}\r\n"));
    let (status, page) = get("hub.example");
    assert_eq!(status, 200);
    assert!(
        page.contains("content-security-policy: frame-ancestors 'self' http://127.0.0.1:*")
            && !page.contains("x-frame-options"),
        "{page}"
    );
    assert_eq!(get("evil.example").0, 421);
    assert!(server.open(token, Some(origin)).await.is_ok());
    assert_eq!(
        server.open(token, Some("https://evil.example")).await.err(),
        Some(403)
    );
    // Without the last slash, the redirect keeps the prefix of a proxy.
    let (status, response) = server.get(&format!("/{token}"), "");
    assert_eq!(status, 308);
    assert!(
        response.contains(&format!("location: {token}/\r\n")),
        "{response}"
    );
}
