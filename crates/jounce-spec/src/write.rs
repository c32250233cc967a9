//! A spec as canonical TOML: every applicable key, in the order of the table of keys, in short
//! units.

use sha2::{Digest, Sha256};

use super::key::{Element, Kind, ValueRef};
use super::read::join;
use super::{DriveSignal, Modal, Source, Spec};

impl Spec {
    /// Prints the spec as TOML. [`Spec::from_toml`] reads an identical spec back, bit for bit.
    ///
    /// Defaults are printed too; the spring of a mass is printed as its stiffness.
    ///
    /// # Validation
    /// `crates/jounce-spec/tests/spec/round_trip.rs`: random specs with all laws, sides and
    /// structures come back equal.
    pub fn to_toml(&self) -> String {
        let mut out = String::new();
        write_keys(self, "", false, &mut out);
        out.trim_start().to_owned()
    }

    /// Returns the SHA-256 of [`Spec::to_toml`] as 64 hexadecimal digits. Comments, order, units,
    /// written defaults and the `[source]` do not change it.
    pub fn hash_hex(&self) -> String {
        let without_source = Spec {
            source: Source::default(),
            ..self.clone()
        };
        let mut hasher = Sha256::new_with_prefix(without_source.to_toml().as_bytes());
        // Recordings enter by their samples, because a file may change under its name.
        for drive in self.drive.values() {
            if let DriveSignal::Recording {
                record: Some(record),
                ..
            } = &drive.signal
            {
                [record.step_s]
                    .iter()
                    .chain(record.values.iter())
                    .for_each(|value| hasher.update(value.to_le_bytes()));
            }
        }
        format!("{:x}", hasher.finalize())
    }
}

impl Modal {
    /// Prints the structure as `[modal.NAME]` with its tables, as [`Spec::to_toml`] does.
    pub fn to_toml(&self, name: &str) -> String {
        let mut out = String::new();
        write_keys(self, &join("modal", &key(name)), true, &mut out);
        out.trim_start().to_owned()
    }
}

/// Prints one element under its header; `always` prints the header of an empty element too.
fn write_keys(element: &dyn Element, path: &str, always: bool, out: &mut String) {
    let mut key_lines = String::new();
    let mut below = String::new();
    for (index, info) in element.keys().filter(|(_, info)| element.applies(info)) {
        let value = element.get(index);
        write_below(&value, info.kind, &join(path, info.name), &mut below);
        if let Some(value) = text(value, element.kind(index, info)) {
            line(&mut key_lines, info.name, &value);
        }
    }
    if always || !key_lines.is_empty() {
        out.push_str(&format!("\n[{path}]\n{key_lines}"));
    }
    out.push_str(&below);
}

fn line(out: &mut String, name: &str, value: &str) {
    out.push_str(&format!("{name} = {value}\n"));
}

/// Returns the value of a key in a line; `None` if it is not printed or has its own header.
fn text(value: ValueRef<'_>, kind: Kind) -> Option<String> {
    let number = |value: f64| match kind {
        Kind::Quantity(quantity) => quoted(&quantity.write(value)),
        _ => float(value),
    };
    match value {
        // A key that another one replaces has no number.
        ValueRef::Number(value) => value.is_finite().then(|| number(value)),
        ValueRef::Optional(value) => value.map(number),
        ValueRef::Count(count) => Some(count.to_string()),
        ValueRef::Text(text) => (!text.is_empty()).then(|| quoted(&text)),
        ValueRef::Texts(values) => (!values.is_empty()).then(|| texts(values)),
        ValueRef::Numbers(values) => (!values.is_empty()).then(|| list(values)),
        _ => None,
    }
}

/// Prints the values of a key that have their own header.
fn write_below(value: &ValueRef<'_>, kind: Kind, path: &str, out: &mut String) {
    let mut lines = String::new();
    match (value, kind) {
        (ValueRef::NamedQuantities(values), Kind::NamedQuantities(quantity)) => {
            for (name, value) in *values {
                line(&mut lines, &key(name), &quoted(&quantity.write(*value)));
            }
        }
        (ValueRef::NamedNumbers(values), _) => {
            for (name, values) in *values {
                line(&mut lines, &key(name), &list(values));
            }
        }
        (ValueRef::Table(inner), _) => write_keys(*inner, path, false, out),
        (ValueRef::Things(inner), _) => {
            inner.for_each(&mut |name, element| {
                write_keys(element, &join(path, &key(name)), true, out);
            });
        }
        _ => {}
    }
    if !lines.is_empty() {
        out.push_str(&format!("\n[{path}]\n{lines}"));
    }
}

/// Returns a name as a key, in quotes where TOML requires them.
fn key(name: &str) -> String {
    toml_edit::Key::new(name).to_string()
}

fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}

/// Returns the shortest digits that read back as the same bits.
fn float(value: f64) -> String {
    format!("{value:?}")
}

fn texts(values: &[String]) -> String {
    format!(
        "[{}]",
        values
            .iter()
            .map(|value| quoted(value))
            .collect::<Vec<_>>()
            .join(", ")
    )
}

fn list(values: &[f64]) -> String {
    format!(
        "[{}]",
        values
            .iter()
            .map(|value| float(*value))
            .collect::<Vec<_>>()
            .join(", ")
    )
}
