//! Apache Parquet: every numeric column; unit and quantity from the notes of jounce if it wrote the
//! file.

mod pages;

use std::fs::File;
use std::path::Path;

use jounce_io::parquet_check;
use parquet::basic::Type;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::DataType;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescPtr;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Raw, RawColumn, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::heading::name;
use crate::read::notes::written::WrittenNotes;
use crate::recording::{Issue, IssueKind, Series};
use pages::CheckedPages;

/// Metadata key of the notes of jounce.
const NOTES: &str = "jounce";
/// Number of values decoded at once.
const BATCH: usize = 1 << 16;

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let parquet_error = |fault: &dyn std::fmt::Display| {
        Damage::new(format!(
            "{fault}; is the file \
        truncated?"
        ))
    };
    let file = File::open(path).map_err(|fault| parquet_error(&fault))?;
    let size = file
        .metadata()
        .map_err(|fault| parquet_error(&fault))?
        .len();
    parquet_check::footer(&file).map_err(|fault| parquet_error(&fault))?;
    let pages = file.try_clone().map_err(|fault| parquet_error(&fault))?;
    let reader = SerializedFileReader::new(file).map_err(|fault| parquet_error(&fault))?;
    check_places(&reader, size)?;
    parquet_check::page_headers(&pages, reader.metadata())
        .map_err(|fault| parquet_error(&fault))?;
    let notes = notes(&reader);
    let (mut columns, mut issues) = (Vec::new(), Vec::new());
    let schema = reader.metadata().file_metadata().schema_descr_ptr();
    for (index, column) in schema.columns().iter().enumerate() {
        let head = column.path().string();
        match values(&reader, index, column, store)
            .map_err(|why| Damage::new(format!("column {head}: {why}")))?
        {
            Some(values) => {
                // The notes of jounce give the unit; the heading is the name, including any
                // brackets.
                let notes_text = notes
                    .as_ref()
                    .and_then(|notes| notes.unit(&head))
                    .map(|unit| (head.clone(), unit));
                let (name, unit) = notes_text.unwrap_or_else(|| {
                    issues.extend(name::ambiguity_issue(&head));
                    name::split(&head)
                });
                let mut column = RawColumn::new(&name, &unit, values);
                notes.iter().for_each(|notes| notes.apply_to(&mut column));
                columns.push(column);
            }
            None => issues.push(Issue::new(
                IssueKind::Skipped,
                1,
                None,
                format!("column {head} contains no numbers"),
            )),
        }
    }
    if columns.is_empty() {
        return Err(Damage::new("it contains no column of numbers"));
    }
    Ok(Raw {
        stamps: TimeStamps::Named,
        ..Raw::columns(columns, issues)
    }
    .into())
}

/// Refuses columns outside the file and negative counts, at which the library would panic.
fn check_places(reader: &SerializedFileReader<File>, size: u64) -> Result<(), Damage> {
    let metadata = reader.metadata();
    let rows = metadata
        .row_groups()
        .iter()
        .try_fold(0_i64, |rows, group| rows.checked_add(group.num_rows()));
    if rows != Some(metadata.file_metadata().num_rows()) {
        return Err(Damage::new(
            "its groups differ in number of rows from the file: is the file truncated?",
        ));
    }
    for group in metadata.row_groups() {
        for column in group.columns() {
            let start = column
                .dictionary_page_offset()
                .unwrap_or_else(|| column.data_page_offset());
            let numbers = [
                start,
                column.data_page_offset(),
                column.compressed_size(),
                column.uncompressed_size(),
                column.num_values(),
            ];
            let end = numbers[0]
                .checked_add(column.compressed_size())
                .and_then(|end| u64::try_from(end).ok());
            let is_list = column.column_descr().max_rep_level() > 0;
            if !is_list && column.num_values() != group.num_rows() {
                let (path, values, rows) = (
                    column.column_path().string(),
                    column.num_values(),
                    group.num_rows(),
                );
                return Err(Damage::new(format!(
                    "column {path} has {values} values for {rows} rows: is the file truncated?"
                )));
            }
            if group.num_rows() < 0
                || numbers.iter().any(|number| *number < 0)
                || end.is_none_or(|end| end > size)
            {
                let why = format!(
                    "column {} starts at byte {start}, outside the file of {size} bytes",
                    column.column_path().string()
                );
                return Err(Damage::new(format!("{why}; is the file truncated?")));
            }
        }
    }
    Ok(())
}

/// Reads the notes of jounce; `None` for a file of another program.
fn notes(reader: &SerializedFileReader<File>) -> Option<WrittenNotes> {
    let text = reader.metadata().file_metadata().key_value_metadata()?;
    WrittenNotes::from_json(
        text.iter()
            .find(|pair| pair.key == NOTES)?
            .value
            .as_deref()?,
    )
}

/// Reads the numbers of a column, NaN where missing; `None` for other types.
fn values(
    reader: &SerializedFileReader<File>,
    index: usize,
    column: &ColumnDescPtr,
    store: &SampleStore,
) -> Result<Option<ColumnNumbers>, String> {
    let is_number = matches!(
        column.physical_type(),
        Type::DOUBLE | Type::FLOAT | Type::INT32 | Type::INT64
    );
    if !is_number || column.max_rep_level() > 0 {
        return Ok(None);
    }
    let optional = column.max_def_level();
    let mut values = store.column();
    let rows = usize::try_from(reader.metadata().file_metadata().num_rows())
        .map_err(|fault| fault.to_string())?;
    if !values.expect(rows) {
        return Err(format!("{rows} rows do not fit into memory"));
    }
    for group in 0..reader.num_row_groups() {
        let rows = reader
            .get_row_group(group)
            .map_err(|fault| fault.to_string())?;
        let count =
            usize::try_from(rows.metadata().num_rows()).map_err(|fault| fault.to_string())?;
        let target = values.count() + count;
        let pages = rows
            .get_column_page_reader(index)
            .map_err(|fault| fault.to_string())?;
        match get_column_reader(column.clone(), Box::new(CheckedPages::new(pages, optional))) {
            ColumnReader::DoubleColumnReader(r) => typed(r, count, optional, |x| x, &mut values)?,
            ColumnReader::FloatColumnReader(r) => {
                typed(r, count, optional, f64::from, &mut values)?
            }
            ColumnReader::Int32ColumnReader(r) => {
                typed(r, count, optional, f64::from, &mut values)?
            }
            ColumnReader::Int64ColumnReader(r) => {
                typed(r, count, optional, |x| x as f64, &mut values)?
            }
            _ => return Ok(None),
        }
        if values.count() != target {
            return Err(format!(
                "row group {} holds {} of {count} values",
                group + 1,
                values.count() + count - target
            ));
        }
    }
    Ok(Some(values))
}

fn typed<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    count: usize,
    optional: i16,
    number: impl Fn(T::T) -> f64,
    values: &mut ColumnNumbers,
) -> Result<(), String> {
    let (mut present, mut levels, mut read) = (Vec::new(), Vec::new(), 0);
    while read < count {
        present.clear();
        levels.clear();
        let definition = (optional > 0).then_some(&mut levels);
        let most = (count - read).min(BATCH);
        let (records, ..) = reader
            .read_records(most, definition, None, &mut present)
            .map_err(|fault| fault.to_string())?;
        if records == 0 {
            break;
        }
        read += records;
        let mut numbers = present.drain(..).map(&number);
        if optional == 0 {
            numbers.try_for_each(|x| values.push(x))
        } else {
            let mut of = |level: &i16| {
                if *level == optional {
                    numbers.next().unwrap_or(f64::NAN)
                } else {
                    f64::NAN
                }
            };
            levels.iter().try_for_each(|level| values.push(of(level)))
        }
        .map_err(|fault| Damage::from(fault).why)?;
    }
    Ok(())
}
