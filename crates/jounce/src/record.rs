//! Input files of a command, for the record of its tables.

use jounce_io::table::RecordedInput;
use sha2::{Digest, Sha256};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Largest TOML file whose text is recorded, bytes.
const MAX_TEXT_BYTES: u64 = 16 << 20;

/// Returns the input files of a command: those that its arguments name, those that a TOML file among
/// them names, relative to its folder, and the notes of the channels of recordings. A value of
/// `--set` may be relative to the folder of the spec.
pub fn recorded_inputs(arguments: &[String]) -> Vec<RecordedInput> {
    let mut found = Vec::new();
    for value in arguments.iter().flat_map(|argument| values(argument)) {
        add(Path::new(value), &mut found);
    }
    let folders: Vec<PathBuf> = found.iter().filter_map(folder_of_text).collect();
    for value in arguments.iter().flat_map(|argument| values(argument)) {
        folders
            .iter()
            .for_each(|folder| add(&folder.join(value), &mut found));
    }
    found
}

/// Returns the SHA-256 of a file in hexadecimal; the file is read in blocks.
///
/// # Errors
/// A file that cannot be read.
pub fn file_sha256(path: &Path) -> std::io::Result<String> {
    let mut input = std::fs::File::open(path)?;
    let (mut hash, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        let count = input.read(&mut buffer)?;
        if count == 0 {
            return Ok(format!("{:x}", hash.finalize()));
        }
        hash.update(&buffer[..count]);
    }
}

/// Returns the SHA-256 of a text in hexadecimal.
pub fn text_sha256(text: &str) -> String {
    format!("{:x}", Sha256::digest(text.as_bytes()))
}

/// Returns an argument and the values after its equals signs.
fn values(argument: &str) -> impl Iterator<Item = &str> {
    let after = argument.match_indices('=');
    let after = after.map(|(index, _)| argument[index + 1..].trim_matches('"'));
    std::iter::once(argument).chain(after)
}

/// Adds a file, if it is one, with the files that it names.
fn add(path: &Path, found: &mut Vec<RecordedInput>) {
    let Some(name) = path.to_str() else {
        return;
    };
    if found.iter().any(|input| input.path == name) || !path.is_file() {
        return;
    }
    let text = text(path);
    let sha256 = match &text {
        Some(text) => text_sha256(text),
        None => match file_sha256(path) {
            Ok(sha256) => sha256,
            Err(_) => return,
        },
    };
    let named = text.as_deref().map_or_else(Vec::new, texts);
    found.push(RecordedInput {
        path: name.to_owned(),
        sha256,
        text,
    });
    let folder = path.parent().unwrap_or(Path::new(""));
    for value in named {
        add(&folder.join(value), found);
    }
    add(Path::new(&format!("{name}.channels.toml")), found);
}

/// Returns the text of a TOML file.
fn text(path: &Path) -> Option<String> {
    let is_toml = path
        .extension()
        .is_some_and(|extension| extension == "toml");
    let is_small = std::fs::metadata(path).ok()?.len() <= MAX_TEXT_BYTES;
    (is_toml && is_small).then(|| std::fs::read_to_string(path).ok())?
}

fn folder_of_text(input: &RecordedInput) -> Option<PathBuf> {
    let folder = Path::new(&input.path).parent().map(Path::to_path_buf);
    folder.filter(|_| input.text.is_some())
}

/// Returns all texts among the values of a TOML document.
fn texts(document: &str) -> Vec<String> {
    let mut texts = Vec::new();
    if let Ok(document) = document.parse::<toml_edit::DocumentMut>() {
        collect(document.as_item(), &mut texts);
    }
    texts
}

fn collect(item: &toml_edit::Item, texts: &mut Vec<String>) {
    if let Some(tables) = item.as_array_of_tables() {
        let items = tables.iter().flat_map(toml_edit::Table::iter);
        items.for_each(|(_, item)| collect(item, texts));
    } else if let Some(table) = item.as_table_like() {
        table.iter().for_each(|(_, item)| collect(item, texts));
    } else if let Some(value) = item.as_value() {
        of_value(value, texts);
    }
}

fn of_value(value: &toml_edit::Value, texts: &mut Vec<String>) {
    match value {
        toml_edit::Value::String(text) => texts.push(text.value().clone()),
        toml_edit::Value::Array(values) => values.iter().for_each(|value| of_value(value, texts)),
        toml_edit::Value::InlineTable(table) => {
            table.iter().for_each(|(_, value)| of_value(value, texts));
        }
        _ => {}
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn files_named_in_files_are_inputs_too() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path.to_str().unwrap().to_owned()
        };
        file("rec.csv", "t,a\n0,1\n");
        file("rec.csv.channels.toml", "[channel.a]\nunit = \"V\"\n");
        file("other.csv", "t,a\n0,2\n");
        file(
            "spec.toml",
            "[drive.floor]\nfile = \"rec.csv\"\n[[list]]\nof = [{ a = \"rest\" }]\n",
        );
        let study = file("study.toml", "spec = \"spec.toml\"\n");
        let arguments = [
            study,
            "--set".to_owned(),
            "drive.floor.file=other.csv".to_owned(),
        ];
        let inputs = recorded_inputs(&arguments);
        let name = |input: &RecordedInput| input.path.rsplit('/').next().unwrap().to_owned();
        let names: Vec<String> = inputs.iter().map(name).collect();
        let expected = [
            "study.toml",
            "spec.toml",
            "rec.csv",
            "rec.csv.channels.toml",
            "other.csv",
        ];
        assert_eq!(names, expected);
        assert!(inputs[0].text.is_some() && inputs[2].text.is_none());
        for input in &inputs {
            assert_eq!(input.sha256, file_sha256(Path::new(&input.path)).unwrap());
        }
    }
}
