//! Links and requests of the live page.

use super::text_of;
use jounce::Harvester;
use jounce::live::Design;
use jounce_explorer::Link;
use request::{Request, RequestKind};
use std::sync::LazyLock;

#[path = "../../../crates/jounce-explorer/src/session/request.rs"]
#[allow(dead_code, reason = "the server reads the other fields")]
mod request;

/// A link that was read prints as a link that reads back to the same design.
pub fn link(data: &[u8]) {
    match Link::parse(&text_of(data)) {
        Ok(link) => assert_eq!(Link::parse(&link.to_string()), Ok(link)),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A request is read, and its overrides and ranges are applied to the design; nothing is computed.
pub fn request(data: &[u8]) {
    static HARVESTER: LazyLock<Harvester> = LazyLock::new(|| {
        let text = include_str!("../../../examples/bouncing-and-impact-oscillators/impact.toml");
        Harvester::from_text(text, ".").expect("an example")
    });
    let Ok(request) = serde_json::from_slice::<Request>(data) else {
        return;
    };
    if request.set.len() > request::MAX_OVERRIDES {
        return;
    }
    assert!(!request.kind.name().is_empty() && request.removed_keys().len() <= request.set.len());
    let Ok(design) = Design::new(&HARVESTER, &request.set) else {
        return;
    };
    match &request.kind {
        RequestKind::Design { width } => {
            drop((design.drawing("design", *width), design.controls()));
        }
        RequestKind::Response { span, .. }
        | RequestKind::Sweep { span, .. }
        | RequestKind::Export { span, .. } => drop(span.text(&design)),
        RequestKind::DesignSearch(fields) => {
            let text = fields.text(None);
            super::library::design(text.as_bytes());
        }
        _ => {}
    }
}
