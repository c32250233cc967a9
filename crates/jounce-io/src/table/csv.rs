//! Comma-separated text: one header line of names, one line per row; notes in a sidecar.

use crate::store::reason;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use super::notes::Notes;
use super::{Manifest, Table, Values};

/// Returns the path of the notes: `sweep.manifest.json` for `sweep.csv`.
pub(super) fn sidecar_path(path: &Path) -> PathBuf {
    path.with_extension("manifest.json")
}

pub(super) fn sidecar(table: &Table, manifest: &Manifest) -> String {
    Notes::of(table, manifest).to_json()
}

pub(super) fn encode(table: &Table) -> Result<Vec<u8>, String> {
    if table.columns().is_empty() {
        return Ok(Vec::new());
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    heads(&mut writer, table)
        .and_then(|()| rows(&mut writer, table))
        .map_err(|fault| fault.to_string())?;
    writer.into_inner().map_err(|fault| fault.to_string())
}

/// Writes tables of the same columns below one header line; only one table is in memory at a time.
pub(super) fn join<W: Write, E>(
    target: W,
    tables: impl IntoIterator<Item = Result<Table, E>>,
    failed: impl Fn(String) -> E,
) -> Result<(), E> {
    let mut writer = csv::Writer::from_writer(BufWriter::new(target));
    let to_error = |fault: csv::Error| failed(reason(&fault));
    let mut is_empty = true;
    for table in tables {
        let table = table?;
        if is_empty {
            heads(&mut writer, &table).map_err(to_error)?;
            is_empty = false;
        }
        rows(&mut writer, &table).map_err(to_error)?;
    }
    match is_empty {
        false => writer.flush().map_err(|fault| failed(reason(&fault))),
        true => Err(failed("there is no table to write".to_owned())),
    }
}

fn heads<W: Write>(writer: &mut csv::Writer<W>, table: &Table) -> Result<(), csv::Error> {
    writer.write_record(table.columns().iter().map(|column| &column.name))
}

fn rows<W: Write>(writer: &mut csv::Writer<W>, table: &Table) -> Result<(), csv::Error> {
    for row in 0..table.rows() {
        writer.write_record(
            table
                .columns()
                .iter()
                .map(|column| column.values.text(row).unwrap_or_default()),
        )?;
    }
    Ok(())
}

pub(super) fn decode(path: &Path) -> Result<(Table, Manifest), String> {
    let sidecar = sidecar_path(path);
    let notes = std::fs::read_to_string(&sidecar)
        .map_err(|fault| format!("its notes \"{}\": {}", sidecar.display(), reason(&fault)))?;
    let notes = Notes::from_json(&notes)?;
    let mut reader = csv::Reader::from_path(path).map_err(|fault| fault.to_string())?;
    let expected: Vec<_> = notes
        .columns
        .iter()
        .map(|note| note.name.as_str())
        .collect();
    if *reader.headers().map_err(|fault| fault.to_string())? != expected {
        return Err("its header is not the one in its notes".to_owned());
    }
    let mut fields = vec![Vec::new(); expected.len()];
    for record in reader.records() {
        let record = record.map_err(|fault| fault.to_string())?;
        fields
            .iter_mut()
            .zip(record.iter())
            .for_each(|(column, field)| column.push(field.to_owned()));
    }
    let parse = |(texts, kind): (_, &String)| Values::parse(kind, texts);
    let values = fields
        .into_iter()
        .zip(notes.columns.iter().map(|note| &note.kind))
        .map(parse)
        .collect::<Result<_, _>>()?;
    notes.join(values)
}
