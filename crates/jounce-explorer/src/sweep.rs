//! Marched points up and down over a key, as they come.

use crate::design::{Design, Wrong};
use crate::frame::Frame;
use crate::halt::Halt;
use crate::request::Over;
use crate::session::Session;
use jounce::spec::KeyRange;
use jounce::study::{Direction, Sweep, SweepPoint, Way};
use std::path::PathBuf;

/// Most values.
pub const MOST_POINTS: usize = 400;

/// Sends each point as soon as it is marched.
///
/// # Errors
/// [`Wrong`].
pub fn respond(session: &Session, id: u64, design: &Design, over: &Over, points: usize, halt: &Halt) -> Result<(), Wrong> {
    let key = design.range(&over.over, over.from, over.to)?;
    let text = format!("{}:{}:{}x", key.show(over.from), key.show(over.to), points.clamp(2, MOST_POINTS));
    let range = KeyRange::parse(key, &text).map_err(|fault| Wrong::Faults(vec![fault]))?;
    march(session, id, "sweep", design, &range, Direction::Both, halt)
}

/// Marches over a range; points carry the name of what was asked.
pub fn march(
    session: &Session,
    id: u64,
    ask: &str,
    design: &Design,
    range: &KeyRange,
    direction: Direction,
    halt: &Halt,
) -> Result<(), Wrong> {
    let sweep = Sweep { spec: &design.spec, range, direction, fixed_duration: false, folder: PathBuf::new() };
    let of = sweep.len();
    let done = |point: &SweepPoint| {
        let mut frame = Frame::new(id, ask, "point");
        frame.put("over", range.key().path()).put("of", of).put("index", point.index).put("x", point.parameter);
        frame.put("power", point.mean_power_w).put("voltage", point.voltage_rms_v).put("penetration", point.max_penetration_m);
        frame.put("settled", point.settled).put("up", point.direction != Way::Down);
        session.send(halt, frame);
    };
    sweep.run(None, halt.watch(), &done)?;
    let mut frame = Frame::new(id, ask, "done");
    frame.put("of", of);
    session.send(halt, frame);
    Ok(())
}
