//! Reads a variable of a MAT file, or an element of a struct or cell.

use super::elements::{Elements, MATRIX, Tag};
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::read::format::arrays::{Array, ArrayLayout, MAX_ARRAYS, Path, Tree};

/// Maximum depth of nested structs.
const MAX_DEPTH: usize = 100;
/// Maximum number of characters read from a text.
const MAX_CHARACTERS: u64 = 1 << 16;

/// Classes of arrays.
const CELL: u8 = 1;
const STRUCT: u8 = 2;
const OBJECT: u8 = 3;
const TEXT: u8 = 4;
const SPARSE: u8 = 5;
/// Numbers of 1 to 8 bytes.
const NUMBERS: std::ops::RangeInclusive<u8> = 6..=15;

/// Reads the contents of a matrix; returns its text, if it is one.
pub(super) fn read(
    elements: &mut Elements<'_>,
    path: &Path,
    depth: usize,
    store: &SampleStore,
    tree: &mut Tree,
) -> Result<Option<String>, Damage> {
    if depth > MAX_DEPTH {
        return Err(Damage::new(format!(
            "{path} is nested in more than {MAX_DEPTH} structs and cells"
        )));
    }
    if tree.arrays.len() >= MAX_ARRAYS {
        return Err(Damage::new(format!(
            "it contains more than {MAX_ARRAYS} arrays"
        )));
    }
    let Some((class, complex)) = class(elements)? else {
        return Ok(None);
    };
    let is_known = matches!(class, CELL | STRUCT | OBJECT | TEXT) || NUMBERS.contains(&class);
    let dimensions = if is_known {
        dimensions(elements)?
    } else {
        Vec::new()
    };
    let own_name = name(elements)?;
    // Only variables have their own name; the unnamed one contains objects in a private format.
    if depth == 0 && own_name.is_empty() && is_known {
        return Ok(None);
    }
    let path = if depth == 0 { &path.to(own_name) } else { path };
    let context = ArrayContext {
        path,
        depth,
        dimensions,
        store,
    };
    match class {
        CELL => context.cell(elements, tree)?,
        STRUCT => context.fields(elements, tree)?,
        OBJECT => {
            name(elements)?;
            context.fields(elements, tree)?;
        }
        TEXT => return context.text(elements, tree),
        _ if NUMBERS.contains(&class) => context.numbers(elements, complex, tree)?,
        SPARSE => tree.skip(format!(
            "{path} is a sparse matrix and was left out; save full({path})"
        )),
        _ => tree.skip(
            "an object (timeseries, table, function) was left out; save its numbers, for example \
            t = x.Time; v = x.Data; save('file.mat', 't', 'v', '-v7')",
        ),
    }
    Ok(None)
}

/// Returns the class of an array and true if it is complex; `None` for an empty matrix without
/// header.
fn class(elements: &mut Elements<'_>) -> Result<Option<(u8, bool)>, Damage> {
    if !elements.may_hold(1) {
        return Ok(None);
    }
    let tag = elements.tag()?;
    let little_endian = elements.little_endian;
    let flags = elements.bytes(&tag)?;
    let Some([a, b, c, d]) = flags.first_chunk::<4>().copied() else {
        return Err(Damage::new("the flags of an array are missing"));
    };
    let word = if little_endian {
        u32::from_le_bytes([a, b, c, d])
    } else {
        u32::from_be_bytes([a, b, c, d])
    };
    Ok(Some((word as u8, word & 0x800 != 0)))
}

fn dimensions(elements: &mut Elements<'_>) -> Result<Vec<u64>, Damage> {
    let tag = elements.tag()?;
    let mut result = Vec::new();
    let count = tag.length / 4;
    if count > 32 {
        return Err(Damage::new(format!(
            "an array has {count} dimensions; the limit is 32"
        )));
    }
    elements.numbers(&tag, count, |_, size| {
        result.push(size);
        Ok(())
    })?;
    let is_invalid = |size: &&f64| !(**size >= 0.0 && size.fract() == 0.0);
    match result.iter().find(is_invalid) {
        Some(size) => Err(Damage::new(format!(
            "a side has {size} numbers; it must be a whole number, 0 or more"
        ))),
        None => Ok(result.iter().map(|size| *size as u64).collect()),
    }
}

fn name(elements: &mut Elements<'_>) -> Result<String, Damage> {
    let tag = elements.tag()?;
    Ok(latin(&elements.bytes(&tag)?))
}

fn latin(bytes: &[u8]) -> String {
    let text = bytes.split(|b| *b == 0).next().unwrap_or_default();
    std::str::from_utf8(text).map_or_else(
        |_| text.iter().map(|b| char::from(*b)).collect(),
        str::to_owned,
    )
}

/// Contents after the header of an array.
struct ArrayContext<'a> {
    path: &'a Path,
    depth: usize,
    dimensions: Vec<u64>,
    store: &'a SampleStore,
}

impl ArrayContext<'_> {
    /// Returns the number of elements of the array.
    fn count(&self, elements: &Elements<'_>, per_element: u64) -> Result<u64, Damage> {
        let count = self
            .dimensions
            .iter()
            .try_fold(per_element, |product, size| product.checked_mul(*size));
        let possible_count = count.filter(|count| elements.may_hold(*count));
        let path = self.path;
        possible_count.ok_or_else(|| {
            Damage::new(format!(
                "{path} has the size {:?}, but fewer elements follow: is the file truncated?",
                self.dimensions
            ))
        })
    }

    fn child(
        &self,
        elements: &mut Elements<'_>,
        path: &Path,
        tree: &mut Tree,
    ) -> Result<Option<String>, Damage> {
        let tag = elements.tag()?;
        if tag.kind != MATRIX {
            return Err(Damage::new(format!(
                "{path}: expected an array, not data of type {}",
                tag.kind
            )));
        }
        let bytes_after = elements.enter(&tag);
        let text = read(elements, path, self.depth + 1, self.store, tree)?;
        elements.leave(&tag, bytes_after)?;
        Ok(text)
    }

    /// Reads a cell array. Cells are named by their number from 1; a cell array of texts becomes a
    /// list.
    fn cell(&self, elements: &mut Elements<'_>, tree: &mut Tree) -> Result<(), Damage> {
        let mut texts = Vec::new();
        let count = self.count(elements, 1)?;
        for k in 1..=count {
            texts.extend(self.child(elements, &self.path.to(format!("{{{k}}}")), tree)?);
        }
        if texts.len() as u64 == count {
            tree.text(self.path, texts);
        }
        Ok(())
    }

    /// Reads a struct, or a struct array with consecutive fields.
    fn fields(&self, elements: &mut Elements<'_>, tree: &mut Tree) -> Result<(), Damage> {
        let tag = elements.tag()?;
        let little_endian = elements.little_endian;
        let length = elements.bytes(&tag)?;
        let width = length.first_chunk::<4>().map(|b| {
            if little_endian {
                u32::from_le_bytes(*b)
            } else {
                u32::from_be_bytes(*b)
            }
        });
        let Some(width @ 1..) = width else {
            return Err(Damage::new(format!(
                "{}: the length of its field names is missing",
                self.path
            )));
        };
        let tag = elements.tag()?;
        let names: Vec<String> = elements
            .bytes(&tag)?
            .chunks(width as usize)
            .map(latin)
            .collect();
        let has_several = self.dimensions.iter().any(|size| *size > 1);
        self.count(elements, names.len() as u64)?;
        for k in 1..=self.count(elements, 1)? {
            let parent = if has_several {
                self.numbered(k)
            } else {
                self.path.clone()
            };
            for name in &names {
                self.child(elements, &parent.to(name), tree)?;
            }
        }
        Ok(())
    }

    /// `data.signal(2)`
    fn numbered(&self, k: u64) -> Path {
        let mut path = self.path.clone();
        if let Some(last) = path.0.last_mut() {
            last.push_str(&format!("({k})"));
        }
        path
    }

    fn text(&self, elements: &mut Elements<'_>, tree: &mut Tree) -> Result<Option<String>, Damage> {
        let tag = elements.tag()?;
        let rows = self.dimensions.first().copied().unwrap_or(0);
        let Some(scalar) = tag
            .scalar(elements.little_endian)
            .filter(|_| tag.length <= MAX_CHARACTERS && rows > 0)
        else {
            return Ok(None);
        };
        let bytes = elements.bytes(&tag)?;
        // UTF-8 characters may be longer than one byte; the text then has one row.
        let utf8 = std::str::from_utf8(&bytes)
            .ok()
            .filter(|_| scalar.size == 1 && rows == 1);
        let units: Vec<u16> = bytes
            .chunks_exact(scalar.size)
            .map(|unit| scalar.number(unit) as u16)
            .collect();
        let row = |row: usize| {
            String::from_utf16_lossy(
                &units
                    .iter()
                    .skip(row)
                    .step_by(rows as usize)
                    .copied()
                    .collect::<Vec<u16>>(),
            )
        };
        let rows = usize::try_from(rows).unwrap_or(0).min(units.len());
        let texts: Vec<String> = utf8.map_or_else(
            || (0..rows).map(row).collect(),
            |text| vec![text.to_owned()],
        );
        let one = if let [text] = &texts[..] {
            Some(text.clone())
        } else {
            None
        };
        tree.text(self.path, texts);
        Ok(one)
    }

    fn numbers(
        &self,
        elements: &mut Elements<'_>,
        complex: bool,
        tree: &mut Tree,
    ) -> Result<(), Damage> {
        let Some(layout) = ArrayLayout::new(&self.dimensions, false) else {
            tree.skip(format!(
                "the array {} of size {:?} is not a series of numbers",
                self.path, self.dimensions
            ));
            return Ok(());
        };
        if layout.total() == 0 {
            return Ok(());
        }
        let read_part = |elements: &mut Elements<'_>| {
            let tag: Tag = elements.tag()?;
            let size = tag
                .scalar(elements.little_endian)
                .map_or(1, |scalar| scalar.size as u64);
            if tag.length / size != layout.total() {
                let (path, expected, stored_count) = (self.path, layout.total(), tag.length / size);
                return Err(Damage::new(format!(
                    "{path} has {expected} numbers by its size, but {stored_count} follow: is the file \
                    truncated?"
                )));
            }
            let mut series = layout.series(self.store)?;
            elements.numbers(&tag, layout.total(), |number, x| {
                layout.push(&mut series, number, x)
            })?;
            Ok(series)
        };
        let series = read_part(elements)?;
        let imaginary = if complex {
            Some(read_part(elements)?)
        } else {
            None
        };
        let path = self.path.clone();
        tree.arrays.push(Array {
            path,
            unit: String::new(),
            series,
            imaginary,
            labels: layout.labels(),
        });
        Ok(())
    }
}
