//! Options of the conversion of a recording.

use crate::error::Error;
use crate::options::{defaults, ends};
use jounce_data::read::RecordingSummary;
use jounce_data::recording::{Over, Series as _, find_channel};
use jounce_spec::Quantity;
use serde::{Deserialize, Serialize};

/// Options of [`crate::RecordedFile::convert`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ConvertOptions {
    /// Part of the recording to write, in its own times or frequencies, as in 10s:60s or 5Hz:200Hz;
    /// by default all of it.
    #[arg(long, value_name = "FROM:TO")]
    pub span: Option<String>,
    /// Channel to write, by name or by number from 1; can be given several times; by default all
    /// channels.
    #[arg(long, value_name = "CHANNEL")]
    pub channel: Vec<String>,
    /// Resamples to even times without missing samples; by default the recording is written
    /// unchanged.
    #[arg(long)]
    pub even: bool,
}

impl Default for ConvertOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ConvertOptions {
    /// Returns the selected part of a recording; `None` where all of it is selected.
    pub(super) fn part(
        &self,
        recording: &RecordingSummary,
    ) -> Result<Option<RecordingSummary>, Error> {
        if *self == Self::default() {
            return Ok(None);
        }
        let span = match &self.span {
            None => (f64::NEG_INFINITY, f64::INFINITY),
            Some(span) => span_of(recording, span)?,
        };
        let number = |name: &String| find_channel(&recording.name, &recording.heads(), name);
        let channels = match &self.channel[..] {
            [] => (0..recording.channels.len()).collect(),
            names => names.iter().map(number).collect::<Result<Vec<_>, _>>()?,
        };
        let nothing = || {
            let expected = format!("{} has no sample in this range", recording.name);
            Error::option("span", self.span.clone().unwrap_or_default(), expected)
        };
        let slice = recording.slice(span, &channels).map_err(Error::Scratch)?;
        let slice = slice.ok_or_else(nothing)?;
        if !self.even {
            return Ok(Some(slice));
        }
        let loaded = slice.into_recording().map_err(Error::Scratch)?;
        Ok(Some(loaded.into_even()?.into()))
    }
}

/// Returns the ends of a part of a recording.
fn span_of(recording: &RecordingSummary, span: &str) -> Result<(f64, f64), Error> {
    let (quantity, unit) = match recording.over {
        Over::Time => (Quantity::Time, "s"),
        Over::Frequency => (Quantity::Frequency, "Hz"),
    };
    let (from, to) = ends(span, quantity).map_err(|reason| Error::option("span", span, reason))?;
    let (mut lowest, mut highest) = (f64::NAN, f64::NAN);
    let extend = |place: f64| (lowest, highest) = (lowest.min(place), highest.max(place));
    recording.places.each(extend).map_err(Error::Scratch)?;
    if from <= highest && to >= lowest {
        return Ok((from, to));
    }
    let name = &recording.name;
    let expected = format!(
        "there is no sample in this range: {name} extends from {lowest} {unit} to {highest} {unit}"
    );
    Err(Error::option("span", span, expected))
}
