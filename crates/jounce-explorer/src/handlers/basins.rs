//! Basins of attraction over a plane of initial displacements and velocities.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::BasinsOptions;
use jounce::live::Design;
use jounce::parts::StartPoint;
use serde_json::json;

/// Number of the attractor of a start without one.
const NO_ATTRACTOR: f64 = -1.0;

/// Sends the progress, then the attractors with their basin fractions and the attractor of each
/// start. All cores work on the basins, whatever the request says.
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
    let options = BasinsOptions {
        threads: None,
        ..design.in_plane(options)?
    };
    let harvester = design.harvester().with_control(cancellation.control());
    let outcome = with_progress(session, (id, "basins"), cancellation, || {
        harvester.basins(&options)
    });
    let result = outcome?;
    session.analysis.store_attractors(id, design, &result);
    let points = &result.points;
    let attractor = |point: &StartPoint| point.attractor.map_or(NO_ATTRACTOR, |k| k as f64);
    let mut frame = Frame::new(id, "basins", "done");
    frame
        .put_all(&json!(result))
        .put("frequency_hz", design.drive_frequency_hz()?);
    frame
        .array(
            "displacement_m",
            points.iter().map(|own| own.displacement_m),
        )
        .array("velocity_m_s", points.iter().map(|own| own.velocity_m_s))
        .array("attractor", points.iter().map(attractor));
    session.send(cancellation, frame);
    Ok(())
}
