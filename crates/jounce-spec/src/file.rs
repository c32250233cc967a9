//! A spec file: its text, its overrides, and the resulting spec.

mod causes;

use std::path::{Path, PathBuf};

use super::fault::{Fault, Faults};
use super::key::Kind;
use super::nearest::clip;
use super::numeric_key::NumericKey;
use super::overrides::{Override, resolve};
use super::read::{ReadState, read_keys, read_number};
use super::read_error::{MAX_SPEC_BYTES, ReadError};
use super::source::{Lines, Source, SourcePlace, parse};
use super::{DriveSignal, KeyRange, Quantity, Recording, Spec, force_table_file, validation};
use std::sync::Arc;

/// Text of a spec with overrides.
///
/// ```
/// use jounce_spec::SpecFile;
/// let mut file = SpecFile::from_text("[mass.table]\nmass = \"12 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.3");
/// file.set("mass.table.damping_ratio", "0.05")?;
/// assert_eq!(file.spec()?.mass["table"].damping_ratio, Some(0.05));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SpecFile {
    text: String,
    source: Source,
    overrides: Vec<Override>,
    /// Folder to which the paths in the spec are relative.
    folder: PathBuf,
}

impl SpecFile {
    /// Reads a file. [`SpecFile::spec`] reports the faults of its contents.
    ///
    /// # Errors
    /// A path that is missing, a folder, not readable, larger than 16 MiB or not UTF-8 text.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let path = path.as_ref();
        let file = super::read_error::read_text(path).map(Self::from_text)?;
        Ok(Self {
            folder: path.parent().map_or_else(PathBuf::new, Path::to_path_buf),
            ..file
        })
    }

    /// Takes the text of a spec. [`SpecFile::spec`] reports its faults. Paths in it are relative to
    /// the current folder.
    pub fn from_text(text: impl Into<String>) -> Self {
        let text = text.into();
        let source = parse(if text.len() > MAX_SPEC_BYTES {
            ""
        } else {
            &text
        });
        Self {
            text,
            source,
            overrides: Vec::new(),
            folder: PathBuf::new(),
        }
    }

    /// Returns this file with its paths relative to another folder.
    #[must_use]
    pub fn in_folder(self, folder: &Path) -> Self {
        Self {
            folder: folder.to_path_buf(),
            ..self
        }
    }

    /// Overrides one key. The value is written as on a command line: `0.5 mm`, `"0.5 mm"`, `13`,
    /// `[0.1, 0.2]`, `table`; a value without characters removes the key.
    ///
    /// The element must exist in the file; an optional key of it may be new. Setting a key removes
    /// the keys that it excludes. A complete table, `{mass = "12 kg", frequency = "1 Hz"}`,
    /// replaces the table of this name or adds it.
    ///
    /// # Errors
    /// An unknown key, with the nearest key of this file. [`SpecFile::spec`] reports a wrong value.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), Fault> {
        let change = Override::new(&self.source.root, key, value, self.overrides.len());
        let change = change.map_err(|message| Fault {
            set: Some(Override::option_text(key, value)),
            ..Fault::without_position(&clip(key), message)
        })?;
        change.apply(&mut self.source.root);
        self.overrides.push(change);
        Ok(())
    }

    /// True where an override sets a key.
    pub fn sets(&self, key: &str) -> bool {
        self.overrides
            .iter()
            .any(|change| change.assignment().0 == key)
    }

    /// Returns the spec with the overrides applied.
    ///
    /// # Errors
    /// All faults, sorted by place; faults of overrides come first, those without a place last.
    pub fn spec(&self) -> Result<Spec, Faults> {
        self.read_spec()
            .map_err(|faults| Faults::new(self.with_causes(faults)))
    }

    /// Returns the spec, or its faults without their causes among the overrides.
    fn read_spec(&self) -> Result<Spec, Vec<Fault>> {
        if self.text.len() > MAX_SPEC_BYTES {
            return Err(vec![Fault {
                line: 1,
                column: 1,
                ..Fault::without_position("", "the spec is larger than 16 MiB")
            }]);
        }
        if self.source.errors.is_empty() && self.source.root.entries().is_some_and(<[_]>::is_empty)
        {
            let message = "the spec is empty; add at least one structure: [beam.NAME], [mass.NAME] or [modal.NAME]";
            return Err(vec![Fault {
                line: 1,
                column: 1,
                ..Fault::without_position("", message)
            }]);
        }
        let mut spec = Spec::default();
        let mut reading = ReadState::new(self.source.complete);
        read_keys("", &self.source.root, &mut spec, &mut reading);
        if self.source.complete {
            reading.add_broken(validation::broken(&spec));
            reading.add_broken(self.read_recordings(&mut spec));
            reading.add_broken(force_table_file::read_all(&self.folder, &mut spec));
        }
        if reading.found.is_empty() && self.source.errors.is_empty() {
            Ok(spec)
        } else {
            Err(self.faults(reading))
        }
    }

    /// Reads the recordings that the drives name; returns their faults by key.
    fn read_recordings(&self, spec: &mut Spec) -> Vec<(String, String)> {
        let mut faults = Vec::new();
        for (name, drive) in &mut spec.drive {
            let DriveSignal::Recording { file, .. } = &drive.signal else {
                continue;
            };
            if file.is_empty() {
                continue;
            }
            let outcome = Recording::read(&self.folder.join(file), drive);
            let DriveSignal::Recording { record, .. } = &mut drive.signal else {
                continue;
            };
            match outcome {
                Ok(outcome) => *record = Some(Arc::new(outcome)),
                Err((key, message)) => faults.push((
                    format!("drive.{name}.{key}"),
                    format!("drive.{name}.{key}: {message}"),
                )),
            }
        }
        faults
    }

    fn faults(&self, reading: ReadState) -> Vec<Fault> {
        let lines = Lines::new(&self.text);
        let syntax = self.source.errors.iter().map(|error| {
            let (line, column) = lines.line_and_column(error.offset);
            Fault {
                line,
                column,
                key: error.key.clone(),
                message: error.message.clone(),
                set: None,
            }
        });
        let read = reading.found.into_iter().map(|issue| {
            let fault = Fault::without_position(&clip(&issue.key), issue.message);
            match issue.position {
                SourcePlace::At(offset) => {
                    let (line, column) = lines.line_and_column(offset);
                    Fault {
                        line,
                        column,
                        ..fault
                    }
                }
                SourcePlace::Set(index) => Fault {
                    set: self.overrides.get(index).map(Override::to_string),
                    ..fault
                },
                SourcePlace::Nowhere => fault,
            }
        });
        syntax.chain(read).collect()
    }

    /// Returns the file with the overrides written into its text, to which faults then refer.
    #[must_use]
    pub fn written(&self) -> Self {
        Self::from_text(self.text()).in_folder(&self.folder)
    }

    /// Returns the text with the overrides written into it; comments and layout are retained.
    pub fn text(&self) -> String {
        let Ok(mut document) = self.text.parse::<toml_edit::DocumentMut>() else {
            return self.text.clone();
        };
        for change in &self.overrides {
            change.write_into(&mut document);
        }
        document.to_string()
    }

    /// Returns a key with one number that can be set many times.
    ///
    /// # Errors
    /// A spec with faults, an unknown key, or a key without a number.
    pub fn numeric_key(&self, key: &str) -> Result<NumericKey, Faults> {
        let info = resolve(&self.source.root, key)
            .map_err(|message| Fault::without_position(&clip(key), message))?;
        if !info.kind.is_numeric() {
            let message = format!(
                "{} is {}, not a number; give a key with a number",
                clip(key),
                info.kind.noun()
            );
            return Err(Fault::without_position(&clip(key), message).into());
        }
        let numeric = NumericKey::find(&self.spec()?, key)?;
        // A mass whose spring is given by its frequency retains the frequency, as if the file were
        // edited.
        let ["mass", name, "mass"] = key.split('.').collect::<Vec<_>>()[..] else {
            return Ok(numeric);
        };
        let frequency = self
            .source
            .root
            .get("mass")
            .and_then(|masses| masses.node.get(name)?.node.get("frequency"));
        let kind = Kind::Quantity(Quantity::Frequency);
        let value = frequency
            .and_then(|entry| read_number(kind, super::key::Range::POSITIVE, &entry.node).ok());
        Ok(match value {
            Some(frequency_hz) => numeric.holding(format!("mass.{name}.frequency"), frequency_hz),
            None => numeric,
        })
    }

    /// Returns a key with one number as [`SpecFile::numeric_key`], or every number of a list:
    /// `damping.ratios` stands for `damping.ratios.1`, `damping.ratios.2` and so on.
    ///
    /// # Errors
    /// As [`SpecFile::numeric_key`].
    pub fn numeric_keys(&self, key: &str) -> Result<Vec<NumericKey>, Faults> {
        let info = resolve(&self.source.root, key)
            .map_err(|message| Fault::without_position(&clip(key), message))?;
        if info.kind.is_list_of_numbers() || info.kind == Kind::NamedNumbers {
            let numeric = NumericKey::all_in(&self.spec()?, key)?;
            if !numeric.is_empty() {
                return Ok(numeric);
            }
        }
        Ok(vec![self.numeric_key(key)?])
    }

    /// Reads the range of a sweep, `"drive.shaker.frequency=4Hz:20Hz:0.1Hz"`; see [`KeyRange`].
    ///
    /// # Errors
    /// As [`SpecFile::numeric_key`], and a range that is empty, reversed, too long or in wrong
    /// units.
    pub fn range(&self, assignment: &str) -> Result<KeyRange, Faults> {
        let Some((key, range)) = assignment.split_once('=') else {
            let message = format!(
                "{}: expected KEY=FROM:TO:STEP, such as drive.shaker.frequency=4Hz:20Hz:0.1Hz",
                clip(assignment)
            );
            return Err(Fault::without_position("", message).into());
        };
        Ok(KeyRange::parse(self.numeric_key(key.trim())?, range)?)
    }
}

impl Spec {
    /// Reads a spec from TOML.
    ///
    /// # Errors
    /// All faults, sorted by place.
    pub fn from_toml(text: &str) -> Result<Self, Faults> {
        SpecFile::from_text(text).spec()
    }
}

impl std::str::FromStr for Spec {
    type Err = Faults;

    fn from_str(text: &str) -> Result<Self, Faults> {
        Self::from_toml(text)
    }
}
