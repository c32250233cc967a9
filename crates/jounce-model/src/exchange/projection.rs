//! Points, electrodes, base and damping in the coordinates of modes.

use super::{NameKind, Names};
use jounce_linalg::{Mat, column};
use jounce_sparse::{MatrixEntries, SymmetricMatrix};
use std::collections::{BTreeMap, BTreeSet};

/// Entry of a capacitance or conductance off its diagonal, relative to the largest one, that is
/// roundoff.
const ROUNDOFF: f64 = 1e-9;

/// Everything of a set of matrices but mass and stiffness.
pub(super) struct Projection {
    pub(super) damping: Option<SymmetricMatrix>,
    pub(super) coupling: Option<Mat<f64>>,
    pub(super) capacitance: Option<Mat<f64>>,
    pub(super) conductance: Option<Mat<f64>>,
    pub(super) points: Option<MatrixEntries>,
    pub(super) base: Option<Mat<f64>>,
    pub(super) names: Names,
    /// Number of degrees of freedom.
    pub(super) size: usize,
}

/// An electrode in modal coordinates.
pub(super) struct Electrode {
    pub(super) name: String,
    /// Force per voltage on each mode.
    pub(super) coupling: Vec<f64>,
    pub(super) capacitance_f: f64,
    pub(super) leakage_ohm: Option<f64>,
}

impl Projection {
    /// Returns all faults of sizes and names.
    pub(super) fn faults(&self) -> Vec<String> {
        let size = self.size;
        let mut faults = Vec::new();
        let mut check = |name: &str, found: usize, what: &str, expected: usize| {
            if found != expected {
                faults.push(format!(
                    "{name} has {found} {what}, but must have {expected}"
                ));
            }
        };
        if let Some(damping) = &self.damping {
            check("damping", damping.size(), "rows", size);
        }
        let electrodes = self.coupling.as_ref().map_or(0, Mat::ncols);
        if let Some(coupling) = &self.coupling {
            check(
                "coupling",
                coupling.nrows(),
                "rows, one per degree of freedom",
                size,
            );
        }
        for (name, matrix) in [
            ("capacitance", &self.capacitance),
            ("conductance", &self.conductance),
        ] {
            if let Some(matrix) = matrix {
                check(
                    name,
                    matrix.nrows(),
                    "rows, one per column of coupling",
                    electrodes,
                );
                check(
                    name,
                    matrix.ncols(),
                    "columns, one per column of coupling",
                    electrodes,
                );
            }
        }
        if let Some(points) = &self.points {
            check(
                "points",
                points.columns,
                "columns, one per degree of freedom",
                size,
            );
        }
        if let Some(base) = &self.base {
            check(
                "base",
                base.nrows(),
                "rows, one per degree of freedom",
                size,
            );
            check("base", base.ncols(), "columns", 1);
        }
        faults.extend(self.electrical_faults(electrodes));
        faults.extend(self.name_faults(electrodes));
        faults
    }

    /// Capacitances must be positive, and both electrical matrices diagonal.
    fn electrical_faults(&self, electrodes: usize) -> Vec<String> {
        let mut faults = Vec::new();
        if self.capacitance.is_none() && electrodes > 0 {
            faults.push("capacitance is missing; coupling needs it".to_owned());
        }
        for (name, matrix) in [
            ("capacitance", &self.capacitance),
            ("conductance", &self.conductance),
        ] {
            let Some(matrix) = matrix else { continue };
            let largest = matrix.amax();
            for (i, j) in (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j)))
            {
                let value = matrix[(i, j)];
                if i != j && value.abs() > ROUNDOFF * largest {
                    faults.push(format!(
                        "{name}: entry ({}, {}) is {value}; electrodes that share charge cannot be read, so it must be 0",
                        i + 1,
                        j + 1
                    ));
                }
            }
            for i in 0..matrix.nrows().min(matrix.ncols()) {
                let value = matrix[(i, i)];
                if value < 0.0 || (value == 0.0 && name == "capacitance") {
                    faults.push(format!(
                        "{name}: entry ({0}, {0}) is {value}; it must be positive",
                        i + 1
                    ));
                }
            }
        }
        faults
    }

    /// Indices must exist, and every electrode needs a name.
    fn name_faults(&self, electrodes: usize) -> Vec<String> {
        let mut faults = Vec::new();
        let places = self.points.as_ref().map_or(self.size, |points| points.rows);
        let kinds = [
            (
                NameKind::Point,
                places,
                if self.points.is_some() {
                    "rows of points"
                } else {
                    "degrees of freedom"
                },
            ),
            (NameKind::Electrode, electrodes, "columns of coupling"),
        ];
        for (kind, most, what) in kinds {
            for (index, name) in self.names.of(kind).filter(|(index, _)| *index >= most) {
                faults.push(format!(
                    "names: {name} has index {}, but there are {most} {what}; indices count from 1",
                    index + 1
                ));
            }
        }
        for kind in [NameKind::Point, NameKind::Electrode] {
            let mut seen = BTreeMap::new();
            for (_, name) in self.names.of(kind) {
                if let Some(other) = seen.insert(plain(name), name) {
                    faults.push(format!(
                        "names: {other} and {name} are one name in a spec, {}; rename one",
                        plain(name)
                    ));
                }
            }
        }
        let mut named = BTreeSet::new();
        for (index, _) in self.names.of(NameKind::Electrode) {
            if !named.insert(index) {
                faults.push(format!(
                    "names: column {} of coupling has two names; remove one",
                    index + 1
                ));
            }
        }
        for index in (0..electrodes).filter(|index| !named.contains(index)) {
            let column = index + 1;
            faults.push(format!(
                "names: column {column} of coupling has no name; add electrode,{column},NAME"
            ));
        }
        faults
    }

    /// Returns the shape of each named point, one number per mode.
    pub(super) fn point_shapes(&self, columns: &[Vec<f64>]) -> Vec<(String, Vec<f64>)> {
        let shape = |index: usize| match &self.points {
            None => columns.iter().map(|column| column[index]).collect(),
            Some(points) => {
                let row = || points.entries.iter().filter(move |entry| entry.0 == index);
                let at = |column: &Vec<f64>| row().map(|(_, j, value)| value * column[*j]).sum();
                columns.iter().map(at).collect()
            }
        };
        self.names
            .of(NameKind::Point)
            .map(|(index, name)| (plain(name), shape(index)))
            .collect()
    }

    /// Returns the electrodes in modal coordinates.
    pub(super) fn electrodes(&self, columns: &[Vec<f64>]) -> Vec<Electrode> {
        let (Some(coupling), Some(capacitance)) = (&self.coupling, &self.capacitance) else {
            return Vec::new();
        };
        let electrode = |(index, name): (usize, &str)| {
            let force = column(coupling, index);
            let leak = self
                .conductance
                .as_ref()
                .map_or(0.0, |matrix| matrix[(index, index)]);
            Electrode {
                name: plain(name),
                coupling: columns.iter().map(|shape| dot(shape, force)).collect(),
                capacitance_f: capacitance[(index, index)],
                leakage_ohm: (leak > 0.0).then(|| leak.recip()),
            }
        };
        self.names.of(NameKind::Electrode).map(electrode).collect()
    }

    /// Returns `X^T M b`; empty without a base.
    pub(super) fn participation(&self, momenta: &[Vec<f64>]) -> Vec<f64> {
        let Some(base) = &self.base else {
            return Vec::new();
        };
        momenta
            .iter()
            .map(|momentum| dot(momentum, column(base, 0)))
            .collect()
    }
}

/// A name that a spec accepts: `beam-tip` for `beam.tip`.
fn plain(name: &str) -> String {
    name.replace('.', "-")
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
