//! A beam cut where something changes or is looked at: at its ends, at the ends of its patches and at its named points.

use super::error::StructureError;
use super::section::CrossSection;
use crate::spec::{Beam, Face, Patch, Spec};

/// Two cuts nearer than this part of the beam's length are one.
const SAME_PLACE: f64 = 1e-9;

/// A stretch of beam with one cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub start_m: f64,
    pub length_m: f64,
    pub section: CrossSection,
}

impl Segment {
    /// Phase of a bending wave of 1 rad/s over the segment, s^(1/2); it grows with the root of the frequency.
    pub fn phase_per_root_frequency(&self) -> f64 {
        self.length_m * self.section.wave_number_per_root_frequency()
    }
}

/// A stretch of beam with the patches that cover it, at most one on each face.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stretch<'a> {
    pub start_m: f64,
    pub end_m: f64,
    /// Names and patches, in the order of the names.
    pub patches: Vec<(&'a str, &'a Patch)>,
}

/// The segments of the beam `name`, from root to end.
pub(super) fn segments(spec: &Spec, name: &str, beam: &Beam) -> Result<Vec<Segment>, StructureError> {
    let segment = |stretch: Stretch| Segment {
        start_m: stretch.start_m,
        length_m: stretch.end_m - stretch.start_m,
        section: CrossSection::covered(beam, stretch.patches.iter().map(|(_, patch)| *patch)),
    };
    Ok(stretches(spec, name, beam)?.into_iter().map(segment).collect())
}

/// The beam `name` cut at its named points and at the ends of its patches, from root to end.
///
/// # Errors
/// Every variant that names a beam or a patch.
pub(super) fn stretches<'a>(spec: &'a Spec, name: &str, beam: &Beam) -> Result<Vec<Stretch<'a>>, StructureError> {
    check_beam(name, beam)?;
    let patches = patches_on(spec, name, beam)?;
    let mut cuts_m = vec![0.0, beam.length_m];
    let patch_ends = patches.iter().flat_map(|(_, patch)| [patch.start_m, patch.start_m + patch.length_m]);
    for cut_m in patch_ends.chain(beam.point.values().copied()) {
        if cuts_m.iter().all(|have_m| (have_m - cut_m).abs() > SAME_PLACE * beam.length_m) {
            cuts_m.push(cut_m);
        }
    }
    cuts_m.sort_by(f64::total_cmp);
    cuts_m.windows(2).map(|ends| stretch(&patches, ends[0], ends[1])).collect()
}

fn stretch<'a>(patches: &[(&'a str, &'a Patch)], start_m: f64, end_m: f64) -> Result<Stretch<'a>, StructureError> {
    let middle_m = (start_m + end_m) / 2.0;
    let covers = |patch: &Patch| patch.start_m < middle_m && middle_m < patch.start_m + patch.length_m;
    let patches: Vec<_> = patches.iter().filter(|(_, patch)| covers(patch)).copied().collect();
    match patches.as_slice() {
        [(first, one), (second, other)] if one.section != other.section => {
            Err(StructureError::SectionsDiffer { first: (*first).into(), second: (*second).into() })
        }
        _ => Ok(Stretch { start_m, end_m, patches }),
    }
}

fn check_beam(name: &str, beam: &Beam) -> Result<(), StructureError> {
    let quantities = [
        ("length", beam.length_m),
        ("width", beam.width_m),
        ("thickness", beam.thickness_m),
        ("youngs_modulus", beam.youngs_modulus_pa),
        ("density", beam.density_kg_m3),
    ];
    for (key, value) in quantities {
        StructureError::positive(format!("beam.{name}.{key}"), value)?;
    }
    match beam.point.iter().find(|(_, place_m)| !(0.0..=beam.length_m).contains(*place_m)) {
        None => Ok(()),
        Some((point, &place_m)) => {
            Err(StructureError::PointOutside { beam: name.into(), point: point.clone(), place_m, length_m: beam.length_m })
        }
    }
}

/// The patches of a beam, in the order of their names; those of one face do not overlap.
fn patches_on<'a>(spec: &'a Spec, name: &str, beam: &Beam) -> Result<Vec<(&'a str, &'a Patch)>, StructureError> {
    let patches: Vec<_> = spec.patch.iter().filter(|(_, patch)| patch.on == name).map(|(key, patch)| (key.as_str(), patch)).collect();
    for (key, patch) in &patches {
        check_patch(key, patch, beam)?;
    }
    for face in [Face::Top, Face::Bottom] {
        let mut row: Vec<_> = patches.iter().filter(|(_, patch)| patch.face == face).collect();
        row.sort_by(|(_, one), (_, other)| one.start_m.total_cmp(&other.start_m));
        for pair in row.windows(2) {
            let ((first, near), (second, far)) = (pair[0], pair[1]);
            let end_m = near.start_m + near.length_m;
            if end_m > far.start_m + SAME_PLACE * beam.length_m {
                return Err(StructureError::PatchesOverlap {
                    first: (*first).into(),
                    end_m,
                    second: (*second).into(),
                    start_m: far.start_m,
                });
            }
        }
    }
    Ok(patches)
}

fn check_patch(name: &str, patch: &Patch, beam: &Beam) -> Result<(), StructureError> {
    let quantities = [
        ("length", patch.length_m),
        ("width", patch.width_m),
        ("thickness", patch.thickness_m),
        ("youngs_modulus", patch.youngs_modulus_pa),
        ("capacitance", patch.clamped_capacitance_f()),
    ];
    for (key, value) in quantities {
        StructureError::positive(format!("patch.{name}.{key}"), value)?;
    }
    StructureError::not_negative(format!("patch.{name}.density"), patch.density_kg_m3)?;
    let coefficient = if patch.d33_m_per_v.is_some() { "d33" } else { "d31" };
    StructureError::finite(format!("patch.{name}.{coefficient}"), patch.free_strain_per_v())?;
    let (start_m, end_m, length_m) = (patch.start_m, patch.start_m + patch.length_m, beam.length_m);
    if start_m >= 0.0 && end_m <= length_m * (1.0 + SAME_PLACE) {
        Ok(())
    } else {
        Err(StructureError::PatchOutside { patch: name.into(), start_m, end_m, length_m })
    }
}
