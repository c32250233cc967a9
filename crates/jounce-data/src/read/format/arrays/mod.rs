//! Named arrays of MAT, NPZ, HDF5 and TDMS files: assigns each array to a time or frequency axis.
mod axes;
mod grids;
mod layout;
mod names;
mod nearest;
mod sorted;
mod spacing;

use std::collections::{BTreeMap, HashMap};
use std::fmt;

use crate::read::column::numbers::ColumnNumbers;
use crate::recording::{Issue, IssueKind, Series};

pub(in crate::read) use grids::into_found;
pub(in crate::read) use layout::ArrayLayout;

/// Maximum number of arrays in a file.
pub(in crate::read) const MAX_ARRAYS: usize = 100_000;

/// Path of an array: the names of the enclosing structs or groups, then the name of the array.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub(in crate::read) struct Path(pub Vec<String>);

impl Path {
    /// Path of a member.
    pub fn to(&self, name: impl Into<String>) -> Self {
        Self(self.0.iter().cloned().chain([name.into()]).collect())
    }

    /// Name of the array.
    pub fn name(&self) -> &str {
        self.0.last().map_or("", String::as_str)
    }

    /// Names of the enclosing structs or groups.
    pub fn scope(&self) -> &[String] {
        &self.0[..self.0.len().saturating_sub(1)]
    }
}

/// `data.signal(1).values`, `runs{2}`
impl fmt::Display for Path {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, name) in self.0.iter().enumerate() {
            let point = if k == 0 || name.starts_with('{') {
                ""
            } else {
                "."
            };
            write!(to, "{point}{name}")?;
        }
        Ok(())
    }
}

/// An array of numbers as series of equal length.
#[derive(Debug)]
pub(in crate::read) struct Array {
    pub path: Path,
    /// Unit stored with the array; empty without one.
    pub unit: String,
    /// Real parts.
    pub series: Vec<ColumnNumbers>,
    /// Imaginary parts of a complex array.
    pub imaginary: Option<Vec<ColumnNumbers>>,
    /// Indices of the series in the array, `(2,1)`; empty for a single series.
    pub labels: Vec<String>,
}

impl Array {
    /// Samples of each series.
    pub fn length(&self) -> usize {
        self.series.first().map_or(0, Series::count)
    }
}

/// Contents of a file of arrays.
#[derive(Debug, Default)]
pub(in crate::read) struct Tree {
    pub arrays: Vec<Array>,
    /// Texts by scope and name.
    texts: HashMap<Vec<String>, BTreeMap<String, Vec<String>>>,
    pub issues: Vec<Issue>,
}

impl Tree {
    /// Records a skipped item.
    pub fn skip(&mut self, message: impl Into<String>) {
        self.issues
            .push(Issue::new(IssueKind::Skipped, 1, None, message.into()));
    }

    /// Stores trimmed texts unless all are empty.
    pub fn text(&mut self, path: &Path, texts: Vec<String>) {
        let texts: Vec<String> = texts
            .into_iter()
            .map(|text| text.trim_matches(['\0', ' ']).to_owned())
            .collect();
        if texts.iter().any(|text| !text.is_empty()) {
            self.texts
                .entry(path.scope().to_vec())
                .or_default()
                .insert(path.name().to_owned(), texts);
        }
    }

    /// Texts of a name in a scope.
    fn text_at(&self, scope: &[String], name: &str) -> Option<&Vec<String>> {
        self.texts.get(scope)?.get(name)
    }
}
