//! Files of the page, embedded in the program, and their response headers.

use axum::http::header::{self, HeaderName};
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};

/// Content-security policy of the page: everything comes from this server.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'";

/// Policy of a page that no other page may embed in a frame.
const NO_FRAMES: &str = "frame-ancestors 'none'";

/// Policy of a page that notebooks may embed: pages of the same proxy, and of this machine.
const FRAMES_OF_THIS_MACHINE: &str = "frame-ancestors 'self' http://127.0.0.1:* http://localhost:*";

/// Files: name, content type, content.
const FILES: [(&str, &str, &[u8]); 4] = [
    (
        "",
        "text/html; charset=utf-8",
        include_bytes!("../../page/index.html"),
    ),
    (
        "app.js",
        "text/javascript; charset=utf-8",
        include_bytes!("../../page/app.js"),
    ),
    (
        "app.css",
        "text/css; charset=utf-8",
        include_bytes!("../../page/app.css"),
    ),
    (
        "icon.svg",
        "image/svg+xml",
        include_bytes!("../../page/icon.svg"),
    ),
];

/// Returns the file with a name; only files of the list above are served. With `frames` notebooks
/// may embed the page.
pub fn serve(name: &str, frames: bool) -> Response {
    match FILES.iter().find(|(file_name, ..)| *file_name == name) {
        Some((_, kind, content)) => with_security_headers(
            (
                [(header::CONTENT_TYPE, HeaderValue::from_static(kind))],
                *content,
            )
                .into_response(),
            frames,
        ),
        None => refusal(StatusCode::NOT_FOUND, "this server has no such file"),
    }
}

/// Returns a refusal with a message of one line.
pub fn refusal(status: StatusCode, message: &'static str) -> Response {
    with_security_headers((status, message).into_response(), false)
}

/// Adds the headers of every response.
fn with_security_headers(mut response: Response, frames: bool) -> Response {
    let frame_policy = if frames {
        FRAMES_OF_THIS_MACHINE
    } else {
        NO_FRAMES
    };
    let headers: [(HeaderName, &'static str); 7] = [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::CONTENT_SECURITY_POLICY, frame_policy),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
        (
            HeaderName::from_static("cross-origin-opener-policy"),
            "same-origin",
        ),
        (
            HeaderName::from_static("cross-origin-resource-policy"),
            "same-origin",
        ),
    ];
    for (name, value) in headers {
        response
            .headers_mut()
            .append(name, HeaderValue::from_static(value));
    }
    if !frames {
        response
            .headers_mut()
            .insert(header::X_FRAME_OPTIONS, HeaderValue::from_static("DENY"));
    }
    response
}
