//! Export of the model for other programs.

mod options;
mod result;

pub use options::ExportOptions;
pub use result::ExportResult;

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_io::store;
use jounce_model::exchange::{MatrixSet, NameKind, modal_matrices, netlist};
use jounce_sparse::{write_market_array, write_market_symmetric};
use std::path::{Path, PathBuf};

/// File of the names in a folder of matrices.
pub(crate) const NAMES_FILE: &str = "names.csv";

impl Harvester {
    /// Writes the model as matrices in modal coordinates, as an equivalent circuit, or both.
    ///
    /// The matrices have no loads, stops and drives; the circuit has all of them.
    ///
    /// # Errors
    /// [`Error::Option`] without any output, or with one path for both;
    /// [`Error::Analysis`] for a structure without a solution;
    /// [`Error::Exchange`] for elements without an equivalent circuit; [`Error::File`].
    ///
    /// ```
    /// use jounce::{ExportOptions, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let folder = tempfile::tempdir().unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let spice = Some(folder.path().join("harvester.cir"));
    /// let result = harvester.export(&ExportOptions { spice, ..Default::default() })?;
    /// assert_eq!(result.modes, 8);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn export(&self, options: &ExportOptions) -> Result<ExportResult, Error> {
        if options.matrices.is_none() && options.spice.is_none() {
            let expected = "give a folder for the matrices, a file for the circuit, or both";
            return Err(Error::option("matrices", "none", expected));
        }
        if let Some(path) = &options.spice
            && options.matrices.as_ref() == Some(path)
        {
            let expected = "it is the folder of the matrices too; give the circuit another name";
            return Err(Error::option("spice", path.display(), expected));
        }
        let model = self.model()?;
        let system = &model.kernel.plant.system;
        let set = modal_matrices(system);
        let named = |kind| {
            set.names
                .of(kind)
                .map(|(_, name)| name.to_owned())
                .collect()
        };
        let mut result = ExportResult {
            files: Vec::new(),
            modes: system.modes.len(),
            points: named(NameKind::Point),
            electrodes: named(NameKind::Electrode),
        };
        if let Some(folder) = &options.matrices {
            result.files.extend(write_matrices(&set, folder)?);
        }
        if let Some(path) = &options.spice {
            let title = format!("jounce, spec {}", self.hash_hex());
            let text = netlist(&title, system, &self.spec().run)?;
            store::write(path, text.as_bytes())?;
            result.files.push(path.clone());
        }
        Ok(result)
    }
}

/// Writes each matrix and the names into a folder.
fn write_matrices(set: &MatrixSet, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    let mut write = |name: &str, text: String| -> Result<(), Error> {
        let path = folder.join(name);
        store::write(&path, text.as_bytes())?;
        files.push(path);
        Ok(())
    };
    for (name, matrix) in &set.matrix {
        // The square matrices of this set are symmetric; others are full.
        let is_symmetric = !["coupling", "points", "base"].contains(&name.as_str());
        let text = match is_symmetric.then(|| matrix.clone().symmetric()) {
            Some(Ok(symmetric)) => write_market_symmetric(&symmetric),
            _ => write_market_array(&matrix.dense()),
        };
        write(&format!("{name}.mtx"), text)?;
    }
    write(NAMES_FILE, set.names.text())?;
    Ok(files)
}
