//! Reading of values: kind and limits.

use super::{ReadState, read_keys, read_named};
use crate::key::{Element, KeyInfo, Kind, Need, Range, ValueMut};
use crate::nearest::{clip, did_you_mean, sentence};
use crate::source::{Node, Value};

/// Reads the value of one key; false if it is wrong.
pub(super) fn read_slot(
    (index, info): (usize, &KeyInfo),
    path: &str,
    node: &Node,
    element: &mut dyn Element,
    reading: &mut ReadState,
) -> bool {
    let kind = element.kind(index, info);
    let range = info.range;
    match element.open(index) {
        ValueMut::Number => {
            // A hole instead of the default, so rules between keys do not report a value that was
            // not intended; 0 for a whole number.
            let number = one_number(kind, range, path, node, reading);
            element.set_number(index, number.unwrap_or(f64::NAN));
            return number.is_some();
        }
        ValueMut::Text => {
            let text = text(info, path, node, reading);
            return text.map(|text| element.set_text(index, text)).is_some();
        }
        ValueMut::Texts(open) => {
            let list = texts(info, path, node, reading);
            return list.map(|list| *open = list).is_some();
        }
        ValueMut::Numbers(open) => {
            let list = numbers(info, path, node, reading);
            return list.map(|list| *open = list).is_some();
        }
        ValueMut::NamedQuantities(map) => {
            read_named(
                path,
                node,
                kind,
                reading,
                &mut |name, path, node, reading| {
                    // The name remains known, so references to it are not reported as wrong.
                    let value = one_number(kind, range, path, node, reading).unwrap_or(f64::NAN);
                    reading.positions.insert(path.to_owned(), node.position);
                    map.insert(name.to_owned(), value);
                },
            );
        }
        ValueMut::NamedNumbers(map) => {
            read_named(
                path,
                node,
                kind,
                reading,
                &mut |name, path, node, reading| {
                    let list = numbers(info, path, node, reading).unwrap_or_default();
                    reading.positions.insert(path.to_owned(), node.position);
                    map.insert(name.to_owned(), list);
                },
            );
        }
        ValueMut::Table(inner) => read_keys(path, node, inner, reading),
        ValueMut::Things(inner) => {
            read_named(
                path,
                node,
                kind,
                reading,
                &mut |name, path, node, reading| {
                    read_keys(path, node, inner.open(name), reading);
                },
            );
        }
    }
    true
}

fn one_number(
    kind: Kind,
    range: Range,
    path: &str,
    node: &Node,
    reading: &mut ReadState,
) -> Option<f64> {
    match read_number(kind, range, node) {
        Ok(value) => Some(value),
        Err(text) => {
            reading.fault(node.position, path, || text);
            None
        }
    }
}

/// Returns a number of any kind within its limits, in SI, or its fault.
pub(crate) fn read_number(kind: Kind, range: Range, node: &Node) -> Result<f64, String> {
    let (value, printed) = match (kind, &node.value) {
        (
            Kind::Quantity(quantity) | Kind::NamedQuantities(quantity) | Kind::NumberOr(quantity),
            Value::Text(text),
        ) => (
            quantity.read(text).map_err(|error| error.to_string())?,
            clip(text),
        ),
        (Kind::Quantity(_) | Kind::NamedQuantities(_), Value::Integer(_) | Value::Float(_)) => {
            return Err(format!(
                "{} has no unit; {}",
                clip(&node.raw),
                kind.expectation()
            ));
        }
        (
            Kind::Number | Kind::NumberOr(_) | Kind::Count | Kind::Numbers | Kind::NamedNumbers,
            Value::Integer(value),
        ) => (*value as f64, clip(&node.raw)),
        (
            Kind::Number | Kind::NumberOr(_) | Kind::Numbers | Kind::NamedNumbers,
            Value::Float(value),
        ) => (*value, clip(&node.raw)),
        (Kind::Numbers | Kind::NamedNumbers, _) => {
            return Err(format!("expected a plain number; found {}", node.found()));
        }
        _ => return Err(format!("{}; found {}", kind.expectation(), node.found())),
    };
    if range.holds(value) {
        Ok(value)
    } else {
        Err(format!("is {printed}; it {}", range.broken(value, kind)))
    }
}

fn text<'n>(
    info: &KeyInfo,
    path: &str,
    node: &'n Node,
    reading: &mut ReadState,
) -> Option<&'n str> {
    let wrong = match (&node.value, info.kind) {
        (Value::Text(text), Kind::Choice(words)) if !words.contains(&text.as_str()) => {
            let suggestion = did_you_mean(text, words);
            format!(
                "\"{}\" is not known{suggestion}; {}",
                clip(text),
                info.kind.expectation()
            )
        }
        (Value::Text(text), Kind::ChoiceOrPath(words))
            if !words.contains(&text.as_str()) && !text.contains(['.', '/', '\\']) =>
        {
            let suggestion = did_you_mean(text, words);
            format!(
                "\"{}\" is not known{suggestion}; {}",
                clip(text),
                info.kind.expectation()
            )
        }
        (Value::Text(text), _) if text.trim().is_empty() => {
            format!("the text is empty; {}", info.kind.expectation())
        }
        (Value::Text(text), _) => return Some(text),
        _ => format!("{}; found {}", info.kind.expectation(), node.found()),
    };
    reading.fault(node.position, path, || wrong);
    None
}

fn texts(info: &KeyInfo, path: &str, node: &Node, reading: &mut ReadState) -> Option<Vec<String>> {
    let Value::List(items) = &node.value else {
        reading.fault(node.position, path, || {
            format!("{}; found {}", info.kind.expectation(), node.found())
        });
        return None;
    };
    if items.is_empty() {
        reading.fault(node.position, path, || {
            format!("the list is empty; {}", info.kind.expectation())
        });
        return None;
    }
    let mut list = Vec::with_capacity(items.len());
    for (index, item) in items.iter().enumerate() {
        match &item.value {
            Value::Text(text) if !text.trim().is_empty() => list.push(text.clone()),
            _ => reading.fault(item.position, path, || {
                format!(
                    "name {} of the list: {}; found {}",
                    index + 1,
                    info.kind.expectation(),
                    item.found()
                )
            }),
        }
    }
    (list.len() == items.len()).then_some(list)
}

fn numbers(info: &KeyInfo, path: &str, node: &Node, reading: &mut ReadState) -> Option<Vec<f64>> {
    let Value::List(items) = &node.value else {
        reading.fault(node.position, path, || {
            format!("{}; found {}", info.kind.expectation(), node.found())
        });
        return None;
    };
    let may_be_empty = info.kind == Kind::Numbers && info.need == Need::Default;
    if items.is_empty() && !may_be_empty {
        reading.fault(node.position, path, || {
            "the list is empty; give at least one number".to_owned()
        });
        return None;
    }
    let kind = match info.kind {
        Kind::Quantities(quantity) => Kind::Quantity(quantity),
        _ => Kind::Numbers,
    };
    let mut list = Vec::with_capacity(items.len());
    for (index, item) in items.iter().enumerate() {
        match read_number(kind, info.range, item) {
            Ok(value) => list.push(value),
            Err(text) => reading.fault(item.position, path, || {
                sentence(&format!("number {}", index + 1), &text)
            }),
        }
    }
    (list.len() == items.len()).then_some(list)
}
