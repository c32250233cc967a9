//! Subject of a message: the kind and the name of a part of the harvester.

/// Returns kind and name of a part, `stop tip`, and the kind alone where the name is the same word.
pub(super) fn named(kind: &str, name: &str) -> String {
    if kind == name {
        kind.to_owned()
    } else {
        format!("{kind} {name}")
    }
}
