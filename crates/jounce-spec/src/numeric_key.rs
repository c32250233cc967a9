//! A key that holds one number, for sweeps.

use super::fault::Fault;
use super::key::{Element, KeyInfo, Kind, ValueMut, ValueRef};
use super::nearest::clip;
use super::{Spec, validation};

/// A number of a spec that can be set repeatedly.
///
/// ```
/// use jounce_spec::{NumericKey, Spec};
/// let mut spec = Spec::from_toml("[mass.table]\nmass = \"12 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.3")?;
/// NumericKey::find(&spec, "mass.table.damping_ratio")?.set(&mut spec, 0.05)?;
/// assert_eq!(spec.mass["table"].damping_ratio, Some(0.05));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct NumericKey {
    path: String,
    kind: Kind,
    info: KeyInfo,
    /// A key and its value that are retained when this key changes: the frequency of a mass whose
    /// spring it defines.
    retained_value: Option<(String, f64)>,
}

/// Properties of the number at a path.
#[derive(Debug, Clone, Copy)]
struct Numeric {
    info: KeyInfo,
    kind: Kind,
    value: f64,
}

impl NumericKey {
    /// Finds the key by its dotted path, `"drive.shaker.frequency"`; numbers of a list are counted
    /// from 1, `"damping.ratios.2"`.
    ///
    /// # Errors
    /// A path without a number, or of a complete list. The exponent of a contact law is refused,
    /// because the unit of its stiffness depends on it.
    pub fn find(spec: &Spec, path: &str) -> Result<Self, Fault> {
        let Some(entry) = locate(spec, &segments(path)) else {
            return Err(Fault::without_position(
                path,
                format!("{}: {}", clip(path), no_number(spec, path)),
            ));
        };
        if path.starts_with("stop.") && entry.info.name == "exponent" {
            let reason = "cannot be varied alone, because the unit of `stiffness` depends on it; write one spec for each exponent";
            return Err(Fault::without_position(path, format!("{path} {reason}")));
        }
        Ok(Self {
            path: path.to_owned(),
            kind: entry.kind,
            info: entry.info,
            retained_value: None,
        })
    }

    /// Returns every number of the list at a path; empty if there is no list.
    pub(super) fn all_in(spec: &Spec, path: &str) -> Result<Vec<Self>, Fault> {
        (1..=listed(spec, path))
            .map(|number| Self::find(spec, &format!("{path}.{number}")))
            .collect()
    }

    /// Holds another number of the spec at a value whenever this key is set.
    pub(super) fn holding(mut self, path: String, value: f64) -> Self {
        self.retained_value = Some((path, value));
        self
    }

    /// Returns the dotted path.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Returns the SI unit of the number; empty for a plain number.
    pub fn unit(&self) -> String {
        if let Kind::Quantity(quantity) | Kind::NamedQuantities(quantity) = self.kind {
            quantity.si_unit()
        } else {
            String::new()
        }
    }

    /// Returns the size of a unit in which the number may be written, SI; `None` for a unit of
    /// another quantity.
    pub fn size_of(&self, unit: &str) -> Option<f64> {
        match self.kind {
            Kind::Quantity(quantity)
            | Kind::NamedQuantities(quantity)
            | Kind::NumberOr(quantity) => quantity.read(&format!("1 {unit}")).ok(),
            _ => None,
        }
    }

    /// Returns the smallest and largest value that the key itself allows, SI; infinite if there is
    /// no limit.
    pub fn limits(&self) -> (f64, f64) {
        (self.info.range.low, self.info.range.high)
    }

    /// Returns a value as written in a spec, `"0.5 mm"`.
    pub fn show(&self, value_si: f64) -> String {
        self.kind.show(value_si)
    }

    /// Reads a number in a unit of the key, SI; the limits of the key do not apply.
    ///
    /// # Errors
    /// What is wrong with the number or its unit.
    pub fn read(&self, text: &str) -> Result<f64, String> {
        super::key_range::number(self.kind, text)
    }

    /// Returns the help text of the key.
    pub fn about(&self) -> &'static str {
        self.info.doc
    }

    /// True for a whole number.
    pub fn is_count(&self) -> bool {
        self.info.kind == Kind::Count
    }

    /// Returns the value in a spec, SI.
    ///
    /// # Errors
    /// A spec without this key.
    pub fn get(&self, spec: &Spec) -> Result<f64, Fault> {
        let entry = locate(spec, &segments(&self.path));
        entry.map(|entry| entry.value).ok_or_else(|| {
            Fault::without_position(
                &self.path,
                format!("{}: this spec has no such key", self.path),
            )
        })
    }

    /// Sets the value, SI. On an error the spec is unchanged.
    ///
    /// # Errors
    /// A value outside the limits of the key, or a value that violates a rule between keys (a patch
    /// beyond its beam).
    pub fn set(&self, spec: &mut Spec, value_si: f64) -> Result<(), Fault> {
        Self::set_all(spec, &[(self, value_si)])
    }

    /// Sets the values of several keys together, SI: rules between keys apply to all of them at
    /// once. On an error the spec is unchanged.
    ///
    /// # Errors
    /// As [`NumericKey::set`].
    pub fn set_all(spec: &mut Spec, values: &[(&Self, f64)]) -> Result<(), Fault> {
        let mut changed = spec.clone();
        for (key, value_si) in values {
            key.check(*value_si)?;
            key.get(spec)?;
            key.store(&mut changed, *value_si);
        }
        let Some((_, message)) = validation::first(&changed) else {
            *spec = changed;
            return Ok(());
        };
        let assignment =
            |(key, value): &(&Self, f64)| format!("{} = {}", key.path, key.kind.show(*value));
        let assignments: Vec<String> = values.iter().map(assignment).collect();
        let path = values.first().map_or("", |(key, _)| &key.path);
        Err(Fault::without_position(
            path,
            format!("{}: {message}", assignments.join(", ")),
        ))
    }

    /// Checks a value against the limits of the key itself.
    pub(super) fn check(&self, value_si: f64) -> Result<(), Fault> {
        let is_allowed = self.info.kind != Kind::Count || value_si.fract() == 0.0;
        if self.info.range.holds(value_si) && is_allowed {
            return Ok(());
        }
        let rule = if is_allowed {
            self.info.range.broken(value_si, self.kind)
        } else {
            "must be a whole number".to_owned()
        };
        Err(Fault::without_position(
            &self.path,
            format!("{} is {}; it {rule}", self.path, self.kind.show(value_si)),
        ))
    }

    pub(super) fn kind(&self) -> Kind {
        self.kind
    }

    fn store(&self, spec: &mut Spec, value: f64) {
        store(spec, &segments(&self.path), value);
        if let Some((path, value)) = &self.retained_value {
            store(spec, &segments(path), *value);
        }
    }
}

impl Spec {
    /// Sets one number by its dotted path, SI. For a mass on a spring, setting `mass` retains the
    /// stiffness; the key of [`SpecFile::numeric_key`](super::SpecFile::numeric_key) retains a
    /// given frequency. On an error the spec is unchanged.
    ///
    /// # Errors
    /// As [`NumericKey::find`] and [`NumericKey::set`].
    pub fn set_si(&mut self, path: &str, value_si: f64) -> Result<(), Fault> {
        NumericKey::find(self, path)?.set(self, value_si)
    }
}

fn segments(path: &str) -> Vec<&str> {
    path.split('.').collect()
}

/// Returns the length of the list at a path; 0 if there is no list.
fn listed(spec: &Spec, path: &str) -> usize {
    let is_listed = |number: &usize| {
        let entry = locate(spec, &segments(&format!("{path}.{number}")));
        entry.is_some_and(|entry| {
            entry.info.kind.is_list_of_numbers() || entry.info.kind == Kind::NamedNumbers
        })
    };
    (1..).take_while(is_listed).count()
}

/// Returns why there is no number at a path.
fn no_number(spec: &Spec, path: &str) -> String {
    let above = path
        .rsplit_once('.')
        .map(|(list, _)| (list, listed(spec, list)))
        .filter(|(_, count)| *count > 0);
    match (listed(spec, path), above) {
        (0, None) => super::keys::no_number(spec, path).to_owned(),
        (0, Some((list, count))) => beyond(list, count),
        (count, _) => format!("this is a list; {}", one_of(path, count)),
    }
}

/// Returns the message for a number that is not in a list.
pub(super) fn beyond(list: &str, count: usize) -> String {
    format!(
        "{list} holds {}; {}",
        if count == 1 {
            "1 number".to_owned()
        } else {
            format!("{count} numbers")
        },
        one_of(list, count)
    )
}

fn one_of(list: &str, count: usize) -> String {
    if count == 1 {
        format!("write {list}.1")
    } else {
        format!("write one of {list}.1 to {list}.{count}")
    }
}

/// Returns the index of a number in its list; numbers are counted from 1.
pub(super) fn list_index(number: &str) -> Option<usize> {
    number.parse::<usize>().ok()?.checked_sub(1)
}

/// Returns the number at a path below an element.
fn locate(element: &dyn Element, path: &[&str]) -> Option<Numeric> {
    let (name, rest) = path.split_first()?;
    let (index, info) = element.applicable(name)?;
    let numeric = |value| Numeric {
        info: *info,
        kind: element.kind(index, info),
        value,
    };
    match (element.get(index), rest) {
        (ValueRef::Number(value) | ValueRef::Derived(value), []) => Some(numeric(value)),
        (ValueRef::Optional(value), []) => value.map(numeric),
        (ValueRef::Count(count), []) => Some(numeric(count as f64)),
        (ValueRef::NamedQuantities(values), [name]) => values.get(*name).copied().map(numeric),
        (ValueRef::Numbers(list) | ValueRef::DerivedNumbers { list, .. }, [number]) => {
            one_of_list(info, list, number)
        }
        (ValueRef::NamedNumbers(lists), [name, number]) => {
            one_of_list(info, lists.get(*name)?, number)
        }
        (ValueRef::Table(inner), rest) => locate(inner, rest),
        (ValueRef::Things(inner), [name, rest @ ..]) => locate(inner.get(name)?, rest),
        _ => None,
    }
}

fn one_of_list(info: &KeyInfo, list: &[f64], number: &str) -> Option<Numeric> {
    Some(Numeric {
        info: *info,
        kind: info.kind.of_one(),
        value: *list.get(list_index(number)?)?,
    })
}

/// Stores a number at a path below an element; without one, nothing changes.
fn store(element: &mut dyn Element, path: &[&str], value: f64) {
    let Some((name, rest)) = path.split_first() else {
        return;
    };
    let Some((index, _)) = element.applicable(name) else {
        return;
    };
    let slot = match (element.open(index), rest) {
        (ValueMut::Number, []) => return element.set_number(index, value),
        (ValueMut::NamedQuantities(values), [name]) => values.get_mut(*name),
        (ValueMut::Numbers(list), [number]) => in_list(list, number),
        (ValueMut::NamedNumbers(lists), [name, number]) => {
            lists.get_mut(*name).and_then(|list| in_list(list, number))
        }
        (ValueMut::Table(inner), rest) => return store(inner, rest, value),
        (ValueMut::Things(inner), [name, rest @ ..]) => {
            if let Some(inner) = inner.get_mut(name) {
                store(inner, rest, value);
            }
            return;
        }
        _ => None,
    };
    if let Some(slot) = slot {
        *slot = value;
    }
}

fn in_list<'l>(list: &'l mut [f64], number: &str) -> Option<&'l mut f64> {
    list.get_mut(list_index(number)?)
}
