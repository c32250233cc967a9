//! Sweep up and down over a key; points are sent one by one.

use crate::cancellation::Cancellation;
use crate::design::{Design, DesignFault};
use crate::frame::Frame;
use crate::request::KeySpan;
use crate::session::Session;
use jounce_core::analysis::{Sweep, SweepDirection, SweepOrder, SweepPoint};
use jounce_core::spec::KeyRange;
use std::path::PathBuf;

/// Largest number of values.
pub const MAX_POINTS: usize = 400;

/// Sends each point as soon as it is integrated.
///
/// # Errors
/// [`DesignFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    span: &KeySpan,
    points: usize,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let key = design.range(&span.over, span.from, span.to)?;
    let text = format!(
        "{}:{}:{}x",
        key.show(span.from),
        key.show(span.to),
        points.clamp(2, MAX_POINTS)
    );
    let range = KeyRange::parse(key, &text).map_err(|fault| DesignFault::Faults(vec![fault]))?;
    run_sweep(
        session,
        id,
        "sweep",
        design,
        &range,
        SweepOrder::Both,
        cancellation,
    )
}

/// Runs a sweep over a range; each point has the name of its request.
pub fn run_sweep(
    session: &Session,
    id: u64,
    kind: &str,
    design: &Design,
    range: &KeyRange,
    direction: SweepOrder,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let sweep = Sweep {
        spec: &design.spec,
        range,
        direction,
        fixed_duration: false,
        folder: PathBuf::new(),
    };
    let total = sweep.len();
    let send_point = |point: &SweepPoint| {
        let mut frame = Frame::new(id, kind, "point");
        frame
            .put("over", range.key().path())
            .put("of", total)
            .put("index", point.index)
            .put("x", point.parameter);
        frame
            .put("power", point.mean_power_w)
            .put("voltage", point.voltage_rms_v)
            .put("penetration", point.max_penetration_m);
        frame
            .put("settled", point.settled)
            .put("up", point.direction != SweepDirection::Down);
        session.send(cancellation, frame);
    };
    sweep.run(None, cancellation.control(), &send_point)?;
    let mut frame = Frame::new(id, kind, "done");
    frame.put("of", total);
    session.send(cancellation, frame);
    Ok(())
}
