//! Checks array sizes against the file size before reading.

use crate::read::format::MAX_DEFLATE_RATIO;
use hdf5_pure::{Dataset, Layout};

/// Returns the dimensions of an array that is completely stored; `Err` gives the reason why it
/// cannot be read.
pub(super) fn shape(dataset: &Dataset, file_size: u64) -> Result<Vec<u64>, String> {
    let error_text = |fault: hdf5_pure::Error| fault.to_string();
    let shape = dataset.shape().map_err(error_text)?;
    let size = dataset.element_size().map_err(error_text)?;
    let bytes = product(&shape)
        .and_then(|count| count.checked_mul(size))
        .ok_or("it is larger than can be counted")?;
    match dataset.layout().map_err(error_text)? {
        Layout::Compact { size } if size < bytes => {
            Err(format!("it needs {bytes} bytes, but {size} are stored"))
        }
        Layout::Compact { .. } => Ok(shape),
        Layout::Contiguous {
            address: Some(address),
            ..
        } => {
            let available = file_size.saturating_sub(address);
            if bytes <= available {
                Ok(shape)
            } else {
                Err(format!(
                    "it needs {bytes} bytes, but {available} follow: is the file truncated?"
                ))
            }
        }
        Layout::Contiguous { address: None, .. } if bytes > 0 => {
            Err("it was never written".to_owned())
        }
        Layout::Contiguous { .. } => Ok(shape),
        Layout::Chunked { chunk_shape, .. } => {
            chunks(dataset, &shape, &chunk_shape, size, file_size).map(|()| shape)
        }
        _ => Err("its numbers are in other files".to_owned()),
    }
}

/// Checks that every chunk of the array lies inside the file and that no chunk is missing.
fn chunks(
    dataset: &Dataset,
    shape: &[u64],
    chunk_shape: &[u64],
    size: u64,
    file_size: u64,
) -> Result<(), String> {
    if shape.len() != chunk_shape.len() || chunk_shape.contains(&0) {
        return Err(format!(
            "chunks of {chunk_shape:?} do not match an array of {shape:?}"
        ));
    }
    let chunk_counts: Vec<u64> = shape
        .iter()
        .zip(chunk_shape)
        .map(|(side, chunk_side)| side.div_ceil(*chunk_side))
        .collect();
    let expected = product(&chunk_counts).ok_or("it has more chunks than can be counted")?;
    let bytes = product(chunk_shape)
        .and_then(|count| count.checked_mul(size))
        .ok_or("its chunks are larger than can be counted")?;
    // Each chunk takes room in the file, at least in the chunk index.
    if expected > file_size {
        return Err(format!(
            "it has {expected} chunks, more than the file has bytes"
        ));
    }
    let chunks = dataset.chunks().map_err(|fault| fault.to_string())?;
    let (mut chunk_count, mut stored) = (0_u64, 0_u64);
    for chunk in &chunks {
        let is_inside = chunk.offset.len() == shape.len()
            && chunk
                .offset
                .iter()
                .zip(shape)
                .all(|(offset, side)| offset < side);
        let end = chunk.address.saturating_add(chunk.storage_size);
        if !is_inside || end > file_size || bytes / MAX_DEFLATE_RATIO > chunk.storage_size {
            return Err(format!(
                "the chunk at {:?} of {} bytes is impossible: is the file truncated?",
                chunk.offset, chunk.storage_size
            ));
        }
        chunk_count += 1;
        stored = stored.saturating_add(chunk.storage_size);
    }
    if chunk_count != expected {
        return Err(format!(
            "{chunk_count} of its {expected} chunks are stored; the others were never written"
        ));
    }
    if stored > file_size {
        return Err(format!(
            "its chunks have {stored} bytes, the file has {file_size}"
        ));
    }
    Ok(())
}

fn product(sizes: &[u64]) -> Option<u64> {
    sizes
        .iter()
        .try_fold(1_u64, |product, size| product.checked_mul(*size))
}
