//! Decodes the numbers of data set 58b.

use std::io::Read;

use super::header::Header;
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;

/// Bytes read at once: complete points of any width, 3 numbers of 8 bytes at most.
const BYTES_AT_ONCE: usize = 24 << 10;

/// Decodes binary numbers: all of one size, or an uneven abscissa in single precision with double
/// ordinates; the length decides.
pub(super) fn numbers(
    source: &mut impl Read,
    header: &Header,
    length: usize,
    little_endian: bool,
    store: &SampleStore,
) -> Result<ColumnNumbers, String> {
    let (points, width) = (header.points, header.width());
    let size = if header.is_double { 8 } else { 4 };
    let mixed_length = points.checked_mul(4 + (width - 1) * size);
    let single_abscissa = header.is_double && !header.is_uniform && Some(length) == mixed_length;
    if Some(length) != points.checked_mul(width * size) && !single_abscissa {
        return Err(format!(
            "expected {points} points of {width} numbers of {size} bytes, but {length} bytes follow"
        ));
    }
    let point = if single_abscissa {
        4 + (width - 1) * size
    } else {
        width * size
    };
    let (mut result, mut bytes, mut read) = (store.column(), Vec::new(), 0);
    while read < length {
        bytes.clear();
        let expected = (length - read).min(BYTES_AT_ONCE / point * point);
        source
            .by_ref()
            .take(expected as u64)
            .read_to_end(&mut bytes)
            .map_err(|fault| fault.to_string())?;
        read += bytes.len();
        if bytes.len() < expected {
            return Err(format!(
                "expected {length} bytes of data, but {read} follow: is the file truncated?"
            ));
        }
        for point in bytes.chunks_exact(point) {
            let (single, rest) = point.split_at(if single_abscissa { 4 } else { 0 });
            let all = single.chunks_exact(4).chain(rest.chunks_exact(size));
            all.map(|number| number_of(number, little_endian))
                .try_for_each(|x| result.push(x))
                .map_err(|fault| Damage::from(fault).why)?;
        }
    }
    Ok(result)
}

fn number_of(bytes: &[u8], little_endian: bool) -> f64 {
    match (<[u8; 8]>::try_from(bytes), <[u8; 4]>::try_from(bytes)) {
        (Ok(eight), _) => {
            if little_endian {
                f64::from_le_bytes(eight)
            } else {
                f64::from_be_bytes(eight)
            }
        }
        (_, Ok(four)) => f64::from(if little_endian {
            f32::from_le_bytes(four)
        } else {
            f32::from_be_bytes(four)
        }),
        _ => f64::NAN,
    }
}
