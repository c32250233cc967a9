//! Choices of a free key: a list of values, or of tables with values and ranges.

use crate::problem::free_key::{table_text, value_text};
use crate::problem::{Choice, ChoiceIndex, FreeKey, FreeRange, FreeValues};
use jounce_spec::{Fault, SpecFile};
use toml_edit::{Array, Value};

/// Reads the choices of a key, which has the index `free`. The ranges in its tables follow it.
///
/// # Errors
/// Messages with the mistakes and what is allowed.
pub(super) fn choices(
    file: &SpecFile,
    path: &str,
    array: &Array,
    free: usize,
) -> Result<Vec<FreeKey>, Vec<String>> {
    let allowed = || {
        vec![format!(
            "free.{path} must list at least two values, as in [\"steel\", \"aluminium\"], or two tables of values, as in [{{ law = \"hertz\" }}, {{ law = \"hunt-crossley\", damping = \"0.1:1 s/m\" }}]"
        )]
    };
    let written = array.iter().map(|value| pairs(path, value));
    let written: Vec<_> = written.collect::<Option<_>>().ok_or_else(allowed)?;
    if written.len() < 2 {
        return Err(allowed());
    }
    let texts: Vec<String> = written.iter().map(|values| shown(path, values)).collect();
    let (mut all, mut faults) = (Vec::new(), Vec::new());
    let mut keys = Vec::new();
    for (choice, values) in written.iter().enumerate() {
        if texts[..choice].contains(&texts[choice]) {
            faults.push(format!("free.{path} lists {} twice", texts[choice]));
            continue;
        }
        match read(file, values, ChoiceIndex { free, choice }) {
            Ok((one, ranges)) => {
                all.push(one);
                keys.extend(ranges);
            }
            Err(found) => faults.extend(found.into_iter().map(|fault| {
                let hint = hint(path, values, &fault, &texts).unwrap_or_default();
                format!("free.{path}, {}: {}{hint}", texts[choice], plain(&fault))
            })),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    keys.insert(
        0,
        FreeKey {
            path: path.to_owned(),
            values: FreeValues::Choice(all),
            with: None,
        },
    );
    Ok(keys)
}

/// Returns the keys of a choice with their values as text; `None` for another kind of value.
fn pairs(path: &str, value: &Value) -> Option<Vec<(String, String)>> {
    match value {
        Value::InlineTable(table) => table
            .iter()
            .map(|(key, value)| Some((format!("{path}.{key}"), value_text(value)?)))
            .collect(),
        value => Some(vec![(path.to_owned(), value_text(value)?)]),
    }
}

/// Returns a choice as it is written.
fn shown(path: &str, values: &[(String, String)]) -> String {
    match values {
        [(own, value)] if own == path => format!("{value:?}"),
        values => table_text(path, values),
    }
}

/// Reads a choice and its ranges with the spec that has all its values, and the smaller end of each
/// range.
fn read(
    file: &SpecFile,
    values: &[(String, String)],
    with: ChoiceIndex,
) -> Result<(Choice, Vec<FreeKey>), Vec<Fault>> {
    let (mut changed, mut fixed, mut ranges) = (file.clone(), Vec::new(), Vec::new());
    for (path, value) in values {
        let first = FreeRange::first_end(value);
        changed
            .set(path, first.as_ref().unwrap_or(value))
            .map_err(|fault| vec![fault])?;
        match first {
            Some(_) => ranges.push((path, value)),
            None => fixed.push((path.clone(), value.clone())),
        }
    }
    changed
        .spec()
        .map_err(|faults| faults.as_slice().to_vec())?;
    let range = |(path, value): (&String, &String)| {
        let range = FreeRange::read(&changed, path, value).map_err(|messages| {
            let fault = |message: String| Fault::without_position(path, message);
            messages.into_iter().map(fault).collect::<Vec<_>>()
        })?;
        Ok::<FreeKey, Vec<Fault>>(FreeKey {
            path: path.clone(),
            values: FreeValues::Range(Box::new(range)),
            with: Some(with),
        })
    };
    let ranges = ranges.into_iter().map(range).collect::<Result<_, _>>()?;
    Ok((Choice { values: fixed }, ranges))
}

/// Returns the message without the overrides that made the choice.
pub(super) fn plain(fault: &Fault) -> &str {
    let message = fault.message.as_str();
    message
        .split_once("; caused by --set")
        .map_or(message, |(message, _)| message)
}

/// Returns how to write a choice that needs other keys too; `None` where its own value is wrong, or
/// where it is a table already.
fn hint(
    path: &str,
    values: &[(String, String)],
    fault: &Fault,
    texts: &[String],
) -> Option<String> {
    let [(own, _)] = values else { return None };
    let (table, key) = path.rsplit_once('.')?;
    if own != path || fault.key == *path {
        return None;
    }
    let message = plain(fault);
    let needed = match message.split('`').nth(1) {
        Some(missing) => format!("{missing} = VALUE"),
        // A key that does not apply is removed.
        None => format!("{} = \"\"", fault.key.rsplit('.').next()?),
    };
    let all = texts
        .iter()
        .map(|text| match text == &format!("{:?}", values[0].1) {
            true => format!("{{ {key} = {text}, {needed} }}"),
            false => format!("{{ {key} = {text} }}"),
        });
    Some(format!(
        "; give the keys of each choice with it: \"{table}\" = [{}]",
        all.collect::<Vec<_>>().join(", ")
    ))
}
