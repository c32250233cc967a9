//! WAV: samples of sound cards and acoustic analysers, integer or floating point, any number of
//! channels.
//!
//! Source: IBM and Microsoft, "Multimedia Programming Interface and Data Specifications 1.0", 1991;
//! EBU Tech 3306 for files beyond 4 GiB (RF64). The crate `hound` does not read 64-bit samples,
//! which SciPy writes.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek as _, SeekFrom};
use std::path::Path;

use super::scalar::{Kind, Scalar};
use crate::read::column::raw::{Raw, RawColumn, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::recording::{Issue, IssueKind, IssuePlace, Over};

/// Format codes: integers, floating point, and an extension with the code further on.
const INTEGER_FORMAT: u16 = 1;
const FLOAT_FORMAT: u16 = 3;
const EXTENDED_FORMAT: u16 = 0xfffe;
/// Maximum length of a format chunk, bytes.
const MAX_FORMAT_BYTES: usize = 40;

/// Format of the samples.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Format {
    scalar: Scalar,
    channels: u16,
    rate_hz: u32,
    /// Stored value of 0.
    zero: f64,
}

pub(in crate::read) fn is_wav(head: &[u8]) -> bool {
    (head.starts_with(b"RIFF") || head.starts_with(b"RF64")) && head.get(8..12) == Some(b"WAVE")
}

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let file = File::open(path).map_err(Damage::cut)?;
    let size = file.metadata().map_err(Damage::cut)?.len();
    let mut source = BufReader::with_capacity(1 << 16, file);
    source.seek(SeekFrom::Start(12)).map_err(Damage::cut)?;
    let (mut at, mut format, mut long) = (12_u64, None, None);
    loop {
        let mut head = [0; 8];
        source
            .read_exact(&mut head)
            .map_err(|fault| Damage::cut(fault).at_byte(at))?;
        let [a, b, c, d, lengths @ ..] = head;
        let length = u64::from(u32::from_le_bytes(lengths));
        at += 8;
        match &[a, b, c, d] {
            b"ds64" => {
                let mut sizes = [0; 16];
                source
                    .read_exact(&mut sizes)
                    .map_err(|fault| Damage::cut(fault).at_byte(at))?;
                long = sizes
                    .last_chunk::<8>()
                    .map(|bytes| u64::from_le_bytes(*bytes));
            }
            b"fmt " => {
                format =
                    Some(Format::read(&mut source, length).map_err(|damage| damage.at_byte(at))?)
            }
            b"data" => {
                let Some(format) = format else {
                    return Err(Damage::new(
                        "the format of the samples is not described before them",
                    )
                    .at_byte(at));
                };
                let length = if length == u64::from(u32::MAX) {
                    long.unwrap_or(length)
                } else {
                    length
                };
                return samples(&mut source, format, length, size - at, at, store);
            }
            _ => {}
        }
        at = at.saturating_add(length.next_multiple_of(2));
        source
            .seek(SeekFrom::Start(at))
            .map_err(|fault| Damage::cut(fault).at_byte(at))?;
    }
}

impl Format {
    fn read(source: &mut impl Read, length: u64) -> Result<Self, Damage> {
        let mut bytes = Vec::new();
        source
            .take(length.min(MAX_FORMAT_BYTES as u64))
            .read_to_end(&mut bytes)
            .map_err(Damage::cut)?;
        if bytes.len() < 16 {
            return Err(Damage::new(
                "the description of the samples is incomplete: is the file truncated?",
            ));
        }
        let half = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        let code = if half(0) == EXTENDED_FORMAT && bytes.len() >= 26 {
            half(24)
        } else {
            half(0)
        };
        let (channels, rate_hz) = (
            half(2),
            u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]),
        );
        let (block, bits) = (half(12), half(14));
        let size = usize::from(block)
            .checked_div(usize::from(channels))
            .unwrap_or_default();
        let kind = match code {
            INTEGER_FORMAT if size == 1 => Some(Kind::Unsigned),
            INTEGER_FORMAT => Some(Kind::Signed),
            FLOAT_FORMAT => Some(Kind::Float),
            _ => None,
        };
        let scalar = kind.and_then(|kind| Scalar::new(kind, size, true));
        match scalar {
            Some(scalar)
                if channels > 0
                    && rate_hz > 0
                    && size * usize::from(channels) == usize::from(block) =>
            {
                Ok(Self {
                    scalar,
                    channels,
                    rate_hz,
                    zero: if size == 1 { 128.0 } else { 0.0 },
                })
            }
            _ => Err(Damage::new(format!(
                "{channels} channels of {bits} bits of kind {code} at {rate_hz} Hz: whole numbers of 8 to 64 bits and floating point of 32 and 64 \
                 bits can be read; save it as one of these, for example with Audacity"
            ))),
        }
    }
}

/// Reads the interleaved samples of all channels.
fn samples(
    source: &mut impl Read,
    format: Format,
    length: u64,
    remaining: u64,
    at: u64,
    store: &SampleStore,
) -> Result<FormatContents, Damage> {
    let channels = u64::from(format.channels);
    let block = format.scalar.size as u64 * channels;
    let (stored_count, issue) = sample_count(length, remaining, at, block)?;
    let mut series: Vec<_> = (0..channels).map(|_| store.column()).collect();
    if !series.iter_mut().all(|numbers| {
        usize::try_from(stored_count).is_ok_and(|stored_count| numbers.expect(stored_count))
    }) {
        return Err(Damage::new(format!(
            "{stored_count} samples of {channels} channels do not fit into memory"
        )));
    }
    let mut channel = 0;
    format
        .scalar
        .each(source as &mut dyn Read, stored_count * channels, |x| {
            let numbers: io::Result<()> = series[channel].push(x - format.zero);
            channel = (channel + 1) % series.len();
            numbers
        })?;
    let columns = series
        .into_iter()
        .enumerate()
        .map(|(k, values)| RawColumn::new(&format!("channel {}", k + 1), "", values))
        .collect();
    let stamps = TimeStamps::Even {
        start: 0.0,
        step: 1.0 / f64::from(format.rate_hz),
    };
    Ok(Raw {
        title: String::new(),
        over: Over::Time,
        stamps,
        columns,
        issues: issue.into_iter().collect(),
    }
    .into())
}

/// Number of samples of each channel, with an issue if it comes from the size of the file.
fn sample_count(
    length: u64,
    remaining: u64,
    at: u64,
    block: u64,
) -> Result<(u64, Option<Issue>), Damage> {
    // Recorders that lose power leave a length of 0 or the maximum.
    if length > remaining && length < u64::from(u32::MAX) - 1024 {
        let why = format!(
            "expected {length} bytes of samples, but {remaining} follow: is the file \
            truncated?"
        );
        return Err(Damage::new(why).at_byte(at));
    }
    if length != 0 && length <= remaining {
        return Ok((length / block, None));
    }
    let count = remaining / block;
    let message = format!(
        "the header gives no length; all {count} samples up to the end of the file are read"
    );
    let position = IssuePlace::Byte(usize::try_from(at).unwrap_or(usize::MAX));
    let issue = Issue::new(IssueKind::HeaderDisagrees, 1, Some(position), message);
    Ok((count, Some(issue)))
}
