//! Opening of the page in the user's browser.

use std::io::Write;
use tempfile::NamedTempFile;

/// Opens an address in the browser of the user.
///
/// Every user of the machine can read the command line of a process. So the browser opens a file
/// that only its owner may read and that redirects to the address. The file exists as long as the
/// returned value.
///
/// # Errors
/// No file can be written, or no browser can be started.
pub fn open_in_browser(address: &str) -> std::io::Result<NamedTempFile> {
    let mut file = tempfile::Builder::new()
        .prefix("jounce-")
        .suffix(".html")
        .tempfile()?;
    write!(
        file,
        "<!doctype html><meta charset=\"utf-8\"><title>jounce</title><meta http-equiv=\"refresh\" content=\"0; url={address}\"><a href=\"{address}\">jounce</a>"
    )?;
    file.flush()?;
    open::that_detached(file.path())?;
    Ok(file)
}
