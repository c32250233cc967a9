//! Mean power over the load: integrated points, and the closed form of the harvester without
//! contact.

use crate::cancellation::Cancellation;
use crate::design::{Design, DesignFault};
use crate::frame::Frame;
use crate::session::Session;
use crate::sweep::{self, MAX_POINTS};
use jounce_core::analysis::{Parameter, SweepOrder};
use jounce_core::linear::steady_power_w;
use jounce_core::orbit::ParametricModel;
use jounce_core::spec::KeyRange;

/// Ratio of the ends of the range to the present load.
const RATIO: f64 = 100.0;
/// Number of points of the linear curve.
const LINEAR_POINTS: usize = 121;

/// Sends the linear curve first, then each integrated point.
///
/// # Errors
/// [`DesignFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    over: &str,
    points: usize,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let key = design.key(over)?;
    let value = key
        .get(&design.spec)
        .map_err(|fault| DesignFault::Faults(vec![fault]))?;
    let (low, high) = key.limits();
    let (from, to) = ((value / RATIO).max(low), (value * RATIO).min(high));
    let text = format!(
        "{}:{}:{}log",
        key.show(from),
        key.show(to),
        points.clamp(2, MAX_POINTS)
    );
    let range =
        KeyRange::parse(key.clone(), &text).map_err(|fault| DesignFault::Faults(vec![fault]))?;
    let base = session.model(&design.spec, cancellation)?;
    let parameter = Parameter::new(&base, &key, to - from);
    let load_at = |k: usize| from * (to / from).powf(k as f64 / (LINEAR_POINTS - 1) as f64);
    let power = |k: usize| {
        parameter
            .at(load_at(k))
            .map_or(f64::NAN, |setting| steady_power_w(&setting.kernel.plant))
    };
    let mut frame = Frame::new(id, "load", "linear");
    frame.put("over", key.path()).put("unit", key.unit());
    frame
        .array("linear.x", (0..LINEAR_POINTS).map(load_at))
        .array("linear.power", (0..LINEAR_POINTS).map(power));
    session.send(cancellation, frame);
    sweep::run_sweep(
        session,
        id,
        "load",
        design,
        &range,
        SweepOrder::Independent,
        cancellation,
    )
}
