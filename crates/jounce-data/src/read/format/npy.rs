//! NumPy arrays: one or two dimensions of real numbers; the longer side is time.
//!
//! Source: NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays", versions 1.0 to
//! 3.0.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use super::arrays::ArrayLayout;
use super::scalar::{Kind, Scalar};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Raw, RawColumn};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::recording::{Issue, IssueKind};

pub(in crate::read) const BEGIN: &[u8] = b"\x93NUMPY";
/// Maximum number of bytes of a header.
const MAX_HEADER_BYTES: usize = 1 << 16;

/// Contents of the header of an array.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct Header {
    /// Number type, `<f8`; for records, the complete description.
    pub dtype: String,
    fortran: bool,
    pub shape: Vec<u64>,
}

/// Array split into series along its longest side.
pub(in crate::read) struct SeriesOf {
    pub series: Vec<ColumnNumbers>,
    pub imaginary: Option<Vec<ColumnNumbers>>,
    pub labels: Vec<String>,
}

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let file = File::open(path).map_err(Damage::cut)?;
    let bytes = file.metadata().map_err(Damage::cut)?.len();
    let mut source = BufReader::with_capacity(1 << 16, file);
    let header = Header::read(&mut source)?;
    let (rows, columns) = match header.shape[..] {
        [count] => (1, count),
        [rows, columns] => (rows, columns),
        _ => {
            return Err(Damage::new(format!(
                "the array has {} dimensions; expected one or two",
                header.shape.len()
            )));
        }
    };
    let (_, complex) = header.scalar()?;
    if complex {
        return Err(Damage::new(format!(
            "its numbers are complex ({}), but an array without names must be real. For a \
            response over frequency, save columns NAME.re and NAME.im next to frequency_hz in CSV \
            or Parquet, which `modes --measured` reads, or use numpy.savez(file, \
            frequency_hz=..., NAME=...). For a record over time, save only the real parts",
            header.dtype
        )));
    }
    let array = header.numbers(&mut source, bytes, store)?;
    let name = |k: usize| format!("channel {}", k + 1);
    let series = array
        .series
        .into_iter()
        .enumerate()
        .map(|(k, values)| RawColumn::new(&name(k), "", values))
        .collect();
    let message =
        format!("an array of {rows} x {columns} without names: its longer side is used as time");
    Ok(Raw::columns(
        series,
        vec![Issue::new(IssueKind::Assumed, 1, None, message)],
    )
    .into())
}

impl Header {
    /// Reads `{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }` and the bytes before it.
    pub fn read(source: &mut dyn Read) -> Result<Self, Damage> {
        let mut signature = [0; 8];
        source.read_exact(&mut signature).map_err(Damage::cut)?;
        let version = signature[BEGIN.len()];
        if !signature.starts_with(BEGIN) || !(1..=3).contains(&version) {
            return Err(Damage::new(format!(
                "version {version} of the format is not known; expected 1 to 3"
            )));
        }
        let mut length = [0; 4];
        source
            .read_exact(&mut length[..if version == 1 { 2 } else { 4 }])
            .map_err(Damage::cut)?;
        let length = u32::from_le_bytes(length) as usize;
        if length > MAX_HEADER_BYTES {
            return Err(Damage::new(format!(
                "its header is {length} bytes long; the limit is {MAX_HEADER_BYTES}"
            )));
        }
        let mut text = vec![0; length];
        source.read_exact(&mut text).map_err(Damage::cut)?;
        let text: String = text.iter().map(|b| char::from(*b)).collect();
        Self::parse(&text).ok_or_else(|| {
            Damage::new(format!(
                "its header does not give type, order and shape: {:?}",
                text.trim()
            ))
        })
    }

    fn parse(text: &str) -> Option<Self> {
        let value = |key: &str| {
            let after_key = text
                .split_once(&format!("'{key}'"))
                .or_else(|| text.split_once(&format!("\"{key}\"")))?
                .1;
            Some(after_key.trim_start().strip_prefix(':')?.trim_start())
        };
        let descr = value("descr")?;
        let dtype = match descr.chars().next()? {
            quote @ ('\'' | '"') => descr[1..].split(quote).next()?.to_owned(),
            _ => descr
                .split("'fortran_order'")
                .next()?
                .trim_end_matches([' ', ','])
                .to_owned(),
        };
        let order = value("fortran_order")?;
        let fortran = order.starts_with("True");
        let shape_text = value("shape")?.strip_prefix('(')?.split(')').next()?;
        let lengths = shape_text
            .split(',')
            .map(str::trim)
            .filter(|length| !length.is_empty());
        let shape = lengths
            .map(|length| length.trim_end_matches('L').parse().ok())
            .collect::<Option<Vec<u64>>>()?;
        (fortran || order.starts_with("False")).then_some(Self {
            dtype,
            fortran,
            shape,
        })
    }

    /// Storage type of the numbers, and true where each is a pair of real and imaginary part.
    pub fn scalar(&self) -> Result<(Scalar, bool), Damage> {
        let dtype = self.dtype.as_str();
        if dtype.starts_with('[') || dtype.contains('V') {
            return Err(Damage::new(format!(
                "its numbers are records ({dtype}); save each field as a separate array"
            )));
        }
        let other = || {
            Damage::new(format!(
                "its numbers are of type {dtype}; expected real numbers of 2, 4 or 8 bytes, or \
                integers of 1 to 8"
            ))
        };
        let little_endian = match dtype.chars().next() {
            Some('<' | '|') => true,
            Some('>') => false,
            Some('=') => cfg!(target_endian = "little"),
            _ => return Err(other()),
        };
        let kind = dtype.get(1..2).unwrap_or_default();
        let size: usize = dtype
            .get(2..)
            .unwrap_or_default()
            .parse()
            .map_err(|_| other())?;
        let (kind, size, complex) = match kind {
            "f" => (Kind::Float, size, false),
            "c" => (Kind::Float, size / 2, true),
            "i" => (Kind::Signed, size, false),
            "u" | "b" => (Kind::Unsigned, size, false),
            _ => return Err(other()),
        };
        Ok((
            Scalar::new(kind, size, little_endian).ok_or_else(other)?,
            complex,
        ))
    }

    /// Reads the numbers after the header; at most `bytes` bytes can follow.
    pub fn numbers(
        &self,
        source: &mut dyn Read,
        bytes: u64,
        store: &SampleStore,
    ) -> Result<SeriesOf, Damage> {
        let (scalar, complex) = self.scalar()?;
        let shape_text = self
            .shape
            .iter()
            .map(u64::to_string)
            .collect::<Vec<_>>()
            .join(" x ");
        let layout = ArrayLayout::new(&self.shape, !self.fortran);
        let layout = layout.ok_or_else(|| {
            Damage::new(format!(
                "an array of {shape_text} numbers is not a series of numbers"
            ))
        })?;
        let part_count = if complex { 2 } else { 1 };
        let total = layout.total() * part_count;
        if total
            .checked_mul(scalar.size as u64)
            .is_none_or(|needed_bytes| needed_bytes > bytes)
        {
            return Err(Damage::new(format!(
                "an array of {shape_text} numbers is longer than the {bytes} bytes of the file; is the \
                file truncated?"
            )));
        }
        let mut series = layout.series(store)?;
        let mut imaginary = if complex {
            Some(layout.series(store)?)
        } else {
            None
        };
        let mut number = 0;
        scalar.each(source, total, |x| {
            let index = number / part_count;
            let target = if number % part_count == 0 {
                Some(&mut series)
            } else {
                imaginary.as_mut()
            };
            number += 1;
            target.map_or(Ok(()), |target| layout.push(target, index, x))
        })?;
        Ok(SeriesOf {
            series,
            imaginary,
            labels: layout.labels(),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn headers_are_read_in_every_form() {
        let header = |text| Header::parse(text);
        let result =
            header("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }   \n").unwrap();
        assert_eq!(
            (result.dtype.as_str(), result.fortran, &result.shape[..]),
            ("<f8", false, &[3, 2][..])
        );
        let result = header(
            "{'descr': [('a', '<f8'), ('b', '<i4')], 'fortran_order': True, 'shape': (7L,), }",
        )
        .unwrap();
        assert_eq!(
            (result.dtype.as_str(), result.fortran, &result.shape[..]),
            ("[('a', '<f8'), ('b', '<i4')]", true, &[7][..])
        );
        assert!(result.scalar().is_err());
        assert_eq!(
            header("{'shape': (), 'fortran_order': False, 'descr': '|b1'}")
                .unwrap()
                .scalar()
                .unwrap()
                .0
                .size,
            1
        );
        for invalid_header in [
            "",
            "{'descr': '<f8'}",
            "{'descr': '<f8', 'fortran_order': 1, 'shape': (3,)}",
            "{'descr': '<f8', 'fortran_order': True, 'shape': (-3,)}",
        ] {
            assert_eq!(header(invalid_header), None, "{invalid_header}");
        }
    }

    #[test]
    fn types_of_numbers_are_read() {
        let complex = Header {
            dtype: ">c16".into(),
            fortran: false,
            shape: vec![2],
        };
        assert_eq!(
            complex.scalar().unwrap(),
            (
                Scalar {
                    kind: Kind::Float,
                    size: 8,
                    little_endian: false
                },
                true
            )
        );
        for dtype in ["<f3", "<U3", "|O", "<M8", "f8", "<f", "\u{e9}f8"] {
            assert!(
                Header {
                    dtype: dtype.into(),
                    fortran: false,
                    shape: vec![2]
                }
                .scalar()
                .is_err(),
                "{dtype}"
            );
        }
    }
}
