//! Result of a reproduction: tables, figures and claims, and their output folder.

use super::computed::Computed;
use super::named::{ON_GROUND, ON_TABLE};
use crate::results::{assumptions, runs};
use crate::{Chapter, Claim, NamedFigure, NamedTable, ReproduceError, claims, page};
use jounce_control::Control;
use jounce_io::table::{Manifest, Record};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Reproduction of the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Reproduction {
    /// Tables `table-2`, `claims`, `runs`, `assumptions`, and the data of every figure.
    pub tables: Vec<NamedTable>,
    /// Figures `figure-4` to `figure-9`, `figure-7-spectrum`, figures 6, 8 and 9 `-stop-on-table`,
    /// `figure-6-branches` and `jumps-over-gap`.
    pub figures: Vec<NamedFigure>,
    /// Claims S2 to S9.
    pub claims: Vec<Claim>,
    summary: String,
    chapters: Vec<Chapter>,
    manifest: Manifest,
}

/// Paths of a written reproduction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The report, one self-contained HTML file.
    pub report: PathBuf,
    /// `tables/NAME.csv` (with its manifest) and `tables/NAME.json`.
    pub tables: Vec<PathBuf>,
    /// `figures/NAME.svg`, `.png` and `.pdf`.
    pub figures: Vec<PathBuf>,
}

/// Computes the paper's simulated tables and figures and tests its claims. `progress` receives each
/// stage; `control` can cancel the runs.
///
/// The numbers are bitwise identical for any number of threads.
///
/// # Errors
/// Only cancellation by the control is expected, because the inputs are built in. See
/// [`ReproduceError`].
pub fn reproduce(
    control: &Control,
    progress: &dyn Fn(&str),
) -> Result<Reproduction, ReproduceError> {
    let computed = Computed::new(control, progress)?;
    let mut figures = computed.hammer.figures();
    figures.push(computed.ground.frequency.figure(&ON_GROUND));
    figures.extend(computed.ground.voltage.figures()?);
    figures.extend([
        computed.ground.above.figure(8, &ON_GROUND),
        computed.ground.below.figure(9, &ON_GROUND),
    ]);
    figures.extend([
        computed.table.frequency.figure(&ON_TABLE),
        computed.table.above.figure(8, &ON_TABLE),
    ]);
    figures.push(computed.table.below.figure(9, &ON_TABLE));
    figures.extend([
        computed.orbits.figure(&computed.ground.frequency),
        computed.orbits.map(),
    ]);
    let (ground, on_table) = (
        claims::test_claims(&computed.ground),
        claims::test_claims(&computed.table),
    );
    let manifest =
        Manifest::new(&computed.ground.harvester.spec.hash_hex()).with("command", "reproduce");
    let tables = tables(&computed, claims::table(&ground, &on_table)?)?;
    Ok(Reproduction {
        tables,
        figures,
        claims: claims::claims(&ground, &on_table),
        summary: page::summary(&computed),
        chapters: Vec::new(),
        manifest,
    })
}

fn tables(computed: &Computed, claims: NamedTable) -> Result<Vec<NamedTable>, ReproduceError> {
    let (ground, on_table) = (&computed.ground, &computed.table);
    let mut tables = vec![
        computed.table_2.table()?,
        claims,
        runs::table(ground)?,
        assumptions::table(&computed.variants)?,
    ];
    tables.extend([
        computed.hammer.table()?,
        ground.frequency.table(&ON_GROUND)?,
    ]);
    tables.extend(ground.voltage.tables()?);
    tables.extend([
        ground.above.table(8, &ON_GROUND)?,
        ground.below.table(9, &ON_GROUND)?,
    ]);
    tables.extend([
        on_table.frequency.table(&ON_TABLE)?,
        on_table.above.table(8, &ON_TABLE)?,
        on_table.below.table(9, &ON_TABLE)?,
    ]);
    tables.extend(computed.orbits.tables()?);
    Ok(tables)
}

/// Creates a folder with its subfolders for tables and figures. A call before the computation
/// checks that the results can be written.
///
/// # Errors
/// A folder cannot be created.
pub fn folders(folder: &Path) -> Result<[PathBuf; 2], ReproduceError> {
    let both = [folder.join("tables"), folder.join("figures")];
    for path in [folder, &both[0], &both[1]] {
        std::fs::create_dir_all(path).map_err(|fault| ReproduceError::Folder {
            path: path.to_owned(),
            reason: fault.to_string(),
        })?;
    }
    Ok(both)
}

impl Reproduction {
    /// Returns the reproduction with one more chapter, including its tables and figures.
    #[must_use]
    pub fn with(mut self, chapter: Chapter) -> Self {
        self.tables.extend(chapter.tables.iter().cloned());
        self.figures.extend(chapter.figures.iter().cloned());
        self.chapters.push(chapter);
        self
    }

    /// Returns the table with a name.
    pub fn table(&self, name: &str) -> Option<&NamedTable> {
        self.tables.iter().find(|table| table.name == name)
    }

    /// Returns the figure with a name.
    pub fn figure(&self, name: &str) -> Option<&NamedFigure> {
        self.figures.iter().find(|figure| figure.name == name)
    }

    pub(super) fn chapters(&self) -> &[Chapter] {
        &self.chapters
    }

    /// Returns the origin of a file: the command has no option that changes a number, and no input
    /// file.
    fn recorded(&self, folder: &str, name: &str) -> Manifest {
        Manifest {
            record: Some(Record {
                arguments: vec!["reproduce".to_owned()],
                table: format!("{folder}/{name}"),
                inputs: Vec::new(),
            }),
            ..self.manifest.clone()
        }
    }

    /// Returns the conclusion from Table 2, in one or two sentences.
    pub(super) fn summary(&self) -> &str {
        &self.summary
    }

    /// Writes `report.html`, `tables/` and `figures/` into a folder and creates it if necessary.
    ///
    /// # Errors
    /// A folder or file is not writable.
    pub fn write(&self, folder: &Path) -> Result<Written, ReproduceError> {
        let [tables, figures] = folders(folder)?;
        let report = folder.join("report.html");
        let mut written = Written {
            report,
            tables: Vec::new(),
            figures: Vec::new(),
        };
        for table in &self.tables {
            for ending in ["csv", "json"] {
                let path = tables.join(format!("{}.{ending}", table.name));
                table
                    .table
                    .write(&path, &self.recorded("tables", &table.name))?;
                written.tables.push(path);
            }
        }
        let files = self.figures.iter().flat_map(|figure| {
            ["svg", "png", "pdf"]
                .map(|ending| (figure, figures.join(format!("{}.{ending}", figure.name))))
        });
        let files: Vec<_> = files.collect();
        files.par_iter().try_for_each(|(figure, path)| {
            let manifest = self.recorded("figures", &figure.name);
            figure.figure.write_with(path, &manifest)
        })?;
        written.figures = files.into_iter().map(|(_, path)| path).collect();
        // Last: a report is complete, with its tables and figures.
        page::page(self)?.write(&written.report)?;
        Ok(written)
    }
}
