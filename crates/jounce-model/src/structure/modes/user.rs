//! A structure defined by its modes: converts `[modal.NAME]` to [`Modes`], with the prefix `NAME.`
//! on every name.

use crate::structure::error::StructureError;
use crate::structure::modes::{Modes, PatchModes};
use jounce_spec::Modal;
use std::f64::consts::TAU;

/// Returns all modes of `[modal.NAME]`.
///
/// # Errors
/// `WrongLength`; `OutOfRange` for a frequency or a damping ratio that is negative or not finite.
pub(in crate::structure) fn user_modes(name: &str, modal: &Modal) -> Result<Modes, StructureError> {
    let count = modal.frequency_hz.len();
    let full = |key: String, values: &Vec<f64>| match values.len() {
        length if length == count => Ok(values.clone()),
        length => Err(StructureError::WrongLength {
            place: key,
            found: length,
            expected: count,
        }),
    };
    for frequency_hz in &modal.frequency_hz {
        StructureError::not_negative(format!("modal.{name}.frequency_hz"), *frequency_hz)?;
    }
    let participation = match modal.participation_sqrt_kg.is_empty() {
        true => vec![0.0; count],
        false => full(
            format!("modal.{name}.participation_sqrt_kg"),
            &modal.participation_sqrt_kg,
        )?,
    };
    let mut modes = Modes {
        participation_sqrt_kg: participation,
        frequency_rad_s: modal
            .frequency_hz
            .iter()
            .map(|frequency_hz| TAU * frequency_hz)
            .collect(),
        damping_ratio: full(format!("modal.{name}.damping_ratio"), &modal.damping_ratio)?,
        discretisation_error: vec![0.0; count],
        ..Modes::default()
    };
    for (point, values) in &modal.point {
        modes.shape.insert(
            format!("{name}.{point}"),
            full(format!("modal.{name}.point.{point}"), values)?,
        );
    }
    for (patch, modal_patch) in &modal.patch {
        let key = format!("modal.{name}.patch.{patch}.coupling_n_per_v");
        let coupling_n_per_v = full(key, &modal_patch.coupling_n_per_v)?;
        modes.patch.insert(
            format!("{name}.{patch}"),
            PatchModes {
                coupling_n_per_v,
                capacitance_f: modal_patch.capacitance_f,
                leakage_ohm: modal_patch.leakage_ohm,
                strain: Vec::new(),
            },
        );
    }
    Ok(modes)
}
