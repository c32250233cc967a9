//! Files of instruments: their contents, and their conversion.

mod options;
mod report;
mod result;

pub use options::ConvertOptions;
pub use result::{ChannelResult, ReadResult, RecordingResult, ShapeResult};

use crate::error::Error;
use crate::recording::{ReadOptions, Recording};
use jounce_data::read::{FileSummary, summary_with_notes};
use jounce_data::recording::{Issue, Over};
use jounce_data::write::write_summary;
use jounce_io::table::Record;
use std::path::{Path, PathBuf};

/// A file of an instrument with its recordings and mode shapes. Its samples need not be in memory.
#[derive(Debug)]
pub struct RecordedFile {
    path: PathBuf,
    contents: FileSummary,
}

/// What was written by [`RecordedFile::convert`].
#[derive(Debug, Clone, PartialEq)]
pub struct Conversion {
    /// Name of the written recording.
    pub recording: String,
    /// Issues of the written part that the recording does not have.
    pub issues: Vec<Issue>,
    /// What the file contains and was not written.
    pub left_out: Vec<String>,
}

impl RecordedFile {
    /// Reads a file of any known format, with the notes in `FILE.channels.toml`.
    ///
    /// # Errors
    /// [`Error::ReadRecording`] for a file that cannot be read, [`Error::Option`].
    ///
    /// ```
    /// use jounce::{ConvertOptions, ReadOptions, RecordedFile};
    /// # let folder = std::env::temp_dir().join(format!("jounce-read-{}", std::process::id()));
    /// # std::fs::create_dir_all(&folder).unwrap();
    /// let path = folder.join("floor.csv");
    /// std::fs::write(&path, "time (ms),floor (g)\n0,0.5\n1,-0.5\n2,0.5\n").unwrap();
    /// let file = RecordedFile::read(&path, &ReadOptions::default())?;
    /// assert_eq!(file.result().recordings[0].channels[0].unit, "m/s^2");
    /// let part = ConvertOptions { span: Some("0 s:1 ms".into()), ..Default::default() };
    /// let written = file.convert(folder.join("part.parquet"), &part)?;
    /// println!("{}: {} issues", written.recording, written.issues.len());
    /// # std::fs::remove_dir_all(&folder).unwrap();
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, Error> {
        let path = path.as_ref().to_path_buf();
        let contents = summary_with_notes(&path, &options.notes(&path)?)?;
        Ok(Self { path, contents })
    }

    /// Returns the contents without the samples.
    pub fn result(&self) -> ReadResult {
        let FileSummary {
            recordings,
            shapes,
            issues,
        } = &self.contents;
        ReadResult {
            recordings: recordings.iter().map(RecordingResult::of).collect(),
            shape_frequencies_hz: shapes.iter().map(|shape| shape.frequency_hz).collect(),
            shapes: shapes.iter().map(ShapeResult::of).collect(),
            issues: issues.clone(),
        }
    }

    /// Writes the first recording, or a part of it, to another file in SI units: `.uff` (UFF 58 in
    /// ASCII), `.parquet` or `.csv`.
    ///
    /// # Errors
    /// [`Error::NoRecording`], [`Error::Option`], [`Error::NoChannel`], and [`Error::Write`] for
    /// another ending or a file that cannot be written.
    pub fn convert(
        &self,
        to: impl AsRef<Path>,
        options: &ConvertOptions,
    ) -> Result<Conversion, Error> {
        self.convert_with(to, options, None)
    }

    /// Converts like [`RecordedFile::convert`], with the record of the command.
    ///
    /// # Errors
    /// Those of [`RecordedFile::convert`].
    pub fn convert_with(
        &self,
        to: impl AsRef<Path>,
        options: &ConvertOptions,
        record: Option<Record>,
    ) -> Result<Conversion, Error> {
        let shapes = self.contents.shapes.len();
        let Some((recording, others)) = self.contents.recordings.split_first() else {
            let path = self.path.clone();
            return Err(Error::NoRecording { path, shapes });
        };
        if is_same_file(to.as_ref(), &self.path) {
            let expected = "it is the file that is read; choose another name";
            return Err(Error::option("to", to.as_ref().display(), expected));
        }
        let part = options.part(recording)?;
        write_summary(part.as_ref().unwrap_or(recording), to.as_ref(), record)?;
        let issues = part.iter().flat_map(|part| &part.issues);
        let issues = issues.filter(|issue| !recording.issues.contains(issue));
        let others = others.iter().map(|other| other.name.clone());
        let shapes = (shapes > 0).then(|| format!("{shapes} mode shapes"));
        Ok(Conversion {
            recording: recording.name.clone(),
            issues: issues.cloned().collect(),
            left_out: others.chain(shapes).collect(),
        })
    }

    /// Loads all recordings.
    ///
    /// # Errors
    /// [`Error::Scratch`].
    pub fn into_recordings(self) -> Result<Vec<Recording>, Error> {
        let recordings = self.contents.recordings.into_iter();
        let load = |recording: jounce_data::read::RecordingSummary| {
            let loaded = recording.into_recording().map_err(Error::Scratch)?;
            Ok(loaded.into())
        };
        recordings.map(load).collect()
    }
}

/// True where two paths lead to one existing file.
fn is_same_file(one: &Path, two: &Path) -> bool {
    one.canonicalize()
        .is_ok_and(|one| two.canonicalize().is_ok_and(|two| one == two))
}

impl Recording {
    /// Reads the recordings of a test: the first recording over time in each file, or all
    /// recordings of one file over frequency.
    ///
    /// # Errors
    /// Those of [`Recording::read`].
    pub fn read_test(paths: &[PathBuf], options: &ReadOptions) -> Result<Vec<Self>, Error> {
        if let [path] = paths {
            let file = RecordedFile::read(path, options)?;
            let mut recordings = file.contents.recordings.iter();
            if recordings.all(|recording| recording.over == Over::Frequency) {
                return file.into_recordings();
            }
        }
        let recordings = paths.iter();
        recordings.map(|path| Self::read(path, options)).collect()
    }

    /// Writes the recording in SI units, in the format of the ending: `.uff` (UFF 58 in ASCII),
    /// `.parquet` or `.csv`.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        self.write_with(path, None)
    }

    /// Writes the recording like [`Recording::write`], with the record of the command.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write_with(&self, path: impl AsRef<Path>, record: Option<Record>) -> Result<(), Error> {
        let summary = self.data().clone().into();
        Ok(write_summary(&summary, path.as_ref(), record)?)
    }

    /// Returns a part of the recording: a span, some channels, or an even grid.
    ///
    /// # Errors
    /// [`Error::Option`] for a span without a sample, [`Error::NoChannel`].
    pub fn part(&self, options: &ConvertOptions) -> Result<Self, Error> {
        let summary = self.data().clone().into();
        let part = options.part(&summary)?.unwrap_or(summary);
        Ok(part.into_recording().map_err(Error::Scratch)?.into())
    }
}
