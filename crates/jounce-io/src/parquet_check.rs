//! Checks lengths in a Parquet file before the library reads it.
//!
//! Metadata and page headers are values of the compact protocol of Thrift. The library skips a list of flags without reading a byte for
//! each, so a damaged length of 2^31 takes many seconds. Here each element takes at least one byte of the file.
//!
//! Source: Apache Thrift, doc/specs/thrift-compact-protocol.md; Apache Parquet, parquet.thrift.

use parquet::file::metadata::ParquetMetaData;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

/// Largest number of nested values; the metadata need ten.
const MAX_DEPTH: u32 = 32;

/// Field of a page header: the size of the page without its header.
const COMPRESSED_SIZE: i64 = 3;

/// Checks the metadata at the end of a file. A file whose end is no such metadata is left to the library.
///
/// # Errors
/// One sentence: a length that is impossible, or a file that cannot be read.
pub fn footer(file: &File) -> Result<(), String> {
    let size = file.metadata().map_err(text)?.len();
    let Some(end) = size.checked_sub(8) else {
        return Ok(());
    };
    let mut tail = [0; 4];
    let mut reader = BufReader::new(file);
    reader.seek(SeekFrom::Start(end)).map_err(text)?;
    reader.read_exact(&mut tail).map_err(text)?;
    let Some(start) = end.checked_sub(u64::from(u32::from_le_bytes(tail))) else {
        return Ok(());
    };
    reader.seek(SeekFrom::Start(start)).map_err(text)?;
    let mut scan = Scan {
        left: end - start,
        source: reader,
    };
    scan.structure(0).map(drop)
}

/// Checks the headers of all pages; the chunks of columns must be inside the file.
///
/// # Errors
/// As [`footer`].
pub fn page_headers(file: &File, metadata: &ParquetMetaData) -> Result<(), String> {
    let mut source = BufReader::new(file);
    for column in metadata
        .row_groups()
        .iter()
        .flat_map(|group| group.columns())
    {
        let start = column
            .dictionary_page_offset()
            .unwrap_or(column.data_page_offset());
        let (Ok(mut start), Ok(size)) = (
            u64::try_from(start),
            u64::try_from(column.compressed_size()),
        ) else {
            continue;
        };
        let end = start.saturating_add(size);
        while start < end {
            source.seek(SeekFrom::Start(start)).map_err(text)?;
            let mut scan = Scan {
                left: end - start,
                source: &mut source,
            };
            let page_size = scan.structure(0)?.ok_or("a page has no size")?;
            start = (end - scan.left).saturating_add(page_size);
        }
    }
    Ok(())
}

fn text(error: io::Error) -> String {
    error.to_string()
}

/// Values of a part of a file.
struct Scan<R> {
    source: R,
    /// Bytes that follow.
    left: u64,
}

impl<R: Read> Scan<R> {
    /// Passes over a structure; returns its field of the compressed size.
    fn structure(&mut self, depth: u32) -> Result<Option<u64>, String> {
        let (mut field, mut compressed_size) = (0_i64, None);
        loop {
            let head = self.byte()?;
            let kind = head & 15;
            if kind == 0 {
                return Ok(compressed_size);
            }
            field = match i64::from(head >> 4) {
                0 => self.signed()?,
                step => field.saturating_add(step),
            };
            if kind == 5 && field == COMPRESSED_SIZE {
                compressed_size = u64::try_from(self.signed()?).ok();
            } else {
                self.value(kind, depth)?;
            }
        }
    }

    /// Passes over a value. Flags of a structure are in the heads of their fields.
    fn value(&mut self, kind: u8, depth: u32) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err(format!(
                "its metadata have more than {MAX_DEPTH} nested values"
            ));
        }
        match kind {
            1 | 2 => Ok(()),
            3 => self.byte().map(drop),
            4..=6 => self.number().map(drop),
            7 => self.skip(8),
            8 => {
                let length = self.number()?;
                self.skip(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = match head >> 4 {
                    15 => self.number()?,
                    count => u64::from(count),
                };
                self.elements(count, &[head & 15], depth)
            }
            11 => match self.number()? {
                0 => Ok(()),
                count => {
                    let kinds = self.byte()?;
                    self.elements(count, &[kinds >> 4, kinds & 15], depth)
                }
            },
            12 => self.structure(depth + 1).map(drop),
            13 => self.skip(16),
            _ => Err(format!("its metadata have a value of unknown kind {kind}")),
        }
    }

    fn elements(&mut self, count: u64, kinds: &[u8], depth: u32) -> Result<(), String> {
        if count > self.left {
            return Err(format!(
                "a list of {count} elements in its metadata has {} bytes",
                self.left
            ));
        }
        for kind in (0..count).flat_map(|_| kinds) {
            match kind {
                1 | 2 => self.skip(1)?,
                kind => self.value(*kind, depth + 1)?,
            }
        }
        Ok(())
    }

    fn signed(&mut self) -> Result<i64, String> {
        let number = self.number()?;
        Ok((number >> 1) as i64 ^ -((number & 1) as i64))
    }

    /// Reads a number of seven bits a byte, the lowest first.
    fn number(&mut self) -> Result<u64, String> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err("a number in its metadata has more than 10 bytes".to_owned())
    }

    fn byte(&mut self) -> Result<u8, String> {
        let mut byte = [0];
        self.take(1)?;
        self.source.read_exact(&mut byte).map_err(text)?;
        Ok(byte[0])
    }

    fn skip(&mut self, bytes: u64) -> Result<(), String> {
        self.take(bytes)?;
        let passed = io::copy(&mut self.source.by_ref().take(bytes), &mut io::sink());
        match passed.map_err(text)? == bytes {
            true => Ok(()),
            false => Err("its metadata are truncated".to_owned()),
        }
    }

    fn take(&mut self, bytes: u64) -> Result<(), String> {
        let left = self.left.checked_sub(bytes);
        self.left = left.ok_or_else(|| "its metadata are truncated".to_owned())?;
        Ok(())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::table::{Column, Manifest, Table};
    use std::io::Write;

    /// Checks the footer of a file with these metadata.
    fn footer_of(metadata: &[u8]) -> Result<(), String> {
        let mut file = tempfile::tempfile().unwrap();
        let length = u32::try_from(metadata.len()).unwrap().to_le_bytes();
        file.write_all(&[b"PAR1", metadata, &length, b"PAR1"].concat())
            .unwrap();
        footer(&file)
    }

    #[test]
    fn lists_longer_than_the_file_are_refused() {
        // Field 1, a list of 2^31 - 1 flags, or a map of as many pairs of flags.
        for list in [
            b"\x19\xf1\xff\xff\xff\xff\x07\0".as_slice(),
            b"\x1b\xff\xff\xff\xff\x07\x11\0",
        ] {
            assert_eq!(
                footer_of(list),
                Err("a list of 2147483647 elements in its metadata has 1 bytes".to_owned())
            );
        }
        assert_eq!(footer_of(b"\x19\x21\x01\x02\0"), Ok(()));
        assert_eq!(
            footer_of(b"\x19\x21\x01\0"),
            Err("its metadata are truncated".to_owned())
        );
        let nested = [[0x1c; 50].as_slice(), &[0; 51]].concat();
        assert!(
            footer_of(&nested)
                .unwrap_err()
                .contains("more than 32 nested values")
        );
    }

    #[test]
    fn a_table_is_passed_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.parquet");
        let values: Vec<f64> = (0..3000).map(f64::from).collect();
        let flags = vec![true; 3000];
        let columns = vec![
            Column::new("x", "m", "", values),
            Column::new("y", "", "", flags),
        ];
        let table = Table::new(columns).unwrap();
        table.write(&path, &Manifest::new("")).unwrap();
        assert_eq!(Table::read(&path).unwrap().0, table);
        assert_eq!(footer(&File::open(&path).unwrap()), Ok(()));
    }
}
