//! Attractors at the operating point of a design, from a cloud of starts.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::session::request::{Request, RequestKind};
use jounce::BasinsOptions;
use jounce::live::Design;
use serde_json::json;
use std::sync::Arc;

/// What the attractors of an operating point depend on.
pub type OperatingPointKey = (Arc<Design>, BasinsOptions);

/// Sends the progress, then the attractors with their basin fractions, peaks and warnings. Pages with the same design
/// share the computation.
///
/// # Errors
/// [`RequestFault`].
pub async fn respond(
    session: &Arc<Session>,
    request: Request,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let id = request.id;
    let RequestKind::OperatingPoint(options) = request.kind.clone() else {
        return Ok(());
    };
    let own = Arc::clone(session);
    let share = session.quick_share();
    let read = share.compute(cancellation, move |_| own.design(&request));
    let Some(design) = read.await.transpose()?.map(Arc::new) else {
        return Ok(());
    };
    let key = (Arc::clone(&design), options.clone());
    let (drives, analysis) = (Arc::clone(&design), session.analysis.fork());
    let found = session.host.operating_points.find_or_start(
        key,
        session.operating_point_share(),
        move |control| Ok(analysis.operating_point(&design, &options, control)?),
    );
    let stage = (id, "operating-point", "operating-point");
    let Some(result) = session.shared(stage, found, cancellation).await? else {
        return Ok(());
    };
    let basins = &result.basins;
    session.analysis.store_attractors(id, &drives, basins);
    let mut frame = Frame::new(id, "operating-point", "done");
    frame
        .put_all(&json!(basins))
        .put("peaks", json!(result.peaks))
        .put("limit_shares", json!(result.limit_shares))
        .put("stops", result.stops)
        .put("frequency_hz", drives.drive_frequency_hz()?);
    session.send_unless_stopped(cancellation, frame).await;
    Ok(())
}
