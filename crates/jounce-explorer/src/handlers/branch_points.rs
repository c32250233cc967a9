//! Points of a response whose orbits are given ones.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::Error;
use jounce::live::{BranchPlace, SoughtOrbit};
use serde_json::json;

/// Sends the point of each orbit, or null where no branch of the response is proved to have it.
///
/// # Errors
/// [`RequestFault`]: the response or an attractor is no longer stored.
pub fn respond(
    session: &Session,
    id: u64,
    response: u64,
    orbits: &[Option<SoughtOrbit>],
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let place = |orbit: &Option<SoughtOrbit>| match orbit {
        Some(orbit) => {
            let analysis = &session.analysis;
            analysis.branch_point(response, orbit, cancellation.control())
        }
        None => Ok(None),
    };
    let places: Result<Vec<Option<BranchPlace>>, Error> = orbits.iter().map(place).collect();
    let mut frame = Frame::new(id, "branch-points", "done");
    frame.put("places", json!(places?));
    session.send(cancellation, frame);
    Ok(())
}
