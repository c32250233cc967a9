//! Stretch of the motion of an attractor without a period.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::AttractorPlace;

/// Sends the Poincaré section and the time history.
///
/// # Errors
/// [`RequestFault`]: the attractor is no longer stored or has a period, or the integration fails.
pub fn respond(
    session: &Session,
    id: u64,
    place: &AttractorPlace,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let analysis = &session.analysis;
    let motion = analysis.aperiodic_motion(place, cancellation.control())?;
    let mut frame = Frame::new(id, "aperiodic-motion", "done");
    frame
        .put("cycles", motion.cycles)
        .put("history_cycles", motion.history_cycles)
        .put("mean_power_w", motion.mean_power_w)
        .put("gap_m", motion.gap_m);
    frame.list("time", &motion.time_s);
    for (name, points) in [("section", &motion.section), ("history", &motion.history)] {
        frame
            .array(
                &format!("{name}.displacement"),
                points.iter().map(|own| own.displacement_m),
            )
            .array(
                &format!("{name}.velocity"),
                points.iter().map(|own| own.velocity_m_s),
            )
            .array(
                &format!("{name}.voltage"),
                points.iter().map(|own| own.voltage_v),
            );
    }
    session.send(cancellation, frame);
    Ok(())
}
