//! What may be read of an array: only what the file can hold.

use hdf5_pure::{Dataset, Layout};

/// Bytes that one compressed byte can stand for.
const MAX_RATIO: u64 = 1032;

/// The dimensions of an array whose bytes are all there; `Err` says why it cannot be read.
pub(super) fn shape(dataset: &Dataset, file_size: u64) -> Result<Vec<u64>, String> {
    let told = |fault: hdf5_pure::Error| fault.to_string();
    let shape = dataset.shape().map_err(told)?;
    let size = dataset.element_size().map_err(told)?;
    let bytes = product(&shape)
        .and_then(|count| count.checked_mul(size))
        .ok_or("it is larger than can be counted")?;
    match dataset.layout().map_err(told)? {
        Layout::Compact { size } if size < bytes => {
            Err(format!("{bytes} bytes are due, {size} are there"))
        }
        Layout::Compact { .. } => Ok(shape),
        Layout::Contiguous {
            address: Some(address),
            ..
        } => {
            let there = file_size.saturating_sub(address);
            if bytes <= there {
                Ok(shape)
            } else {
                Err(format!(
                    "{bytes} bytes are due, {there} follow: was the file cut?"
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
        _ => Err("its numbers lie in other files".to_owned()),
    }
}

/// Every part of the array lies inside the file, and none is missing.
fn chunks(
    dataset: &Dataset,
    shape: &[u64],
    chunk_shape: &[u64],
    size: u64,
    file_size: u64,
) -> Result<(), String> {
    if shape.len() != chunk_shape.len() || chunk_shape.contains(&0) {
        return Err(format!(
            "parts of {chunk_shape:?} do not make up an array of {shape:?}"
        ));
    }
    let sides: Vec<u64> = shape
        .iter()
        .zip(chunk_shape)
        .map(|(side, part)| side.div_ceil(*part))
        .collect();
    let due = product(&sides).ok_or("it has more parts than can be counted")?;
    let bytes = product(chunk_shape)
        .and_then(|count| count.checked_mul(size))
        .ok_or("its parts are larger than can be counted")?;
    // Each part takes room in the file, at least in the list of the parts.
    if due > file_size {
        return Err(format!("it has {due} parts, more than the file has bytes"));
    }
    let chunks = dataset.chunks().map_err(|fault| fault.to_string())?;
    let (mut there, mut stored) = (0_u64, 0_u64);
    for chunk in &chunks {
        let inside = chunk.offset.len() == shape.len()
            && chunk
                .offset
                .iter()
                .zip(shape)
                .all(|(offset, side)| offset < side);
        let end = chunk.address.saturating_add(chunk.storage_size);
        if !inside || end > file_size || bytes / MAX_RATIO > chunk.storage_size {
            return Err(format!(
                "the part at {:?} of {} bytes cannot be: was the file cut?",
                chunk.offset, chunk.storage_size
            ));
        }
        there += 1;
        stored = stored.saturating_add(chunk.storage_size);
    }
    if there != due {
        return Err(format!(
            "{there} of its {due} parts are there; the others were never written"
        ));
    }
    if stored > file_size {
        return Err(format!(
            "its parts have {stored} bytes, the file has {file_size}"
        ));
    }
    Ok(())
}

fn product(sizes: &[u64]) -> Option<u64> {
    sizes
        .iter()
        .try_fold(1_u64, |product, size| product.checked_mul(*size))
}
