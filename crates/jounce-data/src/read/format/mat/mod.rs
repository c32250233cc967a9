//! MATLAB files of version 5 (`-v6`, `-v7`): numeric arrays and texts, including those nested in
//! structs, cells and objects.
//!
//! Source: The MathWorks, "MAT-File Format", R2023b. Numbers are streamed to the store, so no array
//! is held in memory.
mod elements;
mod matrix;

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path as FilePath;

use flate2::read::ZlibDecoder;

use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::format::MAX_DEFLATE_RATIO;
use crate::read::format::arrays::{Path, Tree, into_found};
use elements::{COMPRESSED, Elements, MATRIX, Tag};

/// Bytes of the file header; the last two give the byte order.
const HEADER: usize = 128;

pub(in crate::read) fn read(
    path: &FilePath,
    store: &SampleStore,
) -> Result<FormatContents, Damage> {
    let file = File::open(path).map_err(Damage::cut)?;
    let size = file.metadata().map_err(Damage::cut)?.len();
    let mut source = BufReader::with_capacity(1 << 16, file);
    let mut header = [0; HEADER];
    source.read_exact(&mut header).map_err(Damage::cut)?;
    let little_endian = header.ends_with(b"IM");
    let mut tree = Tree::default();
    let mut at = HEADER as u64;
    while at < size {
        at += element(&mut source, size - at, little_endian, store, &mut tree)
            .map_err(|damage| damage.at_byte(at))?;
    }
    into_found(tree)
}

/// Reads one element of the file, compressed or not, and returns its size in bytes.
fn element(
    source: &mut impl Read,
    remaining: u64,
    little_endian: bool,
    store: &SampleStore,
    tree: &mut Tree,
) -> Result<u64, Damage> {
    let tag = Tag::read(source, little_endian)?;
    let remaining = remaining.saturating_sub(8);
    if tag.length > remaining {
        return Err(Damage::new(format!(
            "the element at this position is {} bytes long, but {remaining} follow: is the file \
            truncated?",
            tag.length
        )));
    }
    let mut content = source.by_ref().take(tag.length);
    if tag.kind == COMPRESSED {
        let mut inflated = ZlibDecoder::new(&mut content);
        let inner_tag = Tag::read(&mut inflated, little_endian)?;
        if inner_tag.length / MAX_DEFLATE_RATIO > tag.length {
            let why = format!(
                "{} bytes cannot be {} compressed ones: is the file truncated?",
                inner_tag.length, tag.length
            );
            return Err(Damage::new(why));
        }
        root(&mut inflated, inner_tag, little_endian, store, tree)?;
        // Reading past the last byte verifies the checksum.
        io::copy(&mut inflated.take(1), &mut io::sink()).map_err(Damage::cut)?;
    } else {
        root(&mut content, tag, little_endian, store, tree)?;
    }
    io::copy(&mut content, &mut io::sink()).map_err(Damage::cut)?;
    // Uncompressed data are padded to eight bytes.
    let stored_length = if tag.kind == COMPRESSED {
        tag.length
    } else {
        tag.length.next_multiple_of(8)
    };
    let padding = stored_length.min(remaining) - tag.length;
    io::copy(&mut source.by_ref().take(padding), &mut io::sink()).map_err(Damage::cut)?;
    Ok(8 + tag.length + padding)
}

/// Reads a variable of the file.
fn root(
    source: &mut dyn Read,
    tag: Tag,
    little_endian: bool,
    store: &SampleStore,
    tree: &mut Tree,
) -> Result<(), Damage> {
    if tag.kind != MATRIX {
        tree.skip(format!(
            "an element of type {} is not a variable and was left out",
            tag.kind
        ));
        return Ok(());
    }
    let mut elements = Elements::new(source, tag.length, little_endian);
    matrix::read(&mut elements, &Path::default(), 0, store, tree)?;
    elements.skip_rest()
}
