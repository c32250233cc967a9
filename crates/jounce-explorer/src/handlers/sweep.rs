//! Sweep over a key; points are sent one by one.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::{Design, KeySpan, LivePoint};

/// Sends each point up and down over a key as soon as it is integrated.
///
/// # Errors
/// [`RequestFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    (span, points): (&KeySpan, usize),
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let send = |point: LivePoint| {
        session.send(cancellation, point_frame(id, "sweep", &span.over, &point));
    };
    let points = design.sweep(span, points, cancellation.control(), &send)?;
    send_end(session, id, "sweep", points, cancellation);
    Ok(())
}

/// Returns the frame of an integrated point.
pub(super) fn point_frame(id: u64, kind: &str, over: &str, point: &LivePoint) -> Frame {
    let mut frame = Frame::new(id, kind, "point");
    frame
        .put("over", over)
        .put("of", point.points)
        .put("index", point.index)
        .put("x", point.parameter)
        .put("power", point.mean_power_w)
        .put("voltage", point.voltage_rms_v)
        .put("penetration", point.max_penetration_m)
        .put("settled", point.settled)
        .put("up", point.up);
    frame
}

/// Sends the frame after the last point.
pub(super) fn send_end(
    session: &Session,
    id: u64,
    kind: &str,
    points: usize,
    cancellation: &Cancellation,
) {
    let mut frame = Frame::new(id, kind, "done");
    frame.put("of", points);
    session.send(cancellation, frame);
}
