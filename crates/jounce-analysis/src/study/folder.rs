//! A study on disk: `study.json` identifies the study, `parts/` holds finished parts,
//! `study.parquet` the merged table.

use super::card::StudyCard;
use super::lock::Lock;
use super::{Shard, Study, StudyError};
use jounce_control::Control;
use jounce_io::store;
use jounce_io::table::{Manifest, Record, Table, TableError, Values};
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The folder of a study.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    card: StudyCard,
}

/// Progress of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Status {
    /// Digest of the study.
    pub study_sha256: String,
    /// Points of the study.
    pub points: usize,
    /// Parts of the study.
    pub parts: usize,
    /// Finished parts.
    pub finished: usize,
    /// Points without a result in these parts.
    pub failed_points: usize,
    /// Files whose content is not the part in their name.
    pub damaged: Vec<PathBuf>,
    /// True if the merged table exists.
    pub merged: bool,
    /// What the table lacks, one sentence each.
    pub warnings: Vec<String>,
}

impl Folder {
    /// Opens the folder of a study; creates it if necessary.
    ///
    /// # Errors
    /// A folder that cannot be created, or that holds another study.
    pub fn of(path: &Path, study: &Study) -> Result<Self, StudyError> {
        let parts = path.join("parts");
        let unwritable = |reason: std::io::Error| StudyError::Folder {
            folder: parts.clone(),
            reason: store::reason(&reason),
        };
        std::fs::create_dir_all(&parts).map_err(unwritable)?;
        let manifest = study.manifest();
        let card = StudyCard {
            created_by: manifest.created_by,
            version: manifest.version,
            study_sha256: study.hash_hex().to_owned(),
            command: study.quantity.command().to_owned(),
            points: study.design.len(),
            parts: study.parts(),
            record: None,
        };
        match Self::open(path) {
            Ok(folder) if folder.card.is_of(&card) => Ok(folder),
            Ok(folder) => Err(StudyError::OtherStudy {
                folder: path.to_owned(),
                found: short(&folder.card.study_sha256),
                wanted: short(&card.study_sha256),
            }),
            Err(StudyError::NoStudy { .. }) => {
                let folder = Self {
                    path: path.to_owned(),
                    card,
                };
                folder.card.write(path)?;
                Ok(folder)
            }
            Err(error) => Err(error),
        }
    }

    /// Opens a folder that holds a study.
    ///
    /// # Errors
    /// A folder without a study.
    pub fn open(path: &Path) -> Result<Self, StudyError> {
        Ok(Self {
            path: path.to_owned(),
            card: StudyCard::read(path)?,
        })
    }

    /// Stores the command that computes this study, from which `jounce rerun` makes its table again.
    /// The first command of a folder remains, so that the table does not depend on who joins it.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn set_record(&mut self, record: &Record) -> Result<(), StudyError> {
        if self.card.record.is_some() {
            return Ok(());
        }
        self.card.record = Some(record.clone());
        self.card.write(&self.path)
    }

    /// Computes the missing parts of a shard on all threads. `done` receives the number of points
    /// already finished, then of each finished part. If the control stops the run, finished parts
    /// remain.
    ///
    /// # Errors
    /// A folder that cannot be written, another process on the same shard.
    pub fn run(
        &self,
        study: &Study,
        shard: Shard,
        control: &Control,
        done: &(dyn Fn(usize) + Sync),
    ) -> Result<(), StudyError> {
        let _lock = Lock::take(&self.path, shard)?;
        self.clean();
        let shard_parts: Vec<usize> = (0..self.card.parts)
            .filter(|part| shard.takes(*part))
            .collect();
        let missing: Vec<usize> = shard_parts
            .iter()
            .copied()
            .filter(|part| self.part(*part).is_err())
            .collect();
        let points = |parts: &[usize]| {
            parts
                .iter()
                .map(|part| study.points(*part).len())
                .sum::<usize>()
        };
        control.expect(points(&missing));
        done(points(&shard_parts) - points(&missing));
        // One part at a time for each thread: parts are few and long.
        missing
            .into_par_iter()
            .with_max_len(1)
            .try_for_each(|part| {
                if control.is_stopped() {
                    return Ok(());
                }
                if let Some(table) = study.part(part, control)? {
                    let bytes = table.to_parquet(&study.part_manifest(part))?;
                    store::write_in_folder(&self.file(part), &bytes)?;
                    done(table.rows());
                }
                Ok(())
            })
    }

    /// Stores a part that was computed elsewhere.
    ///
    /// # Errors
    /// A file that cannot be written; bytes that are not this part, which are not written.
    pub fn keep(&self, part: usize, bytes: &[u8]) -> Result<(), StudyError> {
        self.checked(part, Table::from_parquet(bytes))?;
        Ok(store::write_in_folder(&self.file(part), bytes)?)
    }

    /// Returns the numbers of the missing or damaged parts.
    pub fn missing(&self) -> Vec<usize> {
        (0..self.card.parts)
            .filter(|part| self.part(*part).is_err())
            .collect()
    }

    /// Returns the number of finished points whose runs had not settled when they were averaged,
    /// although their drives have a common period.
    pub fn unsettled_points(&self) -> usize {
        let parts = (0..self.card.parts).filter_map(|part| self.part(part).ok());
        parts.map(|table| unsettled(&table)).sum()
    }

    /// Returns the progress of the study.
    pub fn status(&self) -> Status {
        let (mut finished, mut failed_points, mut damaged) = (0, 0, Vec::new());
        for part in 0..self.card.parts {
            match self.part(part) {
                Ok(table) => {
                    finished += 1;
                    failed_points += failures(&table);
                }
                Err(StudyError::Damaged { path, .. }) => damaged.push(path),
                Err(_) => {}
            }
        }
        let StudyCard {
            study_sha256,
            points,
            parts,
            ..
        } = self.card.clone();
        let warning = format!(
            "points without a result: {failed_points} of {points}; the column `failure` gives the reasons"
        );
        Status {
            warnings: Vec::from_iter((failed_points > 0).then_some(warning)),
            study_sha256,
            points,
            parts,
            finished,
            failed_points,
            damaged,
            merged: self.table().is_file(),
        }
    }

    /// Returns the path of the merged table.
    pub fn table(&self) -> PathBuf {
        self.path.join("study.parquet")
    }

    /// Joins all parts to one table, in the order of the points, one part at a time.
    ///
    /// # Errors
    /// Parts that are missing or damaged, a file that cannot be written.
    pub fn merge(&self) -> Result<PathBuf, StudyError> {
        let missing: Vec<usize> = (0..self.card.parts)
            .filter(|part| !self.file(*part).is_file())
            .collect();
        if let Some(first) = missing.first() {
            return Err(StudyError::Missing {
                missing: missing.len(),
                parts: self.card.parts,
                first: *first,
            });
        }
        self.clean();
        let (_, mut manifest) = Table::read(&self.file(0))?;
        manifest.options.remove("part");
        // Another process may have stored it.
        manifest.record = StudyCard::read(&self.path)?.record;
        let parts = (0..self.card.parts).map(|part| self.part(part));
        Table::write_joined(&self.table(), &manifest, parts)?;
        Ok(self.table())
    }

    /// Returns the merged table, which is written if it is missing.
    ///
    /// # Errors
    /// Parts that are missing or damaged, a file that cannot be written or read.
    pub fn merged(&self) -> Result<(Table, Manifest), StudyError> {
        if !self.table().is_file() {
            self.merge()?;
        }
        Ok(Table::read(&self.table())?)
    }

    /// Removes files left by killed processes.
    fn clean(&self) {
        store::clean(&self.path);
        store::clean(&self.path.join("parts"));
    }

    /// Reads a finished part.
    fn part(&self, part: usize) -> Result<Table, StudyError> {
        let path = self.file(part);
        if !path.is_file() {
            return Err(StudyError::Missing {
                missing: 1,
                parts: self.card.parts,
                first: part,
            });
        }
        self.checked(part, Table::read(&path))
    }

    /// Returns the table of a part that was read, if it is this part of this study.
    fn checked(
        &self,
        part: usize,
        read: Result<(Table, Manifest), TableError>,
    ) -> Result<Table, StudyError> {
        let damaged = |reason: String| StudyError::Damaged {
            path: self.file(part),
            reason,
        };
        let (table, manifest) = read.map_err(|error| match error {
            TableError::Read { reason, .. } => damaged(reason),
            error => error.into(),
        })?;
        let says = |option: &str, value: &str| {
            manifest
                .options
                .get(option)
                .is_some_and(|stored| stored == value)
        };
        if says("study_sha256", &self.card.study_sha256) && says("part", &part.to_string()) {
            Ok(table)
        } else {
            Err(damaged("it is not this part of this study".to_owned()))
        }
    }

    fn file(&self, part: usize) -> PathBuf {
        self.path
            .join("parts")
            .join(format!("part-{part:06}.parquet"))
    }
}

/// Returns the beginning of a digest, enough to distinguish two.
fn short(digest: &str) -> String {
    digest.chars().take(12).collect()
}

/// Counts the points without a result.
fn failures(table: &Table) -> usize {
    let texts = table.column("failure").map(|column| &column.values);
    match texts {
        Some(Values::Text(texts)) => texts.iter().filter(|text| !text.is_empty()).count(),
        _ => 0,
    }
}

/// Returns the number of points of a table whose runs had not settled.
fn unsettled(table: &Table) -> usize {
    let values = |name: &str| table.column(name).map(|column| &column.values);
    match (values("settled"), values("period_cycles")) {
        (Some(Values::Flag(settled)), Some(Values::Count(periods))) => {
            let runs = settled.iter().zip(periods);
            runs.filter(|(settled, period)| !**settled && **period > 0)
                .count()
        }
        _ => 0,
    }
}
