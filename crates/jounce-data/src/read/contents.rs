//! Reads the complete contents of a file.

use std::io::Read as _;
use std::path::Path;

use crate::read::column::raw::Raw;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::read::format::{hdf5, lvm, mat, npy, npz, parquet, tdms, text, uff, wav};
use crate::read::{FileSummary, Notes, ReadError, RecordingSummary, assemble, magic};
use crate::recording::{Issue, IssueKind, Over, Recording};

/// Contents of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contents {
    /// Recordings: one for each set of channels that share a grid.
    pub recordings: Vec<Recording>,
    /// Mode shapes (UFF 55).
    pub shapes: Vec<ModeShape>,
    /// Issues that concern the complete file.
    pub issues: Vec<Issue>,
}

/// Mode shape or other set of nodal values, from UFF 55.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeShape {
    /// Natural frequency, Hz; NaN if missing.
    pub frequency_hz: f64,
    /// Viscous damping ratio; NaN if missing.
    pub damping_ratio: f64,
    /// Modal mass of a normal mode, in units of the file; NaN if missing.
    pub modal_mass: f64,
    /// Node numbers.
    pub nodes: Vec<i64>,
    /// Real part of each component at each node.
    pub real: Vec<Vec<f64>>,
    /// Imaginary parts of a complex shape.
    pub imaginary: Option<Vec<Vec<f64>>>,
}

/// Contents as returned by the reader of a format.
pub(in crate::read) struct FormatContents {
    pub sets: Vec<Raw>,
    pub shapes: Vec<ModeShape>,
    pub issues: Vec<Issue>,
}

impl From<Raw> for FormatContents {
    fn from(set: Raw) -> Self {
        Self {
            sets: vec![set],
            shapes: Vec::new(),
            issues: Vec::new(),
        }
    }
}

type Reader = fn(&Path, &SampleStore) -> Result<FormatContents, Damage>;

/// Reads a file of any known format and the notes that belong to it.
///
/// # Errors
/// A file that cannot be opened, is damaged, has an unknown format or contains no time, or whose
/// notes are wrong.
pub fn file(path: &Path) -> Result<Contents, ReadError> {
    read(path, &SampleStore::Memory, &Notes::for_file(path)?)?.into_contents(path)
}

/// Reads a file as [`file()`] does, but stores its numbers in a scratch file, so memory does not
/// grow with file size. Exception: for HDF5, the library holds an array of one row in memory.
///
/// # Errors
/// Those of [`file()`], and a scratch file that cannot be written.
pub fn summary(path: &Path) -> Result<FileSummary, ReadError> {
    summary_with_notes(path, &Notes::for_file(path)?)
}

/// Reads a file as [`summary()`] does, with these notes instead of those of the file.
///
/// # Errors
/// Those of [`summary()`].
pub fn summary_with_notes(path: &Path, notes: &Notes) -> Result<FileSummary, ReadError> {
    read(path, &SampleStore::scratch(), notes)
}

fn read(path: &Path, store: &SampleStore, notes: &Notes) -> Result<FileSummary, ReadError> {
    let (format, reader) = format_of(path)?;
    let contents = reader(path, store).map_err(|Damage { place, why }| ReadError::Damaged {
        path: path.to_owned(),
        format,
        place,
        why: format!("{why}{}", other_begin(path, format)),
    })?;
    let stem = path
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let has_several_sets = contents.sets.len() > 1;
    let mut summary = FileSummary {
        recordings: Vec::new(),
        shapes: contents.shapes,
        issues: contents.issues,
    };
    for (k, set) in contents.sets.into_iter().enumerate() {
        let name = match (has_several_sets, set.title.is_empty()) {
            (false, _) => stem.clone(),
            (true, true) => format!("{stem} {}", k + 1),
            (true, false) => format!("{stem} {}: {}", k + 1, set.title),
        };
        summary
            .recordings
            .push(assemble::recording(path, name, set, notes)?);
    }
    Ok(summary)
}

/// Extensions of the formats that are known by their first bytes.
const EXTENSIONS: [&str; 11] = [
    "parquet", "npy", "npz", "h5", "hdf5", "mat", "tdms", "wav", "uff", "unv", "lvm",
];

/// States where a file that was read as text has the name of another format.
fn other_begin(path: &Path, format: &str) -> String {
    let extension = path
        .extension()
        .map(|extension| extension.to_string_lossy());
    let is_other = |extension: &str| format == "text" && EXTENSIONS.contains(&extension);
    match extension.filter(|extension| is_other(&extension.to_lowercase())) {
        Some(extension) => {
            format!("; its name ends in .{extension}, but it does not begin as such a file")
        }
        None => String::new(),
    }
}

/// Reads the first time-domain recording of a file.
///
/// # Errors
/// Those of [`file()`], and a file without such a recording.
pub fn record(path: &Path) -> Result<Recording, ReadError> {
    let scratch_error = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    first_time_recording(
        path,
        read(path, &SampleStore::Memory, &Notes::for_file(path)?)?,
    )?
    .into_recording()
    .map_err(scratch_error)
}

/// Reads the first time-domain recording with its numbers in a scratch file, so that only the
/// channels needed are loaded.
///
/// # Errors
/// Those of [`summary()`], and a file without such a recording.
pub fn record_summary(path: &Path) -> Result<RecordingSummary, ReadError> {
    record_summary_with_notes(path, &Notes::for_file(path)?)
}

/// Reads a recording as [`record_summary()`] does, with these notes instead of those of the file.
///
/// # Errors
/// Those of [`record_summary()`].
pub fn record_summary_with_notes(
    path: &Path,
    notes: &Notes,
) -> Result<RecordingSummary, ReadError> {
    first_time_recording(path, summary_with_notes(path, notes)?)
}

/// Returns the first time-domain recording and reports those left out.
fn first_time_recording(path: &Path, summary: FileSummary) -> Result<RecordingSummary, ReadError> {
    let mut others = summary.recordings;
    let first = others
        .iter()
        .position(|recording| recording.over == Over::Time);
    let mut selected = others.remove(first.ok_or_else(|| ReadError::NoRecord {
        path: path.to_owned(),
    })?);
    if !others.is_empty() {
        let names: Vec<&str> = others
            .iter()
            .map(|recording| recording.name.as_str())
            .collect();
        let message = format!(
            "{} is used, the first recording over time in the file; left out: {}",
            selected.name,
            names.join(", ")
        );
        selected
            .issues
            .push(Issue::new(IssueKind::Skipped, others.len(), None, message));
    }
    Ok(selected)
}

/// Identifies the format by the first bytes of a file.
fn format_of(path: &Path) -> Result<(&'static str, Reader), ReadError> {
    let open_error = |reason| ReadError::Open {
        path: path.to_owned(),
        reason,
    };
    let mut head = Vec::new();
    let file = std::fs::File::open(path).map_err(open_error)?;
    if !file.metadata().map_err(open_error)?.is_file() {
        return Err(ReadError::Format {
            path: path.to_owned(),
            why: "it is not a file".to_owned(),
        });
    }
    file.take(4096).read_to_end(&mut head).map_err(open_error)?;
    let format_error = |why: &str| {
        Err(ReadError::Format {
            path: path.to_owned(),
            why: why.to_owned(),
        })
    };
    let first_line = head
        .split(|b| *b == b'\n')
        .map(<[u8]>::trim_ascii)
        .find(|line| !line.is_empty())
        .unwrap_or_default();
    match () {
        () if head.trim_ascii().is_empty() => format_error("it is empty"),
        () if head.starts_with(b"PAR1") => Ok(("Parquet", parquet::read as Reader)),
        () if head.starts_with(npy::BEGIN) => Ok(("NPY", npy::read)),
        () if head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06") => {
            Ok(("NPZ", npz::read))
        }
        () if hdf5::is_hdf5(&head) => Ok(("HDF5", hdf5::read)),
        () if head.starts_with(b"MATLAB 5.0") => Ok(("MAT v5", mat::read)),
        () if head.starts_with(tdms::BEGIN) => Ok(("TDMS", tdms::read)),
        () if wav::is_wav(&head) => Ok(("WAV", wav::read)),
        () if first_line == b"-1" => Ok(("UFF", uff::read)),
        () if head.starts_with(b"LabVIEW Measurement") => Ok(("LVM", lvm::read)),
        () if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") => {
            format_error("it is UTF-16 text: save it as UTF-8")
        }
        () if head.contains(&0) => match magic::describe(path, &head) {
            Some(description) => format_error(&format!("it is {description}")),
            None => format_error("it is a binary file of unknown format"),
        },
        () => Ok(("text", text::read)),
    }
}

#[cfg(test)]
mod tests {
    use super::EXTENSIONS;
    use std::collections::BTreeSet;

    /// A browser offers only the files that `accept` lists.
    #[test]
    fn the_live_page_offers_the_files_of_every_format() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../jounce-explorer/page");
        let page = std::fs::read_to_string(format!("{folder}/index.html")).expect("the page");
        let (_, input) = page
            .split_once("id=\"shake-file\" accept=\"")
            .expect("the field of the recording");
        let (accepted, _) = input.split_once('"').expect("a closed list");
        let accepted: BTreeSet<&str> = accepted.split(',').collect();
        let text = ["csv", "txt"];
        let expected: Vec<String> = text
            .iter()
            .chain(&EXTENSIONS)
            .map(|one| format!(".{one}"))
            .collect();
        assert_eq!(accepted, expected.iter().map(String::as_str).collect());
    }
}
