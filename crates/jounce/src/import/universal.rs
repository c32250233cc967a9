//! Modes of a universal file (data set 55) as matrices in modal coordinates.
//!
//! With the modal masses `m`, angular frequencies `w`, damping ratios `z` and the shapes `x` of the
//! file, a point moves by the sum of `x q`, and
//!
//! ```text
//! M = diag(m),   D = diag(2 z m w),   K = diag(m w^2)
//! ```

use super::files::table_of_names;
use crate::error::Error;
use jounce_data::read::{self, ModeShape};
use jounce_io::store::unreadable;
use jounce_model::exchange::{ExchangeFaults, MatrixSet, NameKind, Names};
use jounce_sparse::MatrixEntries;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// Directions at a node, in the order of the values of a shape.
const DIRECTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A degree of freedom of the shapes.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Degree {
    node: i64,
    direction: usize,
    sign: f64,
}

/// Reads the modes and the names of points; returns also the number of modes.
///
/// # Errors
/// [`Error::Exchange`] with all faults of the file and of the names; those of reading a recording.
pub(super) fn read(path: &Path, names: Option<&Path>) -> Result<(MatrixSet, usize), Error> {
    let modes = match is_universal(path)? {
        true => read::file(path)?.shapes,
        false => Vec::new(),
    };
    if modes.is_empty() {
        let message = format!(
            "{} has no modes (data set 55 of a universal file); give such a file, or a folder of matrices",
            path.display()
        );
        return Err(ExchangeFaults::from(message).into());
    }
    let mut faults = faults_of(&modes);
    let mut set = MatrixSet::default();
    match named(path, names, &modes) {
        Ok((names, points)) => {
            set.names = names;
            set.matrix.insert("points".to_owned(), points);
        }
        Err(messages) => faults.extend(messages),
    }
    if !faults.is_empty() {
        return Err(ExchangeFaults(faults).into());
    }
    let angular = |mode: &ModeShape| TAU * mode.frequency_hz;
    let mut insert = |name: &str, value: &dyn Fn(&ModeShape) -> f64| {
        let matrix = diagonal(modes.iter().map(value));
        set.matrix.insert(name.to_owned(), matrix);
    };
    insert("mass", &|mode| mode.modal_mass);
    insert("stiffness", &|mode| mode.modal_mass * angular(mode).powi(2));
    if modes.iter().any(|mode| mode.damping_ratio > 0.0) {
        insert("damping", &|mode| {
            2.0 * mode.damping_ratio * mode.modal_mass * angular(mode)
        });
    }
    Ok((set, modes.len()))
}

/// True for a file whose first line with text is the mark of a data set.
fn is_universal(path: &Path) -> Result<bool, Error> {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head));
    read.map_err(|error| ExchangeFaults::from(unreadable(path, &error)))?;
    let mut lines = head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    Ok(lines.find(|line| !line.is_empty()) == Some(b"-1"))
}

fn diagonal(values: impl ExactSizeIterator<Item = f64>) -> MatrixEntries {
    let size = values.len();
    MatrixEntries {
        rows: size,
        columns: size,
        entries: values.enumerate().map(|(k, value)| (k, k, value)).collect(),
    }
}

/// Returns the faults of the modes.
fn faults_of(modes: &[ModeShape]) -> Vec<String> {
    let is_damped = modes.iter().any(|mode| mode.damping_ratio > 0.0);
    let first = &modes[0];
    let mut faults = Vec::new();
    for (number, mode) in (1..).zip(modes) {
        let mut fault = |text: &str| faults.push(format!("mode {number} of the file {text}"));
        if mode.imaginary.is_some() {
            fault("has a complex shape; write the real (normal) modes");
        }
        if !(mode.frequency_hz >= 0.0 && mode.frequency_hz.is_finite()) {
            fault(&format!(
                "has the frequency {} Hz; it must be a number of at least 0",
                mode.frequency_hz
            ));
        }
        if !(mode.modal_mass > 0.0 && mode.modal_mass.is_finite()) {
            fault(
                "has no modal mass, so that the scale of its shape is unknown; write it, or import the matrices with the shapes",
            );
        }
        let ratio = mode.damping_ratio;
        if is_damped && !(0.0..=10.0).contains(&ratio) {
            fault(&format!(
                "has the damping ratio {ratio}; it must be from 0 to 10"
            ));
        }
        if mode.nodes != first.nodes || per_node(mode) != per_node(first) {
            fault("has other nodes or directions than mode 1; write the shapes at the same nodes");
        }
    }
    faults
}

/// Returns the number of values at each node.
fn per_node(mode: &ModeShape) -> usize {
    mode.real.first().map_or(0, Vec::len)
}

/// Reads the names; returns them with the displacement of each named point in each mode.
fn named(
    path: &Path,
    names: Option<&Path>,
    modes: &[ModeShape],
) -> Result<(Names, MatrixEntries), Vec<String>> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut degrees: Vec<Degree> = Vec::new();
    let names = match table_of_names(folder, names).map_err(|message| vec![message])? {
        Some((file, text)) => Names::read_with(&text, &file, |kind, index| {
            if kind == NameKind::Electrode {
                return Err("a universal file has no electrodes; remove the line".to_owned());
            }
            degrees.push(degree(index, &modes[0])?);
            Ok(degrees.len() - 1)
        })
        .map_err(|faults| faults.0)?,
        None => Names::default(),
    };
    let entry = |(row, degree): (usize, &Degree)| {
        let node = modes[0].nodes.iter().position(|node| *node == degree.node);
        let value = move |mode: &ModeShape| {
            let values = mode.real.get(node?)?;
            Some(degree.sign * values.get(degree.direction)?)
        };
        let values = modes.iter().enumerate();
        values
            .filter_map(move |(k, mode)| Some((row, k, value(mode)?)))
            .collect::<Vec<_>>()
    };
    let points = MatrixEntries {
        rows: degrees.len(),
        columns: modes.len(),
        entries: degrees.iter().enumerate().flat_map(entry).collect(),
    };
    Ok((names, points))
}

/// Reads node and direction, `2z` or `2-z`; a shape with one value at each node needs no direction.
fn degree(index: &str, mode: &ModeShape) -> Result<Degree, String> {
    let directions = &DIRECTIONS[..per_node(mode).min(DIRECTIONS.len())];
    let form = match directions {
        [_] => "a node, as in 2".to_owned(),
        _ => format!(
            "a node and a direction, as in 2z or 2-z; the directions of this file are {}",
            directions.join(", ")
        ),
    };
    let fault = || format!("the index {index:?} is not {form}");
    let end = index
        .find(|c: char| !c.is_ascii_digit())
        .unwrap_or(index.len());
    let (node, word) = index.split_at(end);
    let node: i64 = node.parse().map_err(|_| fault())?;
    let (sign, word) = match word.strip_prefix('-') {
        Some(word) => (-1.0, word),
        None => (1.0, word.strip_prefix('+').unwrap_or(word)),
    };
    let found = directions.iter().position(|name| *name == word);
    let only = (word.is_empty() && directions.len() == 1).then_some(0);
    let direction = found.or(only).ok_or_else(fault)?;
    if !mode.nodes.contains(&node) {
        let (first, last) = (mode.nodes.iter().min(), mode.nodes.iter().max());
        return Err(match first.zip(last) {
            Some((first, last)) => format!(
                "the shapes have no node {node}; their {} nodes are numbered from {first} to {last}",
                mode.nodes.len()
            ),
            None => format!("the shapes have no node {node}, and no other"),
        });
    }
    Ok(Degree {
        node,
        direction,
        sign,
    })
}
