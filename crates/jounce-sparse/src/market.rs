//! The Matrix Market format: text files of sparse (`coordinate`) and full (`array`) matrices.
//!
//! Source: R. F. Boisvert, R. Pozo, K. A. Remington, The Matrix Market exchange formats: initial
//! design, NISTIR 5935 (1996). Real and integer entries, general and symmetric storage.

use crate::{MatrixEntries, SymmetricMatrix};
use jounce_linalg::Mat;
use std::fmt::Write as _;
use thiserror::Error;

/// Why a text is not a matrix in this format.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {line}: {message}")]
pub struct MarketError {
    /// Line, counted from 1.
    pub line: usize,
    /// What is wrong, and what is allowed.
    pub message: String,
}

fn fault(line: usize, message: impl Into<String>) -> MarketError {
    MarketError {
        line,
        message: message.into(),
    }
}

/// Largest number of rows or columns.
pub const MAX_DIMENSION: usize = 100_000_000;

/// Words of the first line.
struct Header {
    is_coordinate: bool,
    is_symmetric: bool,
}

/// Reads a matrix. Symmetric storage is expanded to both triangles.
///
/// # Errors
/// The first wrong line.
///
/// ```
/// let text = "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 4.0\n2 1 -1.5\n";
/// let matrix = jounce_sparse::read_market(text)?;
/// assert_eq!(matrix.entries, [(0, 0, 4.0), (1, 0, -1.5), (0, 1, -1.5)]);
/// # Ok::<(), jounce_sparse::MarketError>(())
/// ```
pub fn read_market(text: &str) -> Result<MatrixEntries, MarketError> {
    let header = header(text.lines().next().unwrap_or_default())?;
    let is_content = |(_, line): &(usize, &str)| !line.is_empty() && !line.starts_with('%');
    let lines = text
        .lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line.trim()));
    let mut lines = lines.skip(1).filter(is_content);
    let last = text.lines().count();
    let (line, sizes) = lines
        .next()
        .ok_or_else(|| fault(last, "the line of sizes is missing"))?;
    let (rows, columns, stored) = sizes_of(line, sizes, header.is_coordinate)?;
    if header.is_symmetric && rows != columns {
        return Err(fault(
            line,
            format!("a symmetric matrix has {rows} rows but {columns} columns"),
        ));
    }
    let mut matrix = MatrixEntries {
        rows,
        columns,
        entries: Vec::new(),
    };
    let full = match (header.is_coordinate, header.is_symmetric) {
        (true, _) => stored,
        (false, false) => rows.saturating_mul(columns),
        (false, true) => rows.saturating_mul(rows.saturating_add(1)) / 2,
    };
    let (mut count, mut next) = (0, (0, 0));
    for (line, text) in lines {
        let (row, column, value) = match header.is_coordinate {
            true => coordinate(line, text, (rows, columns), header.is_symmetric)?,
            false => (next.0, next.1, number(line, text)?),
        };
        count += 1;
        if count > full {
            return Err(fault(
                line,
                format!("more than the {full} entries of the line of sizes"),
            ));
        }
        next = if row + 1 < rows {
            (row + 1, column)
        } else {
            (if header.is_symmetric { column + 1 } else { 0 }, column + 1)
        };
        matrix.entries.push((row, column, value));
        if header.is_symmetric && row != column {
            matrix.entries.push((column, row, value));
        }
    }
    match count == full {
        true => Ok(matrix),
        false => Err(fault(
            last,
            format!("the file ends after {count} of {full} entries"),
        )),
    }
}

fn header(line: &str) -> Result<Header, MarketError> {
    let words: Vec<String> = line
        .split_whitespace()
        .map(str::to_ascii_lowercase)
        .collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let ["%%matrixmarket", "matrix", storage, field, symmetry] = words[..] else {
        let expected =
            "expected a first line such as \"%%MatrixMarket matrix coordinate real symmetric\"";
        return Err(fault(1, expected));
    };
    let choice = |word: &str, allowed: [&str; 2]| match allowed.contains(&word) {
        true => Ok(word == allowed[0]),
        false => Err(fault(
            1,
            format!("{word}: only {} and {} are read", allowed[0], allowed[1]),
        )),
    };
    choice(field, ["real", "integer"])?;
    Ok(Header {
        is_coordinate: choice(storage, ["coordinate", "array"])?,
        is_symmetric: choice(symmetry, ["symmetric", "general"])?,
    })
}

fn sizes_of(
    line: usize,
    text: &str,
    is_coordinate: bool,
) -> Result<(usize, usize, usize), MarketError> {
    let sizes: Option<Vec<usize>> = text
        .split_whitespace()
        .map(|word| word.parse().ok())
        .collect();
    if let Some(size) = sizes
        .iter()
        .flatten()
        .take(2)
        .find(|size| **size > MAX_DIMENSION)
    {
        return Err(fault(
            line,
            format!("{size} rows or columns; at most {MAX_DIMENSION} are read"),
        ));
    }
    match (sizes.as_deref(), is_coordinate) {
        (Some(&[rows, columns, stored]), true) => Ok((rows, columns, stored)),
        (Some(&[rows, columns]), false) => Ok((rows, columns, 0)),
        (_, true) => Err(fault(
            line,
            "expected the numbers of rows, columns and entries",
        )),
        (_, false) => Err(fault(line, "expected the numbers of rows and columns")),
    }
}

fn coordinate(
    line: usize,
    text: &str,
    (rows, columns): (usize, usize),
    is_symmetric: bool,
) -> Result<(usize, usize, f64), MarketError> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let [row, column, value] = words[..] else {
        return Err(fault(line, "expected row, column and value"));
    };
    let index = |word: &str, most: usize, what: &str| match word.parse() {
        Ok(index) if (1..=most).contains(&index) => Ok(index - 1),
        _ => Err(fault(
            line,
            format!("{what} {word} is not a number from 1 to {most}"),
        )),
    };
    let (row, column) = (index(row, rows, "row")?, index(column, columns, "column")?);
    if is_symmetric && row < column {
        let place = format!("entry ({}, {})", row + 1, column + 1);
        return Err(fault(
            line,
            format!("{place} lies above the diagonal; a symmetric file holds the lower triangle"),
        ));
    }
    Ok((row, column, number(line, value)?))
}

fn number(line: usize, word: &str) -> Result<f64, MarketError> {
    // Fortran writes exponents with D.
    let value = word
        .replace(['D', 'd'], "e")
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| fault(line, format!("{word} is not a finite number")))
}

/// Writes the lower triangle of a symmetric matrix; a reader gets the same bits.
pub fn write_market_symmetric(matrix: &SymmetricMatrix) -> String {
    let size = matrix.size();
    let lower = |i: usize| {
        matrix
            .row(i)
            .filter(move |(j, _)| *j <= i)
            .map(move |(j, x)| (i, j, x))
    };
    let entries: Vec<(usize, usize, f64)> = (0..size).flat_map(lower).collect();
    let mut text = format!(
        "%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {}\n",
        entries.len()
    );
    for (row, column, value) in entries {
        let _ = writeln!(text, "{} {} {value:e}", row + 1, column + 1);
    }
    text
}

/// Writes a full matrix by columns; a reader gets the same bits.
pub fn write_market_array(matrix: &Mat<f64>) -> String {
    let (rows, columns) = matrix.shape();
    let mut text = format!("%%MatrixMarket matrix array real general\n{rows} {columns}\n");
    for value in matrix {
        let _ = writeln!(text, "{value:e}");
    }
    text
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn written_matrices_are_read_back_to_the_same_bits() {
        let entries = [(0, 0, 1.0 / 3.0), (2, 1, -6.02e-23), (2, 2, 1e300)];
        let matrix = SymmetricMatrix::from_lower(3, entries).unwrap();
        let read = read_market(&write_market_symmetric(&matrix)).unwrap();
        assert_eq!(read.symmetric().unwrap(), matrix);
        let array = Mat::from_fn(3, 2, |i, j| (i as f64 - 0.1) / (j as f64 + 0.7));
        assert_eq!(
            read_market(&write_market_array(&array)).unwrap().dense(),
            array
        );
        let empty = Mat::zeros(3, 0);
        assert_eq!(
            read_market(&write_market_array(&empty)).unwrap().dense(),
            empty
        );
    }

    /// As SciPy and Fortran programs write them.
    #[test]
    fn variants_of_the_format() {
        let text = "%%MatrixMarket MATRIX array Real symmetric\n% comment\n\n2 2\n1\n2.5D-1\n4\n";
        let matrix = read_market(text).unwrap().dense();
        assert_eq!(matrix, Mat::from_row_slice(2, 2, &[1.0, 0.25, 0.25, 4.0]));
        let text = "%%MatrixMarket matrix coordinate integer general\r\n%\r\n2 3 1\r\n2 3 -7\r\n";
        assert_eq!(read_market(text).unwrap().entries, [(1, 2, -7.0)]);
    }

    #[test]
    fn faults_name_the_line() {
        let fault = |text: &str| read_market(text).unwrap_err().to_string();
        let general = "%%MatrixMarket matrix coordinate real general\n";
        assert!(fault("1 1 1\n").contains("line 1: expected a first line such as"));
        assert!(fault(&general.replace("real", "complex")).contains("complex: only real"));
        assert!(fault(general).contains("line of sizes is missing"));
        assert!(
            fault(&format!("{general}2 2 1\n3 1 5\n"))
                .contains("line 3: row 3 is not a number from 1 to 2")
        );
        assert!(fault(&format!("{general}2 2 1\n1 1 x\n")).contains("x is not a finite number"));
        assert!(fault(&format!("{general}2 2 2\n1 1 1\n")).contains("ends after 1 of 2"));
        assert!(
            fault(&format!("{general}2 2 1\n1 1 1\n1 2 1\n")).contains("line 4: more than the 1")
        );
        let array = "%%MatrixMarket matrix array real general\n999999999999 999999999999\n1\n";
        assert!(
            fault(array)
                .contains("line 2: 999999999999 rows or columns; at most 100000000 are read")
        );
        let symmetric = general.replace("general", "symmetric");
        assert!(
            fault(&format!("{symmetric}2 2 1\n1 2 1\n"))
                .contains("line 3: entry (1, 2) lies above the diagonal")
        );
    }
}
