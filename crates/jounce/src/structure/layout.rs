//! A beam cut where something changes or is looked at: at its ends, at the ends of its patches and at its named points.

use super::error::StructureError;
use super::section::CrossSection;
use crate::spec::{Beam, Patch, Spec};

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

/// The segments of the beam `name`, from root to end.
pub(super) fn segments(spec: &Spec, name: &str, beam: &Beam) -> Result<Vec<Segment>, StructureError> {
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
    Ok(cuts_m.windows(2).map(|ends| segment(beam, &patches, ends[0], ends[1])).collect())
}

fn segment(beam: &Beam, patches: &[(&str, &Patch)], start_m: f64, end_m: f64) -> Segment {
    let middle_m = (start_m + end_m) / 2.0;
    let cover = patches.iter().find(|(_, patch)| patch.start_m < middle_m && middle_m < patch.start_m + patch.length_m);
    let section = cover.map_or_else(|| CrossSection::bare(beam), |(_, patch)| CrossSection::patched(beam, patch));
    Segment { start_m, length_m: end_m - start_m, section }
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

/// The patches of a beam, from the root on.
fn patches_on<'a>(spec: &'a Spec, name: &str, beam: &Beam) -> Result<Vec<(&'a str, &'a Patch)>, StructureError> {
    let mut patches: Vec<_> = spec.patch.iter().filter(|(_, patch)| patch.on == name).map(|(key, patch)| (key.as_str(), patch)).collect();
    for (key, patch) in &patches {
        check_patch(key, patch, beam)?;
    }
    patches.sort_by(|(_, one), (_, other)| one.start_m.total_cmp(&other.start_m));
    for pair in patches.windows(2) {
        let ((first, near), (second, far)) = (pair[0], pair[1]);
        let end_m = near.start_m + near.length_m;
        if end_m > far.start_m + SAME_PLACE * beam.length_m {
            return Err(StructureError::PatchesOverlap { first: first.into(), end_m, second: second.into(), start_m: far.start_m });
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
        ("capacitance", patch.capacitance_f),
    ];
    for (key, value) in quantities {
        StructureError::positive(format!("patch.{name}.{key}"), value)?;
    }
    StructureError::not_negative(format!("patch.{name}.density"), patch.density_kg_m3)?;
    StructureError::finite(format!("patch.{name}.d31"), patch.d31_m_per_v)?;
    let (start_m, end_m, length_m) = (patch.start_m, patch.start_m + patch.length_m, beam.length_m);
    if start_m >= 0.0 && end_m <= length_m * (1.0 + SAME_PLACE) {
        Ok(())
    } else {
        Err(StructureError::PatchOutside { patch: name.into(), start_m, end_m, length_m })
    }
}
