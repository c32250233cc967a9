//! A recording that was dropped onto the page, made what a spec takes: times and values.

use crate::design::Wrong;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use jounce_measure::read;
use jounce_measure::recording::{Channel, Over, Recording};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Longest ending of a name that is kept.
const ENDING: usize = 8;

/// A recording with one channel chosen.
pub struct Dropped {
    /// Times and values, separated by commas.
    pub file: PathBuf,
    /// Name and unit of the channel.
    pub channel: String,
    /// What was noticed about the recording and this channel.
    pub findings: Vec<String>,
}

/// Reads a file by its bytes and writes one of its channels into a folder.
///
/// # Errors
/// [`Wrong::Text`]: what is no recording over time, or a channel that must be named.
pub fn dropped(name: &str, bytes: &str, wanted: Option<&str>, folder: &Path) -> Result<Dropped, Wrong> {
    let ending: String = Path::new(name).extension().unwrap_or_default().to_string_lossy().chars().take(ENDING).collect();
    let plain = if ending.chars().all(|letter| letter.is_ascii_alphanumeric()) { ending } else { String::new() };
    let (received, file) = (folder.join("received").with_extension(plain), folder.join("recording.csv"));
    std::fs::write(&received, STANDARD.decode(bytes)?)?;
    let own = |words: &str| Wrong::Text(words.replace(&received.display().to_string(), name).replace("received", name));
    let contents = read::file(&received).map_err(|error| own(&error.to_string()))?;
    let over_time = contents.recordings.into_iter().find(|recording| recording.over == Over::Time);
    let recording = over_time.ok_or_else(|| own(&format!("{name} holds no recording over time")))?.even()?;
    let channel = chosen(&recording, wanted).map_err(|words| own(&format!("{name}: {words}")))?;
    let mut text = String::new();
    for (place, value) in recording.grid.places().iter().zip(&channel.values) {
        let _ = writeln!(text, "{place:?},{value:?}");
    }
    std::fs::write(&file, text)?;
    let of_this = |finding: &&jounce_measure::recording::Finding| finding.channel.as_ref().is_none_or(|own| *own == channel.name);
    let findings = recording.findings.iter().filter(of_this).map(|finding| finding.about.clone()).collect();
    let unit = if channel.unit.is_empty() { String::new() } else { format!(" in {}", channel.unit) };
    Ok(Dropped { file, channel: format!("{}{unit}", channel.name), findings })
}

/// The wanted channel, or the only one.
fn chosen<'r>(recording: &'r Recording, wanted: Option<&str>) -> Result<&'r Channel, String> {
    match (wanted, &recording.channels[..]) {
        (Some(wanted), _) => recording.channel(wanted).map_err(|error| error.to_string()),
        (None, [only]) => Ok(only),
        (None, all) => {
            let names: Vec<&str> = all.iter().map(|channel| channel.name.as_str()).collect();
            Err(format!("which of its channels? Name one of {}, or its number from 1", names.join(", ")))
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn drop(text: &str, wanted: Option<&str>) -> Result<(String, String), String> {
        let folder = tempfile::tempdir().unwrap();
        let found = dropped("bridge.csv", &STANDARD.encode(text), wanted, folder.path());
        let told = found.map(|found| (std::fs::read_to_string(found.file).unwrap(), found.channel));
        told.map_err(|wrong| if let Wrong::Text(words) = wrong { words } else { panic!("{wrong:?}") })
    }

    #[test]
    fn one_channel_is_taken_and_one_of_several_is_named() {
        let one: String = (0..50).map(|k| format!("{},{}\n", 0.01 * f64::from(k), k % 7)).collect();
        let (text, _) = drop(&one, None).unwrap();
        assert_eq!((text.lines().count(), text.lines().nth(9)), (50, Some("0.09,2.0")));
        let two: String = (0..50).map(|k| format!("{},{},{}\n", 0.01 * f64::from(k), k % 7, k % 5)).collect();
        let two = format!("time (s),left (g),right (m/s^2)\n{two}");
        let words = drop(&two, None).unwrap_err();
        assert!(words.starts_with("bridge.csv: which of its channels?") && words.contains("left"), "{words}");
        let (text, channel) = drop(&two, Some("2")).unwrap();
        assert!(text.lines().nth(9).unwrap().ends_with(",4.0") && channel == "right in m/s^2", "{text} {channel}");
        assert!(drop(&two, Some("middle")).unwrap_err().contains("no channel \"middle\""));
    }

    #[test]
    fn what_is_no_recording_is_refused_by_its_own_name() {
        let words = drop("\u{89}PNG\r\n\u{1a}\n", None).unwrap_err();
        assert!(words.contains("bridge.csv") && !words.contains("received"), "{words}");
    }
}
