//! Table as JSON in an element of an HTML page, which scripts read and [`Table::read`] too.

use serde_json::{Value, json};

use super::json::array;
use super::notes::Notes;
use super::{Manifest, Table, Values};

/// Begin of the element.
const BEGIN: &str = "<script type=\"application/json\" id=\"table\">";

/// End of the element.
const END: &str = "</script>";

/// Returns the element: one JSON object with the notes of a sidecar and `values`, a list for each
/// column. Numbers are the shortest text that reads back to the same bits; `NaN`, `inf` and `-inf`
/// are text, because JSON lacks them. No text can end the element.
pub(super) fn encode(table: &Table, manifest: &Manifest) -> String {
    let notes = Notes::of(table, manifest);
    let columns = table.columns().iter();
    let values: Vec<Value> = columns
        .map(|column| array(&column.values, number))
        .collect();
    let data = json!({ "manifest": notes.manifest, "columns": notes.columns, "values": values });
    let text = data.to_string().replace('<', "\\u003c");
    format!("{BEGIN}{text}{END}")
}

/// Reads the table of a page.
pub(super) fn decode(page: &str) -> Result<(Table, Manifest), String> {
    if !page.trim_end().ends_with("</html>") {
        return Err("its end is missing: it is no complete page".to_owned());
    }
    let data = page.split_once(BEGIN).map(|(_, rest)| rest);
    let data = data.and_then(|rest| Some(rest.split_once(END)?.0));
    let data = data.ok_or("it is no page of jounce with a table")?;
    let mut data: Value = serde_json::from_str(data).map_err(|fault| fault.to_string())?;
    let values = data.as_object_mut().and_then(|data| data.remove("values"));
    let Some(Value::Array(lists)) = values else {
        return Err("its table has no values".to_owned());
    };
    let notes = Notes::from_json(&data.to_string())?;
    if notes.columns.len() != lists.len() {
        return Err("its table has notes of other columns".to_owned());
    }
    let pairs = notes.columns.iter().zip(lists);
    let values = pairs.map(|(note, list)| Values::parse(&note.kind, texts(&note.name, list)?));
    let values = values.collect::<Result<Vec<Values>, String>>()?;
    notes.join(values)
}

/// Returns the values of a list as text.
fn texts(column: &str, list: Value) -> Result<Vec<String>, String> {
    let Value::Array(values) = list else {
        return Err(format!("column {column} is no list"));
    };
    let text = |value| match value {
        Value::String(text) => text,
        value => value.to_string(),
    };
    Ok(values.into_iter().map(text).collect())
}

fn number(x: f64) -> Value {
    match x.is_finite() {
        true => Value::from(x),
        false => Value::from(format!("{x:?}")),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::Column;
    use super::*;

    fn table() -> Table {
        let numbers = vec![0.1 + 0.2, 5e-324, -0.0, f64::NAN, f64::NEG_INFINITY];
        let texts = ["", "</script><b>", "<!-- 1", "a\nb", "NaN"].map(str::to_owned);
        Table::new(vec![
            Column::new("power_w", "W", "mean power", numbers),
            Column::new("point", "", "number", vec![0_u64, 1, 2, 3, u64::MAX]),
            Column::new("step", "", "", vec![-1_i64, 0, 1, 2, 3]),
            Column::new("settled", "", "", vec![true, false, true, true, true]),
            Column::new("failure", "", "reason", texts.to_vec()),
        ])
        .unwrap()
    }

    #[test]
    fn every_value_reads_back_to_the_same_bits() {
        let manifest = Manifest::new("ab").with("command", "study </script>");
        let page = format!(
            "<!doctype html>\n{}\n</html>\n",
            encode(&table(), &manifest)
        );
        let (read, read_manifest) = decode(&page).unwrap();
        assert_eq!(read_manifest, manifest);
        let texts = |table: &Table| {
            let text = |column: &Column| -> Vec<String> {
                (0..5).map(|row| column.values.text(row).unwrap()).collect()
            };
            table.columns().iter().map(text).collect::<Vec<_>>()
        };
        assert_eq!(texts(&read), texts(&table()));
        let bits = |table: &Table| -> Vec<u64> {
            let power_w = table.floats("power_w").unwrap();
            power_w.iter().map(|x| x.to_bits()).collect()
        };
        assert_eq!(bits(&read), bits(&table()));
        let heads = |table: &Table| -> Vec<(String, String, String)> {
            let head = |c: &Column| (c.name.clone(), c.unit.clone(), c.about.clone());
            table.columns().iter().map(head).collect()
        };
        assert_eq!(heads(&read), heads(&table()));
    }

    #[test]
    fn no_text_ends_the_element_or_opens_a_comment() {
        let element = encode(&table(), &Manifest::new("ab"));
        assert_eq!(element.matches('<').count(), 2, "{element}");
    }

    #[test]
    fn other_pages_are_refused() {
        let element = encode(&table(), &Manifest::new("ab")) + "</html>";
        assert!(decode(&element).is_ok());
        let damaged = [
            String::new(),
            element.replace("</html>", ""),
            "<html></html>".to_owned(),
            element.replace("</script>", ""),
            element.replace("\"values\"", "\"other\""),
            element.replace("[true,", "[1,"),
            element.replace("[true,", "["),
            element.replace("\"kind\":\"text\"", "\"kind\":\"picture\""),
            element.replace("\"values\":[[", "\"values\":[5,["),
        ];
        for page in damaged {
            assert!(decode(&page).is_err(), "{page}");
        }
    }
}
