//! Band of the power over the key of a response, under tolerances.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::{BandOptions, Design};

/// Sends the progress, then the band.
///
/// # Errors
/// [`RequestFault`]: faults of the tolerances, or a response that is no longer stored.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    options: &BandOptions,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let found = with_progress(session, (id, "band"), cancellation, || {
        let control = cancellation.control();
        session.analysis.band(design, options, control)
    });
    let found = found.map_err(|error| match options.faults(&error) {
        Some(faults) => RequestFault::Fields(faults),
        None => error.into(),
    })?;
    let mut frame = Frame::new(id, "band", "done");
    frame
        .put("over", found.over.as_str())
        .put("draws", found.draws)
        .list("x", &found.band.parameter)
        .list("low", &found.band.low_w)
        .list("median", &found.band.median_w)
        .list("high", &found.band.high_w)
        .list("share", &found.band.found_share);
    session.send(cancellation, frame);
    Ok(())
}
