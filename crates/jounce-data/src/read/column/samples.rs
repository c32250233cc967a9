//! Stores for the numbers of a file: in memory, or in a scratch file so that memory does not grow
//! with the file.
//!
//! A scratch store keeps the first numbers in memory and writes all others to a scratch file, in
//! pieces of one column each. The scratch file is in `TMPDIR`, else in `/var/tmp`. It has no name
//! and is deleted with the store.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::PathBuf;
use std::rc::Rc;

use crate::read::column::numbers::ColumnNumbers;
use crate::recording::PIECE;

/// Pieces that a store keeps in memory, 16 MiB for all columns together.
const MAX_PIECES_IN_MEMORY: usize = (16 << 20) / (8 * PIECE);

/// Store for the numbers of a file.
#[derive(Debug, Clone)]
pub(in crate::read) enum SampleStore {
    /// All numbers in memory.
    Memory,
    /// The first numbers in memory, all others in a scratch file.
    Scratch(Rc<RefCell<Scratch>>),
}

/// Scratch file, created at first use.
#[derive(Debug)]
pub(in crate::read) struct Scratch {
    /// Pieces that may still be kept in memory.
    pieces_left: usize,
    file: Option<File>,
    end: u64,
    bytes: Vec<u8>,
}

/// Piece of a stored column.
#[derive(Debug)]
pub(in crate::read) enum StoredPiece {
    Memory(Vec<f64>),
    /// Offset in the scratch file.
    Scratch(u64),
}

impl SampleStore {
    /// Returns a store with a scratch file.
    pub(in crate::read) fn scratch() -> Self {
        Self::Scratch(Rc::new(RefCell::new(Scratch {
            pieces_left: MAX_PIECES_IN_MEMORY,
            file: None,
            end: 0,
            bytes: Vec::new(),
        })))
    }

    /// Returns an empty column.
    pub(in crate::read) fn column(&self) -> ColumnNumbers {
        ColumnNumbers::new(self)
    }
}

impl Scratch {
    /// Stores a full piece and empties `numbers`.
    pub(in crate::read) fn store(&mut self, numbers: &mut Vec<f64>) -> io::Result<StoredPiece> {
        if self.pieces_left > 0 {
            self.pieces_left -= 1;
            return Ok(StoredPiece::Memory(std::mem::take(numbers)));
        }
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(tempfile::tempfile_in(folder())?),
        };
        self.bytes.clear();
        self.bytes
            .extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        file.seek(SeekFrom::Start(self.end))?;
        file.write_all(&self.bytes)?;
        let offset = self.end;
        self.end += self.bytes.len() as u64;
        numbers.clear();
        Ok(StoredPiece::Scratch(offset))
    }

    /// Reads the piece of [`PIECE`] numbers at an offset.
    pub(in crate::read) fn load(&mut self, offset: u64) -> io::Result<Vec<f64>> {
        let file = self
            .file
            .as_mut()
            .ok_or_else(|| io::Error::other("the scratch file was never created"))?;
        file.seek(SeekFrom::Start(offset))?;
        self.bytes.resize(8 * PIECE, 0);
        file.read_exact(&mut self.bytes)?;
        Ok(self
            .bytes
            .as_chunks()
            .0
            .iter()
            .map(|bytes| f64::from_le_bytes(*bytes))
            .collect())
    }
}

/// Folder of scratch files. On many systems `/tmp` is in memory.
pub(in crate::read) fn folder() -> PathBuf {
    let configured = std::env::var_os("TMPDIR").map(PathBuf::from);
    let var_tmp = Some(PathBuf::from("/var/tmp")).filter(|folder| folder.is_dir());
    configured.or(var_tmp).unwrap_or_else(std::env::temp_dir)
}
