//! Mean power over realisations of the noise of a spec.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::EnsembleOptions;
use jounce::live::Design;
use serde_json::json;

/// Sends the progress, then the result of `jounce ensemble` with its warnings as text. All cores
/// work on it, whatever the request says.
///
/// # Errors
/// [`RequestFault`]: the spec has no noise, or an integration does not converge.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    options: &EnsembleOptions,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let options = EnsembleOptions {
        threads: None,
        ..options.clone()
    };
    let harvester = design.harvester().with_control(cancellation.control());
    let outcome = with_progress(session, (id, "ensemble"), cancellation, || {
        harvester.ensemble(&options)
    });
    let result = outcome?;
    let mut frame = Frame::new(id, "ensemble", "done");
    frame
        .put_all(&json!(result))
        .put("warnings", result.warnings());
    session.send(cancellation, frame);
    Ok(())
}
