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
    pub findings: Vec<String>,
}

/// Reads a file from its bytes and writes one of its channels into a folder.
///
/// # Errors
/// [`DesignFault::Text`]: the file is not a recording over time, or the channel must be named.
pub fn read_upload(
    name: &str,
    bytes: &str,
    wanted: Option<&str>,
    folder: &Path,
) -> Result<Upload, DesignFault> {
    // Stored under its own name, which faults then show; a name from a page is never a path.
    let own = Path::new(name)
        .file_name()
        .ok_or_else(|| DesignFault::Text(format!("{name:?} is not the name of a file")))?;
    let (received, file) = (folder.join("dropped"), folder.join("recording.csv"));
    std::fs::create_dir(&received)?;
    std::fs::write(received.join(own), STANDARD.decode(bytes)?)?;
    let here = received.join("").display().to_string();
    let recording = read::record(&received.join(own))
        .map_err(|error| DesignFault::Text(error.to_string().replace(&here, "")))?
        .into_even()?;
    let channel = chosen(&recording, wanted)
        .map_err(|error| DesignFault::Text(format!("{name}: {error}")))?;
    let mut text = "time (s),value\n".to_owned();
    for (place, value) in recording.grid.places().iter().zip(&channel.values) {
        let _ = writeln!(text, "{place:?},{value:?}");
    }
    std::fs::write(&file, text)?;
    let of_this = |finding: &&Issue| {
        finding
            .channel
            .as_ref()
            .is_none_or(|own| *own == channel.name)
    };
    let findings = recording
        .findings
        .iter()
        .filter(of_this)
        .map(|finding| finding.about.clone())
        .collect();
    let unit = if channel.unit.is_empty() {
        String::new()
    } else {
        format!(" in {}", channel.unit)
    };
    Ok(Upload {
        file,
        channel: format!("{}{unit}", channel.name),
        findings,
    })
}

/// Returns the requested channel, or the only one; any quantity is allowed, since the scale
/// converts it.
fn chosen<'r>(recording: &'r Recording, wanted: Option<&str>) -> Result<&'r Channel, ChannelError> {
    match (wanted, &recording.channels[..]) {
        (Some(wanted), _) => Ok(recording.channel(wanted)?),
        (None, [only]) => Ok(only),
        (None, _) => Err(recording.unnamed()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn drop(text: &str, wanted: Option<&str>) -> Result<(String, String), String> {
        let folder = tempfile::tempdir().unwrap();
        let found = read_upload("bridge.csv", &STANDARD.encode(text), wanted, folder.path());
        let told = found.map(|found| (std::fs::read_to_string(found.file).unwrap(), found.channel));
        told.map_err(|wrong| {
            if let DesignFault::Text(words) = wrong {
                words
            } else {
                panic!("{wrong:?}")
            }
        })
    }

    #[test]
    fn one_channel_is_taken_and_one_of_several_is_named() {
        let one: String = (0..50)
            .map(|k| format!("{},{}\n", 0.01 * f64::from(k), k % 7))
            .collect();
        let (text, _) = drop(&format!("time (s),x\n{one}"), None).unwrap();
        assert_eq!(
            (text.lines().count(), text.lines().nth(9)),
            (51, Some("0.08,1.0"))
        );
        assert!(
            drop(&one, None)
                .unwrap_err()
                .contains("no column has a unit of time")
        );
        let two: String = (0..50)
            .map(|k| format!("{},{},{}\n", 0.01 * f64::from(k), k % 7, k % 5))
            .collect();
        let two = format!("time (s),left (g),right (m/s^2)\n{two}");
        let words = drop(&two, None).unwrap_err();
        assert!(
            words.starts_with("bridge.csv: name the channel; bridge has left, right"),
            "{words}"
        );
        let (text, channel) = drop(&two, Some("2")).unwrap();
        assert!(
            text.lines().nth(10).unwrap().ends_with(",4.0") && channel == "right in m/s^2",
            "{text} {channel}"
        );
        assert!(
            drop(&two, Some("middle"))
                .unwrap_err()
                .contains("no channel \"middle\"")
        );
    }

    #[test]
    fn what_is_no_recording_is_refused_by_its_own_name() {
        let words = drop("\u{89}PNG\r\n\u{1a}\n", None).unwrap_err();
        assert!(words.starts_with("bridge.csv: "), "{words}");
    }
}
