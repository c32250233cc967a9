//! Files of the page, embedded in the program, and their response headers.

use axum::http::header::{self, HeaderName};
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};

/// Content-security policy of the page: everything comes from this server.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

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

/// Returns the file with a name; only files of the list above are served.
pub fn serve(name: &str) -> Response {
    match FILES.iter().find(|(file_name, ..)| *file_name == name) {
        Some((_, kind, content)) => with_security_headers(
            (
                [(header::CONTENT_TYPE, HeaderValue::from_static(kind))],
                *content,
            )
                .into_response(),
        ),
        None => refusal(StatusCode::NOT_FOUND, "this server has no such file"),
    }
}

/// Returns a refusal with a message of one line.
pub fn refusal(status: StatusCode, message: &'static str) -> Response {
    with_security_headers((status, message).into_response())
}

/// Adds the headers of every response.
fn with_security_headers(mut response: Response) -> Response {
    let headers: [(HeaderName, &'static str); 7] = [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::X_FRAME_OPTIONS, "DENY"),
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
    response
        .headers_mut()
        .extend(headers.map(|(name, value)| (name, HeaderValue::from_static(value))));
    response
}
