//! Files of a folder of matrices.

use crate::error::Error;
use crate::export::NAMES_FILE;
use jounce_io::store;
use jounce_model::exchange::{ExchangeFaults, MATRICES, MatrixSet, Names};
use jounce_sparse::read_market;
use std::path::Path;

/// Reads every matrix that exists, and the names.
///
/// # Errors
/// [`Error::Exchange`] with all faults.
pub(super) fn read(folder: &Path) -> Result<MatrixSet, Error> {
    if !folder.is_dir() {
        let message = format!(
            "{} is not a folder of matrices: mass.mtx, stiffness.mtx and, for points and electrodes, names.csv",
            folder.display()
        );
        return Err(ExchangeFaults::from(message).into());
    }
    let mut set = MatrixSet::default();
    let mut faults = Vec::new();
    for (name, _) in MATRICES {
        let path = folder.join(format!("{name}.mtx"));
        if !path.exists() {
            continue;
        }
        let text = std::fs::read_to_string(&path).map_err(|error| store::unreadable(&path, &error));
        let read = text.and_then(|text| {
            read_market(&text).map_err(|error| format!("{}, {error}", path.display()))
        });
        match read {
            Ok(matrix) => {
                set.matrix.insert(name.to_owned(), matrix);
            }
            Err(message) => faults.push(message),
        }
    }
    for name in ["mass", "stiffness"] {
        let path = folder.join(format!("{name}.mtx"));
        if !path.exists() {
            faults.push(store::missing(&path));
        }
    }
    let path = folder.join(NAMES_FILE);
    if path.exists() {
        let text = std::fs::read_to_string(&path).map_err(|error| store::unreadable(&path, &error));
        match text.map(|text| Names::read(&text)) {
            Ok(Ok(names)) => set.names = names,
            Ok(Err(names)) => faults.extend(names.0),
            Err(message) => faults.push(message),
        }
    }
    if faults.is_empty() {
        Ok(set)
    } else {
        Err(ExchangeFaults(faults).into())
    }
}
