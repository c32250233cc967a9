//! Attractors at the operating point of a design, from a cloud of starts.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::BasinsOptions;
use jounce::live::Design;
use serde_json::json;

/// Sends the progress, then the attractors with their basin fractions.
///
/// # Errors
/// [`RequestFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    options: &BasinsOptions,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let harvester = design.harvester().with_control(cancellation.control());
    let result = with_progress(session, (id, "operating-point"), cancellation, || {
        harvester.basins(options)
    })?;
    let mut frame = Frame::new(id, "operating-point", "done");
    frame
        .put_all(&json!(result))
        .put("frequency_hz", design.drive_frequency_hz()?);
    session.send(cancellation, frame);
    Ok(())
}
