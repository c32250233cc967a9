//! A study: its points, its parts, and the computation of a part.

use super::quantity::evaluation::evaluate;
use super::read::{StudyText, read};
use super::{Design, Quantity, StudyError};
use crate::run::identity_text;
use crate::{AnalysisError, Model};
use jounce_control::Control;
use jounce_io::table::{Column, Manifest, Table};
use jounce_spec::{Fault, Spec, SpecFile};
use sha2::{Digest, Sha256};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A spec, the keys to vary, and what to compute at each point.
#[derive(Debug)]
pub struct Study {
    /// Spec with the values that the study sets for all points.
    pub spec: Spec,
    /// Points.
    pub design: Design,
    /// Quantity at each point.
    pub quantity: Quantity,
    /// Folder of the start state.
    folder: PathBuf,
    points_per_part: usize,
    hash_hex: String,
}

impl Study {
    /// Reads a study; the path of its spec is relative to its folder.
    ///
    /// # Errors
    /// A file that cannot be read; all faults in it.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        let unreadable = |reason: std::io::Error| StudyError::Unreadable {
            path: path.to_owned(),
            reason: jounce_io::store::unreadable(path, &reason),
        };
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        Self::parse(&text, path.parent().unwrap_or(Path::new("")))
    }

    /// Parses a study from its text; the path of its spec is relative to `folder`.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(text: &str, folder: &Path) -> Result<Self, StudyError> {
        let mut sibling_folder = folder.to_path_buf();
        let parsed = read(text, |named| {
            let Some(named) = named else {
                let message = "the study names no spec; write spec = \"harvester.toml\" at its top";
                return Err(fault_of_spec(message));
            };
            let path = folder.join(named);
            sibling_folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
            Ok((SpecFile::read(&path)?, path.display().to_string()))
        })?;
        Self::of(parsed, sibling_folder)
    }

    /// Creates a study from its text and a separate spec.
    ///
    /// # Errors
    /// As [`Study::read`], and a text that names a spec.
    pub fn with_spec(file: SpecFile, folder: &Path, text: &str) -> Result<Self, StudyError> {
        let parsed = read(text, |named| match named {
            None => Ok((file, "the spec of the study".to_owned())),
            Some(named) => Err(fault_of_spec(&format!(
                "spec is \"{named}\", but this study has a spec already; omit the key"
            ))),
        })?;
        Self::of(parsed, folder.to_path_buf())
    }

    fn of(parsed: StudyText, folder: PathBuf) -> Result<Self, StudyError> {
        let spec = parsed.file.spec().map_err(|faults| StudyError::Spec {
            file: "the spec of the study".to_owned(),
            faults,
        })?;
        let hash_hex = digest(&identity_text(&spec, &folder), &parsed);
        let StudyText {
            design,
            quantity,
            points_per_part,
            ..
        } = parsed;
        Ok(Self {
            spec,
            design,
            quantity,
            folder,
            points_per_part,
            hash_hex,
        })
    }

    /// Returns the SHA-256 of all inputs of the table: the spec with its recordings and its start
    /// state, the points, the quantity, the parts and the version of jounce.
    pub fn hash_hex(&self) -> &str {
        &self.hash_hex
    }

    /// Returns the number of parts.
    pub fn parts(&self) -> usize {
        self.design.len().div_ceil(self.points_per_part)
    }

    /// Returns the points of a part.
    pub fn points(&self, part: usize) -> Range<usize> {
        let first = part * self.points_per_part;
        first..(first + self.points_per_part).min(self.design.len())
    }

    /// Returns the manifest of a table of this study.
    pub fn manifest(&self) -> Manifest {
        Manifest::new(&self.spec.hash_hex())
            .with("command", "study")
            .with("study_sha256", &self.hash_hex)
    }

    /// Returns the manifest of one part.
    pub fn part_manifest(&self, part: usize) -> Manifest {
        self.manifest().with("part", part)
    }

    /// Computes a part: a row for each of its points, with the values of its keys and the reason of
    /// a failure. Returns `None` if the control stops it. The control counts every finished point.
    ///
    /// # Errors
    /// [`StudyError::Table`].
    pub fn part(&self, part: usize, control: &Control) -> Result<Option<Table>, StudyError> {
        let measures = self.quantity.measures(&self.spec);
        let points: Vec<(usize, Vec<f64>)> = self
            .points(part)
            .map(|index| (index, self.design.point(index)))
            .collect();
        let mut rows: Vec<Result<Vec<f64>, String>> = Vec::with_capacity(points.len());
        let mut last: Option<Model> = None;
        for (_, values) in &points {
            rows.push(self.evaluate_point(values, &mut last, &control.apart()));
            if control.is_stopped() {
                return Ok(None);
            }
            control.count();
        }
        let mut columns = vec![Column::new(
            "point",
            "",
            "number of the point",
            points
                .iter()
                .map(|(index, _)| *index as u64)
                .collect::<Vec<_>>(),
        )];
        for (k, varied) in self.design.varied.iter().enumerate() {
            let (path, unit) = (varied.key.path(), varied.key.unit());
            columns.push(Column::new(
                path,
                &unit,
                "varied key",
                points
                    .iter()
                    .map(|(_, values)| values[k])
                    .collect::<Vec<_>>(),
            ));
        }
        for (k, measure) in measures.iter().enumerate() {
            columns.push(
                measure.column(
                    rows.iter()
                        .map(|row| row.as_ref().map_or(f64::NAN, |values| values[k]))
                        .collect(),
                ),
            );
        }
        let reason = rows
            .into_iter()
            .map(|row| row.err().unwrap_or_default())
            .collect::<Vec<String>>();
        columns.push(Column::new(
            "failure",
            "",
            "reason of a failure; empty for a result",
            reason,
        ));
        Ok(Some(Table::new(columns)?))
    }

    /// Evaluates the numbers at one point; neighbouring points share their common computations.
    fn evaluate_point(
        &self,
        values: &[f64],
        last: &mut Option<Model>,
        control: &Control,
    ) -> Result<Vec<f64>, String> {
        let mut spec = self.spec.clone();
        for (varied, value) in self.design.varied.iter().zip(values) {
            varied
                .key
                .set(&mut spec, *value)
                .map_err(|fault| fault.to_string())?;
        }
        let variant = match last {
            Some(before) => before.changed(spec),
            None => Model::watched(spec, control),
        };
        let model = variant.map_err(|error: AnalysisError| error.to_string())?;
        let result = evaluate(&self.quantity, &model, &self.folder);
        *last = Some(model);
        result
    }
}

/// Returns the error of the key `spec`.
fn fault_of_spec(message: &str) -> StudyError {
    StudyError::Faults(vec![Fault {
        line: 0,
        column: 0,
        key: "spec".to_owned(),
        message: message.to_owned(),
        set: None,
    }])
}

/// Returns the digest of everything that determines the bits of the table.
fn digest(spec: &str, parsed: &StudyText) -> String {
    let mut all = format!("jounce {}\n{spec}\n", env!("CARGO_PKG_VERSION"));
    for varied in &parsed.design.varied {
        let values = varied
            .values
            .iter()
            .map(|value| value.to_bits().to_string())
            .collect::<Vec<_>>()
            .join(" ");
        all += &format!("{} {} {values}\n", varied.key.path(), varied.logarithmic);
    }
    let position = (0..parsed.design.len().min(3))
        .map(|index| parsed.design.point(index))
        .collect::<Vec<_>>();
    all += &format!(
        "{} {} {position:?} {} {:?}",
        parsed.design.sampling.name(),
        parsed.design.len(),
        parsed.points_per_part,
        parsed.quantity
    );
    format!("{:x}", Sha256::digest(all.as_bytes()))
}
