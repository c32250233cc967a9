//! NumPy arrays: one or two dimensions of real numbers; the longer side is time.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use npyz::half::f16;
use npyz::{DType, Deserialize, NpyFile, Order};

use super::contents::Found;
use super::error::Damage;
use super::raw::{Column, Raw};
use super::shelf::Shelf;
use crate::recording::{Finding, FindingKind};

pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
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
    // The longer side is time; numbers of a row (C) or of a column (Fortran) follow each other in the file.
    let (inner, outer_is_row) = if order == Order::C { (columns, true) } else { (rows, false) };
    let series_are_rows = columns >= rows;
    let (count, length) = (rows.min(columns) as usize, rows.max(columns) as usize);
    let mut series: Vec<_> = (0..count).map(|_| shelf.column()).collect();
    if !series.iter_mut().all(|numbers| numbers.expect(length)) {
        return Err(Damage::new(format!("an array of {rows} x {columns} numbers does not fit into memory")));
    }
    let mut place = 0;
    each(array, |value| {
        let (outer, inside) = (place / inner, place % inner);
        let of = if series_are_rows == outer_is_row { outer } else { inside };
        place += 1;
        series[of as usize].push(value)
    })?;
    let series = series.into_iter().enumerate().map(|(k, values)| Column::new(&format!("channel {}", k + 1), "", values)).collect();
    let about = format!("an array of {rows} x {columns} without names: its longer side is taken as time");
    Ok(Raw::columns(series, vec![Finding::new(FindingKind::Assumed, 1, None, about)]).into())
}

/// Every number in the order of the file.
fn each(array: NpyFile<BufReader<File>>, take: impl FnMut(f64) -> std::io::Result<()>) -> Result<(), Damage> {
    let dtype = match array.dtype() {
        DType::Plain(kind) => kind.to_string(),
        other => return Err(Damage::new(format!("its numbers are records ({}); save each as an array of its own", other.descr()))),
    };
    match dtype.get(1..).unwrap_or_default() {
        "f8" => typed(array, |x: f64| x, take),
        "f4" => typed(array, |x: f32| x.into(), take),
        "f2" => typed(array, f16::to_f64, take),
        "i8" => typed(array, |x: i64| x as f64, take),
        "i4" => typed(array, |x: i32| x.into(), take),
        "i2" => typed(array, |x: i16| x.into(), take),
        "i1" => typed(array, |x: i8| x.into(), take),
        "u8" => typed(array, |x: u64| x as f64, take),
        "u4" => typed(array, |x: u32| x.into(), take),
        "u2" => typed(array, |x: u16| x.into(), take),
        "u1" => typed(array, |x: u8| x.into(), take),
        "c8" | "c16" => Err(Damage::new(format!(
            "its numbers are complex ({dtype}), and an array without names is a record of real ones: save real and imaginary parts of a response \
             over frequency as columns NAME.re and NAME.im beside frequency_hz in CSV or Parquet, which `modes --measured` takes, or the real \
             parts alone of a record over time"
        ))),
        _ => {
            Err(Damage::new(format!("its numbers are of type {dtype}; real numbers are due, of 2, 4 or 8 bytes, or whole ones of 1 to 8")))
        }
    }
}

fn typed<T: Deserialize>(
    array: NpyFile<BufReader<File>>,
    number: impl Fn(T) -> f64,
    mut take: impl FnMut(f64) -> std::io::Result<()>,
) -> Result<(), Damage> {
    let told = |fault: std::io::Error| Damage::new(format!("{fault}; was the file cut?"));
    for value in array.data::<T>().map_err(|fault| Damage::new(fault.to_string()))? {
        take(number(value.map_err(told)?))?;
    }
    Ok(())
}
