//! Archives of NumPy arrays (`numpy.savez`): named arrays, including texts.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path as FilePath;

use flate2::read::DeflateDecoder;
use rawzip::{
    CompressionMethod, FileReader, RECOMMENDED_BUFFER_SIZE, ZipArchive, ZipEntry,
    ZipFileHeaderRecord,
};

use super::MAX_DEFLATE_RATIO;
use super::arrays::{Array, MAX_ARRAYS, Path, Tree, into_found};
use super::npy::Header;
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;

/// Maximum total number of characters of a text array.
const MAX_CHARACTERS: u64 = 1 << 20;

pub(in crate::read) fn read(
    path: &FilePath,
    store: &SampleStore,
) -> Result<FormatContents, Damage> {
    let mut tree = Tree::default();
    let skipped = each_array(path, |name, source, bytes| {
        array(source, &Path::default().to(name), bytes, store, &mut tree)
    })?;
    for file_name in skipped {
        tree.skip(format!(
            "{file_name} in the archive is not an array and was left out"
        ));
    }
    into_found(tree)
}

/// Passes each array of an archive to `visit`, as its name, the bytes of its `.npy` file and their
/// largest number, and verifies its checksum; returns the names of other files.
pub(in crate::read) fn each_array(
    path: &FilePath,
    mut visit: impl FnMut(&str, &mut dyn Read, u64) -> Result<(), Damage>,
) -> Result<Vec<String>, Damage> {
    let file = File::open(path).map_err(Damage::cut)?;
    let mut buffer = vec![0; RECOMMENDED_BUFFER_SIZE];
    let archive =
        ZipArchive::from_file(file, &mut buffer).map_err(|fault| archive_error(&fault))?;
    let mut skipped = Vec::new();
    let mut entries = archive.entries(&mut buffer);
    let mut result = 0;
    while let Some(entry) = entries
        .next_entry()
        .map_err(|fault| archive_error(&fault))?
    {
        let file_name = String::from_utf8_lossy(entry.file_path().as_ref()).into_owned();
        let Some(name) = file_name.strip_suffix(".npy") else {
            skipped.push(file_name);
            continue;
        };
        result += 1;
        if result > MAX_ARRAYS {
            return Err(Damage::new(format!(
                "it contains more than {MAX_ARRAYS} arrays"
            )));
        }
        let with_name = |damage: Damage| Damage {
            why: format!("{name}: {}", damage.why),
            ..damage
        };
        let stored = archive
            .get_entry(entry.wayfinder())
            .map_err(|fault| archive_error(&fault))?;
        member(&entry, &stored, |source, bytes| visit(name, source, bytes)).map_err(with_name)?;
    }
    if result == 0 {
        return Err(Damage::new(
            "it is a ZIP archive without NumPy arrays: unpack it and read the files in it; save \
            an Excel workbook (.xlsx) as CSV; save a PicoScope recording (.psdata) as CSV in \
            PicoScope",
        ));
    }
    Ok(skipped)
}

/// Reads an array of the archive and verifies its checksum.
fn member(
    entry: &ZipFileHeaderRecord<'_>,
    stored: &ZipEntry<'_, FileReader>,
    visit: impl FnOnce(&mut dyn Read, u64) -> Result<(), Damage>,
) -> Result<(), Damage> {
    let bytes = entry.uncompressed_size_hint().min(
        entry
            .compressed_size_hint()
            .saturating_mul(MAX_DEFLATE_RATIO),
    );
    let compressed = stored.reader();
    let content: Box<dyn Read + '_> = match entry.compression_method() {
        CompressionMethod::STORE => Box::new(compressed),
        CompressionMethod::DEFLATE => Box::new(DeflateDecoder::new(compressed)),
        other => {
            return Err(Damage::new(format!(
                "it is compressed by {other:?}; save it with numpy.savez_compressed"
            )));
        }
    };
    let mut checked = stored.verifying_reader(content);
    visit(&mut checked, bytes)?;
    // Reading past the last byte verifies the checksum.
    io::copy(&mut checked.take(bytes), &mut io::sink()).map_err(Damage::cut)?;
    Ok(())
}

fn archive_error(fault: &rawzip::Error) -> Damage {
    Damage::new(format!("{fault}; is the file truncated?"))
}

fn array(
    source: &mut dyn Read,
    path: &Path,
    bytes: u64,
    store: &SampleStore,
    tree: &mut Tree,
) -> Result<(), Damage> {
    let header = Header::read(source)?;
    if let Some(length) = header
        .dtype
        .strip_prefix("<U")
        .and_then(|length| length.parse().ok())
    {
        tree.text(path, texts(source, &header, length)?);
        return Ok(());
    }
    match header.scalar() {
        Ok(_) => {
            let result = header.numbers(source, bytes, store)?;
            tree.arrays.push(Array {
                path: path.clone(),
                unit: String::new(),
                series: result.series,
                imaginary: result.imaginary,
                labels: result.labels,
            });
        }
        Err(damage) => tree.skip(format!("{path} was left out: {}", damage.why)),
    }
    Ok(())
}

/// Reads texts of `length` characters of four bytes each, padded with zeros.
fn texts(source: &mut dyn Read, header: &Header, length: u64) -> Result<Vec<String>, Damage> {
    let count = header
        .shape
        .iter()
        .try_fold(1_u64, |product, size| product.checked_mul(*size));
    let plausible_count = count.filter(|count| {
        count
            .checked_mul(length)
            .is_some_and(|characters| (1..=MAX_CHARACTERS).contains(&characters))
    });
    let Some(count) = plausible_count else {
        return Ok(Vec::new());
    };
    let mut result = Vec::new();
    let mut bytes = vec![0; 4 * length as usize];
    for _ in 0..count {
        source.read_exact(&mut bytes).map_err(Damage::cut)?;
        let characters = bytes
            .as_chunks()
            .0
            .iter()
            .map(|four| u32::from_le_bytes(*four))
            .take_while(|c| *c > 0);
        result.push(
            characters
                .map(|c| char::from_u32(c).unwrap_or('\u{fffd}'))
                .collect(),
        );
    }
    Ok(result)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn texts_of(dtype: &str, shape: &str, content: &[u8]) -> Vec<String> {
        let text = format!("{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}");
        let mut bytes = [super::super::npy::BEGIN, &[1, 0]].concat();
        bytes.extend((text.len() as u16).to_le_bytes());
        bytes.extend(text.bytes().chain(content.iter().copied()));
        let mut source = bytes.as_slice();
        let header = Header::read(&mut source).unwrap();
        let length = header.dtype.trim_start_matches("<U").parse().unwrap();
        texts(&mut source, &header, length).unwrap()
    }

    /// An empty array of long texts takes no memory.
    #[test]
    fn an_empty_array_of_long_texts_is_empty() {
        assert_eq!(texts_of("<U2", "(1,)", b"m\0\0\0s\0\0\0"), ["ms"]);
        assert!(texts_of("<U1000000000000", "(0,)", b"").is_empty());
        assert!(texts_of("<U0", "(3,)", b"").is_empty());
    }
}
