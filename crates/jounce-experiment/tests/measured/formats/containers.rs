//! Formats with named arrays, texts and numbers: NPZ, HDF5, TDMS; and WAV.

use super::through_a_file::{kinds, one, read};
use super::writers::tdms::{Channel, Property, segment};
use super::writers::{wav, zip};
use crate::samples::npy;
use hdf5_pure::{AttrValue, FileBuilder};
use jounce_data::read::Contents;
use jounce_data::recording::{IssueKind, Quantity, Recording};

pub fn ramp(count: u32, step: f64) -> Vec<f64> {
    (0..count).map(|k| f64::from(k) * step).collect()
}

pub fn sine(count: u32, phase: f64) -> Vec<f64> {
    (0..count)
        .map(|k| (f64::from(k) * 0.1 + phase).sin())
        .collect()
}

pub fn names(recording: &Recording) -> Vec<(&str, &str)> {
    recording
        .channels
        .iter()
        .map(|channel| (channel.name.as_str(), channel.unit.as_str()))
        .collect()
}

pub fn all(name: &str, bytes: &[u8]) -> Contents {
    read(name, bytes, None).unwrap_or_else(|fault| panic!("{fault}"))
}

#[test]
fn an_archive_of_arrays_is_read_by_their_names() {
    let entry = |name: &'static str, values: Vec<f64>| (name, npy(&[values]));
    let entries = [
        entry("time.npy", ramp(64, 1e-3)),
        entry("tip_mv.npy", sine(64, 0.0)),
        entry("gain.npy", vec![2.0]),
    ];
    for compressed in [false, true] {
        let recording = one("a.npz", &zip::file(&entries, compressed), None);
        assert_eq!(names(&recording), [("tip_mv", "V")]);
        assert!((recording.rate() - 1000.0).abs() < 1e-9);
        assert_eq!(
            recording.channels[0].values,
            sine(64, 0.0).iter().map(|x| x * 1e-3).collect::<Vec<f64>>()
        );
    }
    let message = read(
        "a.zip",
        &zip::file(&[("a.txt", b"hello".to_vec())], false),
        None,
    )
    .expect_err("no array")
    .to_string();
    assert!(
        message.contains("ZIP archive without NumPy arrays"),
        "{message}"
    );
    let mut damaged = zip::file(&entries, true);
    damaged[150] ^= 0x55;
    read("a.npz", &damaged, None).expect_err("its check sum is wrong");
}

fn hdf5(matlab: bool) -> Vec<u8> {
    let mut file = FileBuilder::new();
    let mut group = file.create_group("run");
    group
        .create_dataset("time")
        .with_f64_data(&ramp(300, 1e-3))
        .with_shape(&[300, 1]);
    let tip = group.create_dataset("tip").with_f32_data(
        &sine(300, 0.0)
            .iter()
            .map(|x| *x as f32)
            .collect::<Vec<f32>>(),
    );
    tip.with_shape(&[300, 1])
        .with_chunks(&[64, 1])
        .with_deflate(6)
        .set_attr("units", AttrValue::String("mV".into()));
    if matlab {
        tip.set_attr("MATLAB_class", AttrValue::AsciiString("single".into()));
    }
    file.add_group(group.finish());
    file.finish().expect("memory")
}

#[test]
fn hdf5_groups_and_chunks_are_read() {
    for matlab in [false, true] {
        let mut bytes = hdf5(matlab);
        let name = if matlab { "a.mat" } else { "a.h5" };
        let recording = one(name, &bytes, None);
        assert_eq!(names(&recording), [("run.tip", "V")]);
        assert!(
            recording.channels[0]
                .values
                .iter()
                .zip(sine(300, 0.0))
                .all(|(a, b)| *a == f64::from(b as f32) * 1e-3)
        );
        assert_eq!(recording.channels[0].quantity, Quantity::Voltage);
        bytes.truncate(bytes.len() / 2);
        let message = read(name, &bytes, None).expect_err("it is cut").to_string();
        assert!(message.contains("is the file truncated?"), "{message}");
    }
}

fn channel(path: &'static str, values: Vec<f64>) -> Channel {
    let unit = Property::Text("unit_string", "mV");
    Channel {
        path,
        values,
        properties: vec![
            unit,
            Property::Number("wf_increment", 1e-3),
            Property::Number("wf_start_offset", 0.25),
        ],
    }
}

#[test]
fn tdms_channels_run_through_all_segments() {
    let (a, b) = (sine(200, 0.0), sine(200, 1.0));
    for interleaved in [false, true] {
        let part = |from: usize, to: usize, closed| {
            let channels = [
                channel("/'run'/'a'", a[from..to].to_vec()),
                channel("/'run'/'b'", b[from..to].to_vec()),
            ];
            segment(&channels, interleaved, closed)
        };
        let recording = one(
            "a.tdms",
            &[part(0, 70, true), part(70, 200, true)].concat(),
            None,
        );
        assert_eq!(
            (names(&recording), recording.grid.at(0)),
            (vec![("a", "V"), ("b", "V")], 0.25)
        );
        assert!((recording.rate() - 1000.0).abs() < 1e-9);
        assert_eq!(
            recording.channels[1].values,
            b.iter().map(|x| x * 1e-3).collect::<Vec<f64>>()
        );
        let open = one(
            "a.tdms",
            &[part(0, 70, true), part(70, 200, false)].concat(),
            None,
        );
        assert_eq!(open.channels, recording.channels);
        assert!(kinds(&open).contains(&IssueKind::HeaderDisagrees));
        let complete = part(0, 200, true);
        let message = read("a.tdms", &complete[..complete.len() - 8], None)
            .expect_err("it is cut")
            .to_string();
        assert!(message.contains("is the file truncated?"), "{message}");
    }
    let groups = [
        channel("/'x'/'a'", a.clone()),
        channel("/'y'/'a'", b.clone()),
    ];
    assert_eq!(
        names(&one("a.tdms", &segment(&groups, false, true), None)),
        [("x.a", "V"), ("y.a", "V")]
    );
}

#[test]
fn wav_samples_of_every_size_are_read() {
    let counts: Vec<i32> = (0..300).map(|k| (k * 37) % 251 - 125).collect();
    let integers = |size: usize| -> Vec<u8> {
        counts
            .iter()
            .flat_map(|x| x.to_le_bytes()[..size].to_vec())
            .collect()
    };
    let floats = |wide: bool| -> Vec<u8> {
        let each = |x: &i32| {
            if wide {
                f64::from(*x).to_le_bytes().to_vec()
            } else {
                (*x as f32).to_le_bytes().to_vec()
            }
        };
        counts.iter().flat_map(each).collect()
    };
    let bytes: Vec<u8> = counts.iter().map(|x| (x + 128) as u8).collect();
    for (kind, size, samples) in [
        (1, 1, bytes),
        (1, 2, integers(2)),
        (1, 3, integers(3)),
        (1, 4, integers(4)),
        (3, 4, floats(false)),
        (3, 8, floats(true)),
    ] {
        let recording = one("a.wav", &wav::file(kind, size, 2, 48_000, &samples), None);
        assert_eq!(
            (recording.channels.len(), recording.rate().round()),
            (2, 48_000.0)
        );
        let expected: Vec<f64> = counts
            .iter()
            .skip(1)
            .step_by(2)
            .map(|x| f64::from(*x))
            .collect();
        assert_eq!(recording.channels[1].values, expected, "{kind} {size}");
    }
    let message = read("a.wav", &wav::file(6, 1, 1, 8000, &[0; 100]), None)
        .expect_err("A-law")
        .to_string();
    assert!(message.contains("kind 6"), "{message}");
}

#[test]
fn other_binary_files_are_named_with_their_program() {
    for (name, bytes, program) in [
        ("a.ide", &b"\x1aE\xdf\xa3\0\0"[..], "enDAQ"),
        ("a.wfm", b"\x0f\x0f:WFM#003\0", "Tektronix"),
        ("a.bin", b"AG10\0\0\0", "Keysight"),
        ("a.mf4", b"MDF     4.10\0", "asammdf"),
        ("a.dat", b"|CF,2,1,1;\0", "FAMOS"),
        ("a.dxd", b"\x01\x02\0\0", "DewesoftX"),
        ("a.nc", b"CDF\x01\0\0", "NetCDF 3"),
    ] {
        let message = read(name, bytes, None).expect_err(program).to_string();
        assert!(message.contains(program), "{message}");
    }
}
