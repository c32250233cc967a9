//! Key reference of the book, generated from the table of keys.

use super::Spec;
use super::key::{Kind, Need, Range, Row, rows};

/// Returns every key of a spec as Markdown: one section with one table for each kind of element.
pub fn reference_markdown() -> String {
    let mut out = String::from(
        "# Keys of a spec\n\nA quantity is text with a unit, such as `\"0.98 mm\"`; the units listed here are examples.\n",
    );
    out.push_str("An element of a list is a key too, counted from 1: `damping.ratios.2` can be set, swept, continued and fitted.\n");
    for row in rows(&Spec::default()) {
        section(&row, "", &mut out);
    }
    out
}

fn section(row: &Row, above: &str, out: &mut String) {
    let name = if row.info.kind == Kind::Things {
        format!("{above}{}.NAME", row.info.name)
    } else {
        row.info.name.to_owned()
    };
    out.push_str(&format!(
        "\n## `[{name}]`\n\n{}.\n\n",
        capital(row.info.doc)
    ));
    out.push_str("| key | holds | allowed | default | meaning |\n|---|---|---|---|---|\n");
    for key in &row.inner {
        out.push_str(&line(key));
    }
    for key in row.inner.iter().filter(|key| !key.inner.is_empty()) {
        section(key, &format!("{name}."), out);
    }
}

fn line(row: &Row) -> String {
    let info = &row.info;
    let mut name = match info.kind {
        Kind::NamedQuantities(_) | Kind::NamedNumbers => format!("`{}.NAME`", info.name),
        Kind::Things => format!("`[.{}.NAME]`", info.name),
        _ => format!("`{}`", info.name),
    };
    if let Some(when) = info.when {
        let words: Vec<String> = when.is.iter().map(|word| format!("`{word}`")).collect();
        name.push_str(&format!(" with `{}` {}", when.key, words.join(", ")));
    }
    let quoted = |names: &[&str]| {
        names
            .iter()
            .map(|name| format!("`{name}`"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let default = match (info.need, &row.default) {
        (Need::Required, _) => "required".to_owned(),
        (Need::AtMostOne(names), _) => format!("none; at most one of {}", quoted(names)),
        (Need::OneOf(names), _) => format!("exactly one of {}", quoted(names)),
        (Need::Default, Some(default)) => format!("`{default}`"),
        (Need::Default, None) => "none".to_owned(),
    };
    let default = info.unless.map_or_else(
        || default.clone(),
        |other| format!("{default}, unless `{other}` gives it"),
    );
    format!(
        "| {name} | {} | {} | {default} | {} |\n",
        holds(info.kind),
        allowed(info.kind, &info.range),
        info.doc
    )
}

fn holds(kind: Kind) -> String {
    match kind {
        Kind::Quantity(quantity) => {
            format!("{}: {}", bare(quantity.kind()), quantity.units().join(", "))
        }
        Kind::NamedQuantities(quantity) => format!(
            "{} by name: {}",
            bare(quantity.kind()),
            quantity.units().join(", ")
        ),
        Kind::Number => "number".to_owned(),
        Kind::NumberOr(quantity) => format!(
            "number, or {}: {}",
            bare(quantity.kind()),
            quantity.units().join(", ")
        ),
        Kind::Quantities(quantity) => format!(
            "list, each {}: {}",
            quantity.kind(),
            quantity.units().join(", ")
        ),
        Kind::Count => "whole number".to_owned(),
        Kind::Numbers => "list of numbers".to_owned(),
        Kind::NamedNumbers => "list of numbers by name".to_owned(),
        Kind::ChoiceOrPath(_) => "choice or path".to_owned(),
        Kind::Path => "path".to_owned(),
        Kind::Text => "text".to_owned(),
        Kind::Choice(_) => "choice".to_owned(),
        Kind::Reference { what: noun } => format!("name of {noun}"),
        Kind::References { what: noun } => format!("list of names of {noun}"),
        Kind::Things | Kind::Table => "table".to_owned(),
    }
}

fn allowed(kind: Kind, range: &Range) -> String {
    match kind {
        Kind::Choice(words) => words
            .iter()
            .map(|word| format!("`{word}`"))
            .collect::<Vec<_>>()
            .join(", "),
        Kind::ChoiceOrPath(_)
        | Kind::Path
        | Kind::Text
        | Kind::Reference { .. }
        | Kind::References { .. }
        | Kind::Things
        | Kind::Table
        | Kind::NamedNumbers => String::new(),
        _ if *range == Range::ANY => "any".to_owned(),
        _ => range.rule(kind).trim_start_matches("must be ").to_owned(),
    }
}

fn bare(kind: &str) -> &str {
    kind.split_once(' ').map_or(kind, |(_, kind)| kind)
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(chars).collect()
    })
}
