//! Studies: one quantity at many points over the keys of a spec, in parts that several processes
//! share.

mod options;

pub use jounce_analysis::study::{Folder as StudyFolder, Shard, Status as StudyStatus};
pub use options::StudyOptions;

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::on_threads;
use jounce_control::Control;
use jounce_io::table::Record;
use jounce_spec::Spec;
use std::path::Path;
use std::sync::Arc;

/// A parametric study: a spec, the keys to vary, and the quantity to compute at each point. Its text
/// alone fixes its points and parts, so any number of processes write the same table.
#[derive(Debug, Clone)]
pub struct Study {
    study: Arc<jounce_analysis::study::Study>,
    control: Control,
    record: Option<Record>,
}

impl Harvester {
    /// Reads a study of this harvester from the text of its file, without the key `spec`.
    ///
    /// # Errors
    /// [`Error::Study`] with all faults.
    ///
    /// ```
    /// use jounce::{Harvester, StudyOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let study = harvester.study(
    ///     "[vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm:3x\"\n[quantity]\ncommand = \"modes\"",
    /// )?;
    /// # let out = std::env::temp_dir().join(format!("jounce-study-{}", std::process::id()));
    /// let status = study.run(&out, &StudyOptions::default())?;
    /// assert_eq!((status.points, status.merged), (3, true));
    /// # std::fs::remove_dir_all(&out).unwrap();
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn study(&self, text: &str) -> Result<Study, Error> {
        let file = self.file().clone();
        let study = jounce_analysis::study::Study::with_spec(file, self.folder(), text)?;
        Ok(Study::of(study).with_control(self.control()))
    }
}

impl Study {
    /// Reads the file of a study (TOML); the path of its spec is relative to its folder.
    ///
    /// # Errors
    /// [`Error::Study`] for a file that cannot be read, or with all faults.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Ok(Self::of(jounce_analysis::study::Study::read(
            path.as_ref(),
        )?))
    }

    fn of(study: jounce_analysis::study::Study) -> Self {
        Self {
            study: Arc::new(study),
            control: Control::default(),
            record: None,
        }
    }

    /// Returns a copy whose table holds the record of a command, so that `jounce rerun` makes it
    /// again.
    #[must_use]
    pub fn with_record(&self, record: Option<Record>) -> Self {
        Self {
            record,
            ..self.clone()
        }
    }

    /// Returns a copy whose computations poll a control: it reports progress and stops them.
    #[must_use]
    pub fn with_control(&self, control: &Control) -> Self {
        Self {
            control: control.clone(),
            ..self.clone()
        }
    }

    /// Returns the spec with the values that the study sets for all points.
    pub fn spec(&self) -> &Spec {
        &self.study.spec
    }

    /// Returns the SHA-256 of all inputs of the table.
    pub fn hash_hex(&self) -> &str {
        self.study.hash_hex()
    }

    /// Returns the number of points.
    pub fn points(&self) -> usize {
        self.study.design.len()
    }

    /// Returns the number of parts.
    pub fn parts(&self) -> usize {
        self.study.parts()
    }

    /// Returns the number of points of a part.
    pub fn points_of(&self, part: usize) -> usize {
        self.study.points(part).len()
    }

    /// Returns the values of the varied keys at a point, SI.
    ///
    /// # Errors
    /// [`Error::Option`] for a point that the study does not have.
    pub fn point(&self, index: usize) -> Result<Vec<f64>, Error> {
        check_number("point", index, self.points())?;
        Ok(self.study.design.point(index))
    }

    /// Computes the unfinished parts of a shard in a folder, and joins all parts to one table when
    /// none is missing. After a stop by the control the finished parts remain.
    ///
    /// # Errors
    /// [`Error::Study`] for a folder that cannot be written or holds another study, and for another
    /// process on the same shard.
    pub fn run(
        &self,
        folder: impl AsRef<Path>,
        options: &StudyOptions,
    ) -> Result<StudyStatus, Error> {
        let mut folder = StudyFolder::of(folder.as_ref(), &self.study)?;
        if let Some(record) = &self.record {
            folder.set_record(record)?;
        }
        let (shard, control) = (options.shard, &self.control);
        let work = || Ok(folder.run(&self.study, shard, control, &|_| ())?);
        on_threads(options.threads, work)?;
        let status = folder.status();
        if control.is_stopped() || status.finished < status.parts {
            return Ok(status);
        }
        folder.merge()?;
        Ok(StudyStatus {
            merged: true,
            ..status
        })
    }

    /// Computes a part on one thread and returns the bytes of its file, for another process to keep.
    ///
    /// # Errors
    /// [`Error::Option`] for a part that the study does not have, [`Error::Stopped`].
    pub fn part(&self, part: usize) -> Result<Vec<u8>, Error> {
        check_number("part", part, self.parts())?;
        let table = self.study.part(part, &self.control)?;
        let table = table.ok_or(Error::Stopped)?;
        Ok(table.to_parquet(&self.study.part_manifest(part))?)
    }

    /// Returns the numbers of the unfinished parts of a shard in a folder, which is created if
    /// missing.
    ///
    /// # Errors
    /// [`Error::Study`].
    pub fn missing(&self, folder: impl AsRef<Path>, shard: Shard) -> Result<Vec<usize>, Error> {
        let mut missing = StudyFolder::of(folder.as_ref(), &self.study)?.missing();
        missing.retain(|part| shard.takes(*part));
        Ok(missing)
    }

    /// Stores the bytes of a part that another process computed.
    ///
    /// # Errors
    /// [`Error::Study`] for a folder that cannot be written, and bytes that are not this part.
    pub fn keep(&self, folder: impl AsRef<Path>, part: usize, bytes: &[u8]) -> Result<(), Error> {
        Ok(StudyFolder::of(folder.as_ref(), &self.study)?.keep(part, bytes)?)
    }
}

fn check_number(name: &'static str, number: usize, count: usize) -> Result<(), Error> {
    if number < count {
        return Ok(());
    }
    let expected = format!("the study has {count}, numbered from 0");
    Err(Error::option(name, number, expected))
}
