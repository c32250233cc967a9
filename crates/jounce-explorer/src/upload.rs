//! Recording dropped onto the page, converted to times and values for a spec.

use crate::design::DesignFault;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use jounce_measure::read;
use jounce_measure::recording::{Channel, ChannelError, Issue, Recording};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Recording with one selected channel.
pub struct Upload {
    /// Times and values, separated by commas.
    pub file: PathBuf,
    /// Name and unit of the channel.
    pub channel: String,
    /// Data-quality issues of the recording and this channel.
    pub issues: Vec<String>,
}

/// Reads a file from its bytes and writes one of its channels into a folder.
///
/// # Errors
/// [`DesignFault::Text`]: the file is not a recording over time, or the channel must be named.
pub fn read_upload(
    name: &str,
    bytes: &str,
    channel_name: Option<&str>,
    folder: &Path,
) -> Result<Upload, DesignFault> {
    // Stored under its own name, which faults then show; a name from a page is never a path.
    let file_name = Path::new(name)
        .file_name()
        .ok_or_else(|| DesignFault::Text(format!("{name:?} is not the name of a file")))?;
    let (upload_folder, file) = (folder.join("dropped"), folder.join("recording.csv"));
    std::fs::create_dir(&upload_folder)?;
    std::fs::write(upload_folder.join(file_name), STANDARD.decode(bytes)?)?;
    let folder_prefix = upload_folder.join("").display().to_string();
    let recording = read::record(&upload_folder.join(file_name))
        .map_err(|error| DesignFault::Text(error.to_string().replace(&folder_prefix, "")))?
        .into_even()?;
    let channel = select_channel(&recording, channel_name)
        .map_err(|error| DesignFault::Text(format!("{name}: {error}")))?;
    let mut text = "time (s),value\n".to_owned();
    for (position, value) in recording.grid.places().iter().zip(&channel.values) {
        let _ = writeln!(text, "{position:?},{value:?}");
    }
    std::fs::write(&file, text)?;
    let concerns_channel = |issue: &&Issue| {
        issue
            .channel
            .as_ref()
            .is_none_or(|issue_channel| *issue_channel == channel.name)
    };
    let issues = recording
        .findings
        .iter()
        .filter(concerns_channel)
        .map(|issue| issue.about.clone())
        .collect();
    let unit = if channel.unit.is_empty() {
        String::new()
    } else {
        format!(" in {}", channel.unit)
    };
    Ok(Upload {
        file,
        channel: format!("{}{unit}", channel.name),
        issues,
    })
}

/// Returns the requested channel, or the only one; any quantity is allowed, since the scale
/// converts it.
fn select_channel<'r>(
    recording: &'r Recording,
    channel_name: Option<&str>,
) -> Result<&'r Channel, ChannelError> {
    match (channel_name, &recording.channels[..]) {
        (Some(channel_name), _) => Ok(recording.channel(channel_name)?),
        (None, [only]) => Ok(only),
        (None, _) => Err(recording.unnamed()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn upload(text: &str, channel_name: Option<&str>) -> Result<(String, String), String> {
        let folder = tempfile::tempdir().unwrap();
        let result = read_upload(
            "bridge.csv",
            &STANDARD.encode(text),
            channel_name,
            folder.path(),
        );
        let text_and_channel = result.map(|result| {
            (
                std::fs::read_to_string(result.file).unwrap(),
                result.channel,
            )
        });
        text_and_channel.map_err(|fault| {
            if let DesignFault::Text(message) = fault {
                message
            } else {
                panic!("{fault:?}")
            }
        })
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
