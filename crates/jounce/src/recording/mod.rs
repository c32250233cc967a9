//! Recordings: channels in SI units over time or frequency, with their data-quality issues.

mod channels;
mod load;
mod options;

pub use channels::{ChannelList, ChosenChannel, UsesChannels};
pub use options::ReadOptions;

use crate::error::Error;
use jounce_control::Control;
use jounce_data::read::{self, RawChannel};
use jounce_data::recording::{self as data, Channel, Grid, Issue, Over};
use std::path::Path;

/// A recording, and the computations on it.
///
/// ```
/// use jounce::{ReadOptions, Recording};
/// # let folder = std::env::temp_dir().join(format!("jounce-recording-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).unwrap();
/// let path = folder.join("floor.csv");
/// std::fs::write(&path, "time (ms),floor (g)\n0,0.5\n1,-0.5\n2,0.5\n").unwrap();
/// let recording = Recording::read(&path, &ReadOptions::default())?;
/// assert_eq!((recording.rate(), recording.samples()), (1000.0, 3));
/// assert_eq!(recording.channel("floor")?.values[0], 4.903325);
/// # std::fs::remove_dir_all(&folder).unwrap();
/// # Ok::<(), jounce::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recording {
    /// The loaded channels.
    data: data::Recording,
    /// All channels of the recording.
    list: ChannelList,
    /// Index among the loaded channels, of each channel of the list.
    loaded: Vec<Option<usize>>,
    control: Control,
}

impl PartialEq for Recording {
    fn eq(&self, other: &Self) -> bool {
        self.data == other.data && self.loaded == other.loaded
    }
}

impl Recording {
    /// Reads the first recording over time in a file of any known format, with the notes in
    /// `FILE.channels.toml`.
    ///
    /// # Errors
    /// [`Error::ReadRecording`] for a file that cannot be read, [`Error::Option`].
    pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, Error> {
        let path = path.as_ref();
        let summary = read::record_summary_with_notes(path, &options.notes(path)?)?;
        Ok(summary.into_recording().map_err(Error::Scratch)?.into())
    }

    /// Reads a recording as [`Recording::read`] does, and loads only the channels that a
    /// computation with these options uses: memory does not grow with the other channels.
    ///
    /// # Errors
    /// Those of [`Recording::read`].
    pub fn read_for(
        path: impl AsRef<Path>,
        options: &ReadOptions,
        usage: &impl UsesChannels,
    ) -> Result<Self, Error> {
        let path = path.as_ref();
        let mut summary = read::record_summary_with_notes(path, &options.notes(path)?)?;
        let list = ChannelList::of_summary(&summary);
        let mut numbers = Vec::new();
        // A choice that is not possible is an error of the computation.
        for chosen in usage.channels(&list).unwrap_or_default() {
            if !numbers.contains(&chosen.number) {
                numbers.push(chosen.number);
            }
        }
        let mut loaded = vec![None; list.len()];
        for (index, number) in numbers.iter().enumerate() {
            loaded[*number] = Some(index);
        }
        // The issues of all channels are kept.
        let issues = std::mem::take(&mut summary.issues);
        let data = summary
            .into_recording_of(&numbers)
            .map_err(Error::Scratch)?;
        let data = data::Recording { issues, ..data };
        Ok(Self {
            data,
            list,
            loaded,
            control: Control::default(),
        })
    }

    /// Returns a recording of channels in SI units, without issues.
    pub fn new(name: &str, over: Over, grid: Grid, channels: Vec<Channel>) -> Self {
        data::Recording {
            name: name.to_owned(),
            over,
            grid,
            channels,
            issues: Vec::new(),
        }
        .into()
    }

    /// Returns a recording of channels with units in the notation of instruments: values are
    /// converted to SI, and the issues of the samples are found.
    ///
    /// # Errors
    /// [`Error::Arrays`] for no channel, or a channel whose length differs from the grid.
    pub fn from_arrays(
        name: &str,
        over: Over,
        grid: Grid,
        channels: Vec<RawChannel>,
    ) -> Result<Self, Error> {
        Ok(read::recording_from_arrays(name, over, grid, channels)?.into())
    }

    /// Returns the recording with a control that its computations poll: it stops them.
    #[must_use]
    pub fn with_control(self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            ..self
        }
    }

    /// Returns the control of the computations.
    pub fn control(&self) -> &Control {
        &self.control
    }

    /// Returns the recording with further issues before its own.
    #[must_use]
    pub fn with_issues(mut self, issues: Vec<Issue>) -> Self {
        self.data.issues.splice(0..0, issues);
        self
    }

    /// Returns the name: the file name, with the number of the data set if the file has several.
    pub fn name(&self) -> &str {
        &self.data.name
    }

    /// Returns the independent variable.
    pub fn over(&self) -> Over {
        self.data.over
    }

    /// Returns the number of samples of each channel.
    pub fn samples(&self) -> usize {
        self.data.grid.len()
    }

    /// Returns the samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        self.data.rate()
    }

    /// Returns the names of all channels.
    pub fn channel_names(&self) -> Vec<String> {
        self.list.names()
    }

    /// Returns the channel of a name, or of a number from 1.
    ///
    /// # Errors
    /// [`Error::NoChannel`].
    pub fn channel(&self, name: &str) -> Result<&Channel, Error> {
        self.loaded_channel(self.list.find(name)?.number)
    }

    /// Returns the data-quality issues, and the conversions made.
    pub fn issues(&self) -> &[Issue] {
        &self.data.issues
    }

    /// Returns the channels, their samples and their places.
    pub fn data(&self) -> &data::Recording {
        &self.data
    }

    /// Returns the channels, their samples and their places, without a copy.
    pub fn into_data(self) -> data::Recording {
        self.data
    }

    /// Returns the recording at even steps without missing samples, by linear interpolation; issues
    /// list the corrections.
    ///
    /// # Errors
    /// [`Error::RecordingGrid`] for stamps without a rate.
    pub fn even(&self) -> Result<Self, Error> {
        Ok(self.data.even()?.into())
    }
}

impl From<data::Recording> for Recording {
    fn from(data: data::Recording) -> Self {
        let list = ChannelList::of_data(&data);
        let loaded = (0..list.len()).map(Some).collect();
        Self {
            data,
            list,
            loaded,
            control: Control::default(),
        }
    }
}
