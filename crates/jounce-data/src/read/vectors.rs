//! Arrays of one dimension and texts of an archive of NumPy, as `scipy.sparse.save_npz` writes them.

use super::ReadError;
use super::error::Damage;
use super::format::npy::Header;
use super::format::npz::each_array;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// Longest text, in bytes.
const MAX_TEXT: u64 = 1 << 10;

/// An array of an archive.
#[derive(Debug, Clone, PartialEq)]
pub enum Vector {
    /// Numbers of an array of at most one dimension.
    Numbers(Vec<f64>),
    /// A text of bytes.
    Text(String),
    /// Another array, with the reason why it is not read.
    Other(String),
}

/// Reads all arrays of an archive into memory.
///
/// # Errors
/// [`ReadError::Damaged`], also for a file that cannot be opened.
pub fn vectors(path: &Path) -> Result<BTreeMap<String, Vector>, ReadError> {
    let mut vectors = BTreeMap::new();
    let read = each_array(path, |name, source, bytes| {
        vectors.insert(name.to_owned(), vector(source, bytes)?);
        Ok(())
    });
    match read {
        Ok(_) => Ok(vectors),
        Err(Damage { place, why }) => Err(ReadError::Damaged {
            path: path.to_owned(),
            format: "NPZ",
            place,
            why,
        }),
    }
}

fn vector(source: &mut dyn Read, bytes: u64) -> Result<Vector, Damage> {
    let header = Header::read(source)?;
    let count = match header.shape[..] {
        [] => 1,
        [count] => count,
        _ => {
            let text = format!("it has {} dimensions", header.shape.len());
            return Ok(Vector::Other(text));
        }
    };
    if let Some(length) = header.dtype.strip_prefix("|S") {
        let length = length.parse().ok().filter(|length| *length <= MAX_TEXT);
        let Some(length) = length.filter(|_| count == 1) else {
            return Ok(Vector::Other(format!("it is of type {}", header.dtype)));
        };
        let mut text = Vec::new();
        source
            .take(length)
            .read_to_end(&mut text)
            .map_err(Damage::cut)?;
        let text = String::from_utf8_lossy(&text).into_owned();
        return Ok(Vector::Text(text.trim_end_matches('\0').to_owned()));
    }
    let (scalar, is_complex) = match header.scalar() {
        Ok(scalar) => scalar,
        Err(damage) => return Ok(Vector::Other(damage.why)),
    };
    if is_complex {
        return Ok(Vector::Other("its numbers are complex".to_owned()));
    }
    if count
        .checked_mul(scalar.size as u64)
        .is_none_or(|needed| needed > bytes)
    {
        return Err(Damage::new(format!(
            "{count} numbers are longer than the {bytes} bytes of the file; is the file truncated?"
        )));
    }
    let mut numbers = Vec::with_capacity(count as usize);
    scalar.each(source, count, |number| {
        numbers.push(number);
        Ok(())
    })?;
    Ok(Vector::Numbers(numbers))
}
