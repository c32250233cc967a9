//! Cover of the faces of a beam: passive layers, and patches on them or next to them.

use super::layout::MIN_CUT_DISTANCE;
use crate::structure::error::StructureError;
use jounce_spec::{Beam, Face, Layer, Patch, Section, Spec};

/// A layer or a patch with its position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Covering<'a> {
    name: &'a str,
    kind: CoveringKind<'a>,
    pub start_m: f64,
    pub end_m: f64,
    pub section: Section,
    face: Face,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum CoveringKind<'a> {
    Layer(&'a Layer),
    Patch(&'a Patch),
}

impl<'a> Covering<'a> {
    /// Key path, `"patch.mfc"`.
    pub fn key(&self) -> String {
        match self.kind {
            CoveringKind::Layer(_) => format!("layer.{}", self.name),
            CoveringKind::Patch(_) => format!("patch.{}", self.name),
        }
    }

    /// Returns the layer, if the cover is one.
    pub fn layer(&self) -> Option<&'a Layer> {
        if let CoveringKind::Layer(layer) = self.kind {
            Some(layer)
        } else {
            None
        }
    }

    /// Returns name and patch, if the cover is a patch.
    pub fn patch(&self) -> Option<(&'a str, &'a Patch)> {
        if let CoveringKind::Patch(patch) = self.kind {
            Some((self.name, patch))
        } else {
            None
        }
    }
}

/// Returns the layers and then the patches on the beam `name`, each in the order of their names.
/// Layers on one face do not overlap, nor do patches. A patch that overlaps a layer of its face
/// lies completely on it.
///
/// # Errors
/// Every variant that names a layer or a patch.
pub(super) fn covers<'a>(
    spec: &'a Spec,
    name: &str,
    beam: &Beam,
) -> Result<Vec<Covering<'a>>, StructureError> {
    let layers = spec
        .layer
        .iter()
        .filter(|(_, layer)| layer.on == name)
        .map(|(key, layer)| Covering {
            name: key,
            kind: CoveringKind::Layer(layer),
            start_m: layer.start_m,
            end_m: layer.start_m + layer.length_m,
            section: layer.section,
            face: layer.face,
        });
    let patches = spec
        .patch
        .iter()
        .filter(|(_, patch)| patch.on == name)
        .map(|(key, patch)| Covering {
            name: key,
            kind: CoveringKind::Patch(patch),
            start_m: patch.start_m,
            end_m: patch.start_m + patch.length_m,
            section: patch.section,
            face: patch.face,
        });
    let covers: Vec<Covering> = layers.chain(patches).collect();
    covers.iter().try_for_each(|cover| check(cover, beam))?;
    for face in [Face::Top, Face::Bottom] {
        let of = |is_layer: bool| {
            covers
                .iter()
                .filter(move |cover| cover.face == face && cover.layer().is_some() == is_layer)
        };
        check_adjacent(of(true).collect(), beam)?;
        check_adjacent(of(false).collect(), beam)?;
        if let Some((layer, patch)) = of(true)
            .flat_map(|layer| of(false).map(move |patch| (layer, patch)))
            .find(|(layer, patch)| is_partly_on(patch, layer, beam))
        {
            let [start_m, end_m] = [layer.start_m, layer.end_m];
            return Err(StructureError::LayerUnderPart {
                layer: layer.key(),
                start_m,
                end_m,
                patch: patch.key(),
            });
        }
    }
    Ok(covers)
}

/// True for a patch that overlaps a layer but does not lie completely on it.
fn is_partly_on(patch: &Covering, layer: &Covering, beam: &Beam) -> bool {
    let slack_m = MIN_CUT_DISTANCE * beam.length_m;
    let meets = patch.start_m < layer.end_m - slack_m && layer.start_m < patch.end_m - slack_m;
    meets && (patch.start_m < layer.start_m - slack_m || patch.end_m > layer.end_m + slack_m)
}

fn check_adjacent(mut row: Vec<&Covering>, beam: &Beam) -> Result<(), StructureError> {
    row.sort_by(|one, other| one.start_m.total_cmp(&other.start_m));
    match row
        .windows(2)
        .find(|pair| pair[0].end_m > pair[1].start_m + MIN_CUT_DISTANCE * beam.length_m)
    {
        None => Ok(()),
        Some(pair) => Err(StructureError::PatchesOverlap {
            first: pair[0].key(),
            end_m: pair[0].end_m,
            second: pair[1].key(),
            start_m: pair[1].start_m,
        }),
    }
}

fn check(cover: &Covering, beam: &Beam) -> Result<(), StructureError> {
    let key = cover.key();
    match cover.kind {
        CoveringKind::Layer(layer) => {
            let quantities = [
                layer.length_m,
                layer.width_m,
                layer.thickness_m,
                layer.youngs_modulus_pa,
            ];
            check_positive(&key, quantities)?;
            StructureError::not_negative(format!("{key}.density"), layer.density_kg_m3)?;
        }
        CoveringKind::Patch(patch) => {
            check_positive(
                &key,
                [
                    patch.length_m,
                    patch.width_m,
                    patch.thickness_m,
                    patch.youngs_modulus_pa,
                ],
            )?;
            StructureError::positive(format!("{key}.capacitance"), patch.clamped_capacitance_f())?;
            StructureError::not_negative(format!("{key}.density"), patch.density_kg_m3)?;
            let coefficient = if patch.d33_m_per_v.is_some() {
                "d33"
            } else {
                "d31"
            };
            StructureError::finite(format!("{key}.{coefficient}"), patch.free_strain_per_v())?;
        }
    }
    let (start_m, end_m, length_m) = (cover.start_m, cover.end_m, beam.length_m);
    if start_m >= 0.0 && end_m <= length_m * (1.0 + MIN_CUT_DISTANCE) {
        Ok(())
    } else {
        Err(StructureError::PatchOutside {
            patch: key,
            start_m,
            end_m,
            length_m,
        })
    }
}

fn check_positive(key: &str, values: [f64; 4]) -> Result<(), StructureError> {
    let names = ["length", "width", "thickness", "youngs_modulus"];
    names
        .iter()
        .zip(values)
        .try_for_each(|(name, value)| StructureError::positive(format!("{key}.{name}"), value))
}
