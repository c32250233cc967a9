//! Recording dropped onto the page, converted to times and values for a spec.

use crate::session::fault::RequestFault;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use jounce::live::ChannelFile;
use std::path::{Path, PathBuf};

/// Writes one channel of a recording, given as bytes, to a file in a folder; returns the file.
///
/// # Errors
/// [`RequestFault`]: the bytes are not a recording over time, or the channel must be named.
pub fn write_channel(
    name: &str,
    bytes: &str,
    channel: Option<&str>,
    folder: &Path,
) -> Result<(PathBuf, ChannelFile), RequestFault> {
    // Stored under its own name, which faults then show; a name from a page is never a path.
    let file_name = Path::new(name)
        .file_name()
        .ok_or_else(|| RequestFault::Text(format!("{name:?} is not the name of a file")))?;
    let (upload_folder, file) = (folder.join("dropped"), folder.join("recording.csv"));
    std::fs::create_dir(&upload_folder)?;
    let upload = upload_folder.join(file_name);
    std::fs::write(&upload, STANDARD.decode(bytes)?)?;
    let channel = ChannelFile::write(&upload, channel, &file)?;
    Ok((file, channel))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn upload(text: &str, channel_name: Option<&str>) -> Result<(String, String), String> {
        let folder = tempfile::tempdir().unwrap();
        let bytes = STANDARD.encode(text);
        match write_channel("bridge.csv", &bytes, channel_name, folder.path()) {
            Ok((file, own)) => Ok((std::fs::read_to_string(file).unwrap(), own.channel)),
            Err(RequestFault::Library(error)) => Err(error.to_string()),
            Err(RequestFault::Text(message)) => Err(message),
            Err(RequestFault::Fields(faults)) => Err(format!("{faults:?}")),
        }
    }

    #[test]
    fn one_channel_is_selected_and_one_of_several_must_be_named() {
        let one: String = (0..50)
            .map(|k| format!("{},{}\n", 0.01 * f64::from(k), k % 7))
            .collect();
        let (text, _) = upload(&format!("time (s),x\n{one}"), None).unwrap();
        assert_eq!(
            (text.lines().count(), text.lines().nth(9)),
            (51, Some("0.08,1.0"))
        );
        assert!(
            upload(&one, None)
                .unwrap_err()
                .contains("no column has a unit of time")
        );
        let two: String = (0..50)
            .map(|k| format!("{},{},{}\n", 0.01 * f64::from(k), k % 7, k % 5))
            .collect();
        let two = format!("time (s),left (g),right (m/s^2)\n{two}");
        let message = upload(&two, None).unwrap_err();
        assert!(
            message.starts_with("bridge.csv: name the channel; bridge has left, right"),
            "{message}"
        );
        let (text, channel) = upload(&two, Some("2")).unwrap();
        assert!(
            text.lines().nth(10).unwrap().ends_with(",4.0") && channel == "right in m/s^2",
            "{text} {channel}"
        );
        assert!(
            upload(&two, Some("middle"))
                .unwrap_err()
                .contains("no channel \"middle\"")
        );
    }

    #[test]
    fn a_file_that_is_no_recording_is_refused_with_its_name() {
        let message = upload("\u{89}PNG\r\n\u{1a}\n", None).unwrap_err();
        assert!(message.starts_with("bridge.csv: "), "{message}");
    }
}
