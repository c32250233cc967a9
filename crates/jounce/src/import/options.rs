//! Options of an import.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, si};
use jounce_spec::Quantity;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Options of [`crate::import_matrices`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImportOptions {
    /// Name of the structure in the spec.
    #[arg(long, default_value = "structure")]
    pub name: String,
    /// Number of modes, the lowest ones; at most those of a universal file; without effect if the
    /// folder has shapes.
    #[arg(long, default_value_t = 10)]
    pub modes: usize,
    /// Damping ratios of the elastic modes, ascending in frequency; the last one is that of all
    /// further modes; without effect if the folder has a damping matrix, or the universal file damping
    /// ratios.
    #[arg(long, value_delimiter = ',', default_value = "0.01")]
    pub damping_ratio: Vec<f64>,
    /// Unit of the mass in the matrices, as in 1000kg for tonnes.
    #[arg(long = "mass-unit", value_name = "MASS", default_value = "1kg", value_parser = si(Quantity::Mass))]
    pub mass_unit_kg: f64,
    /// Unit of displacements in the matrices, as in 1mm; the unit of time is the second.
    #[arg(long = "length-unit", value_name = "LENGTH", default_value = "1m", value_parser = si(Quantity::Length))]
    pub length_unit_m: f64,
    /// Table of the names of points and electrodes; by default names.csv in the folder of the
    /// matrices or of the universal file.
    #[arg(long, value_name = "FILE")]
    pub names: Option<PathBuf>,
}

impl Default for ImportOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ImportOptions {
    /// Checks the ranges.
    pub(super) fn check(&self) -> Result<(), Error> {
        let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if self.name.is_empty() || !self.name.chars().all(allowed) {
            let expected = "use letters, digits, _ and -";
            return Err(Error::option("name", format!("{:?}", self.name), expected));
        }
        if self.modes == 0 {
            return Err(Error::option("modes", 0, "it must be at least 1"));
        }
        let is_ratio = |ratio: &f64| (0.0..=10.0).contains(ratio);
        if let Some(ratio) = self.damping_ratio.iter().find(|ratio| !is_ratio(ratio)) {
            return Err(Error::option(
                "damping_ratio",
                ratio,
                "each must be from 0 to 10",
            ));
        }
        check_above_zero("mass_unit", self.mass_unit_kg, "kg")?;
        check_above_zero("length_unit", self.length_unit_m, "m")?;
        Ok(())
    }
}
