//! The harvester of a spec.

use crate::error::Error;
use jounce_analysis::Model;
use jounce_control::Control;
use jounce_data::recording::Issue;
use jounce_io::store;
use jounce_io::table::Manifest;
use jounce_spec::{NumericKey, Spec, SpecFile};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// Key of the relative tolerance of the integration.
const TOLERANCE: &str = "run.tolerance";

/// A harvester: a valid spec, and the computations on it.
///
/// ```
/// use jounce::{Harvester, RunOptions};
/// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
/// let mut harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
/// harvester.set("stop.tip.gap", "0.5 mm")?;
/// let result = harvester.run(&RunOptions::default())?;
/// println!("{:.3e} W, settled: {:?}", result.mean_power_w, result.settled);
/// # Ok::<(), jounce::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Harvester {
    file: SpecFile,
    folder: PathBuf,
    spec: Spec,
    control: Control,
    /// The model, created by the first computation and shared by all copies of this harvester.
    model: Arc<OnceLock<Model>>,
    /// The digest of the spec, likewise.
    hash_hex: Arc<OnceLock<String>>,
}

/// Value of a key with a number.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyValue {
    /// Value in SI units.
    pub value_si: f64,
    /// SI unit, as text.
    pub unit: String,
}

impl Harvester {
    /// Reads a spec file (TOML). Paths in the spec are relative to its folder.
    ///
    /// # Errors
    /// [`Error::Read`] for a file that cannot be read, [`Error::Spec`] with all faults of the spec.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        Self::of(SpecFile::read(path)?, folder)
    }

    /// Takes the text of a spec. Paths in the spec are relative to `folder`.
    ///
    /// # Errors
    /// [`Error::Spec`] with all faults.
    ///
    /// ```
    /// let text = "[mass.table]\nmass = \"12 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.3";
    /// let harvester = jounce::Harvester::from_text(text, ".")?;
    /// assert_eq!(harvester.get("mass.table.frequency")?.value_si, 1.0);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn from_text(text: &str, folder: impl AsRef<Path>) -> Result<Self, Error> {
        let folder = folder.as_ref().to_path_buf();
        Self::of(SpecFile::from_text(text).in_folder(&folder), folder)
    }

    /// Checks a spec file with its overrides.
    ///
    /// # Errors
    /// [`Error::Spec`] with all faults.
    pub fn of(file: SpecFile, folder: PathBuf) -> Result<Self, Error> {
        let spec = file.spec()?;
        Ok(Self {
            file,
            folder,
            spec,
            control: Control::default(),
            model: Arc::default(),
            hash_hex: Arc::default(),
        })
    }

    /// Sets a key, for example `set("stop.tip.gap", "0.5 mm")`; a value without characters removes
    /// it. An error changes nothing.
    ///
    /// # Errors
    /// [`Error::Spec`] for an unknown key or an invalid value.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), Error> {
        *self = self.changed([(key, value)])?;
        Ok(())
    }

    /// Returns a copy with keys set together. Places in later faults are those in its
    /// [`Harvester::text`].
    ///
    /// # Errors
    /// [`Error::Spec`] with the faults of all keys.
    pub fn changed<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, Error> {
        let mut file = self.file.clone();
        let set = |(key, value)| file.set(key, value).err();
        let faults: Vec<_> = values.into_iter().filter_map(set).collect();
        if !faults.is_empty() {
            return Err(Error::Spec(faults.into()));
        }
        let changed = Self::of(file, self.folder.clone())?;
        Ok(Self {
            control: self.control.clone(),
            file: changed.file.written(),
            ..changed
        })
    }

    /// Returns the origin of a result of this harvester: the SHA-256 of its spec, the question and
    /// its options.
    ///
    /// # Errors
    /// [`Error::Table`] for an option that JSON cannot hold.
    pub fn manifest(&self, question: &str, options: &impl Serialize) -> Result<Manifest, Error> {
        let manifest = Manifest::new(self.hash_hex()).with("command", question);
        Ok(manifest.with_options(options)?)
    }

    /// Returns the SHA-256 of the canonical form of the spec, in hexadecimal.
    pub fn hash_hex(&self) -> &str {
        self.hash_hex.get_or_init(|| self.spec.hash_hex())
    }

    /// Checks a tolerance of the integration that replaces the one of the spec.
    pub(crate) fn check_tolerance(&self, tolerance: f64) -> Result<(), Error> {
        if self.file.sets(TOLERANCE) {
            let expected = format!("{TOLERANCE} is set too; omit one of them");
            return Err(Error::option("tolerance", tolerance, expected));
        }
        let (low, high) = NumericKey::find(self.spec(), TOLERANCE)?.limits();
        if !(low..=high).contains(&tolerance) {
            let expected = format!("it must be from {low:e} to {high}");
            return Err(Error::option("tolerance", tolerance, expected));
        }
        Ok(())
    }

    /// Returns a copy with a tolerance of the integration; `None` keeps the one of the spec.
    pub(crate) fn with_tolerance(&self, tolerance: Option<f64>) -> Result<Self, Error> {
        let Some(tolerance) = tolerance else {
            return Ok(self.clone());
        };
        self.check_tolerance(tolerance)?;
        self.changed([(TOLERANCE, format!("{tolerance:e}").as_str())])
    }

    /// Returns the value of a key with a number.
    ///
    /// # Errors
    /// [`Error::Spec`] for an unknown key or a key without a number.
    pub fn get(&self, key: &str) -> Result<KeyValue, Error> {
        let key = NumericKey::find(&self.spec, key)?;
        Ok(KeyValue {
            value_si: key.get(&self.spec)?,
            unit: key.unit(),
        })
    }

    /// Returns the data-quality issues of the recordings that the drives use, with the drive.
    pub fn issues(&self) -> impl Iterator<Item = (&str, &Issue)> {
        self.spec.issues()
    }

    /// Returns the text of the spec with the set keys written into it.
    pub fn text(&self) -> String {
        self.file.text()
    }

    /// Writes that text to a file, completely or not at all.
    ///
    /// # Errors
    /// [`Error::File`] for a file that cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        Ok(store::write(path.as_ref(), self.text().as_bytes())?)
    }

    /// Returns the spec file with its overrides.
    pub fn file(&self) -> &SpecFile {
        &self.file
    }

    /// Returns the validated spec.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Returns the folder to which paths in the spec are relative.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns a copy whose computations poll a control: it reports progress and stops them.
    #[must_use]
    pub fn with_control(&self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            ..self.clone()
        }
    }

    /// Returns the control of the computations.
    pub fn control(&self) -> &Control {
        &self.control
    }

    /// Returns the model under the control of this harvester.
    ///
    /// # Errors
    /// [`Error::Analysis`] for a structure or circuit without a solution.
    pub fn model(&self) -> Result<Model, Error> {
        let known = match self.model.get() {
            Some(known) => known,
            None => {
                let made = Model::watched(self.spec.clone(), &self.control)?;
                // A model created under a stopped control lacks its noise.
                if self.control.is_stopped() {
                    return Ok(made);
                }
                let unwatched = made.with_control(&Control::default())?;
                self.model.get_or_init(|| unwatched)
            }
        };
        Ok(known.with_control(&self.control)?)
    }
}
