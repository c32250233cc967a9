//! Identifies binary files that jounce does not read, by magic number or extension, and names a converter.

use std::path::Path;

/// Offset of the magic number, the bytes, and a description. Longer magic numbers precede shorter
/// ones.
const SIGNATURES: [(usize, &[u8], &str); 27] = [
    (0, b"\x1aE\xdf\xa3", IDE),
    (
        0,
        b"TDSh",
        "the index of a TDMS file: read the .tdms file in the same folder",
    ),
    (
        0,
        b"MDF     ",
        "a measurement in MDF (Vector CANape, ETAS INCA): export it as CSV or MAT there, or with asammdf in Python",
    ),
    (
        0,
        b"UnFinMF ",
        "an unfinished measurement in MDF (Vector CANape, ETAS INCA): repair and export it with asammdf in Python",
    ),
    (
        0,
        b"|CF,",
        "a recording of imc FAMOS: export it as ASCII or MAT in FAMOS",
    ),
    (0, b"AG01", KEYSIGHT),
    (0, b"AG03", KEYSIGHT),
    (0, b"AG10", KEYSIGHT),
    (0, b"\xa5\xa5", RIGOL),
    (0, b"RG01", RIGOL),
    (2, b":WFM#", TEKTRONIX),
    (0, b"WAVEDESC", LECROY),
    (11, b"WAVEDESC", LECROY),
    (
        0,
        b"<SALEAE>",
        "a recording of Saleae Logic: export its raw data as CSV in Logic",
    ),
    (
        0,
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "an Excel workbook (.xls): save the sheet as CSV",
    ),
    (0, b"CDF\x01", NETCDF),
    (0, b"CDF\x02", NETCDF),
    (0, b"CDF\x05", NETCDF),
    (
        0,
        b"\x0e\x03\x13\x01",
        "HDF4: convert it to HDF5 with h4toh5",
    ),
    (
        0,
        b"ARROW1",
        "Feather (Arrow IPC): convert it in Python: import pandas; pandas.read_feather('FILE').to_parquet('FILE.parquet')",
    ),
    (0, b"\x80\x02", PICKLE),
    (0, b"\x80\x04\x95", PICKLE),
    (0, b"\x80\x05\x95", PICKLE),
    (
        0,
        b"SQLite format 3\0",
        "an SQLite database: export its table as CSV",
    ),
    (
        0,
        b"fLaC",
        "FLAC sound: convert it to WAV, for example with ffmpeg -i FILE FILE.wav",
    ),
    (
        0,
        b"OggS",
        "Ogg sound: convert it to WAV, for example with ffmpeg -i FILE FILE.wav",
    ),
    (
        0,
        b"\x1f\x8b",
        "compressed by gzip: unpack it with gunzip and read the result",
    ),
];
const IDE: &str = "EBML, the format of enDAQ and Slam Stick loggers (IDE): export it as CSV or \
    MAT in enDAQ Lab, or with idelib in Python";
const KEYSIGHT: &str =
    "a waveform of a Keysight or Agilent oscilloscope: save it as CSV on the instrument";
const RIGOL: &str = "a waveform of a Rigol oscilloscope: save it as CSV on the instrument, or convert it with RigolWFM in Python";
const TEKTRONIX: &str = "a waveform of a Tektronix oscilloscope: save it as CSV on the instrument, or convert it with tm_data_types in Python";
const LECROY: &str = "a waveform of a LeCroy oscilloscope: save it as ASCII on the instrument, or convert it with lecroyparser in Python";
const NETCDF: &str = "NetCDF 3: convert it in Python: import xarray; xarray.open_dataset('FILE').to_netcdf('FILE.h5', engine='h5netcdf')";
const PICKLE: &str = "a pickle of Python: save the arrays in it with numpy.savez";

/// File extensions in lower case, with the usual kind of file.
const REFUSED_EXTENSIONS: [(&str, &str); 14] = [
    ("ide", IDE),
    ("dxd", DEWESOFT),
    ("d7d", DEWESOFT),
    ("trc", LECROY),
    (
        "wfm",
        "a waveform of a Tektronix or Rigol oscilloscope: save it as CSV on the instrument",
    ),
    ("isf", TEKTRONIX),
    (
        "psdata",
        "a recording of PicoScope: save it as CSV or MAT in PicoScope",
    ),
    ("ldsf", TESTLAB),
    ("tdf", TESTLAB),
    (
        "pti",
        "a recording of Bruel & Kjaer PULSE: export it as UFF or MAT in PULSE",
    ),
    (
        "hdf",
        "a recording of HEAD acoustics ArtemiS: export it as UFF or MAT in ArtemiS",
    ),
    (
        "rsp",
        "a recording of MTS RPC: export it as CSV or UFF in RPC or nCode",
    ),
    (
        "tim",
        "a recording of MTS RPC: export it as CSV or UFF in RPC or nCode",
    ),
    (
        "sie",
        "a recording of HBK SoMat: export it as CSV in nCode or TCE",
    ),
];
const DEWESOFT: &str = "a recording of DewesoftX: export it as MAT, CSV or UFF in DewesoftX";
const TESTLAB: &str = "a recording of Simcenter Testlab: export it as UFF or MAT in Testlab";

/// Describes a binary file by its first bytes, else by its extension.
pub(in crate::read) fn describe(path: &Path, head: &[u8]) -> Option<String> {
    let has_signature = |(at, bytes, _): &&(usize, &[u8], &str)| {
        head.get(*at..).is_some_and(|head| head.starts_with(bytes))
    };
    if let Some((_, _, description)) = SIGNATURES.iter().find(has_signature) {
        return Some((*description).to_owned());
    }
    let extension = path.extension()?.to_str()?.to_lowercase();
    let (_, description) = REFUSED_EXTENSIONS
        .iter()
        .find(|(known, _)| *known == extension)?;
    Some(format!("by its extension it is {description}"))
}
