//! Numbers of the page, saved to the file of the spec.

use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::source::Source;
use jounce::live::Design;

/// Writes a design into the file of the spec; comments and other lines remain. `before` is the text
/// of the file with which the page has compared the design.
///
/// # Errors
/// [`RequestFault`]: the spec has no file, the file has changed since, or it cannot be written.
pub fn save(
    id: u64,
    design: &Design,
    before: &str,
    source: &Source,
) -> Result<Frame, RequestFault> {
    let Some(path) = source.file() else {
        let message = "this spec has no file; export it instead";
        return Err(RequestFault::Text(message.to_owned()));
    };
    if source.read()?.text() != before {
        let message = "the file has changed meanwhile; compare again before you save";
        return Err(RequestFault::Text(message.to_owned()));
    }
    design.harvester().write(path)?;
    Ok(Frame::new(id, "save", "done"))
}
