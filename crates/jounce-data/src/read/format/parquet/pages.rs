//! Checks pages of a Parquet column before the library decodes them, because it panics at some
//! damaged pages.

use parquet::basic::Encoding;
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::{ParquetError, Result};

/// Maximum bytes of the length of a run, seven bits each: enough for 32 bits.
const MAX_LENGTH_BYTES: usize = 5;

/// Checked pages of a column without lists.
pub(super) struct CheckedPages {
    pages: Box<dyn PageReader>,
    /// Bits of a definition level, 0 where no value is missing.
    level_bits: usize,
    has_dictionary: bool,
}

impl CheckedPages {
    /// Returns the pages of a column whose definition levels go up to `max_level`.
    pub fn new(pages: Box<dyn PageReader>, max_level: i16) -> Self {
        let level_bits = (i16::BITS - max_level.max(0).leading_zeros()) as usize;
        Self {
            pages,
            level_bits,
            has_dictionary: false,
        }
    }

    fn check(&mut self, page: &Page) -> Result<()> {
        let buffer = page.buffer();
        let (levels, values) = match page {
            Page::DictionaryPage {
                encoding,
                num_values,
                ..
            } => {
                self.has_dictionary = true;
                // The smallest numbers have four bytes.
                if *num_values as usize > buffer.len() / 4 {
                    return Err(damaged(&format!(
                        "a dictionary of {num_values} numbers has {} bytes",
                        buffer.len()
                    )));
                }
                return check_encoding(*encoding);
            }
            Page::DataPage { .. } if self.level_bits == 0 => (&buffer[..0], &buffer[..]),
            Page::DataPage {
                def_level_encoding: Encoding::RLE,
                ..
            } => {
                let (length, rest) = buffer
                    .split_first_chunk::<4>()
                    .ok_or_else(|| damaged("its levels are truncated"))?;
                rest.split_at_checked(u32::from_le_bytes(*length) as usize)
                    .ok_or_else(|| damaged("its levels are truncated"))?
            }
            Page::DataPage { .. } => return Err(damaged("its levels use an old encoding")),
            Page::DataPageV2 {
                def_levels_byte_len,
                rep_levels_byte_len: 0,
                ..
            } => buffer
                .split_at_checked(*def_levels_byte_len as usize)
                .ok_or_else(|| damaged("its levels are truncated"))?,
            Page::DataPageV2 { .. } => {
                return Err(damaged("it contains lists, but the column has none"));
            }
        };
        check_encoding(page.encoding())?;
        check_runs(levels, self.level_bits, page.num_values() as usize)?;
        if page.encoding() == Encoding::PLAIN {
            return Ok(());
        }
        if !self.has_dictionary {
            return Err(damaged("it refers to a missing dictionary"));
        }
        match values.split_first() {
            Some((bits, runs)) if *bits <= 32 => {
                check_runs(runs, usize::from(*bits), page.num_values() as usize)
            }
            Some((bits, _)) => Err(damaged(&format!(
                "its indices in the dictionary have {bits} bits"
            ))),
            None => Ok(()),
        }
    }
}

/// Refuses rare encodings, whose contents the library does not check.
fn check_encoding(encoding: Encoding) -> Result<()> {
    match encoding {
        Encoding::PLAIN | Encoding::PLAIN_DICTIONARY | Encoding::RLE_DICTIONARY => Ok(()),
        other => Err(ParquetError::General(format!(
            "its numbers are encoded as {other}; write them plain or with a dictionary, for \
            example with pandas.read_parquet(FILE).to_parquet(FILE)"
        ))),
    }
}

/// Checks runs of equal numbers and of packed ones, each preceded by its length, up to `count`
/// numbers.
fn check_runs(mut runs: &[u8], bits: usize, count: usize) -> Result<()> {
    let mut numbers = 0_usize;
    while numbers < count && !runs.is_empty() {
        let bytes = runs
            .iter()
            .position(|byte| *byte < 0x80)
            .filter(|last| *last < MAX_LENGTH_BYTES);
        let last = bytes.ok_or_else(|| damaged("the length of a run is too long"))?;
        let length = runs[..=last]
            .iter()
            .rev()
            .fold(0_u64, |length, byte| length << 7 | u64::from(byte & 0x7f))
            as usize;
        let (body, prefix) = if length % 2 == 1 {
            ((length >> 1) * bits, (length >> 1) * 8)
        } else {
            (bits.div_ceil(8), length >> 1)
        };
        numbers = numbers.saturating_add(prefix);
        runs = runs
            .get((last + 1).saturating_add(body)..)
            .unwrap_or_default();
    }
    Ok(())
}

fn damaged(why: &str) -> ParquetError {
    ParquetError::General(format!("a page is damaged: {why}"))
}

impl Iterator for CheckedPages {
    type Item = Result<Page>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for CheckedPages {
    fn get_next_page(&mut self) -> Result<Option<Page>> {
        let page = self.pages.get_next_page()?;
        page.iter().try_for_each(|page| self.check(page))?;
        Ok(page)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.pages.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.pages.skip_next_page()
    }
}
