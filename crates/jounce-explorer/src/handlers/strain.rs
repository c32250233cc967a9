//! Strain of the patches on the branches of a response.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;

/// Sends the largest strain at each point of each branch of a stored response.
///
/// # Errors
/// [`RequestFault`]: the response is no longer stored.
pub fn respond(
    session: &Session,
    id: u64,
    response: u64,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let strain = session.analysis.strain(response, cancellation.control())?;
    let mut frame = Frame::new(id, "strain", "done");
    frame.put("response", response);
    for (branch, values) in strain.iter().enumerate() {
        frame.list(&format!("{branch}.strain"), values);
    }
    session.send(cancellation, frame);
    Ok(())
}
