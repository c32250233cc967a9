//! Tables: present, missing and unknown keys.

use super::value::read_slot;
use super::{ReadState, join, missing_choice};
use crate::key::{Element, KeyInfo, Kind, Need, ValueRef};
use crate::nearest::{clip, did_you_mean, join_words, nearest};
use crate::source::{Entry, Node, SourcePlace, Value};
use std::borrow::Cow;
use std::collections::HashMap;

/// Reads a table of keys into an element. Choices precede the keys that depend on them in the table
/// of keys.
pub(crate) fn read_keys(
    path: &str,
    node: &Node,
    element: &mut dyn Element,
    reading: &mut ReadState,
) {
    let Some(entries) = node.entries() else {
        return reading.fault(node.position, path, || {
            format!(
                "expected a table: write [{path}] with its keys below; found {}",
                node.found()
            )
        });
    };
    let infos: Vec<&KeyInfo> = element.keys().map(|(_, info)| info).collect();
    let names: Vec<&str> = infos.iter().map(|info| info.name).collect();
    let written = entries;
    let corrected = with_misspelt_tables(&infos, &names, written);
    let entries = corrected.as_ref();
    reading.misspelt.extend(misspelt(&names, path, entries));
    let mut doubtful: Vec<&str> = Vec::new();
    for (index, info) in infos.iter().copied().enumerate() {
        if let Some(choice) = info
            .when
            .map(|when| when.key)
            .filter(|choice| doubtful.contains(choice))
        {
            if !names[..index].contains(&info.name)
                && let Some(entry) = entries.iter().find(|entry| entry.name == info.name)
            {
                missing_choice::check(choice, path, entry, element, reading);
            }
            continue;
        }
        let unmeasured = info.measured_by.is_some_and(|by| {
            doubtful.contains(&by) || element.dependent_quantity(index).is_none()
        });
        if unmeasured || !element.applies(info) {
            continue;
        }
        let Some(entry) = entries.iter().find(|entry| entry.name == info.name) else {
            if missing(&names, info, path, (node.position, entries), reading) {
                doubtful.push(info.name);
            }
            continue;
        };
        if let ValueRef::DerivedNumbers { of, .. } = element.get(index) {
            let stored = join(path, of);
            reading.written_as.insert(stored, join(path, info.name));
        }
        let path = join(path, info.name);
        reading.positions.insert(path.clone(), entry.node.position);
        if !read_slot((index, info), &path, &entry.node, element, reading) {
            doubtful.push(info.name);
        }
    }
    let applicable: Vec<&KeyInfo> = (infos.iter().copied())
        .filter(|info| element.applies(info))
        .collect();
    for entry in written {
        if reading.has_room() {
            let all = [&infos[..], &applicable];
            check_known(all, path, entry, element, &doubtful, reading);
        }
    }
    check_alternatives(&applicable, path, entries, reading);
}

/// Returns the keys with each table of a misspelt name as part of the table that the name probably
/// means, so that its keys are checked too.
fn with_misspelt_tables<'e>(
    infos: &[&KeyInfo],
    names: &[&str],
    entries: &'e [Entry],
) -> Cow<'e, [Entry]> {
    let is_meant = |meant: &&str| {
        let named = |info: &&KeyInfo| info.name == *meant && info.kind.is_table();
        infos.iter().any(named)
    };
    let meant = |entry: &'e Entry| {
        let is_unknown = entry.node.entries().is_some() && !names.contains(&entry.name.as_str());
        let meant = is_unknown.then(|| nearest(&entry.name, names)).flatten();
        (meant.filter(is_meant), entry)
    };
    let meant: Vec<(Option<&str>, &Entry)> = entries.iter().map(meant).collect();
    if meant.iter().all(|(name, _)| name.is_none()) {
        return Cow::Borrowed(entries);
    }
    let named = meant.into_iter();
    let named = named.map(|(name, entry)| (name.unwrap_or(&entry.name), entry));
    Cow::Owned(merged(named.collect()))
}

/// Returns the keys with all tables of one name as one table.
fn merged(entries: Vec<(&str, &Entry)>) -> Vec<Entry> {
    let mut groups: Vec<(&str, Vec<&Entry>)> = Vec::new();
    let mut places: HashMap<&str, usize> = HashMap::new();
    for (name, entry) in entries {
        let place = *places.entry(name).or_insert(groups.len());
        match groups.get_mut(place) {
            Some((_, group)) => group.push(entry),
            None => groups.push((name, vec![entry])),
        }
    }
    let combined = |(name, group): (&str, Vec<&Entry>)| {
        let mut first = group[0].renamed(name);
        if let (Value::Table(keys), [_, _, ..]) = (&mut first.node.value, &group[..]) {
            let all = group.iter().filter_map(|entry| entry.node.entries());
            let all = all.flatten().map(|entry| (entry.name.as_str(), entry));
            *keys = merged(all.collect());
        }
        first
    };
    groups.into_iter().map(combined).collect()
}

/// Returns the dotted paths of the keys that unknown keys of a table probably mean.
fn misspelt(names: &[&str], path: &str, entries: &[Entry]) -> Vec<String> {
    let unknown = entries
        .iter()
        .filter(|entry| !names.contains(&entry.name.as_str()));
    let meant = unknown.filter_map(|entry| nearest(&entry.name, names));
    meant.map(|meant| join(path, meant)).collect()
}

/// Reports a required key that is absent, unless a misspelt key replaces it; true if one is
/// missing.
fn missing(
    names: &[&str],
    info: &KeyInfo,
    path: &str,
    (position, entries): (SourcePlace, &[Entry]),
    reading: &mut ReadState,
) -> bool {
    let stands = |name: &&str| entries.iter().any(|entry| entry.name == *name);
    let instead = info
        .unless
        .map_or_else(String::new, |other| format!(", or give `{other}`"));
    let text = || match info.need {
        Need::OneOf(names) => format!("one of {} is missing", quoted(names)),
        _ => format!(
            "`{}` is missing; {}{}",
            info.name,
            info.kind.expectation(),
            instead
        ),
    };
    let is_replaced = info.unless.is_some_and(|other| stands(&other));
    let must = match info.need {
        _ if is_replaced => false,
        Need::Default | Need::AtMostOne(_) => false,
        Need::Required => true,
        Need::OneOf(names) => names.first() == Some(&info.name) && !names.iter().any(stands),
    };
    let misspelt = |entry: &Entry| {
        let meant = nearest(&entry.name, names);
        let replaces = |meant: &str| {
            meant == info.name
                || info.unless == Some(meant)
                || info.need.alternatives().contains(&meant)
        };
        !names.contains(&entry.name.as_str()) && meant.is_some_and(replaces)
    };
    if must && reading.complete && reading.has_room() && !entries.iter().any(misspelt) {
        reading.fault(position, path, text);
    }
    must
}

/// Reports a key that no row has, or whose rows do not apply.
fn check_known(
    [infos, applicable]: [&[&KeyInfo]; 2],
    path: &str,
    entry: &Entry,
    element: &dyn Element,
    doubtful: &[&str],
    reading: &mut ReadState,
) {
    let named = || infos.iter().filter(|info| info.name == entry.name);
    let key = join(path, &entry.name);
    if named().next().is_none() {
        let names = distinct(infos.iter().map(|info| info.name));
        return reading.fault(entry.position, &key, || {
            format!(
                "unknown key{}; keys here: {}",
                did_you_mean(&entry.name, &names),
                join_words(&names)
            )
        });
    }
    if applicable.iter().any(|info| info.name == entry.name) {
        return;
    }
    let Some(when) = named()
        .find_map(|info| info.when)
        .filter(|when| !doubtful.contains(&when.key))
    else {
        return;
    };
    let words = distinct(
        named()
            .filter_map(|info| info.when)
            .flat_map(|when| when.is.iter().copied()),
    );
    reading.fault(entry.position, &key, || {
        format!(
            "does not apply with {} = \"{}\", only with {}",
            when.key,
            element.chosen(when.key).unwrap_or_default(),
            join_words(&words)
        )
    });
}

/// Reports a second key of a group of which exactly one is given.
fn check_alternatives(
    applicable: &[&KeyInfo],
    path: &str,
    entries: &[Entry],
    reading: &mut ReadState,
) {
    for info in applicable {
        let names = info.need.alternatives();
        let mut standing = entries
            .iter()
            .filter(|entry| names.contains(&entry.name.as_str()));
        if names.first() == Some(&info.name)
            && let (Some(first), Some(second)) = (standing.next(), standing.next())
        {
            let key = join(path, &second.name);
            reading.fault(second.position, &key, || {
                format!(
                    "`{}` is given too; give exactly one of {}",
                    first.name,
                    quoted(names)
                )
            });
        }
    }
}

/// Reads a table with names chosen by the user. `kind` is the kind of each entry.
pub(crate) fn read_named(
    path: &str,
    node: &Node,
    kind: Kind,
    reading: &mut ReadState,
    read: &mut dyn FnMut(&str, &str, &Node, &mut ReadState),
) {
    let Some(entries) = node.entries() else {
        let hint = match kind {
            Kind::Things => {
                format!("expected named elements: write [{path}.NAME] with its keys below")
            }
            _ => format!("expected a table: write [{path}] with NAME = VALUE below"),
        };
        return reading.fault(node.position, path, || {
            format!("{hint}; found {}", node.found())
        });
    };
    let mut unknown_keys = 0;
    for entry in entries {
        let path_of = join(path, &entry.name);
        let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if entry.name.is_empty() || !entry.name.chars().all(allowed) {
            reading.fault(entry.position, path, || {
                format!(
                    "the name {:?} is not allowed; use the letters a to z and A to Z, digits, _ and -",
                    clip(&entry.name)
                )
            });
        }
        if matches!(kind, Kind::Things) && entry.node.entries().is_none() {
            unknown_keys += 1;
            if unknown_keys == 1 {
                let text =
                    || format!("expected a name here: write [{path}.NAME] with its keys below");
                reading.fault(entry.position, &path_of, text);
            }
            continue;
        }
        reading.positions.insert(path_of.clone(), entry.position);
        read(&entry.name, &path_of, &entry.node, reading);
    }
}

fn quoted(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(" or ")
}

fn distinct<'k>(names: impl Iterator<Item = &'k str>) -> Vec<&'k str> {
    let mut names_so_far = Vec::new();
    for name in names {
        if !names_so_far.contains(&name) {
            names_so_far.push(name);
        }
    }
    names_so_far
}
