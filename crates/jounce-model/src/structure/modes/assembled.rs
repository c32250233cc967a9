//! Conversion of a solution to [`Modes`]: shapes at the named points and masses, couplings of the
//! patches, damping ratios.

use super::damping::MassMode;
use crate::structure::assembly::solution::StructureSolution;
use crate::structure::assembly::{Assembly, Row};
use crate::structure::beam::layout::{PatchedSegment, patched_segments};
use crate::structure::beam::section::{outer_lever_m, patch_moment_n_m_per_v};
use crate::structure::error::StructureError;
use crate::structure::modes::{Modes, PatchModes, PlaceStrain};
use jounce_spec::{GROUND, Patch, Spec};

/// Number of pieces into which each segment of a patch is divided to find its largest strain.
const STRAIN_POINTS: usize = 16;

/// Returns the retained modes of all assembled structures of a spec, without damping.
///
/// # Errors
/// `NotRepresentable`.
pub(in crate::structure) fn assembled_modes(
    spec: &Spec,
    fixed_masses: &[String],
    solution: &StructureSolution,
    discretisation_error: Vec<f64>,
) -> Result<Modes, StructureError> {
    let frequency_rad_s = solution.frequency_rad_s();
    let damping_ratio = vec![0.0; frequency_rad_s.len()];
    let participation_sqrt_kg = vec![0.0; frequency_rad_s.len()];
    let mut modes = Modes {
        frequency_rad_s,
        damping_ratio,
        discretisation_error,
        participation_sqrt_kg,
        ..Modes::default()
    };
    for (part, (assembly, reduced)) in solution.parts.iter().enumerate() {
        let needed = solution.order.needed(part);
        let modal = |row: &Row| solution.order.spread(part, &reduced.modal(row, needed));
        let participation = modal(&assembly.translated_mass()?);
        add(&mut modes.participation_sqrt_kg, &participation);
        let base = spec.base_under(assembly.body.support());
        if base != GROUND {
            let zeros = || vec![0.0; participation.len()];
            add(
                modes
                    .base_sqrt_kg
                    .entry(base.to_owned())
                    .or_insert_with(zeros),
                &participation,
            );
        }
        modes.shape.extend(
            point_rows(assembly)
                .iter()
                .map(|(name, row)| (name.clone(), modal(row))),
        );
        for rows in patch_rows(spec, assembly)? {
            let patch = PatchModes {
                coupling_n_per_v: modal(&rows.coupling),
                capacitance_f: rows.patch.clamped_capacitance_f(),
                leakage_ohm: rows.patch.leakage_ohm,
                strain: rows
                    .strain
                    .iter()
                    .map(|row| PlaceStrain::Along(modal(row)))
                    .collect(),
            };
            modes.patch.insert(rows.name.to_owned(), patch);
        }
    }
    for name in fixed_masses {
        modes.shape.insert(name.clone(), vec![0.0; modes.len()]);
    }
    Ok(modes)
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut()
        .zip(part)
        .for_each(|(sum, part)| *sum += part);
}

/// Returns the displacement of every name of a body: `"table"`, `"beam.root"`, `"beam.end"`,
/// `"beam.tip"`.
fn point_rows(assembly: &Assembly) -> Vec<(String, Row)> {
    let mut rows: Vec<(String, Row)> = assembly
        .body
        .masses()
        .map(|(part, name, _)| (name.to_owned(), assembly.root_displacement(part)))
        .collect();
    for (part, name, beam) in assembly.body.beams() {
        rows.extend(beam.point.iter().map(|(point, position_m)| {
            (
                format!("{name}.{point}"),
                assembly.displacement(part, *position_m),
            )
        }));
        rows.push((format!("{name}.root"), assembly.root_displacement(part)));
        rows.push((
            format!("{name}.end"),
            assembly.displacement(part, beam.length_m),
        ));
    }
    rows
}

/// A patch of a body, with its rows on the strain coordinates.
struct PatchRows<'a> {
    name: &'a str,
    patch: &'a Patch,
    /// Force per volt.
    coupling: Row,
    /// Strain of its outer face at each place where it may be largest.
    strain: Vec<Row>,
}

/// Returns the patches of a body. The moment of a patch changes where the section under it changes:
/// one pair of moments for each such segment.
///
/// # Errors
/// Errors of [`patched_segments`].
fn patch_rows<'a>(
    spec: &'a Spec,
    assembly: &Assembly,
) -> Result<Vec<PatchRows<'a>>, StructureError> {
    let mut all_rows: Vec<PatchRows> = Vec::new();
    for (part, beam_name, beam) in assembly.body.beams() {
        // Merges segments that only a named point separates.
        let mut runs: Vec<PatchedSegment<'a>> = Vec::new();
        for segment in patched_segments(spec, beam_name, beam)? {
            match runs
                .last_mut()
                .filter(|run| run.patches == segment.patches && run.layers == segment.layers)
            {
                Some(run) => run.end_m = segment.end_m,
                None => runs.push(segment),
            }
        }
        for run in &runs {
            let section = run.section(beam);
            for &(name, patch) in &run.patches {
                let moment_n_m_per_v = patch_moment_n_m_per_v(beam, &section, patch);
                let lever_m = outer_lever_m(beam, &section, patch);
                let (start, end) = (
                    assembly.slope(part, run.start_m),
                    assembly.slope(part, run.end_m),
                );
                let rotation = end
                    .iter()
                    .zip(&start)
                    .map(|(end, start)| moment_n_m_per_v * (end - start));
                let strain = (0..=STRAIN_POINTS).map(|k| {
                    // The end belongs to the next element, which may have another section.
                    let part_of = k as f64 / STRAIN_POINTS as f64 * (1.0 - 1e-9);
                    let position_m = run.start_m + (run.end_m - run.start_m) * part_of;
                    assembly
                        .curvature(part, position_m)
                        .iter()
                        .map(|curvature| -lever_m * curvature)
                        .collect::<Row>()
                });
                match all_rows.iter_mut().find(|rows| rows.name == name) {
                    Some(rows) => {
                        rows.coupling
                            .iter_mut()
                            .zip(rotation)
                            .for_each(|(sum, part)| *sum += part);
                        rows.strain.extend(strain);
                    }
                    None => all_rows.push(PatchRows {
                        name,
                        patch,
                        coupling: rotation.collect(),
                        strain: strain.collect(),
                    }),
                }
            }
        }
    }
    Ok(all_rows)
}

/// Assigns a retained mode to each sprung mass: the mode in which it has the greatest share of the
/// kinetic energy. The mass with the greatest share of all is assigned first.
pub(in crate::structure) fn mass_modes(solution: &StructureSolution) -> Vec<MassMode> {
    let mut of_masses = Vec::new();
    for (part, (assembly, reduced)) in solution.parts.iter().enumerate() {
        let mut shares: Vec<(f64, usize, usize, f64)> = Vec::new();
        for (index, _, mass) in assembly.body.masses() {
            let Some(ratio) = mass.damping_ratio else {
                continue;
            };
            let shape = reduced.modal(&assembly.root_displacement(index), assembly.columns);
            shares.extend(
                shape
                    .iter()
                    .enumerate()
                    .map(|(mode, shape)| (mass.mass_kg * shape * shape, index, mode, ratio)),
            );
        }
        shares.sort_by(|one, other| other.0.total_cmp(&one.0));
        let (mut masses, mut modes) = (Vec::new(), Vec::new());
        for (_, mass, mode, ratio) in shares {
            if !masses.contains(&mass) && !modes.contains(&mode) {
                masses.push(mass);
                modes.push(mode);
                of_masses.extend(
                    solution
                        .order
                        .index_of(part, mode)
                        .map(|mode_index| (mode_index, ratio)),
                );
            }
        }
    }
    of_masses
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::structure::assembly::solution::Structures;
    use crate::structure::beam::section::CrossSection;
    use crate::structure::beam::section::tests::{paper_beam, paper_patch};
    use jounce_spec::{Face, Section};

    /// One volt bends each segment by its own moment: `row . row = sum gamma_i^2 l_i / EI_i`, also
    /// if a second patch covers part of the other face. Measured 2e-15.
    #[test]
    fn the_moment_follows_the_section_under_the_patch() {
        let top = paper_patch(Section::Laminate);
        let bottom = Patch {
            face: Face::Bottom,
            start_m: 0.05,
            length_m: 0.1,
            thickness_m: 0.5e-3,
            ..top.clone()
        };
        let beam = paper_beam();
        let mut spec = Spec {
            beam: [("beam".into(), beam.clone())].into(),
            ..Spec::default()
        };
        spec.patch = [
            ("top".into(), top.clone()),
            ("bottom".into(), bottom.clone()),
        ]
        .into();
        let structures = Structures::new(&spec, &[]).unwrap();
        let solution = structures.solve(&structures.spectral_mesh(1e-6)).unwrap();
        let rows = patch_rows(&spec, &solution.parts[0].0).unwrap();
        let covered_section = CrossSection::covered(&beam, [&top].into_iter());
        let both = CrossSection::covered(&beam, [&top, &bottom].into_iter());
        let energy = |section: &CrossSection, length_m: f64| {
            patch_moment_n_m_per_v(&beam, section, &top).powi(2) * length_m
                / section.bending_stiffness_n_m2
        };
        let exact = energy(&covered_section, 0.05 - 0.009) + energy(&both, 0.094 - 0.05);
        let moment: f64 = rows
            .iter()
            .find(|rows| rows.name == "top")
            .unwrap()
            .coupling
            .iter()
            .map(|value| value * value)
            .sum();
        assert!((moment / exact - 1.0).abs() < 1e-13, "{moment:e} {exact:e}");
    }
}
