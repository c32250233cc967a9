//! Opens the page in the user's browser.

use std::io::Write;
use tempfile::NamedTempFile;

/// Opens an address in the browser of the user.
///
/// The command line of a process can be read by every user of the machine. So the browser is given a file that only its owner may read,
/// which sends it on to the address. The file lives as long as what is returned.
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
