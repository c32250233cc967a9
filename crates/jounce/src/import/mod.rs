//! Import of structures of other programs.

mod files;
mod npz;
mod options;
mod result;

pub use options::ImportOptions;
pub use result::{ImportResult, ImportedMode};

use crate::error::Error;
use jounce_model::exchange::{ImportSettings, ImportedModes, MatrixSet, import_modes};
use jounce_spec::Modal;
use std::path::Path;

/// Deviation from orthonormal shapes above which a warning is given.
const MAX_ORTHOGONALITY: f64 = 1e-8;

/// Damping between modes, relative to that of the modes, above which a warning is given.
const MAX_DAMPING_COUPLING: f64 = 1e-3;

/// Reduces the matrices in a folder to a structure given by its modes, `[modal.NAME]` of a spec.
///
/// The folder holds `mass.mtx` and `stiffness.mtx`; optionally `damping.mtx`, `coupling.mtx` with
/// `capacitance.mtx`, `conductance.mtx`, `points.mtx`, `base.mtx`; and `names.csv`, which names points
/// and electrodes. Each matrix may also be an archive of SciPy, `mass.npz`.
/// [`crate::Harvester::export`] writes such a folder.
///
/// # Errors
/// [`Error::Exchange`] with all faults of the files; [`Error::Option`].
///
/// ```
/// use jounce::ImportOptions;
/// let folder = tempfile::tempdir().unwrap();
/// let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
/// let head = "%%MatrixMarket matrix coordinate real symmetric";
/// write("mass.mtx", &format!("{head}\n2 2 2\n1 1 0.5\n2 2 0.5\n"));
/// write("stiffness.mtx", &format!("{head}\n2 2 3\n1 1 200\n2 1 -100\n2 2 100\n"));
/// write("names.csv", "kind,index,name\npoint,2,tip\n");
/// let options = ImportOptions { name: "chain".into(), modes: 1, ..Default::default() };
/// let result = jounce::import_matrices(folder.path(), &options)?;
/// // w^2 = (3 - sqrt 5) / 2 k / m
/// assert!((result.modes[0].frequency_hz - 1.391).abs() < 1e-3);
/// assert!(result.spec.starts_with("[modal.chain]"));
/// # Ok::<(), jounce::Error>(())
/// ```
pub fn import_matrices(
    folder: impl AsRef<Path>,
    options: &ImportOptions,
) -> Result<ImportResult, Error> {
    options.check()?;
    reduce_matrices(files::read(folder.as_ref())?, options)
}

/// Reduces matrices in memory to a structure given by its modes, as [`import_matrices`] does those of
/// a folder.
///
/// # Errors
/// [`Error::Exchange`] with all faults of the matrices; [`Error::Option`].
pub fn reduce_matrices(set: MatrixSet, options: &ImportOptions) -> Result<ImportResult, Error> {
    options.check()?;
    let settings = ImportSettings {
        modes: options.modes,
        damping_ratio: options.damping_ratio.clone(),
        mass_unit_kg: options.mass_unit_kg,
        length_unit_m: options.length_unit_m,
    };
    let imported = import_modes(set, &settings)?;
    Ok(result_of(&imported, &options.name))
}

fn result_of(imported: &ImportedModes, name: &str) -> ImportResult {
    let modal: &Modal = &imported.modal;
    let mode = |k: usize| ImportedMode {
        frequency_hz: modal.frequency_hz[k],
        damping_ratio: modal.damping_ratio[k],
        frequency_error: imported.frequency_error[k],
    };
    let mut warnings = rigid_warnings(imported);
    if imported.orthogonality > MAX_ORTHOGONALITY {
        warnings.push(format!(
            "the shapes are orthonormal in the mass only to {:.1e}; check the units of the matrices",
            imported.orthogonality
        ));
    }
    if imported.damping_coupling > MAX_DAMPING_COUPLING {
        warnings.push(format!(
            "the damping matrix couples modes, by up to {:.2e} of their own damping; the coupling is left out",
            imported.damping_coupling
        ));
    }
    ImportResult {
        modes: (0..modal.frequency_hz.len()).map(mode).collect(),
        points: modal.point.keys().cloned().collect(),
        electrodes: modal.patch.keys().cloned().collect(),
        orthogonality: imported.orthogonality,
        damping_coupling: imported.damping_coupling,
        spec: modal.to_toml(name),
        warnings,
    }
}

/// Warnings about modes that were taken as rigid-body modes.
fn rigid_warnings(imported: &ImportedModes) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(largest_hz) = largest(&imported.set_to_zero_hz) {
        warnings.push(format!(
            "{} set to 0 Hz as rigid-body motions, because {} far below the first elastic frequency: up to {largest_hz:.3e} Hz in the matrices, \
             which may be the roundoff of written numbers; for a soft support, import the structure without it and add the support in the spec",
            modes_in_words(&imported.set_to_zero_hz),
            if imported.set_to_zero_hz.len() == 1 { "it lies" } else { "they lie" },
        ));
    }
    if let Some(largest_per_s) = largest(&imported.rigid_damping_per_s) {
        let whose = match &imported.rigid_damping_per_s[..] {
            [_] => "this rigid-body motion",
            _ => "these rigid-body motions",
        };
        warnings.push(format!(
            "{} without damping: the damping of {whose} in the matrices, up to {largest_per_s:.3e} 1/s, is left out",
            modes_in_words(&imported.rigid_damping_per_s),
        ));
    }
    warnings
}

fn largest(modes: &[(usize, f64)]) -> Option<f64> {
    modes.iter().map(|mode| mode.1.abs()).reduce(f64::max)
}

/// Returns `mode 1 is`, or `modes 1, 2 are`.
fn modes_in_words(modes: &[(usize, f64)]) -> String {
    let numbers: Vec<String> = modes.iter().map(|mode| (mode.0 + 1).to_string()).collect();
    match &numbers[..] {
        [one] => format!("mode {one} is"),
        _ => format!("modes {} are", numbers.join(", ")),
    }
}
