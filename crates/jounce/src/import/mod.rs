//! Import of structures of other programs.

mod files;
mod npz;
mod options;
mod result;
mod universal;
mod warnings;

pub use options::ImportOptions;
pub use result::{ImportResult, ImportedMode};

use crate::error::Error;
use jounce_model::exchange::{ImportSettings, ImportedModes, MatrixSet, import_modes};
use jounce_spec::Modal;
use std::path::Path;

/// Reduces the matrices in a folder to a structure given by its modes, `[modal.NAME]` of a spec.
///
/// The folder holds `mass.mtx` and `stiffness.mtx`; optionally `damping.mtx`, `coupling.mtx` with
/// `capacitance.mtx`, `conductance.mtx`, `points.mtx`, `base.mtx`; and `names.csv`, which names points
/// and electrodes. With `shapes.mtx`, and perhaps `frequency_hz.mtx`, the structure has these modes in
/// place of those of the eigenproblem. Each matrix may also be an archive of SciPy, `mass.npz`.
/// [`crate::Harvester::export`] writes such a folder. A universal file with modes (data set 55) may take
/// its place: frequency, damping ratio, modal mass and shape of each mode are then the structure, and
/// `names.csv` next to it names points by node and direction, `point,2z,tip`.
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
    path: impl AsRef<Path>,
    options: &ImportOptions,
) -> Result<ImportResult, Error> {
    options.check()?;
    let (path, names) = (path.as_ref(), options.names.as_deref());
    if !path.is_file() {
        return reduce_matrices(files::read(path, names)?, options);
    }
    let (set, modes) = universal::read(path, names)?;
    let modes = modes.min(options.modes);
    let options = &ImportOptions {
        modes,
        ..options.clone()
    };
    reduce_matrices(set, options)
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
        rayleigh_hz: imported.rayleigh_hz[k],
    };
    ImportResult {
        modes: (0..modal.frequency_hz.len()).map(mode).collect(),
        points: modal.point.keys().cloned().collect(),
        electrodes: modal.patch.keys().cloned().collect(),
        has_given_shapes: imported.has_given_shapes,
        orthogonality: imported.orthogonality,
        stiffness_orthogonality: imported.stiffness_orthogonality,
        damping_coupling: imported.damping_coupling,
        spec: modal.to_toml(name),
        warnings: warnings::of(imported),
    }
}
