//! The problem: what is free, what is wanted, and what must not be exceeded.

mod allowed_limit;
mod combinations;
mod condition;
mod free_key;
mod free_range;
mod goal;
mod limit;
mod limited_quantity;
mod read;
mod size;
mod tolerance;

pub use allowed_limit::{AllowedLimit, allowed_limits};
pub use condition::Condition;
pub use free_key::{Choice, ChoiceIndex, FreeKey, FreeValues};
pub use free_range::FreeRange;
pub use goal::Goal;
pub use limit::Limit;
pub(crate) use limit::larger;
pub use limited_quantity::LimitedQuantity;
pub use size::Size;
pub use tolerance::Tolerance;

use crate::DesignError;
use crate::evaluation::Effort;
use jounce_analysis::run::identity_text;
use jounce_analysis::{DerivativeKey, Model};
use jounce_control::Control;
use jounce_orbits::OrbitQuantity;
use jounce_spec::{Fault, NumericKey, Spec, SpecFile};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// A design problem.
#[derive(Debug, Clone)]
pub struct Problem {
    /// File of the spec as given.
    pub file: SpecFile,
    /// Spec as given.
    pub spec: Spec,
    /// Specs of all combinations of choices; the first choice varies fastest.
    variants: Vec<SpecFile>,
    /// Folder of the files that the spec names.
    pub folder: PathBuf,
    /// Free keys.
    pub free: Vec<FreeKey>,
    /// Goals to maximise; several have a front.
    pub goals: Vec<Goal>,
    /// Number of starts of the cloud.
    pub starts: usize,
    /// Limits.
    pub limits: Vec<Limit>,
    /// Conditions; one without changes if the file has none.
    pub conditions: Vec<Condition>,
    /// Changes of the spec by text in conditions, as `--set` takes them; the first has none.
    pub changes: Vec<Vec<(String, String)>>,
    /// True where a drive is noise, in any condition.
    has_noise: bool,
    /// Tolerances of the workshop.
    pub tolerances: Vec<Tolerance>,
    /// Number of draws for each quantile and index.
    pub draws: usize,
    /// Seed of the search, of the cloud and of the draws.
    pub seed: u64,
    /// Largest number of evaluated designs.
    pub evaluations: usize,
    /// Largest wall time of the search, s.
    pub seconds: Option<f64>,
    hash_hex: String,
}

/// Spec of a problem.
struct SpecSource {
    file: SpecFile,
    /// Name in messages.
    name: String,
    /// Folder of the files that the spec names.
    folder: PathBuf,
}

impl Problem {
    /// Reads a file; the path of its spec is relative to its folder.
    ///
    /// # Errors
    /// A file that cannot be read; all faults in it.
    pub fn read(path: &Path) -> Result<Self, DesignError> {
        let unreadable = |reason: std::io::Error| DesignError::Unreadable {
            path: path.to_owned(),
            reason: jounce_io::store::unreadable(path, &reason),
        };
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        let parent = path.parent().unwrap_or(Path::new(""));
        read::read(&text, |named| {
            let Some(named) = named else {
                let message =
                    "the design names no spec; write spec = \"harvester.toml\" at its top";
                return Err(fault_of_spec(message));
            };
            let path = parent.join(named);
            Ok(SpecSource {
                file: SpecFile::read(&path)?,
                name: path.display().to_string(),
                folder: path.parent().map_or_else(PathBuf::new, Path::to_path_buf),
            })
        })
    }

    /// Creates a problem of a spec from its text. A spec that the text names, relative to
    /// `text_folder`, must be the same one; `folder` is that of the files that the spec names.
    ///
    /// # Errors
    /// As [`Problem::read`], and a text that names another spec.
    pub fn with_spec(
        file: SpecFile,
        folder: &Path,
        text: &str,
        text_folder: &Path,
    ) -> Result<Self, DesignError> {
        read::read(text, |named| {
            if let Some(named) = named {
                let other = SpecFile::read(text_folder.join(named))?;
                if !is_same_spec(&file, &other) {
                    return Err(fault_of_spec(&format!(
                        "the design is one of another spec than \"{named}\"; call it on \"{named}\" as it is, or omit the key"
                    )));
                }
            }
            Ok(SpecSource {
                file,
                name: "the spec of the design".to_owned(),
                folder: folder.to_path_buf(),
            })
        })
    }

    /// Returns the SHA-256 of the text and of all specs with their recordings and start states:
    /// everything that determines the result.
    pub fn hash_hex(&self) -> &str {
        &self.hash_hex
    }

    /// Returns the models of all combinations of choices, for each change by a condition.
    pub(crate) fn models(&self, control: &Control) -> Result<Vec<Vec<Model>>, DesignError> {
        let of_change = |change: usize| {
            let files = self.variants.iter();
            let models = files.map(|file| self.changed_model(file, change, control));
            models.collect()
        };
        (0..self.changes.len()).map(of_change).collect()
    }

    /// Returns the model of a spec with the change of a condition.
    pub(crate) fn changed_model(
        &self,
        file: &SpecFile,
        change: usize,
        control: &Control,
    ) -> Result<Model, DesignError> {
        let (mut file, mut faults) = (file.clone(), Vec::new());
        for (path, value) in &self.changes[change] {
            faults.extend(file.set(path, value).err());
        }
        let spec = match faults.is_empty() {
            true => file.spec(),
            false => Err(faults.into()),
        };
        let spec = spec.map_err(|faults| DesignError::Spec {
            file: "a choice or a condition of the design".to_owned(),
            faults,
        })?;
        Ok(Model::watched(spec, control)?)
    }

    /// Returns the values of the numeric keys of the design at a place of the unit cube, SI.
    pub(crate) fn numbers(&self, place: &[f64]) -> Vec<(&NumericKey, f64)> {
        let mut all = Vec::with_capacity(self.free.len());
        for (_, free, coordinate) in self.applying(place) {
            if let FreeValues::Range(range) = &free.values {
                all.push((&range.key, range.value(coordinate)));
            }
        }
        all
    }

    /// True where a goal is the power of an orbit in one condition, so that a search can follow the
    /// orbit.
    pub(crate) fn follows_orbit(&self) -> bool {
        self.needs_starts() && self.conditions.len() == 1
    }

    /// Returns the effort of a first evaluation: a goal without starts has only one, unless limits are
    /// examined under noise.
    pub(crate) fn screening(&self) -> Effort {
        match self.needs_starts() || self.limits_noise() {
            true => Effort::Screening,
            false => Effort::Full,
        }
    }

    /// True where a goal needs the attractors of a cloud of starts.
    pub(crate) fn needs_starts(&self) -> bool {
        self.goals.iter().any(|goal| goal.needs_starts())
    }

    /// True where a limit depends on the realisation of the noise.
    pub(crate) fn limits_noise(&self) -> bool {
        self.realises_noise() && self.limits.iter().any(Limit::depends_on_run)
    }

    /// True where a goal depends on the realisation of the noise.
    pub(crate) fn realises_noise(&self) -> bool {
        self.has_noise && self.goals.iter().any(|goal| goal.needs_run())
    }

    /// Returns the seed of the realisations of the noise in a condition.
    pub(crate) fn noise_seed(&self, condition: usize) -> u64 {
        self.seed.wrapping_add(condition as u64)
    }

    /// Returns the limits of peaks with their indices.
    pub(crate) fn peaks(&self) -> Vec<(usize, OrbitQuantity)> {
        let mut peaks = Vec::new();
        for (index, limit) in self.limits.iter().enumerate() {
            if let LimitedQuantity::Peak(quantity) = limit.quantity {
                peaks.push((index, quantity));
            }
        }
        peaks
    }

    /// Returns the mean power and the limited peaks, as quantities of an orbit.
    pub(crate) fn orbit_quantities(&self) -> Vec<OrbitQuantity> {
        let peaks = self.peaks().into_iter().map(|(_, quantity)| quantity);
        std::iter::once(OrbitQuantity::MeanPower)
            .chain(peaks)
            .collect()
    }

    /// Returns the limits of sizes with their indices.
    pub(crate) fn sizes(&self) -> Vec<(usize, Size)> {
        let mut sizes = Vec::new();
        for (index, limit) in self.limits.iter().enumerate() {
            if let LimitedQuantity::Size(size) = limit.quantity {
                sizes.push((index, size));
            }
        }
        sizes
    }

    /// Returns the keys, among those of some indices, by which results have a derivative. The scale
    /// of each is its derivative by the place.
    pub(crate) fn derivative_keys(
        &self,
        indices: &[usize],
        place: &[f64],
    ) -> Vec<DerivativeKey<'_>> {
        let key = |k: &usize| {
            let range = self.free[*k].smooth().filter(|_| self.applies(*k, place))?;
            Some(DerivativeKey {
                key: &range.key,
                scale: range.slope(place[*k]),
            })
        };
        indices.iter().filter_map(key).collect()
    }
}

/// True where two files have the same spec.
fn is_same_spec(one: &SpecFile, other: &SpecFile) -> bool {
    matches!((one.spec(), other.spec()), (Ok(one), Ok(other)) if one == other)
}

/// Returns the error of the key `spec`.
fn fault_of_spec(message: &str) -> DesignError {
    DesignError::Faults(vec![Fault::without_position("spec", message)])
}

/// Returns the digest of a text and of the specs of models.
fn digest<'a>(text: &str, folder: &Path, models: impl Iterator<Item = &'a Model>) -> String {
    let mut all = format!("jounce {}\n{text}", env!("CARGO_PKG_VERSION"));
    for model in models {
        all += &format!("\n{}", identity_text(&model.spec, folder));
    }
    let bytes = Sha256::digest(all.as_bytes());
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
