//! Recordings and files for tests.

use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use std::f64::consts::TAU;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A time record of two channels, uniform at a rate without a finite decimal.
pub fn record() -> Recording {
    let value = |k: i32, f: f64| {
        (TAU * f * f64::from(k) / 1536.0).sin() * 1e3_f64.powf(f64::from(k % 3 - 1))
    };
    let force = Channel {
        place: "tip".into(),
        direction: "-z".into(),
        ..Channel::new(
            "hammer",
            Quantity::Force,
            "N",
            (0..301).map(|k| value(k, 13.0)).collect(),
        )
    };
    let acceleration = Channel::new(
        "accel",
        Quantity::Acceleration,
        "m/s^2",
        (0..301).map(|k| value(k, 97.0)).collect(),
    );
    let grid = Grid::even(0.0, 1.0 / 1536.0, 301).expect("a grid");
    Recording {
        name: "record".into(),
        over: Over::Time,
        grid,
        channels: vec![force, acceleration],
        issues: Vec::new(),
    }
}

/// A complex spectrum over explicit frequencies.
pub fn response() -> Recording {
    let stamps: Vec<f64> = (0..50).map(|k| f64::from(k * k) * 0.5).collect();
    let mut channel = Channel::new(
        "accelerance",
        Quantity::Response,
        "m/s^2/N",
        stamps.iter().map(|f| 1.0 / (1.0 + f)).collect(),
    );
    channel.imaginary = Some(stamps.iter().map(|f| -f / (1.0 + f)).collect());
    Recording {
        name: "response".into(),
        over: Over::Frequency,
        grid: Grid::Stamped(stamps),
        channels: vec![channel],
        issues: Vec::new(),
    }
}

/// Path of a real recording; prints a line where it is absent.
pub fn real(file: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/data")
        .join(file);
    if path.exists() {
        return Some(path);
    }
    let _ = writeln!(
        std::io::stderr(),
        "SKIPPED: the recording {file} is missing"
    );
    None
}

/// An array in NumPy format, row by row.
pub fn npy(rows: &[Vec<f64>]) -> Vec<u8> {
    let header = format!(
        "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}",
        rows.len(),
        rows[0].len()
    );
    let length = (header.len() + 11).next_multiple_of(64) - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).into_bytes());
    bytes.extend(rows.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes
}

/// A MAT file of version 5 with one uncompressed matrix of doubles, column by column.
pub fn mat(name: &str, columns: &[Vec<f64>]) -> Vec<u8> {
    let element = |kind: u32, data: &[u8]| {
        let mut bytes = kind.to_le_bytes().to_vec();
        bytes.extend((data.len() as u32).to_le_bytes());
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    };
    let words = |values: &[u32]| {
        values
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<u8>>()
    };
    let numbers: Vec<u8> = columns
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let matrix = [
        element(6, &words(&[6, 0])),
        element(5, &words(&[columns[0].len() as u32, columns.len() as u32])),
        element(1, name.as_bytes()),
        element(9, &numbers),
    ];
    let mut bytes = format!("{:<116}", "MATLAB 5.0 MAT-file").into_bytes();
    bytes.extend([0; 8]);
    bytes.extend([0x00, 0x01, b'I', b'M']);
    bytes.extend(element(14, &matrix.concat()));
    bytes
}

/// A LabVIEW measurement of two channels whose header states a step 64 times too small.
pub fn lvm() -> String {
    let mut text =
        "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\tOne\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n"
            .to_owned();
    text.push_str("Samples\t6400\t6400\t\nY_Unit_Label\tVolts\tPounds\t\nX_Dimension\tTime\tTime\t\nX0\t0\t0\t\nDelta_X\t1.953125E-5\t1.953125E-5\t\n");
    text.push_str("***End_of_Header***\t\t\t\nX_Value\tVoltage\tForce\tComment\n");
    for k in 0..100 {
        text.push_str(&format!(
            "{:.6}\t{:.6}\t{:.6}\n",
            f64::from(k) * 0.00125,
            f64::from(k).sin(),
            f64::from(k).cos()
        ));
    }
    text
}

/// A binary function with a non-uniform abscissa, in single or double precision, big or little
/// endian.
pub fn uff58b(double: bool, little_endian: bool) -> Vec<u8> {
    let points: Vec<[f64; 2]> = (0..20)
        .map(|k| [f64::from(k * k), f64::from(k) - 3.5])
        .collect();
    let bytes = |x: f64| -> Vec<u8> {
        match (double, little_endian) {
            (true, true) => x.to_le_bytes().to_vec(),
            (true, false) => x.to_be_bytes().to_vec(),
            (false, true) => (x as f32).to_le_bytes().to_vec(),
            (false, false) => (x as f32).to_be_bytes().to_vec(),
        }
    };
    let data: Vec<u8> = points.iter().flatten().flat_map(|x| bytes(*x)).collect();
    let none = "NONE\n".repeat(5);
    let order = if little_endian { 1 } else { 2 };
    let mut file =
        format!("    -1\n    58b{order:>6}     2          11{:>12}     0     0           0           0\n{none}", data.len()).into_bytes();
    let kind = if double { 4 } else { 2 };
    file.extend(
        b"    1         0    0         0 NONE               5   3 NONE               0   0\n",
    );
    file.extend(
        format!("{kind:>10}        20         0  0.00000E+00  0.00000E+00  0.00000E+00\n").bytes(),
    );
    file.extend(b"        17    0    0    0 Time                 s                   \n");
    file.extend(b"        12    0    0    0 accel                g                   \n");
    file.extend(b"         0    0    0    0 NONE                 NONE                \n".repeat(2));
    file.extend(data);
    file.extend(b"\n    -1\n");
    file
}
