//! Apache Parquet: typed columns, snappy; the notes under the metadata key `jounce`.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use crate::store::reason;
use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;

use super::column::unknown_kind;
use super::notes::Notes;
use super::{Column, Manifest, Table, Values};
use crate::parquet_check;

const KEY: &str = "jounce";

pub(super) fn encode(table: &Table, manifest: &Manifest) -> Result<Vec<u8>, String> {
    write(table, manifest).map_err(|fault| fault.to_string())
}

pub(super) fn decode(path: &Path) -> Result<(Table, Manifest), String> {
    read(File::open(path).map_err(|fault| fault.to_string())?)
}

pub(super) fn decode_bytes(bytes: &[u8]) -> Result<(Table, Manifest), String> {
    let in_file = || {
        let mut file = tempfile::tempfile()?;
        file.write_all(bytes)?;
        Ok(file)
    };
    read(in_file().map_err(|fault: std::io::Error| reason(&fault))?)
}

fn read(file: File) -> Result<(Table, Manifest), String> {
    parquet_check::footer(&file)?;
    let pages = file.try_clone().map_err(|fault| fault.to_string())?;
    let reader = SerializedFileReader::new(file).map_err(|fault| fault.to_string())?;
    parquet_check::page_headers(&pages, reader.metadata())?;
    let notes = notes_of(&reader)?;
    let columns = reader
        .metadata()
        .file_metadata()
        .schema_descr()
        .num_columns();
    if columns != notes.columns.len() {
        return Err(format!(
            "it has {columns} columns, its notes name {}",
            notes.columns.len()
        ));
    }
    let values = notes
        .columns
        .iter()
        .enumerate()
        .map(|(index, note)| read_column(&reader, index, &note.kind));
    let values = values.collect::<Result<_, _>>()?;
    notes.join(values)
}

/// Writes tables of the same columns to one file; only one table is in memory at a time.
pub(super) fn join<E>(
    target: &mut (dyn Write + Send),
    manifest: &Manifest,
    tables: impl IntoIterator<Item = Result<Table, E>>,
    failed: impl Fn(String) -> E,
) -> Result<(), E> {
    let (mut target, mut writer) = (Some(target), None);
    for table in tables {
        let table = table?;
        if let Some(target) = target.take() {
            writer = Some(begin(target, &table, manifest).map_err(|fault| failed(reason(&fault)))?);
        }
        if let Some(writer) = &mut writer {
            append(writer, &table).map_err(|fault| failed(reason(&fault)))?;
        }
    }
    match writer {
        Some(writer) => end(writer).map_err(|fault| failed(reason(&fault))),
        None => Err(failed("there is no table to write".to_owned())),
    }
}

fn write(table: &Table, manifest: &Manifest) -> Result<Vec<u8>, ParquetError> {
    let mut bytes = Vec::new();
    let mut writer = begin(&mut bytes, table, manifest)?;
    append(&mut writer, table)?;
    end(writer)?;
    Ok(bytes)
}

/// A file that is being written. Its type does not depend on that of the file, so that the writer
/// is compiled once.
type FileWriter<'a> = SerializedFileWriter<&'a mut (dyn Write + Send)>;

/// Begins a file for tables with the columns of this one.
fn begin<'a>(
    target: &'a mut (dyn Write + Send),
    table: &Table,
    manifest: &Manifest,
) -> Result<FileWriter<'a>, ParquetError> {
    let notes = KeyValue::new(KEY.to_owned(), Notes::of(table, manifest).to_json());
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(format!(
            "{} version {}",
            manifest.created_by, manifest.version
        ))
        .set_key_value_metadata(Some(vec![notes]))
        .build();
    SerializedFileWriter::new(target, Arc::new(schema(table)?), Arc::new(properties))
}

/// Appends the rows of a table as one row group.
fn append(writer: &mut FileWriter<'_>, table: &Table) -> Result<(), ParquetError> {
    let mut rows = writer.next_row_group()?;
    for column in table.columns() {
        let Some(mut target) = rows.next_column()? else {
            break;
        };
        write_column(&mut target, &column.values)?;
        target.close()?;
    }
    rows.close()?;
    Ok(())
}

/// Writes the end of a file.
fn end(writer: FileWriter<'_>) -> Result<(), ParquetError> {
    writer.close().map(drop)
}

fn schema(table: &Table) -> Result<Type, ParquetError> {
    let fields = table
        .columns()
        .iter()
        .map(field)
        .map(|f| f.map(Arc::new))
        .collect::<Result<_, _>>()?;
    Type::group_type_builder("table")
        .with_fields(fields)
        .build()
}

fn field(column: &Column) -> Result<Type, ParquetError> {
    let (physical, logical) = match column.values {
        Values::Float(_) => (Physical::DOUBLE, None),
        Values::Integer(_) => (Physical::INT64, None),
        Values::Count(_) => (Physical::INT64, Some(LogicalType::integer(64, false))),
        Values::Flag(_) => (Physical::BOOLEAN, None),
        Values::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::REQUIRED)
        .with_logical_type(logical)
        .build()
}

fn write_column(
    target: &mut SerializedColumnWriter<'_>,
    values: &Values,
) -> Result<usize, ParquetError> {
    match values {
        Values::Float(v) => target.typed::<DoubleType>().write_batch(v, None, None),
        Values::Integer(v) => target.typed::<Int64Type>().write_batch(v, None, None),
        // Parquet stores an unsigned integer as the signed integer with the same bits.
        Values::Count(v) => target.typed::<Int64Type>().write_batch(
            &v.iter().map(|x| x.cast_signed()).collect::<Vec<_>>(),
            None,
            None,
        ),
        Values::Flag(v) => target.typed::<BoolType>().write_batch(v, None, None),
        Values::Text(v) => {
            let texts: Vec<_> = v
                .iter()
                .map(|text| ByteArray::from(text.as_str()))
                .collect();
            target
                .typed::<ByteArrayType>()
                .write_batch(&texts, None, None)
        }
    }
}

fn notes_of(reader: &SerializedFileReader<File>) -> Result<Notes, String> {
    let pairs = reader.metadata().file_metadata().key_value_metadata();
    let notes = pairs
        .and_then(|pairs| pairs.iter().find(|pair| pair.key == KEY))
        .and_then(|pair| pair.value.as_deref());
    Notes::from_json(notes.ok_or("it has no notes of jounce")?)
}

fn read_column(
    reader: &SerializedFileReader<File>,
    index: usize,
    kind: &str,
) -> Result<Values, String> {
    let wrong = || {
        format!(
            "column {} does not hold the kind \"{kind}\" that its notes name",
            index + 1
        )
    };
    let mut parts = Vec::new();
    for group in 0..reader.num_row_groups() {
        let rows = reader
            .get_row_group(group)
            .map_err(|fault| fault.to_string())?;
        parts.push((
            rows.get_column_reader(index)
                .map_err(|fault| fault.to_string())?,
            rows.metadata().num_rows(),
        ));
    }
    match kind {
        "float" => typed(parts, doubles, wrong).map(Values::Float),
        "integer" => typed(parts, integers, wrong).map(Values::Integer),
        "count" => Ok(Values::Count(
            typed(parts, integers, wrong)?
                .into_iter()
                .map(i64::cast_unsigned)
                .collect(),
        )),
        "flag" => typed(parts, flags, wrong).map(Values::Flag),
        "text" => {
            let text = |bytes: ByteArray| {
                String::from_utf8(bytes.data().to_vec()).map_err(|fault| fault.to_string())
            };
            typed(parts, texts, wrong)?
                .into_iter()
                .map(text)
                .collect::<Result<_, _>>()
                .map(Values::Text)
        }
        other => Err(unknown_kind(other)),
    }
}

fn doubles(reader: ColumnReader) -> Option<ColumnReaderImpl<DoubleType>> {
    if let ColumnReader::DoubleColumnReader(reader) = reader {
        Some(reader)
    } else {
        None
    }
}

fn integers(reader: ColumnReader) -> Option<ColumnReaderImpl<Int64Type>> {
    if let ColumnReader::Int64ColumnReader(reader) = reader {
        Some(reader)
    } else {
        None
    }
}

fn flags(reader: ColumnReader) -> Option<ColumnReaderImpl<BoolType>> {
    if let ColumnReader::BoolColumnReader(reader) = reader {
        Some(reader)
    } else {
        None
    }
}

fn texts(reader: ColumnReader) -> Option<ColumnReaderImpl<ByteArrayType>> {
    if let ColumnReader::ByteArrayColumnReader(reader) = reader {
        Some(reader)
    } else {
        None
    }
}

fn typed<T: DataType>(
    parts: Vec<(ColumnReader, i64)>,
    pick: impl Fn(ColumnReader) -> Option<ColumnReaderImpl<T>>,
    wrong: impl Fn() -> String,
) -> Result<Vec<T::T>, String> {
    let mut values = Vec::new();
    for (part, rows) in parts {
        let rows = usize::try_from(rows).map_err(|fault| fault.to_string())?;
        let mut reader = pick(part).ok_or_else(&wrong)?;
        let (mut read, mut last) = (0, 1);
        while read < rows && last > 0 {
            last = reader
                .read_records(rows - read, None, None, &mut values)
                .map_err(|fault| fault.to_string())?
                .0;
            read += last;
        }
    }
    Ok(values)
}
