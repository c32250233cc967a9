//! Pages of a Parquet column, checked before the library decodes them: it panics at some damaged ones.

use parquet::basic::Encoding;
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::errors::{ParquetError, Result};

/// Bytes of the length of a run, of seven bits each: enough for 32 bits.
const MAX_LENGTH_BYTES: usize = 5;

/// Pages of a column without lists, of which each is checked.
pub(super) struct CheckedPages {
    pages: Box<dyn PageReader>,
    /// Bits of a definition level, 0 where no value is absent.
    level_bits: usize,
    has_dictionary: bool,
}

impl CheckedPages {
    /// Pages of a column whose definition levels go up to `max_level`.
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
                    .ok_or_else(|| damaged("its levels are cut"))?;
                rest.split_at_checked(u32::from_le_bytes(*length) as usize)
                    .ok_or_else(|| damaged("its levels are cut"))?
            }
            Page::DataPage { .. } => return Err(damaged("its levels are of an old encoding")),
            Page::DataPageV2 {
                def_levels_byte_len,
                rep_levels_byte_len: 0,
                ..
            } => buffer
                .split_at_checked(*def_levels_byte_len as usize)
                .ok_or_else(|| damaged("its levels are cut"))?,
            Page::DataPageV2 { .. } => {
                return Err(damaged("it has lists where the column has none"));
            }
        };
        check_encoding(page.encoding())?;
        check_runs(levels, self.level_bits, page.num_values() as usize)?;
        if page.encoding() == Encoding::PLAIN {
            return Ok(());
        }
        if !self.has_dictionary {
            return Err(damaged("it refers to a dictionary that is not there"));
        }
        match values.split_first() {
            Some((bits, runs)) if *bits <= 32 => {
                check_runs(runs, usize::from(*bits), page.num_values() as usize)
            }
            Some((bits, _)) => Err(damaged(&format!(
                "its places in the dictionary have {bits} bits"
            ))),
            None => Ok(()),
        }
    }
}

/// Other encodings are rare, and the library does not check what they hold.
fn check_encoding(encoding: Encoding) -> Result<()> {
    match encoding {
        Encoding::PLAIN | Encoding::PLAIN_DICTIONARY | Encoding::RLE_DICTIONARY => Ok(()),
        other => Err(ParquetError::General(format!(
            "its numbers are encoded as {other}; write them plain or with a dictionary, as pandas.read_parquet(FILE).to_parquet(FILE) does"
        ))),
    }
}

/// Runs of equal numbers and stretches of packed ones, each behind its length, up to so many numbers.
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
        let (inside, held) = if length % 2 == 1 {
            ((length >> 1) * bits, (length >> 1) * 8)
        } else {
            (bits.div_ceil(8), length >> 1)
        };
        numbers = numbers.saturating_add(held);
        runs = runs
            .get((last + 1).saturating_add(inside)..)
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
