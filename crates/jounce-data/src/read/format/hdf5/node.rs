//! Collects groups and arrays of an HDF5 file in a tree.

use std::collections::HashMap;

use hdf5_pure::{AttrValue, Dataset, Datatype, Group, Object, ReferenceType};

use super::matlab::{self, Class};
use super::stored::Stored;
use super::{checked, hdf5_error};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::read::format::arrays::{Array, ArrayLayout, MAX_ARRAYS, Path, Tree};

/// Maximum depth of nested groups.
const MAX_DEPTH: usize = 60;
/// Bytes decoded at once, for an array of several rows.
const BYTES_AT_ONCE: u64 = 4 << 20;
/// Maximum number of characters read from a text.
const MAX_CHARACTERS: u64 = 1 << 16;

/// Traversal state.
pub(super) struct Walker<'a> {
    pub store: &'a SampleStore,
    /// Bytes of the file.
    pub size: u64,
    pub tree: Tree,
    /// Number of groups and arrays visited; limits cyclic references.
    pub visited_count: usize,
}

impl Walker<'_> {
    pub fn group(&mut self, group: &Group, path: &Path) -> Result<(), Damage> {
        if path.0.len() > MAX_DEPTH {
            return Err(Damage::new(format!(
                "{path} is nested in more than {MAX_DEPTH} groups"
            )));
        }
        self.count_visit()?;
        self.attributes(&group.attrs().unwrap_or_default(), path)?;
        for name in group.datasets().map_err(|fault| hdf5_error(&fault))? {
            match group.dataset(&name) {
                Ok(dataset) => self.dataset(&dataset, &path.to(&name))?,
                Err(fault) => self
                    .tree
                    .skip(format!("{} was left out: {fault}", path.to(&name))),
            }
        }
        for name in group.groups().map_err(|fault| hdf5_error(&fault))? {
            // Contents of cells, and objects of MATLAB.
            if !(path.0.is_empty() && name.starts_with('#')) {
                self.group(
                    &group.group(&name).map_err(|fault| hdf5_error(&fault))?,
                    &path.to(&name),
                )?;
            }
        }
        Ok(())
    }

    fn count_visit(&mut self) -> Result<(), Damage> {
        self.visited_count += 1;
        if self.visited_count > MAX_ARRAYS {
            Err(Damage::new(format!(
                "it contains more than {MAX_ARRAYS} groups and arrays"
            )))
        } else {
            Ok(())
        }
    }

    /// Reads scalars and texts stored as attributes.
    fn attributes(
        &mut self,
        attributes: &HashMap<String, AttrValue>,
        path: &Path,
    ) -> Result<(), Damage> {
        let mut names: Vec<&String> = attributes
            .keys()
            .filter(|name| !name.starts_with("MATLAB_") && *name != "H5PATH")
            .collect();
        names.sort();
        for name in names {
            let value = &attributes[name];
            if let Some(text) = matlab::text(value) {
                self.tree.text(&path.to(name), vec![text]);
            } else if let Some(number) = matlab::number(value) {
                let mut numbers = self.store.column();
                numbers.push(number)?;
                self.push(
                    &path.to(name),
                    String::new(),
                    vec![numbers],
                    None,
                    Vec::new(),
                );
            }
        }
        Ok(())
    }

    fn push(
        &mut self,
        path: &Path,
        unit: String,
        series: Vec<ColumnNumbers>,
        imaginary: Option<Vec<ColumnNumbers>>,
        labels: Vec<String>,
    ) {
        self.tree.arrays.push(Array {
            path: path.clone(),
            unit,
            series,
            imaginary,
            labels,
        });
    }

    fn dataset(&mut self, dataset: &Dataset, path: &Path) -> Result<(), Damage> {
        self.count_visit()?;
        if path.0.len() > MAX_DEPTH {
            return Err(Damage::new(format!(
                "{path} is nested in more than {MAX_DEPTH} cells"
            )));
        }
        let attributes = dataset.attrs().unwrap_or_default();
        let class = Class::of(&attributes);
        if class == Class::Object {
            self.tree.skip(format!(
                "{path} is an object (timeseries, table) and was left out; save its \
                    numbers, for example t = x.Time; v = x.Data"
            ));
        }
        if matches!(class, Class::Object | Class::Empty) {
            return Ok(());
        }
        let (shape, datatype) = match (checked::shape(dataset, self.size), dataset.datatype()) {
            (Ok(shape), Ok(datatype)) => (shape, datatype),
            (Err(why), _) => {
                self.tree.skip(format!("{path} was left out: {why}"));
                return Ok(());
            }
            (_, Err(fault)) => {
                self.tree.skip(format!("{path} was left out: {fault}"));
                return Ok(());
            }
        };
        match &datatype {
            Datatype::Reference {
                ref_type: ReferenceType::Object,
                ..
            } => self.references(dataset, path, class),
            Datatype::String { .. }
            | Datatype::VariableLength {
                is_string: true, ..
            } => self.texts(dataset, path, &shape),
            _ => match Stored::of(&datatype) {
                Some(stored) if class == Class::Text => {
                    self.characters(dataset, path, &shape, &stored)
                }
                Some(stored) => self.numbers(dataset, path, &shape, &stored, &attributes),
                None => {
                    self.tree
                        .skip(format!("{path} contains no numbers and was left out"));
                    Ok(())
                }
            },
        }
    }

    /// Reads cells, `runs{2}`, and fields of struct arrays, `signal(2).values`.
    fn references(&mut self, dataset: &Dataset, path: &Path, class: Class) -> Result<(), Damage> {
        let objects = match dataset.dereference() {
            Ok(objects) => objects,
            Err(fault) => {
                self.tree.skip(format!("{path} was left out: {fault}"));
                return Ok(());
            }
        };
        let has_several = objects.len() > 1;
        for (k, object) in objects.into_iter().enumerate() {
            let object_path = match (class, path.0.split_last()) {
                (Class::Cell, _) | (_, None) => path.to(format!("{{{}}}", k + 1)),
                (_, Some((field, parent))) if has_several && !parent.is_empty() => {
                    let mut parent = Path(parent.to_vec());
                    parent
                        .0
                        .iter_mut()
                        .next_back()
                        .into_iter()
                        .for_each(|last| last.push_str(&format!("({})", k + 1)));
                    parent.to(field)
                }
                _ if has_several => path.to(format!("{{{}}}", k + 1)),
                _ => path.clone(),
            };
            match object {
                Object::Group(group) => self.group(&group, &object_path)?,
                Object::Dataset(dataset) => self.dataset(&dataset, &object_path)?,
                _ => self
                    .tree
                    .skip(format!("{object_path} is not an array and was left out")),
            }
        }
        Ok(())
    }

    fn texts(&mut self, dataset: &Dataset, path: &Path, shape: &[u64]) -> Result<(), Damage> {
        let has_few = shape
            .iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side))
            .is_some_and(|count| count <= 4096);
        let is_short = dataset
            .element_size()
            .is_ok_and(|size| size <= MAX_CHARACTERS);
        if let Some(texts) = (has_few && is_short)
            .then(|| dataset.read_string().ok())
            .flatten()
        {
            self.tree.text(path, texts);
        }
        Ok(())
    }

    /// Reads MATLAB text, two bytes per character.
    fn characters(
        &mut self,
        dataset: &Dataset,
        path: &Path,
        shape: &[u64],
        stored: &Stored,
    ) -> Result<(), Damage> {
        let count = shape
            .iter()
            .try_fold(1_u64, |product, side| product.checked_mul(*side));
        if count.is_none_or(|count| count > MAX_CHARACTERS) {
            return Ok(());
        }
        let bytes = dataset.read_raw().map_err(|fault| hdf5_error(&fault))?;
        let units: Vec<u16> = bytes
            .chunks_exact(stored.width)
            .map(|unit| stored.scalar.number(unit) as u16)
            .collect();
        self.tree.text(path, vec![String::from_utf16_lossy(&units)]);
        Ok(())
    }

    fn numbers(
        &mut self,
        dataset: &Dataset,
        path: &Path,
        shape: &[u64],
        stored: &Stored,
        attributes: &HashMap<String, AttrValue>,
    ) -> Result<(), Damage> {
        let Some(layout) = ArrayLayout::new(shape, true).filter(|layout| layout.total() > 0) else {
            if !shape.contains(&0) {
                self.tree.skip(format!(
                    "the array {path} of size {shape:?} is not a series of numbers"
                ));
            }
            return Ok(());
        };
        let mut series = layout.series(self.store)?;
        let mut imaginary = stored
            .imaginary
            .map(|_| layout.series(self.store))
            .transpose()?;
        let rows = shape.first().copied().unwrap_or(1);
        let row_bytes = layout.total() / rows * stored.width as u64;
        let rows_per_read = (BYTES_AT_ONCE / row_bytes.max(1)).max(1);
        let (mut row, mut number) = (0, 0);
        while row < rows {
            let bytes = match dataset.read_raw_rows(row, rows_per_read.min(rows - row)) {
                Ok(bytes) => bytes,
                Err(fault) => {
                    self.tree.skip(format!("{path} was left out: {fault}"));
                    return Ok(());
                }
            };
            for element in bytes.chunks_exact(stored.width) {
                stored.push(element, &layout, number, &mut series, imaginary.as_mut())?;
                number += 1;
            }
            row += rows_per_read;
        }
        if number != layout.total() {
            return Err(Damage::new(format!(
                "{path} has {} numbers by its size, but {number} are stored: is the file \
                truncated?",
                layout.total()
            )));
        }
        let unit = ["units", "unit", "Units", "Unit"]
            .iter()
            .find_map(|name| matlab::text(attributes.get(*name)?))
            .unwrap_or_default();
        self.attributes(attributes, path)?;
        self.push(path, unit, series, imaginary, layout.labels());
        Ok(())
    }
}
