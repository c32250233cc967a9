//! Solution of every connected structure of a spec on meshes of one rule.

use super::body::{Body, Part, PartKind, bodies};
use super::reduction::AssemblyModes;
use crate::structure::assembly::Assembly;
use crate::structure::beam::element::Element;
use crate::structure::beam::layout::{BeamSegment, segments};
use crate::structure::beam::mesh::Mesh;
use crate::structure::error::StructureError;
use crate::structure::modes::merge::ModeOrder;
use jounce_spec::{Mass, NO_SUPPORT, Reduction, Spec};
use std::collections::BTreeMap;

/// Largest number of unknowns of a mesh; a dense solve with 2000 takes some seconds.
const MAX_UNKNOWNS: usize = 3000;

/// Bodies of a spec with their beams cut into segments, and the number of retained modes.
#[derive(Debug, Clone)]
pub(in crate::structure) struct Structures<'a> {
    bodies: Vec<Body<'a>>,
    segments: BTreeMap<&'a str, Vec<BeamSegment>>,
    /// Number of retained modes of the bodies: `reduction.modes`, less one for each body held fixed.
    modes: usize,
    /// Number of retained modes of the bodies and plates.
    pub retained: usize,
}

/// Modes of every body on one mesh.
#[derive(Debug, Clone)]
pub(in crate::structure) struct StructureSolution<'a> {
    pub parts: Vec<(Assembly<'a>, AssemblyModes)>,
    /// Retained modes.
    pub order: ModeOrder,
}

impl<'a> Structures<'a> {
    /// Checks the spec and cuts its beams.
    ///
    /// # Errors
    /// Every variant of [`StructureError`] that names a key of the spec, `CannotHold`,
    /// `CannotHoldGiven`, `NoModes`, `TooManyModes`.
    pub fn new(spec: &'a Spec, fixed_masses: &[String]) -> Result<Self, StructureError> {
        let bodies = bodies(spec, fixed_masses)?;
        let cut = |(name, beam): (&'a String, _)| Ok((name.as_str(), segments(spec, name, beam)?));
        let segments = spec
            .beam
            .iter()
            .map(cut)
            .collect::<Result<BTreeMap<_, _>, StructureError>>()?;
        let fixed_count = spec
            .mass
            .keys()
            .filter(|name| fixed_masses.contains(name))
            .count();
        let own_coordinates =
            |mass: &Mass| usize::from(mass.stiffness_n_m.is_some() || mass.on == NO_SUPPORT);
        let available = match segments.is_empty() {
            true => bodies
                .iter()
                .flat_map(Body::masses)
                .map(|(_, _, mass)| own_coordinates(mass))
                .sum(),
            false => Reduction::MAX_MODES,
        };
        // The default number never exceeds the available number.
        let is_default = spec.reduction.modes == Reduction::default().modes;
        let retained = spec.reduction.modes.saturating_sub(fixed_count);
        let has_plates = !spec.plate.is_empty();
        let modes = match retained {
            _ if bodies.is_empty() => 0,
            requested if (is_default || has_plates) && segments.is_empty() => {
                requested.min(available)
            }
            requested => requested,
        };
        let has_structure = !bodies.is_empty() || has_plates;
        if has_structure && retained == 0 {
            return Err(StructureError::NoModes {
                wanted: spec.reduction.modes,
                held: fixed_count,
            });
        }
        if modes > available {
            return Err(StructureError::TooManyModes {
                wanted: modes,
                available,
            });
        }
        StructureError::tolerance(
            "reduction.mesh_tolerance".into(),
            spec.reduction.mesh_tolerance,
        )?;
        Ok(Self {
            bodies,
            segments,
            modes,
            retained: if has_plates { retained } else { modes },
        })
    }

    /// Returns the mesh for mode shapes of relative error `tolerance`.
    pub fn spectral_mesh(&self, tolerance: f64) -> Mesh {
        Mesh::spectral(self.modes, tolerance, self.segments.values().flatten())
    }

    /// Solves every body on a mesh.
    ///
    /// # Errors
    /// `NotRepresentable`; `TooManyModes` if the mesh has fewer unknowns than retained modes.
    pub fn solve(&self, mesh: &Mesh) -> Result<StructureSolution<'a>, StructureError> {
        let parts = self
            .bodies
            .iter()
            .map(|body| solved(self.assembled(body, mesh)))
            .collect::<Result<Vec<_>, _>>()?;
        let frequencies: Vec<&[f64]> = parts
            .iter()
            .map(|(_, reduced)| reduced.frequency_rad_s.as_slice())
            .collect();
        let order = ModeOrder::ascending(&frequencies).first(self.modes);
        match order.len() {
            available if available < self.modes => Err(StructureError::TooManyModes {
                wanted: self.modes,
                available,
            }),
            _ => Ok(StructureSolution { parts, order }),
        }
    }

    /// Returns the rule of cubic elements of at most `longest_m`.
    ///
    /// # Errors
    /// `OutOfRange`, `MeshTooFine`.
    pub fn cubic_mesh(&self, longest_m: f64) -> Result<Mesh, StructureError> {
        StructureError::positive("the longest element".into(), longest_m)?;
        let elements: f64 = self
            .segments
            .values()
            .flatten()
            .map(|segment| (segment.length_m / longest_m).ceil())
            .sum();
        let unknowns = ((2.0 * elements) as usize).saturating_add(self.bodies.len());
        if unknowns > MAX_UNKNOWNS {
            return Err(StructureError::MeshTooFine {
                longest_m,
                unknowns,
                allowed: MAX_UNKNOWNS,
            });
        }
        Ok(Mesh::Cubic { longest_m })
    }

    fn assembled(&self, body: &Body<'a>, mesh: &Mesh) -> Assembly<'a> {
        let elements = |part: &Part| match part.kind {
            PartKind::Beam(_) => self.segments[part.name]
                .iter()
                .flat_map(|segment| mesh.elements(segment))
                .collect::<Vec<Element>>(),
            PartKind::Mass(_) => Vec::new(),
        };
        let elements = body.parts.iter().map(elements).collect();
        Assembly::new(body.clone(), elements)
    }
}

impl StructureSolution<'_> {
    /// Returns the angular frequencies of the retained modes, rad/s.
    pub fn frequency_rad_s(&self) -> Vec<f64> {
        let lists: Vec<&[f64]> = self
            .parts
            .iter()
            .map(|(_, reduced)| reduced.frequency_rad_s.as_slice())
            .collect();
        self.order.gather(&lists)
    }

    /// Number of unknowns of all bodies.
    pub fn unknowns(&self) -> usize {
        self.parts
            .iter()
            .map(|(assembly, _)| assembly.columns)
            .sum()
    }
}

/// Solves one body and sets the sign of every mode.
fn solved(assembly: Assembly) -> Result<(Assembly, AssemblyModes), StructureError> {
    let mut reduced = AssemblyModes::new(&assembly)?;
    reduced.orient(&assembly.free_ends());
    Ok((assembly, reduced))
}
