//! Warnings of an import.

use jounce_model::exchange::ImportedModes;
use jounce_spec::Quantity;

/// Deviation of computed shapes from orthonormal ones above which a warning is given.
const MAX_ORTHOGONALITY: f64 = 1e-8;

/// Product of two given shapes above which a warning is given: the kinetic or potential energy of a
/// motion of both modes then has an error of up to 1 %.
const MAX_ENERGY_ERROR: f64 = 0.01;

/// Difference of a given frequency from Rayleigh's quotient, over the damping ratio, above which a
/// warning is given. A resonance that is off by `d` of its frequency has `1 / (1 + (d / zeta)^2)` of
/// its power: 1 % less for a tenth.
const MAX_DETUNING: f64 = 0.1;

/// Damping between modes, relative to that of the modes, above which a warning is given.
const MAX_DAMPING_COUPLING: f64 = 1e-3;

/// Returns all warnings.
pub(super) fn of(imported: &ImportedModes) -> Vec<String> {
    let mut warnings = rigid_warnings(imported);
    if imported.has_given_shapes {
        warnings.extend(energy_warnings(imported));
        warnings.extend(frequency_warning(imported));
    } else if imported.orthogonality > MAX_ORTHOGONALITY {
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
    warnings
}

/// Warnings about given shapes that are not orthogonal.
fn energy_warnings(imported: &ImportedModes) -> impl Iterator<Item = String> {
    let products = [
        (imported.orthogonality, "mass", "kinetic"),
        (imported.stiffness_orthogonality, "stiffness", "potential"),
    ];
    let is_large = |of: &(f64, &str, &str)| of.0 > MAX_ENERGY_ERROR;
    products.into_iter().filter(is_large).map(|(product, matrix, energy)| {
        format!(
            "the given shapes are orthogonal in the {matrix} only to {:.2} %: the {energy} energy of a motion of two modes has an error \
             of up to this, more than {} %; check the degrees of freedom of the shapes, or import without shapes",
            100.0 * product,
            100.0 * MAX_ENERGY_ERROR
        )
    })
}

/// Warning about given frequencies that are not those of the shapes.
fn frequency_warning(imported: &ImportedModes) -> Option<String> {
    let modal = &imported.modal;
    let difference = |mode: &usize| imported.rayleigh_hz[*mode] / modal.frequency_hz[*mode] - 1.0;
    let is_detuned = |mode: &usize| {
        let limit = MAX_DETUNING * modal.damping_ratio[*mode];
        modal.frequency_hz[*mode] > 0.0 && limit > 0.0 && difference(mode).abs() > limit
    };
    let modes = (0..modal.frequency_hz.len()).filter(is_detuned);
    let detuned: Vec<String> = modes
        .map(|mode| {
            format!(
                "mode {} {:.6} Hz, Rayleigh's quotient {:.6} Hz ({:+.2} %)",
                mode + 1,
                modal.frequency_hz[mode],
                imported.rayleigh_hz[mode],
                100.0 * difference(&mode)
            )
        })
        .collect();
    (!detuned.is_empty()).then(|| {
        format!(
            "given frequencies differ from those of shapes, stiffness and mass by more than a tenth of the damping ratio, \
             which changes the power at resonance by more than 1 %; the given ones are used: {}",
            detuned.join("; ")
        )
    })
}

/// Warnings about modes that were taken as rigid-body modes.
fn rigid_warnings(imported: &ImportedModes) -> Vec<String> {
    let mut warnings = Vec::new();
    if let Some(largest_hz) = largest(&imported.set_to_zero_hz) {
        warnings.push(format!(
            "{} set to 0 Hz as rigid-body motions, because {} far below the first elastic frequency: up to {} in the matrices, \
             which may be the roundoff of written numbers; for a soft support, import the structure without it and add the support in the spec",
            modes_in_words(&imported.set_to_zero_hz),
            if imported.set_to_zero_hz.len() == 1 { "it lies" } else { "they lie" },
            Quantity::Frequency.write_rounded(largest_hz, 4),
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
