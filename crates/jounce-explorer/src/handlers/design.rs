//! Drawing and controls of a design, and what a search for a better one can have.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::source::Source;
use jounce::live::{Design, ViewRoom};
use serde_json::json;

/// Returns the drawing, in a room of a width and height in pixels if they are given, and the
/// controls.
pub fn describe(
    id: u64,
    design: &Design,
    (width, height): (Option<f64>, Option<f64>),
    source: &Source,
) -> Frame {
    let room = width.map(|width_px| ViewRoom {
        width_px,
        height_px: height.unwrap_or(f64::INFINITY),
    });
    let title = source.name().file_stem().unwrap_or_default();
    let mut frame = Frame::new(id, "design", "done");
    frame
        .put(
            "drawing",
            json!(design.drawing(&title.to_string_lossy(), room)),
        )
        .put("controls", json!(design.controls()))
        .put("optional", json!(design.optional_keys()))
        .put("drive_frequency_hz", design.drive_frequency_hz().ok());
    frame
}

/// Returns the goals and limits that a search can have.
///
/// # Errors
/// [`RequestFault`]: a design without a model.
pub fn offer(
    session: &Session,
    id: u64,
    design: &Design,
    cancellation: &Cancellation,
) -> Result<Frame, RequestFault> {
    let control = cancellation.control();
    let offer = session.analysis.design_offer(design, control)?;
    let mut frame = Frame::new(id, "design-offer", "done");
    frame.put_all(&json!(offer));
    Ok(frame)
}
