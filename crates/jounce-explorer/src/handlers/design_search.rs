//! Search for a better design; each better one is sent as soon as it is found.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::{BetterDesign, Design, DesignFields};
use serde_json::json;
use std::path::Path;

const KIND: &str = "design-search";

/// Sends the design file, the progress and each better design, then the best one.
///
/// # Errors
/// [`RequestFault`]: faults of the fields, or no design that can be evaluated.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    (fields, spec): (&DesignFields, &Path),
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let spec = spec.file_name().unwrap_or_default().to_string_lossy();
    let mut frame = Frame::new(id, KIND, "file");
    frame.put("file", fields.text(Some(&spec)));
    session.send(cancellation, frame);
    let better = |better: BetterDesign| {
        let mut frame = Frame::new(id, KIND, "better");
        frame.put_all(&json!(better));
        session.send(cancellation, frame);
    };
    let found = with_progress(session, (id, KIND), cancellation, || {
        design.search(fields, cancellation.control(), &better)
    });
    let found = found.map_err(|error| match fields.faults(&error) {
        Some(faults) => RequestFault::Fields(faults),
        None => error.into(),
    })?;
    let mut frame = Frame::new(id, KIND, "done");
    frame.put_all(&json!(found));
    session.send(cancellation, frame);
    Ok(())
}
