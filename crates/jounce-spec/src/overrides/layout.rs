//! Layout of overrides that are written into a document.

use toml_edit::{InlineTable, Item, Table, Value};

/// Returns a value as the item that replaces another one: a table under its header.
pub(super) fn replacement(mut value: Value, old: Option<&Item>) -> Item {
    if let Some(old) = old.and_then(Item::as_value) {
        *value.decor_mut() = old.decor().clone();
        return Item::Value(value);
    }
    let Value::InlineTable(inline) = value else {
        return Item::Value(value);
    };
    let mut table = with_headers(inline);
    if let Some(old) = old.and_then(Item::as_table) {
        *table.decor_mut() = old.decor().clone();
        table.set_position(old.position());
    }
    Item::Table(table)
}

/// Returns an inline table with a header for each table in it.
fn with_headers(inline: InlineTable) -> Table {
    let mut table = inline.into_table();
    table.fmt();
    for (_, item) in table.iter_mut() {
        if let Some(inner) = item.as_inline_table() {
            *item = Item::Table(with_headers(inner.clone()));
        }
    }
    let holds_only_tables = !table.is_empty() && table.iter().all(|(_, item)| item.is_table());
    table.set_implicit(holds_only_tables);
    table
}

/// Returns a table that has a header only if it has keys.
pub(super) fn implicit_table() -> Table {
    let mut table = Table::new();
    table.set_implicit(true);
    table
}
