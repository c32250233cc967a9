//! Elements of a MAT file: a tag with type and length, the data, and zero padding to a multiple of
//! eight bytes.

use std::io::{self, Read};

use crate::read::error::Damage;
use crate::read::format::scalar::{Kind, Scalar};

pub(super) const MATRIX: u32 = 14;
pub(super) const COMPRESSED: u32 = 15;
/// Types of text with 1 byte per character, and with 2.
pub(super) const UTF8: u32 = 16;
pub(super) const UTF16: u32 = 17;

/// Maximum number of bytes of a name or text.
const MAX_TEXT_BYTES: u64 = 1 << 20;

/// Tag of an element.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tag {
    pub kind: u32,
    /// Bytes of the data.
    pub length: u64,
    /// Data stored in the tag, at most four bytes.
    inline: Option<[u8; 4]>,
}

impl Tag {
    /// Reads the tag of a top-level element, which is never a small one.
    pub fn read(source: &mut dyn Read, little_endian: bool) -> Result<Self, Damage> {
        let mut words = [[0; 4]; 2];
        for word in &mut words {
            source.read_exact(word).map_err(Damage::cut)?;
        }
        let [kind, length] = words.map(|word| word_value(word, little_endian));
        Ok(Self {
            kind,
            length: u64::from(length),
            inline: None,
        })
    }

    /// Storage type of the numbers; `None` for other data.
    pub fn scalar(&self, little_endian: bool) -> Option<Scalar> {
        let (kind, size) = match self.kind {
            1 => (Kind::Signed, 1),
            2 | UTF8 => (Kind::Unsigned, 1),
            3 => (Kind::Signed, 2),
            4 | UTF16 => (Kind::Unsigned, 2),
            5 => (Kind::Signed, 4),
            6 => (Kind::Unsigned, 4),
            7 => (Kind::Float, 4),
            9 => (Kind::Float, 8),
            12 => (Kind::Signed, 8),
            13 => (Kind::Unsigned, 8),
            _ => return None,
        };
        Scalar::new(kind, size, little_endian)
    }
}

fn word_value(bytes: [u8; 4], little_endian: bool) -> u32 {
    if little_endian {
        u32::from_le_bytes(bytes)
    } else {
        u32::from_be_bytes(bytes)
    }
}

/// Consecutive elements inside a matrix.
pub(super) struct Elements<'a> {
    source: &'a mut dyn Read,
    /// Remaining bytes of the matrix.
    remaining: u64,
    pub little_endian: bool,
}

impl<'a> Elements<'a> {
    pub fn new(source: &'a mut dyn Read, length: u64, little_endian: bool) -> Self {
        Self {
            source,
            remaining: length,
            little_endian,
        }
    }

    /// Reads the next tag; its data must lie inside the matrix.
    pub fn tag(&mut self) -> Result<Tag, Damage> {
        let mut word = [0; 4];
        self.read_exact(&mut word)?;
        let first = word_value(word, self.little_endian);
        self.read_exact(&mut word)?;
        // A length in the upper half marks a small element.
        if first >> 16 != 0 {
            let (kind, length) = (first & 0xffff, u64::from(first >> 16));
            return if length <= 4 {
                Ok(Tag {
                    kind,
                    length,
                    inline: Some(word),
                })
            } else {
                Err(truncated(length, 4))
            };
        }
        let length = u64::from(word_value(word, self.little_endian));
        if length > self.remaining {
            return Err(truncated(length, self.remaining));
        }
        Ok(Tag {
            kind: first,
            length,
            inline: None,
        })
    }

    /// Reads the data of a name or text.
    pub fn bytes(&mut self, tag: &Tag) -> Result<Vec<u8>, Damage> {
        if let Some(inline) = tag.inline {
            return Ok(inline[..tag.length.min(4) as usize].to_vec());
        }
        if tag.length > MAX_TEXT_BYTES {
            return Err(Damage::new(format!(
                "a name or text of {} bytes; the limit is 1 MiB",
                tag.length
            )));
        }
        let mut bytes = vec![0; tag.length as usize];
        self.read_exact(&mut bytes)?;
        self.pad(tag)?;
        Ok(bytes)
    }

    /// Passes each number to `callback`; the count must match.
    pub fn numbers(
        &mut self,
        tag: &Tag,
        expected: u64,
        mut callback: impl FnMut(u64, f64) -> io::Result<()>,
    ) -> Result<(), Damage> {
        let scalar = tag.scalar(self.little_endian).ok_or_else(|| {
            Damage::new(format!("expected numbers, not data of type {}", tag.kind))
        })?;
        let stored_count = tag.length / scalar.size as u64;
        if stored_count != expected {
            return Err(Damage::new(format!(
                "expected {expected} numbers, but {stored_count} follow: is the file truncated?"
            )));
        }
        let mut number = 0;
        let mut with_index = |x| {
            number += 1;
            callback(number - 1, x)
        };
        if let Some(inline) = tag.inline {
            return scalar.each(&mut inline.as_slice(), expected, &mut with_index);
        }
        let bytes = expected * scalar.size as u64;
        scalar.each(&mut self.source, expected, &mut with_index)?;
        self.remaining = self.remaining.saturating_sub(bytes);
        self.pad(tag)
    }

    /// Enters a nested matrix; returns the value that [`Self::leave`] needs.
    pub fn enter(&mut self, tag: &Tag) -> u64 {
        let bytes_after = self.remaining - tag.length.min(self.remaining);
        self.remaining -= bytes_after;
        bytes_after
    }

    /// Leaves a matrix and skips its unread part.
    pub fn leave(&mut self, tag: &Tag, bytes_after: u64) -> Result<(), Damage> {
        self.skip_rest()?;
        self.remaining = bytes_after;
        self.pad(tag)
    }

    /// Skips the remaining elements.
    pub fn skip_rest(&mut self) -> Result<(), Damage> {
        self.skip(self.remaining)
    }

    /// True where so many elements of at least eight bytes may follow.
    pub fn may_hold(&self, elements: u64) -> bool {
        elements
            .checked_mul(8)
            .is_some_and(|bytes| bytes <= self.remaining)
    }

    fn pad(&mut self, tag: &Tag) -> Result<(), Damage> {
        let padding = if tag.inline.is_some() {
            0
        } else {
            tag.length.next_multiple_of(8) - tag.length
        };
        self.skip(padding.min(self.remaining))
    }

    fn skip(&mut self, bytes: u64) -> Result<(), Damage> {
        let skipped =
            io::copy(&mut self.source.take(bytes), &mut io::sink()).map_err(Damage::cut)?;
        self.remaining = self.remaining.saturating_sub(bytes);
        if skipped < bytes {
            Err(Damage::cut(io::ErrorKind::UnexpectedEof.into()))
        } else {
            Ok(())
        }
    }

    fn read_exact(&mut self, bytes: &mut [u8]) -> Result<(), Damage> {
        let expected = bytes.len() as u64;
        if expected > self.remaining {
            return Err(truncated(expected, self.remaining));
        }
        self.source.read_exact(bytes).map_err(Damage::cut)?;
        self.remaining -= expected;
        Ok(())
    }
}

fn truncated(expected: u64, remaining: u64) -> Damage {
    Damage::new(format!(
        "expected {expected} bytes inside an array that ends after {remaining}: is the file truncated?"
    ))
}
