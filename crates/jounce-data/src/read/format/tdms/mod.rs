//! TDMS of LabVIEW and DIAdem: channels in groups, in any number of segments.
//!
//! Source: National Instruments, "TDMS File Format Internal Structure". Raw DAQmx data and text
//! channels are left out. The existing crates hold the complete file in memory.
mod objects;

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, Read, Seek as _, SeekFrom};
use std::path::Path as FilePath;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::format::arrays::{Array, Path, Tree, into_found};
use crate::read::format::scalar::Scalar;
use crate::recording::{Issue, IssueKind, IssuePlace, PIECE, Series};
use objects::{Metadata, Object, Stored};

pub(in crate::read) const BEGIN: &[u8] = b"TDSm";
/// Bytes before the metadata of a segment.
const LEAD_IN: u64 = 28;
/// Flags of a segment.
const HAS_METADATA: u32 = 1 << 1;
const IS_NEW_LIST: u32 = 1 << 2;
const HAS_DATA: u32 = 1 << 3;
const IS_INTERLEAVED: u32 = 1 << 5;
const IS_BIG_ENDIAN: u32 = 1 << 6;
/// Length of a segment that was not closed.
const UNFINISHED_SEGMENT: u64 = u64::MAX;

/// Reader of consecutive segments.
struct Reader<'a> {
    source: BufReader<File>,
    size: u64,
    metadata: Metadata,
    /// Numbers of each channel, real and imaginary parts.
    channels: HashMap<usize, [ColumnNumbers; 2]>,
    store: &'a SampleStore,
    issues: Vec<Issue>,
}

pub(in crate::read) fn read(
    path: &FilePath,
    store: &SampleStore,
) -> Result<FormatContents, Damage> {
    let file = File::open(path).map_err(Damage::cut)?;
    let size = file.metadata().map_err(Damage::cut)?.len();
    let source = BufReader::with_capacity(1 << 16, file);
    let mut reader = Reader {
        source,
        size,
        metadata: Metadata::default(),
        channels: HashMap::new(),
        store,
        issues: Vec::new(),
    };
    let mut at = 0;
    while at < size {
        at = reader.segment(at).map_err(|damage| damage.at_byte(at))?;
    }
    into_found(reader.into_tree()?)
}

impl Reader<'_> {
    /// Reads the segment at an offset; returns the offset of the next one.
    fn segment(&mut self, at: u64) -> Result<u64, Damage> {
        self.source.seek(SeekFrom::Start(at)).map_err(Damage::cut)?;
        let mut lead = [0; LEAD_IN as usize];
        self.source.read_exact(&mut lead).map_err(Damage::cut)?;
        if !lead.starts_with(BEGIN) {
            return Err(Damage::new(format!(
                "expected a segment, which begins with TDSm, not with {:?}",
                String::from_utf8_lossy(&lead[..4])
            )));
        }
        let word = |from: usize| u64::from_le_bytes(std::array::from_fn(|k| lead[from + k]));
        let (flags, next, data) = (word(4) as u32, word(12), word(20));
        let remaining = self.size - at - LEAD_IN;
        let length = if next == UNFINISHED_SEGMENT {
            remaining
        } else {
            next
        };
        if length > remaining || data > length && data != UNFINISHED_SEGMENT {
            return Err(Damage::new(format!(
                "expected a segment of {length} bytes with data from {data}, but {remaining} bytes \
                follow: is the file truncated?"
            )));
        }
        let little_endian = flags & IS_BIG_ENDIAN == 0;
        if flags & HAS_METADATA != 0 {
            let bytes = data.min(length);
            let mut source = (&mut self.source).take(bytes);
            self.metadata
                .read(&mut source, little_endian, flags & IS_NEW_LIST != 0)?;
        }
        if next == UNFINISHED_SEGMENT {
            let message =
                "the last segment was not closed, because the program that wrote it ended \
                early; the existing data are read"
                    .to_owned();
            self.issues.push(Issue::new(
                IssueKind::HeaderDisagrees,
                1,
                Some(IssuePlace::Byte(at as usize)),
                message,
            ));
        }
        if flags & HAS_DATA != 0 && data < length {
            self.source
                .seek(SeekFrom::Start(at + LEAD_IN + data))
                .map_err(Damage::cut)?;
            self.data(length - data, flags & IS_INTERLEAVED != 0, little_endian)?;
        }
        Ok(at + LEAD_IN + length)
    }

    /// Reads chunks with a given count of numbers of each channel, one channel after the other.
    fn data(&mut self, bytes: u64, interleaved: bool, little_endian: bool) -> Result<(), Damage> {
        let active = self.metadata.active.clone();
        let chunk: Option<u64> = active
            .iter()
            .try_fold(0_u64, |sum, (_, stored)| sum.checked_add(stored.bytes()?));
        let Some(chunk) = chunk.filter(|chunk| *chunk > 0) else {
            return Ok(());
        };
        if interleaved {
            return self.interleaved(&active, bytes, little_endian);
        }
        let mut remaining = bytes;
        while remaining > 0 {
            // The last chunk of an open segment may be truncated, between its channels or inside
            // one.
            let mut chunk_bytes = remaining.min(chunk);
            remaining -= chunk_bytes;
            for (channel, stored) in &active {
                let expected = stored.bytes().unwrap_or(0);
                let available = expected.min(chunk_bytes);
                chunk_bytes -= available;
                self.numbers(*channel, *stored, available, little_endian)?;
            }
        }
        Ok(())
    }

    /// Reads the numbers of a channel from `bytes` bytes.
    fn numbers(
        &mut self,
        channel: usize,
        stored: Stored,
        bytes: u64,
        little_endian: bool,
    ) -> Result<(), Damage> {
        let Some((scalar, parts)) = stored.scalar(little_endian) else {
            std::io::copy(&mut (&mut self.source).take(bytes), &mut std::io::sink())
                .map_err(Damage::cut)?;
            return Ok(());
        };
        let width = scalar.size as u64 * parts as u64;
        let store = self.store;
        let numbers = self
            .channels
            .entry(channel)
            .or_insert_with(|| [store.column(), store.column()]);
        // Big-endian times begin with the seconds.
        let mut part = usize::from(stored.is_time() && !little_endian);
        scalar.each(&mut self.source, bytes / width * parts as u64, |x| {
            let result = numbers[part].push(x);
            part = (part + 1) % parts;
            result
        })?;
        std::io::copy(
            &mut (&mut self.source).take(bytes % width),
            &mut std::io::sink(),
        )
        .map_err(Damage::cut)?;
        Ok(())
    }

    /// Reads interleaved data, one number of each channel in turn.
    fn interleaved(
        &mut self,
        active: &[(usize, Stored)],
        bytes: u64,
        little_endian: bool,
    ) -> Result<(), Damage> {
        let scalars: Vec<Option<(Scalar, usize)>> = active
            .iter()
            .map(|(_, stored)| stored.scalar(little_endian))
            .collect();
        let row: u64 = scalars
            .iter()
            .flatten()
            .map(|(scalar, parts)| (scalar.size * parts) as u64)
            .sum();
        if row == 0 || scalars.contains(&None) {
            return Err(Damage::new(
                "numeric channels are interleaved with others; save it again in DIAdem or LabVIEW",
            ));
        }
        for _ in 0..bytes / row {
            for (channel, stored) in active {
                let width = stored
                    .scalar(little_endian)
                    .map_or(0, |(scalar, parts)| (scalar.size * parts) as u64);
                self.numbers(*channel, *stored, width, little_endian)?;
            }
        }
        Ok(())
    }

    /// Returns the channels with their properties.
    fn into_tree(mut self) -> Result<Tree, Damage> {
        let mut tree = Tree::default();
        tree.issues.append(&mut self.issues);
        let groups: std::collections::BTreeSet<&str> = self
            .metadata
            .objects
            .iter()
            .filter_map(|object| object.names.first().map(String::as_str))
            .collect();
        let one_group = groups.len() < 2;
        for (number, object) in self.metadata.objects.iter().enumerate() {
            let names = if one_group {
                object.names.get(1..).unwrap_or_default()
            } else {
                &object.names
            };
            let path = Path(names.to_vec());
            properties(object, &path, self.store, &mut tree)?;
            let Some([real, imaginary]) = self.channels.remove(&number) else {
                if let Some(why) = object.left_out {
                    tree.skip(format!("{path} was left out: {why}"));
                }
                continue;
            };
            let unit = object
                .texts
                .iter()
                .find(|(name, _)| name == "unit_string")
                .map_or_else(String::new, |(_, unit)| unit.clone());
            let (real, unit, imaginary) = if object.is_time {
                (
                    seconds_since_first(&real, &imaginary, self.store)?,
                    "s".to_owned(),
                    None,
                )
            } else {
                (real, unit, (imaginary.count() > 0).then(|| vec![imaginary]))
            };
            tree.arrays.push(Array {
                path,
                unit,
                series: vec![real],
                imaginary,
                labels: Vec::new(),
            });
        }
        Ok(tree)
    }
}

/// Converts timestamps, in units of 2^-64 s and seconds, to seconds since the first one.
fn seconds_since_first(
    parts: &ColumnNumbers,
    seconds: &ColumnNumbers,
    store: &SampleStore,
) -> std::io::Result<ColumnNumbers> {
    let mut elapsed = store.column();
    let first = (
        parts.first_and_last()?.map_or(0.0, |(first, _)| first),
        seconds.first_and_last()?.map_or(0.0, |(first, _)| first),
    );
    for index in 0..seconds.count().div_ceil(PIECE) {
        let (parts, seconds) = (parts.piece(index)?, seconds.piece(index)?);
        for (part, second) in parts.iter().zip(seconds.iter()) {
            elapsed.push((second - first.1) + (part - first.0) / 2_f64.powi(64))?;
        }
    }
    Ok(elapsed)
}

/// Reads numbers and texts stored as properties of an object.
fn properties(
    object: &Object,
    path: &Path,
    store: &SampleStore,
    tree: &mut Tree,
) -> Result<(), Damage> {
    for (name, number) in &object.numbers {
        let mut numbers = store.column();
        numbers.push(*number)?;
        tree.arrays.push(Array {
            path: path.to(name),
            unit: String::new(),
            series: vec![numbers],
            imaginary: None,
            labels: Vec::new(),
        });
    }
    for (name, text) in &object.texts {
        tree.text(&path.to(name), vec![text.clone()]);
    }
    Ok(())
}
