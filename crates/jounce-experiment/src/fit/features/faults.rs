//! Faults of a features file as a whole.

use toml_edit::TableLike;

use super::ModeFeature;
use super::table::FeatureFault;

/// Kinds of measured values, each in tables of its own.
pub(super) const KINDS: [&str; 5] = ["mode", "response", "power", "jump", "history"];

/// Returns the fault of a text that is not TOML.
pub(super) fn syntax_fault(text: &str, fault: &toml_edit::TomlError) -> FeatureFault {
    let start = fault.span().map(|span| span.start);
    let line = start.and_then(|start| {
        let begin = text[..start].rfind('\n').map_or(0, |end| end + 1);
        text[begin..].lines().next()
    });
    let is_header = |kind: &&&str| line.is_some_and(|line| line.trim() == format!("[{kind}]"));
    let message = match KINDS.iter().find(is_header) {
        Some(kind) => format!("{kind}: write [[{kind}]] with two brackets before each table"),
        None => format!("this is not valid TOML: {}", fault.message()),
    };
    FeatureFault { start, message }
}

/// Returns the fault of a mode that is measured twice under the same conditions.
pub(super) fn second_mode(
    text: &str,
    root: &dyn TableLike,
    modes: &[ModeFeature],
) -> Option<FeatureFault> {
    let is_same = |one: &ModeFeature, other: &ModeFeature| {
        let is_given_twice = one.frequency.is_some() && other.frequency.is_some()
            || one.damping_ratio.is_some() && other.damping_ratio.is_some();
        let conditions = |mode: &ModeFeature| (mode.number, mode.loaded, mode.set.clone());
        is_given_twice && conditions(one) == conditions(other)
    };
    let pair = |second: usize| {
        let first = (0..second).find(|first| is_same(&modes[*first], &modes[second]));
        first.map(|first| (first, second))
    };
    let (first, second) = (0..modes.len()).find_map(pair)?;
    let tables = root.get("mode")?.as_array_of_tables()?;
    let start = |index: usize| Some(tables.get(index)?.span()?.start);
    let line = text[..start(first)?].matches('\n').count() + 1;
    Some(FeatureFault {
        start: start(second),
        message: format!(
            "mode {} is measured twice under the same conditions, first on line {line}; give one of them, or their mean",
            modes[second].number
        ),
    })
}
