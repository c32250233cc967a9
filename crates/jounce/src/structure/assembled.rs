//! A solution as [`Modes`]: shapes at the named points and masses, couplings of the patches, damping ratios.

use super::assembly::{Assembly, Row};
use super::damping::{MassMode, damping_ratios};
use super::error::StructureError;
use super::modes::{Modes, PatchModes};
use super::reduction::Reduced;
use super::section::patch_moment_n_m_per_v;
use super::solution::Solution;
use crate::spec::{Patch, Spec};

/// The kept modes of all assembled structures of a spec.
///
/// # Errors
/// `MissingDamping`, `NotRepresentable`.
pub(super) fn assembled_modes(
    spec: &Spec,
    held: &[String],
    solution: &Solution,
    discretisation_error: Vec<f64>,
) -> Result<Modes, StructureError> {
    let frequency_rad_s = solution.frequency_rad_s();
    let damping_ratio = damping_ratios(&frequency_rad_s, &mass_modes(solution), &spec.damping)?;
    let participation_sqrt_kg = vec![0.0; frequency_rad_s.len()];
    let mut modes = Modes { frequency_rad_s, damping_ratio, discretisation_error, participation_sqrt_kg, ..Modes::default() };
    for (part, (assembly, reduced)) in solution.parts.iter().enumerate() {
        let needed = solution.order.needed(part);
        let modal = |row: &Row| solution.order.spread(part, &reduced.modal(row, needed));
        let participation = modal(&assembly.translated_mass()?);
        modes.participation_sqrt_kg.iter_mut().zip(participation).for_each(|(sum, part)| *sum += part);
        modes.shape.extend(point_rows(spec, assembly).iter().map(|(name, row)| (name.clone(), modal(row))));
        modes
            .patch
            .extend(patches(spec, assembly).map(|(name, patch, row)| {
                (name.clone(), PatchModes { coupling_n_per_v: modal(&row), capacitance_f: patch.capacitance_f })
            }));
    }
    for name in held {
        modes.shape.insert(name.clone(), vec![0.0; modes.len()]);
    }
    Ok(modes)
}

/// The displacement of every name of a body: `"table"`, `"beam.root"`, `"beam.end"`, `"beam.tip"`.
fn point_rows(spec: &Spec, assembly: &Assembly) -> Vec<(String, Row)> {
    let mut rows = Vec::new();
    if let Some((name, _)) = assembly.body.mass {
        rows.push((name.to_owned(), assembly.root_displacement().clone()));
    }
    for (index, name) in assembly.body.beams.iter().enumerate() {
        let beam = &spec.beam[*name];
        rows.extend(beam.point.iter().map(|(point, place_m)| (format!("{name}.{point}"), assembly.displacement(index, *place_m))));
        rows.push((format!("{name}.root"), assembly.root_displacement().clone()));
        rows.push((format!("{name}.end"), assembly.displacement(index, beam.length_m)));
    }
    rows
}

/// The patches of a body, each with its force per volt on every strain coordinate.
fn patches<'a>(spec: &'a Spec, assembly: &'a Assembly) -> impl Iterator<Item = (&'a String, &'a Patch, Row)> {
    spec.patch.iter().filter_map(|(name, patch)| {
        let index = assembly.body.beams.iter().position(|beam| *beam == patch.on)?;
        let moment_n_m_per_v = patch_moment_n_m_per_v(&spec.beam[&patch.on], patch);
        let start = assembly.slope(index, patch.start_m);
        let end = assembly.slope(index, patch.start_m + patch.length_m);
        let row = end.iter().zip(&start).map(|(end, start)| moment_n_m_per_v * (end - start)).collect();
        Some((name, patch, row))
    })
}

/// The kept modes in which a mass has its greatest share of the kinetic energy.
fn mass_modes(solution: &Solution) -> Vec<MassMode> {
    let of_part = |(part, (assembly, reduced)): (usize, &(Assembly, Reduced))| {
        let (_, mass) = assembly.body.mass?;
        let shape = reduced.modal(assembly.root_displacement(), assembly.columns);
        let greatest = (0..shape.len()).max_by(|one, other| shape[*one].abs().total_cmp(&shape[*other].abs()))?;
        Some((solution.order.place(part, greatest)?, mass.damping_ratio))
    };
    solution.parts.iter().enumerate().filter_map(of_part).collect()
}
