//! Files of a folder of matrices.

use super::npz;
use crate::error::Error;
use crate::export::NAMES_FILE;
use jounce_io::store;
use jounce_model::exchange::{ExchangeFaults, MATRICES, MatrixSet, Names};
use jounce_sparse::{MatrixEntries, read_market};
use std::path::Path;

/// Reads every matrix that exists, and the names.
///
/// # Errors
/// [`Error::Exchange`] with all faults.
pub(super) fn read(folder: &Path, names: Option<&Path>) -> Result<MatrixSet, Error> {
    if !folder.is_dir() {
        let message = format!(
            "{} is neither a folder of matrices (mass.mtx or mass.npz, stiffness.mtx or stiffness.npz and, for points and electrodes, names.csv) \
             nor a universal file with modes",
            folder.display()
        );
        return Err(ExchangeFaults::from(message).into());
    }
    let mut set = MatrixSet::default();
    let mut faults = Vec::new();
    for (name, _) in MATRICES {
        match matrix(folder, name) {
            Ok(Some(matrix)) => {
                set.matrix.insert(name.to_owned(), matrix);
            }
            Ok(None) => {}
            Err(message) => faults.push(message),
        }
    }
    match table_of_names(folder, names) {
        Ok(Some((path, text))) => match Names::read(&text, &path) {
            Ok(names) => set.names = names,
            Err(names) => faults.extend(names.0),
        },
        Ok(None) => {}
        Err(message) => faults.push(message),
    }
    if faults.is_empty() {
        Ok(set)
    } else {
        Err(ExchangeFaults(faults).into())
    }
}

/// Reads the given table of names or, if it exists, that of the folder; returns its name and its text.
pub(super) fn table_of_names(
    folder: &Path,
    names: Option<&Path>,
) -> Result<Option<(String, String)>, String> {
    let path = names.map_or_else(|| folder.join(NAMES_FILE), Path::to_path_buf);
    if names.is_none() && !path.exists() {
        return Ok(None);
    }
    let text = std::fs::read_to_string(&path).map_err(|error| store::unreadable(&path, &error))?;
    let name = path.file_name().map_or(path.as_os_str(), |name| name);
    Ok(Some((name.to_string_lossy().into_owned(), text)))
}

/// Reads the matrix of a name from its file in one of both formats; `None` if it is absent and not
/// required.
fn matrix(folder: &Path, name: &str) -> Result<Option<MatrixEntries>, String> {
    let [market, archive] = ["mtx", "npz"].map(|end| folder.join(format!("{name}.{end}")));
    match [market.exists(), archive.exists()] {
        [true, true] => Err(format!(
            "{} and {name}.npz both exist; remove one",
            market.display()
        )),
        [true, false] => {
            let text = std::fs::read_to_string(&market)
                .map_err(|error| store::unreadable(&market, &error));
            let read = read_market(&text?);
            read.map(Some)
                .map_err(|error| format!("{}, {error}", market.display()))
        }
        [false, true] => npz::read(&archive).map(Some),
        [false, false] if ["mass", "stiffness"].contains(&name) => {
            Err(format!("{}, nor does {name}.npz", store::missing(&market)))
        }
        [false, false] => Ok(None),
    }
}
