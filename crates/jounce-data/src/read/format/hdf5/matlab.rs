//! MATLAB attributes of arrays in HDF5.

use std::collections::HashMap;

use hdf5_pure::AttrValue;

/// MATLAB class of a dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Class {
    /// Numbers, or a file not written by MATLAB.
    Numbers,
    /// Characters of two bytes.
    Text,
    /// References to the contents of the cells.
    Cell,
    /// Empty: the stored numbers are the size of an empty array.
    Empty,
    /// Object in a private format.
    Object,
}

impl Class {
    pub fn of(attributes: &HashMap<String, AttrValue>) -> Self {
        let class = attributes
            .get("MATLAB_class")
            .and_then(text)
            .unwrap_or_default();
        match class.as_str() {
            _ if attributes.contains_key("MATLAB_empty") => Self::Empty,
            _ if attributes.contains_key("MATLAB_object_decode") => Self::Object,
            "char" => Self::Text,
            "cell" => Self::Cell,
            _ => Self::Numbers,
        }
    }
}

/// Returns the text of an attribute.
pub(super) fn text(value: &AttrValue) -> Option<String> {
    match value {
        AttrValue::String(text)
        | AttrValue::AsciiString(text)
        | AttrValue::VarLenString(text)
        | AttrValue::VarLenAsciiString(text) => Some(text.trim_matches(['\0', ' ']).to_owned()),
        AttrValue::StringArray(texts)
        | AttrValue::AsciiStringArray(texts)
        | AttrValue::VarLenStringArray(texts) => match &texts[..] {
            [text] => Some(text.trim_matches(['\0', ' ']).to_owned()),
            _ => None,
        },
        _ => None,
    }
}

/// Returns the number of an attribute.
pub(super) fn number(value: &AttrValue) -> Option<f64> {
    match value {
        AttrValue::F64(x) => Some(*x),
        AttrValue::F32(x) => Some(f64::from(*x)),
        AttrValue::F64Array(numbers) => match numbers[..] {
            [x] => Some(x),
            _ => None,
        },
        AttrValue::U8(x) => Some(f64::from(*x)),
        AttrValue::I16(x) => Some(f64::from(*x)),
        AttrValue::U16(x) => Some(f64::from(*x)),
        AttrValue::I32(x) => Some(f64::from(*x)),
        AttrValue::U32(x) => Some(f64::from(*x)),
        AttrValue::I64(x) => Some(*x as f64),
        AttrValue::U64(x) => Some(*x as f64),
        _ => None,
    }
}
