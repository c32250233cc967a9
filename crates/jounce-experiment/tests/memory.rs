//! Memory for reading and converting does not grow with the file. The test compares the peak of the
//! process, as Linux counts it, for small and large files of each format. HDF5 is excluded: its
//! library holds an array of one row completely.
#![cfg(target_os = "linux")]

use jounce_data::read::{FileSummary, summary};
use jounce_data::recording::{IssueKind, Series};
use jounce_data::write::write_summary;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

/// Rows of a small and of a large file: 25 and 46 MB as text, 17 to 22 and 32 to 40 MB as numbers,
/// all more than the 16 MiB held in memory.
const ROWS: [usize; 2] = [540_000, 1_000_000];
const RATE_HZ: f64 = 1000.0;
/// Largest difference of the peaks of a large and a small file, bytes: two blocks of text of 5.7 MB, of
/// which a busy machine reads more ahead. In memory the numbers would need 15 to 18 MB more.
const MORE: u64 = 12 << 20;
/// Largest peak: 16 MiB of numbers, buffers, and memory of the allocator.
const MOST: u64 = 48 << 20;

/// A line of the status of this process, bytes.
fn status(key: &str) -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").expect("a status");
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix(key))
        .expect("a line of the status");
    line.trim_matches([':', '\t', ' '])
        .trim_end_matches(" kB")
        .parse::<u64>()
        .expect("a number")
        << 10
}

/// Returns a result, and the memory peak of its computation above the value `before`.
fn peak_of<T>(before: u64, work: impl FnOnce() -> T) -> (u64, T) {
    // Resets the peak to the memory in use.
    std::fs::write("/proc/self/clear_refs", "5").expect("the peak can be set back");
    let made = work();
    (status("VmHWM").saturating_sub(before), made)
}

fn sample(row: usize, channel: usize) -> f64 {
    ((row * (7 + channel)) as f64 * 1e-4).sin() * 3.0
}

/// Four channels over time as text, below the header of a format.
fn text(path: &Path, head: &str, rows: usize, separator: char) {
    let mut to = BufWriter::new(File::create(path).expect("a file"));
    let mut line = head.to_owned();
    for row in 0..rows {
        // An occasional late time stamp makes the grid non-uniform, so the stamps are stored too.
        let late = if row % 1000 == 17 { 0.3 } else { 0.0 };
        let _ = write!(line, "{:.4}", (row as f64 + late) / RATE_HZ);
        for channel in 0..4 {
            let _ = write!(line, "{separator}{:.6}", sample(row, channel));
        }
        line.push('\n');
        to.write_all(line.as_bytes()).expect("written");
        line.clear();
    }
    to.flush().expect("written");
}

/// Four channels as an array without time, with its notes.
fn npy(path: &Path, rows: usize) {
    let mut head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, 4), }}");
    head.push_str(&" ".repeat(117 - head.len()));
    head.push('\n');
    let mut to = BufWriter::new(File::create(path).expect("a file"));
    to.write_all(b"\x93NUMPY\x01\x00\x76\x00").expect("written");
    to.write_all(head.as_bytes()).expect("written");
    for row in 0..rows {
        (0..4).for_each(|channel| {
            to.write_all(&sample(row, channel).to_le_bytes())
                .expect("written")
        });
    }
    to.flush().expect("written");
    std::fs::write(
        jounce_data::read::Notes::path_of(path),
        "rate = \"1 kHz\"\n",
    )
    .expect("notes");
}

/// One channel of as many numbers in binary, double precision, uniform times.
fn uff58b(path: &Path, rows: usize) {
    let points = 4 * rows;
    let mut to = BufWriter::new(File::create(path).expect("a file"));
    let axis = |kind: u32, name: &str, unit: &str| {
        format!("{kind:>10}{:>5}{:>5}{:>5} {name:<20} {unit:<20}\n", 0, 0, 0)
    };
    let (b58, none) = (
        format!("    58b{:>6}{:>6}{:>12}{:>12}\n", 1, 2, 11, 8 * points),
        "NONE\n".repeat(5),
    );
    let dofs = "    1         0    0         0 NONE               5   3 NONE               0   0\n";
    let form = format!(
        "{:>10}{points:>10}{:>10}  0.00000E+00  1.00000E-03  0.00000E+00\n",
        4, 1
    );
    let axes = axis(17, "Time", "s")
        + &axis(12, "a", "m/s^2")
        + &axis(0, "NONE", "NONE")
        + &axis(0, "NONE", "NONE");
    to.write_all(format!("    -1\n{b58}{none}{dofs}{form}{axes}").as_bytes())
        .expect("written");
    (0..points).for_each(|k| {
        to.write_all(&sample(k / 4, k % 4).to_le_bytes())
            .expect("written")
    });
    to.write_all(b"\n    -1\n").expect("written");
    to.flush().expect("written");
}

/// A matrix of four columns with its rate, in MATLAB 5 format.
fn mat(path: &Path, rows: usize) {
    let mut to = BufWriter::new(File::create(path).expect("a file"));
    let words = |words: &[u32]| {
        words
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect::<Vec<u8>>()
    };
    to.write_all(
        &[
            format!("{:<124}", "MATLAB 5.0 MAT-file").into_bytes(),
            vec![0, 1, b'I', b'M'],
        ]
        .concat(),
    )
    .expect("written");
    for (name, rows, columns) in [(b"fs", 1, 1), (b"ab", rows, 4)] {
        let bytes = (8 * rows * columns) as u32;
        let head = words(&[
            14,
            48 + bytes,
            6,
            8,
            6,
            0,
            5,
            8,
            rows as u32,
            columns as u32,
            2 << 16 | 1,
        ]);
        to.write_all(&[head, name.to_vec(), vec![0; 2], words(&[9, bytes])].concat())
            .expect("written");
        for column in 0..columns {
            let number = |row| {
                if columns == 1 {
                    RATE_HZ
                } else {
                    sample(row, column)
                }
            };
            (0..rows).for_each(|row| to.write_all(&number(row).to_le_bytes()).expect("written"));
        }
    }
    to.flush().expect("written");
}

fn read(path: &Path) -> FileSummary {
    summary(path).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Writes a file of each format.
fn write_files(at: &impl Fn(&str) -> PathBuf, rows: usize) {
    text(&at("a.csv"), "time_s,a_V,b_V,c_V,d_V\n", rows, ',');
    let lvm = "LabVIEW Measurement\t\nSeparator\tTab\nX_Columns\tOne\n***End_of_Header***\t\n\t\nChannels\t4\nDelta_X\t0.001\n***End_of_Header***\t\nX_Value\ta\tb\tc\td\n";
    text(&at("a.lvm"), lvm, rows, '\t');
    npy(&at("a.npy"), rows);
    mat(&at("a.mat"), rows);
    uff58b(&at("b.uff"), rows);
}

/// Peaks of reading each format, and of writing two of them; checks that all numbers are present.
fn peaks(folder: &Path, rows: usize, before: u64) -> Vec<(&'static str, u64)> {
    let at = |name: &str| -> PathBuf { folder.join(format!("{rows}-{name}")) };
    write_files(&at, rows);
    let mut peaks = Vec::new();
    let (peak, summary) = peak_of(before, || read(&at("a.csv")));
    peaks.push(("CSV", peak));
    let jitter = summary.recordings[0]
        .issues
        .iter()
        .find(|issue| issue.kind == IssueKind::Jitter);
    assert_eq!(
        jitter.map(|issue| issue.count),
        Some(2 * rows.div_ceil(1000)),
        "each late stamp makes two odd steps"
    );
    for (name, file) in [
        ("to Parquet", "c.parquet"),
        ("to UFF", "c.uff"),
        ("to CSV", "c.csv"),
    ] {
        let (peak, ()) = peak_of(before, || {
            write_summary(&summary.recordings[0], &at(file), None)
                .unwrap_or_else(|fault| panic!("{fault}"))
        });
        peaks.push((name, peak));
    }
    drop(summary);
    for (name, file) in [
        ("LVM", "a.lvm"),
        ("MAT", "a.mat"),
        ("NPY", "a.npy"),
        ("UFF 58b", "b.uff"),
        ("Parquet", "c.parquet"),
        ("UFF 58", "c.uff"),
        ("CSV", "c.csv"),
    ] {
        let (peak, summary) = peak_of(before, || read(&at(file)));
        let recording = &summary.recordings[0];
        assert_eq!(
            recording.places.count() * recording.channels.len(),
            4 * rows,
            "{name}"
        );
        let mean_square: f64 = recording
            .channels
            .iter()
            .map(|channel| channel.sizes.rms.powi(2))
            .sum::<f64>()
            / recording.channels.len() as f64;
        assert!(
            (mean_square - 4.5).abs() < 0.01,
            "{name}: a sine of 3 has 4.5, not {mean_square}"
        );
        peaks.push((name, peak));
    }
    peaks
}

/// Measured, MB: see the book's page on recordings.
#[test]
#[ignore = "long: runs with ./test --long"]
fn memory_does_not_grow_with_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let before = status("VmRSS");
    let [small, large] = ROWS.map(|rows| peaks(folder.path(), rows, before));
    for ((name, small), (_, large)) in small.into_iter().zip(large) {
        eprintln!(
            "{name}: {:.1} MB, then {:.1} MB",
            small as f64 / 1e6,
            large as f64 / 1e6
        );
        assert!(
            large < MOST && large < small + MORE,
            "{name}: {small} bytes, then {large}"
        );
    }
}
