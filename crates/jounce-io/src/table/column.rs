//! Columns with name, unit, description and values.

/// Column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name, with the unit as suffix: `mean_power_w`.
    pub name: String,
    /// Unit as printed: `W`, `Hz`, `N/m^1.5`; empty for text, flags and pure numbers.
    pub unit: String,
    /// Description in one line.
    pub about: String,
    /// Values of the rows.
    pub values: Values,
}

/// Values of a column, of one kind for all rows.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Real numbers.
    Float(Vec<f64>),
    /// Integers.
    Integer(Vec<i64>),
    /// Counts.
    Count(Vec<u64>),
    /// Booleans.
    Flag(Vec<bool>),
    /// Text.
    Text(Vec<String>),
}

impl Column {
    /// Creates a column from values of any supported kind.
    pub fn new(name: &str, unit: &str, about: &str, values: impl Into<Values>) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            about: about.to_owned(),
            values: values.into(),
        }
    }
}

impl Values {
    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Float(v) => v.len(),
            Self::Integer(v) => v.len(),
            Self::Count(v) => v.len(),
            Self::Flag(v) => v.len(),
            Self::Text(v) => v.len(),
        }
    }

    /// True where the column has no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the value of one row as text that parses back to the same value (`{:?}` of a float
    /// is the shortest such text); `None` beyond the last row.
    pub fn text(&self, row: usize) -> Option<String> {
        match self {
            Self::Float(v) => v.get(row).map(|x| format!("{x:?}")),
            Self::Integer(v) => v.get(row).map(i64::to_string),
            Self::Count(v) => v.get(row).map(u64::to_string),
            Self::Flag(v) => v.get(row).map(bool::to_string),
            Self::Text(v) => v.get(row).cloned(),
        }
    }

    /// Returns the name of this kind in the notes of a file.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Float(_) => "float",
            Self::Integer(_) => "integer",
            Self::Count(_) => "count",
            Self::Flag(_) => "flag",
            Self::Text(_) => "text",
        }
    }

    /// Parses values of the given kind; the error names the first invalid text.
    pub(super) fn parse(kind: &str, texts: Vec<String>) -> Result<Self, String> {
        match kind {
            "float" => parse_all(texts).map(Self::Float),
            "integer" => parse_all(texts).map(Self::Integer),
            "count" => parse_all(texts).map(Self::Count),
            "flag" => parse_all(texts).map(Self::Flag),
            "text" => Ok(Self::Text(texts)),
            other => Err(unknown_kind(other)),
        }
    }
}

/// Returns the message about a kind of column that does not exist.
pub(super) fn unknown_kind(kind: &str) -> String {
    format!("there is no kind of column \"{kind}\"")
}

fn parse_all<T: std::str::FromStr>(texts: Vec<String>) -> Result<Vec<T>, String> {
    let parse = |text: String| {
        text.parse()
            .map_err(|_| format!("\"{text}\" is not a {}", std::any::type_name::<T>()))
    };
    texts.into_iter().map(parse).collect()
}

macro_rules! from_vector {
    ($($kind:ident: $item:ty),*) => {$(
        impl From<Vec<$item>> for Values {
            fn from(values: Vec<$item>) -> Self {
                Self::$kind(values)
            }
        }
    )*};
}
from_vector!(Float: f64, Integer: i64, Count: u64, Flag: bool, Text: String);
