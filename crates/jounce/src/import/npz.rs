//! Sparse matrices in archives of SciPy (`scipy.sparse.save_npz`).

use jounce_data::read::{Vector, vectors};
use jounce_sparse::MatrixEntries;
use std::collections::BTreeMap;
use std::path::Path;

/// Reads a matrix in the formats `csr`, `csc` and `coo`.
///
/// # Errors
/// One sentence with the file: a file that cannot be read, or is not such a matrix.
pub(super) fn read(path: &Path) -> Result<MatrixEntries, String> {
    let arrays = vectors(path).map_err(|error| error.to_string())?;
    matrix(&arrays).map_err(|message| format!("{}: {message}", path.display()))
}

fn matrix(arrays: &BTreeMap<String, Vector>) -> Result<MatrixEntries, String> {
    let format = match arrays.get("format") {
        Some(Vector::Text(format)) => format.as_str(),
        _ => {
            return Err("the text `format` is missing; write it with scipy.sparse.save_npz".into());
        }
    };
    if !["csr", "csc", "coo"].contains(&format) {
        return Err(format!(
            "the format {format} is not read; write it with scipy.sparse.save_npz(FILE, MATRIX.tocsr())"
        ));
    }
    let [rows, columns] = indices(arrays, "shape", usize::MAX)?[..] else {
        return Err("`shape` must have two numbers".into());
    };
    let data = numbers(arrays, "data")?;
    let (row, column) = match format {
        "coo" => (
            indices(arrays, "row", rows)?,
            indices(arrays, "col", columns)?,
        ),
        "csr" => (
            expanded(arrays, rows, data.len())?,
            indices(arrays, "indices", columns)?,
        ),
        _ => (
            indices(arrays, "indices", rows)?,
            expanded(arrays, columns, data.len())?,
        ),
    };
    if row.len() != data.len() || column.len() != data.len() {
        return Err(format!(
            "it has {} values, but {} rows and {} columns for them",
            data.len(),
            row.len(),
            column.len()
        ));
    }
    let places = row.into_iter().zip(column);
    Ok(MatrixEntries {
        rows,
        columns,
        entries: places.zip(data).map(|((i, j), x)| (i, j, *x)).collect(),
    })
}

/// Returns the row of each entry of `csr`, or the column of each entry of `csc`, from `indptr`, where
/// entry `k` is the first of row `k`.
fn expanded(
    arrays: &BTreeMap<String, Vector>,
    lines: usize,
    entries: usize,
) -> Result<Vec<usize>, String> {
    let starts = indices(arrays, "indptr", entries.saturating_add(1))?;
    let is_ascending = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    let ends = [starts.first().copied(), starts.last().copied()];
    if Some(starts.len()) != lines.checked_add(1)
        || !is_ascending
        || ends != [Some(0), Some(entries)]
    {
        return Err(format!(
            "`indptr` must ascend from 0 to {entries} in {} numbers",
            lines.saturating_add(1)
        ));
    }
    let pairs = starts.windows(2).enumerate();
    Ok(pairs
        .flat_map(|(line, pair)| std::iter::repeat_n(line, pair[1] - pair[0]))
        .collect())
}

fn numbers<'a>(arrays: &'a BTreeMap<String, Vector>, name: &str) -> Result<&'a [f64], String> {
    match arrays.get(name) {
        Some(Vector::Numbers(numbers)) => Ok(numbers),
        Some(Vector::Other(why)) => Err(format!("`{name}` cannot be read: {why}")),
        _ => Err(format!("the numbers `{name}` are missing")),
    }
}

/// Returns whole numbers from 0 to below a limit.
fn indices(
    arrays: &BTreeMap<String, Vector>,
    name: &str,
    limit: usize,
) -> Result<Vec<usize>, String> {
    let index = |number: &f64| match *number >= 0.0 && number.fract() == 0.0 {
        true if (*number as usize) < limit => Ok(*number as usize),
        _ => Err(format!(
            "`{name}` contains {number}; it must be a whole number from 0 to {}",
            limit.saturating_sub(1)
        )),
    };
    numbers(arrays, name)?.iter().map(index).collect()
}
