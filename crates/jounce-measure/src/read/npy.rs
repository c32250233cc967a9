//! NumPy arrays: one or two dimensions of real numbers; the longer side is time.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use npyz::{DType, NpyFile, Order};

use super::contents::Found;
use super::error::Damage;
use super::raw::{Raw, RawChannel};
use crate::recording::{Finding, FindingKind};

pub(super) fn read(path: &Path) -> Result<Found, Damage> {
    let told = |fault: std::io::Error| Damage::new(format!("{fault}; was the file cut?"));
    let file = File::open(path).map_err(told)?;
    let bytes = file.metadata().map_err(told)?.len();
    let array = NpyFile::new(BufReader::new(file)).map_err(told)?;
    let shape = array.shape().to_vec();
    let (rows, columns) = match shape[..] {
        [count] => (1, count),
        [rows, columns] => (rows, columns),
        _ => return Err(Damage::new(format!("the array has {} dimensions; one or two are due", shape.len()))),
    };
    let order = array.order();
    let numbers = rows.checked_mul(columns).filter(|numbers| *numbers <= bytes);
    if numbers.is_none() {
        return Err(Damage::new(format!(
            "an array of {rows} x {columns} numbers is more than the {bytes} bytes of the file hold; was it cut?"
        )));
    }
    let values = values(array)?;
    let (rows, columns) = (rows as usize, columns as usize);
    let at = |row: usize, column: usize| if order == Order::C { values[row * columns + column] } else { values[column * rows + row] };
    let series: Vec<Vec<f64>> = if columns >= rows {
        (0..rows).map(|row| (0..columns).map(|column| at(row, column)).collect()).collect()
    } else {
        (0..columns).map(|column| (0..rows).map(|row| at(row, column)).collect()).collect()
    };
    let channels = series.into_iter().enumerate().map(|(k, values)| RawChannel::new(&format!("channel {}", k + 1), "", values)).collect();
    let about = format!("an array of {rows} x {columns} without names: its longer side is taken as time");
    Ok(Raw::columns(channels, vec![Finding::new(FindingKind::Assumed, 1, None, about)]).into())
}

/// The numbers in the order of the file.
fn values(array: NpyFile<BufReader<File>>) -> Result<Vec<f64>, Damage> {
    let dtype = match array.dtype() {
        DType::Plain(kind) => kind.to_string(),
        other => return Err(Damage::new(format!("its numbers are records ({}); save each as an array of its own", other.descr()))),
    };
    let told = |fault: std::io::Error| Damage::new(format!("{fault}; was the file cut?"));
    match dtype.get(1..).unwrap_or_default() {
        "f8" => array.into_vec::<f64>().map_err(told),
        "f4" => widened(array.into_vec::<f32>().map_err(told)?),
        "i4" => widened(array.into_vec::<i32>().map_err(told)?),
        "i2" => widened(array.into_vec::<i16>().map_err(told)?),
        "i1" => widened(array.into_vec::<i8>().map_err(told)?),
        "u4" => widened(array.into_vec::<u32>().map_err(told)?),
        "u2" => widened(array.into_vec::<u16>().map_err(told)?),
        "u1" => widened(array.into_vec::<u8>().map_err(told)?),
        "i8" => Ok(array.into_vec::<i64>().map_err(told)?.into_iter().map(|x| x as f64).collect()),
        "u8" => Ok(array.into_vec::<u64>().map_err(told)?.into_iter().map(|x| x as f64).collect()),
        _ => Err(Damage::new(format!("its numbers are of type {dtype}; real numbers are due (save real and imaginary parts apart)"))),
    }
}

fn widened<T: Into<f64>>(values: Vec<T>) -> Result<Vec<f64>, Damage> {
    Ok(values.into_iter().map(Into::into).collect())
}
