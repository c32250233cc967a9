//! Metadata of a TDMS segment: its objects (file, groups, channels), the layout of their raw data,
//! and their properties.

use std::collections::HashMap;
use std::io::Read;

use crate::read::error::Damage;
use crate::read::format::scalar::{Kind, Scalar};

/// Maximum number of bytes of a name or text.
const MAX_TEXT_BYTES: u32 = 1 << 20;
/// Types of values.
const TEXT: u32 = 0x20;
const TIME: u32 = 0x44;
/// Codes for the layout of raw data: no data, as in the previous segment, and two forms of DAQmx.
const NO_DATA_INDEX: u32 = u32::MAX;
const SAME_DATA_INDEX: u32 = 0;
const DAQMX: [u32; 2] = [0x1269, 0x1369];

/// File, group or channel.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Object {
    /// Names of the group and of the channel.
    pub names: Vec<String>,
    /// Properties that are numbers, and those that are texts.
    pub numbers: Vec<(String, f64)>,
    pub texts: Vec<(String, String)>,
    /// True where its values are timestamps.
    pub is_time: bool,
    /// Reason why its values cannot be read.
    pub left_out: Option<&'static str>,
}

/// Layout of the raw data of a channel in a chunk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stored {
    /// Type of the values.
    pub kind: u32,
    count: u64,
    /// Bytes of all texts.
    texts: u64,
}

/// All objects so far, and those with raw data.
#[derive(Debug, Default)]
pub(super) struct Metadata {
    pub objects: Vec<Object>,
    /// Objects with raw data in the current segment, in file order.
    pub active: Vec<(usize, Stored)>,
    numbers: HashMap<String, usize>,
    /// Most recent layout of the raw data of each object.
    last: HashMap<usize, Stored>,
}

impl Stored {
    /// Bytes of a chunk; `None` on overflow.
    pub fn bytes(self) -> Option<u64> {
        let size = match self.kind {
            TEXT => return Some(self.texts),
            1 | 5 | 0x21 => 1,
            2 | 6 => 2,
            3 | 7 | 9 | 0x19 => 4,
            4 | 8 | 10 | 0x1a | 0x08_000c => 8,
            11 | TIME | 0x10_000d => 16,
            _ => return None,
        };
        self.count.checked_mul(size)
    }

    /// True for timestamps.
    pub fn is_time(self) -> bool {
        self.kind == TIME
    }
}

impl Metadata {
    /// Reads the metadata of a segment.
    pub fn read(
        &mut self,
        source: &mut dyn Read,
        little_endian: bool,
        is_new_list: bool,
    ) -> Result<(), Damage> {
        let mut values = Values {
            source,
            little_endian,
        };
        if is_new_list {
            self.active.clear();
        }
        let mut positions: HashMap<usize, usize> = self
            .active
            .iter()
            .enumerate()
            .map(|(positions, (number, _))| (*number, positions))
            .collect();
        for _ in 0..values.word()? {
            let path = values.text()?;
            let next = self.objects.len();
            let number = *self.numbers.entry(path.clone()).or_insert(next);
            if number == next {
                self.objects.push(Object {
                    names: names(&path),
                    ..Object::default()
                });
            }
            if let Some(stored) = self.stored(&mut values, number)? {
                self.last.insert(number, stored);
                let at = *positions.entry(number).or_insert(self.active.len());
                match self.active.get_mut(at) {
                    Some(entry) => entry.1 = stored,
                    None => self.active.push((number, stored)),
                }
            }
            self.properties(&mut values, number)?;
        }
        Ok(())
    }

    /// Reads the layout of the raw data of an object, if it has any.
    fn stored(&mut self, values: &mut Values<'_>, number: usize) -> Result<Option<Stored>, Damage> {
        let object = &mut self.objects[number];
        let index_word = values.word()?;
        let stored = match index_word {
            NO_DATA_INDEX => return Ok(None),
            SAME_DATA_INDEX => {
                let previous = self.last.get(&number).copied();
                previous.ok_or_else(|| {
                    Damage::new(format!(
                        "{} refers to the previous segment, but there is no previous segment",
                        object.names.join("/")
                    ))
                })?
            }
            _ if DAQMX.contains(&index_word) => {
                return Err(Damage::new(
                    "its data are raw values of DAQmx; save it again scaled: in LabVIEW with TDMS \
                    Write, in DIAdem, or in Python by nptdms: \
                    TdmsFile.read(file).as_dataframe().to_parquet('FILE.parquet')",
                ));
            }
            _ => {
                let (kind, dimension, count) = (values.word()?, values.word()?, values.long()?);
                let texts = if kind == TEXT { values.long()? } else { 0 };
                if dimension != 1 {
                    return Err(Damage::new(format!(
                        "{} has {dimension} dimensions; expected 1",
                        object.names.join("/")
                    )));
                }
                Stored { kind, count, texts }
            }
        };
        if stored.bytes().is_none() {
            return Err(Damage::new(format!(
                "{} has {} values of type {}, which is not known",
                object.names.join("/"),
                stored.count,
                stored.kind
            )));
        }
        object.is_time = stored.is_time();
        object.left_out = match stored.kind {
            TEXT => Some("it holds texts"),
            11 => Some("it contains numbers of extended precision; save them as DBL"),
            _ => None,
        };
        Ok(Some(stored))
    }

    fn properties(&mut self, values: &mut Values<'_>, number: usize) -> Result<(), Damage> {
        for _ in 0..values.word()? {
            let name = values.text()?;
            let object = &mut self.objects[number];
            match values.word()? {
                TEXT => {
                    let text = values.text()?;
                    object.texts.retain(|(known, _)| *known != name);
                    object.texts.push((name, text));
                }
                TIME => values.skip(16)?,
                kind => {
                    let stored = Stored {
                        kind,
                        count: 1,
                        texts: 0,
                    };
                    let size = stored.bytes().ok_or_else(|| {
                        Damage::new(format!(
                            "the property {name} is of type {kind}, which is not known"
                        ))
                    })?;
                    let mut bytes = vec![0; size as usize];
                    values.read_exact(&mut bytes)?;
                    if let Some((scalar, 1)) = stored.scalar(values.little_endian) {
                        object.numbers.retain(|(known, _)| *known != name);
                        object.numbers.push((name, scalar.number(&bytes)));
                    }
                }
            }
        }
        Ok(())
    }
}

/// Splits a path `/'group'/'channel'` into names; quotes inside are doubled.
fn names(path: &str) -> Vec<String> {
    let inner = path
        .trim_start_matches('/')
        .trim_start_matches('\'')
        .trim_end_matches('\'');
    if inner.is_empty() {
        Vec::new()
    } else {
        inner
            .split("'/'")
            .map(|name| name.replace("''", "'"))
            .collect()
    }
}

/// Consecutive values of the metadata.
struct Values<'a> {
    source: &'a mut dyn Read,
    little_endian: bool,
}

impl Values<'_> {
    fn read_exact(&mut self, bytes: &mut [u8]) -> Result<(), Damage> {
        self.source.read_exact(bytes).map_err(Damage::cut)
    }

    fn word(&mut self) -> Result<u32, Damage> {
        let mut bytes = [0; 4];
        self.read_exact(&mut bytes)?;
        Ok(if self.little_endian {
            u32::from_le_bytes(bytes)
        } else {
            u32::from_be_bytes(bytes)
        })
    }

    fn long(&mut self) -> Result<u64, Damage> {
        let mut bytes = [0; 8];
        self.read_exact(&mut bytes)?;
        Ok(if self.little_endian {
            u64::from_le_bytes(bytes)
        } else {
            u64::from_be_bytes(bytes)
        })
    }

    fn text(&mut self) -> Result<String, Damage> {
        let length = self.word()?;
        if length > MAX_TEXT_BYTES {
            return Err(Damage::new(format!(
                "a name or text of {length} bytes; the limit is 1 MiB: is the file truncated?"
            )));
        }
        let mut bytes = vec![0; length as usize];
        self.read_exact(&mut bytes)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }

    fn skip(&mut self, bytes: usize) -> Result<(), Damage> {
        self.read_exact(&mut vec![0; bytes])
    }
}

impl Stored {
    /// Storage type of the numbers of a channel, and their count per sample; `None` for other
    /// types.
    pub fn scalar(self, little_endian: bool) -> Option<(Scalar, usize)> {
        let (kind, size, parts) = match self.kind {
            1..=4 => (Kind::Signed, 1 << (self.kind - 1), 1),
            5..=8 => (Kind::Unsigned, 1 << (self.kind - 5), 1),
            9 | 0x19 => (Kind::Float, 4, 1),
            10 | 0x1a => (Kind::Float, 8, 1),
            0x21 => (Kind::Unsigned, 1, 1),
            // Fractions of a second in units of 2^-64 s, and seconds.
            TIME => (Kind::Unsigned, 8, 2),
            0x08_000c => (Kind::Float, 4, 2),
            0x10_000d => (Kind::Float, 8, 2),
            _ => return None,
        };
        Scalar::new(kind, size, little_endian).map(|scalar| (scalar, parts))
    }
}

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn names_are_separated_by_their_quotes() {
        assert_eq!(names("/"), Vec::<String>::new());
        assert_eq!(names("/'run 1'"), ["run 1"]);
        assert_eq!(names("/'run 1'/'it''s a/b'"), ["run 1", "it's a/b"]);
    }
}
