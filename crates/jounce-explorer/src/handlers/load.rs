//! Mean power over the load; points are sent one by one.

use super::sweep::{point_frame, send_end};
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::{Design, LivePoint, LoadOptions};

/// Sends the power without contact over the load first, then each integrated point.
///
/// # Errors
/// [`RequestFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    options: &LoadOptions,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let control = cancellation.control();
    let linear = session.analysis.linear_load(design, options, control)?;
    let mut frame = Frame::new(id, "load", "linear");
    frame
        .put("over", linear.over.as_str())
        .put("unit", linear.unit.as_str())
        .curve("linear", &linear.curve);
    session.send(cancellation, frame);
    let send = |point: LivePoint| {
        session.send(cancellation, point_frame(id, "load", &options.over, &point));
    };
    let points = design.load_sweep(options, control, &send)?;
    send_end(session, id, "load", points, cancellation);
    Ok(())
}
