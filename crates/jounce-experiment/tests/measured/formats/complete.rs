//! A complete small file of each format.

use super::samples;
use super::writers::mat::{Value, column, file, one as fields};
use super::writers::tdms::{Channel, Property, segment};
use super::writers::{wav, zip};
use jounce_data::write::write;
use std::path::Path;

fn ramp(count: u32) -> Vec<f64> {
    (0..count).map(|k| f64::from(k) * 1e-3).collect()
}

fn sine(count: u32) -> Vec<f64> {
    (0..count).map(|k| (f64::from(k) * 0.3).sin()).collect()
}

fn matlab(compressed: bool) -> Vec<u8> {
    let signal = |name| vec![column(&sine(40)), Value::Text(name), Value::Text("g")];
    let signals = Value::Structs(
        vec!["values", "label", "unit"],
        vec![signal("tip"), signal("base")],
    );
    let response = fields(vec![
        ("freq", column(&ramp(20))),
        ("h", Value::Complex(vec![20, 2], sine(40), sine(40))),
    ]);
    let data = fields(vec![
        ("time", column(&ramp(40))),
        ("signal", signals),
        ("frf", response),
        ("cells", Value::Cell(vec![column(&sine(40)); 3])),
    ]);
    file(
        &[
            ("data", data),
            ("fs", column(&[1000.0])),
            ("n", Value::Short((0..40).collect())),
        ],
        compressed,
    )
}

fn hdf5() -> Vec<u8> {
    let mut file = hdf5_pure::FileBuilder::new();
    file.create_dataset("time").with_f64_data(&ramp(120));
    file.create_dataset("tip")
        .with_f64_data(&sine(120))
        .with_shape(&[120])
        .with_chunks(&[32])
        .with_deflate(6);
    let mut group = file.create_group("more");
    group
        .create_dataset("m")
        .with_f32_data(&[0.5; 240])
        .with_shape(&[120, 2]);
    group.set_attr("fs", hdf5_pure::AttrValue::F64(1000.0));
    file.add_group(group.finish());
    file.finish().expect("memory")
}

/// Returns a complete file of each format, with its extension.
pub fn complete_files(folder: &Path) -> Vec<(&'static str, Vec<u8>)> {
    let bytes_of = |recording, name: &str| {
        let path = folder.join(name);
        write(recording, &path).unwrap_or_else(|fault| panic!("{fault}"));
        std::fs::read(&path).expect("it was written")
    };
    let rows = [ramp(50), sine(50)];
    let channel = |path| Channel {
        path,
        values: sine(40),
        properties: vec![
            Property::Text("unit_string", "V"),
            Property::Number("wf_increment", 1e-3),
        ],
    };
    let channels = || [channel("/'run'/'a'"), channel("/'run'/'b'")];
    let shapes = b"    -1\n    55\nNONE\nNONE\nNONE\nNONE\nNONE\n         1         2         2         8         2         3\n         2         4         1         1\n  1.0e+01  0.0e+00  1.0e-02  0.0e+00\n         1\n -1.4e+00 -1.4e+00 -1.4e+00\n    -1\n";
    let entries = [
        ("time.npy", samples::npy(&rows[..1])),
        ("tip.npy", samples::npy(&rows[1..])),
    ];
    let bytes: Vec<u8> = sine(200)
        .iter()
        .flat_map(|x| ((x * 3e4) as i16).to_le_bytes())
        .collect();
    vec![
        ("csv", bytes_of(&samples::record(), "a.csv")),
        ("parquet", bytes_of(&samples::record(), "a.parquet")),
        ("uff", bytes_of(&samples::record(), "a.uff")),
        ("uff", bytes_of(&samples::response(), "b.uff")),
        ("uff", samples::uff58b(false, true)),
        ("uff", shapes.to_vec()),
        ("npy", samples::npy(&rows)),
        ("npz", zip::file(&entries, false)),
        ("npz", zip::file(&entries, true)),
        ("mat", matlab(false)),
        ("mat", matlab(true)),
        ("h5", hdf5()),
        (
            "tdms",
            [
                segment(&channels(), false, true),
                segment(&channels(), true, false),
            ]
            .concat(),
        ),
        ("wav", wav::file(1, 2, 2, 48_000, &bytes)),
        ("lvm", samples::lvm().into_bytes()),
    ]
}
