//! Matrices of other programs.

use super::text_of;
use jounce_sparse::{read_market, write_market_symmetric};

/// A symmetric matrix is written as a text that reads back to the same bits; faults name a line of the text.
pub fn market(data: &[u8]) {
    let text = text_of(data);
    match read_market(&text) {
        Ok(matrix) => {
            let (rows, columns) = (matrix.rows, matrix.columns);
            assert!(
                matrix
                    .entries
                    .iter()
                    .all(|(row, column, _)| *row < rows && *column < columns)
            );
            if rows > 10_000 {
                return;
            }
            if let Ok(matrix) = matrix.symmetric() {
                let again = read_market(&write_market_symmetric(&matrix)).expect("it was written");
                assert_eq!(again.symmetric().expect("it is symmetric"), matrix);
            }
        }
        Err(error) => assert!(error.line <= text.lines().count().max(1), "{error}"),
    }
}
