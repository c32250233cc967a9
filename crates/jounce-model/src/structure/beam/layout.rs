//! Division of a beam into segments: at its ends, at the ends of its layers and patches and at its
//! named points.

use super::coverage::{Covering, covers};
use super::section::CrossSection;
use crate::structure::error::StructureError;
use jounce_spec::{Beam, Layer, Patch, Section, Spec};

/// Distance, relative to the length of the beam, below which two cuts are merged.
pub(super) const MIN_CUT_DISTANCE: f64 = 1e-9;

/// A segment of a beam with one cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) struct BeamSegment {
    pub start_m: f64,
    pub length_m: f64,
    pub section: CrossSection,
}

impl BeamSegment {
    /// Phase of a bending wave of 1 rad/s over the segment, s^(1/2); it is proportional to the root
    /// of the frequency.
    pub fn phase_per_root_frequency(&self) -> f64 {
        self.length_m * self.section.wave_number_per_root_frequency()
    }
}

/// A segment of a beam with the patches that cover it, at most one on each face.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::structure) struct PatchedSegment<'a> {
    pub start_m: f64,
    pub end_m: f64,
    /// Passive layers, at most one on each face.
    pub layers: Vec<&'a Layer>,
    /// Names and patches, in the order of the names.
    pub patches: Vec<(&'a str, &'a Patch)>,
}

impl PatchedSegment<'_> {
    /// Returns the cross-section of the segment.
    pub fn section(&self, beam: &Beam) -> CrossSection {
        CrossSection::laminated(
            beam,
            self.layers.iter().copied(),
            self.patches.iter().map(|(_, patch)| *patch),
        )
    }
}

/// Returns the segments of the beam `name`, from root to end.
pub(in crate::structure) fn segments(
    spec: &Spec,
    name: &str,
    beam: &Beam,
) -> Result<Vec<BeamSegment>, StructureError> {
    let segment = |patched: PatchedSegment| BeamSegment {
        start_m: patched.start_m,
        length_m: patched.end_m - patched.start_m,
        section: patched.section(beam),
    };
    Ok(patched_segments(spec, name, beam)?
        .into_iter()
        .map(segment)
        .collect())
}

/// Returns the beam `name` cut at its named points and at the ends of its layers and patches, from
/// root to end.
///
/// # Errors
/// Every variant that names a beam or a patch.
pub(in crate::structure) fn patched_segments<'a>(
    spec: &'a Spec,
    name: &str,
    beam: &Beam,
) -> Result<Vec<PatchedSegment<'a>>, StructureError> {
    check_beam(name, beam)?;
    let covers = covers(spec, name, beam)?;
    let mut cuts_m = vec![0.0, beam.length_m];
    let ends = covers.iter().flat_map(|cover| [cover.start_m, cover.end_m]);
    for cut_m in ends.chain(beam.point.values().copied()) {
        if cuts_m
            .iter()
            .all(|have_m| (have_m - cut_m).abs() > MIN_CUT_DISTANCE * beam.length_m)
        {
            cuts_m.push(cut_m);
        }
    }
    cuts_m.sort_by(f64::total_cmp);
    cuts_m
        .windows(2)
        .map(|ends| patched_segment(&covers, ends[0], ends[1]))
        .collect()
}

fn patched_segment<'a>(
    covers: &[Covering<'a>],
    start_m: f64,
    end_m: f64,
) -> Result<PatchedSegment<'a>, StructureError> {
    let middle_m = (start_m + end_m) / 2.0;
    let covers_here: Vec<&Covering> = covers
        .iter()
        .filter(|cover| cover.start_m < middle_m && middle_m < cover.end_m)
        .collect();
    let section = covers_here
        .first()
        .map_or(Section::default(), |cover| cover.section);
    match covers_here.iter().find(|cover| cover.section != section) {
        Some(other) => Err(StructureError::SectionsDiffer {
            first: covers_here[0].key(),
            second: other.key(),
        }),
        None => Ok(PatchedSegment {
            start_m,
            end_m,
            layers: covers_here
                .iter()
                .filter_map(|cover| cover.layer())
                .collect(),
            patches: covers_here
                .iter()
                .filter_map(|cover| cover.patch())
                .collect(),
        }),
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
    let clamp = beam
        .root_stiffness_n_m_rad
        .map(|stiffness_n_m_rad| ("root_stiffness", stiffness_n_m_rad));
    for (key, value) in quantities.into_iter().chain(clamp) {
        StructureError::positive(format!("beam.{name}.{key}"), value)?;
    }
    match beam
        .point
        .iter()
        .find(|(_, position_m)| !(0.0..=beam.length_m).contains(*position_m))
    {
        None => Ok(()),
        Some((point, &position_m)) => Err(StructureError::PointOutside {
            beam: name.into(),
            point: point.clone(),
            place_m: position_m,
            length_m: beam.length_m,
        }),
    }
}
