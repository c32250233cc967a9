//! Mass-normalised modes of beams, plates, masses and supports.
//!
//! The files in `beam`, `assembly` and `modes`, in the order of the computation: [`section`]
//! (layers to `EI`, mass and neutral axis), `layout` (a beam cut into segments), `mesh` and
//! `element` (segments divided into polynomials), `body`, `placement` and `assembly` (connected
//! structures in strain coordinates), `reduction` (the eigenproblem), `solution` and `refinement`
//! (all bodies, until converged), then `damping`, `assembled`, `user` and `merge` (one list of
//! [`Modes`]) and `along` (figures). `plate` holds the finite elements of plates.
//!
//! ```text
//! (EI w'')'' + m w_tt = 0    on each segment of constant EI (N m^2) and m (kg/m); w the displacement, m
//! w = u, w' = v (k_r (w' - v) = EI w'' on a clamp of rotary stiffness k_r, N m/rad) at the root, u and v displacement and slope of what carries it (0 on the ground, v = 0 on a sprung mass)
//! M u_tt + k (u - w) = force of the beams on a mass whose spring stands on a place of displacement w
//! ```
//!
//! Validation (`crates/jounce-model/tests/structure`): the harvester of the paper against the
//! transfer matrix of its segments in 40-digit arithmetic, 4e-15 relative in every frequency;
//! uniform cantilever against its closed form, 40 modes; Table 2 to every printed digit; plain
//! cubic meshes of up to 512 elements without roundoff above 1e-13.
//!
//! Source: impact-harvester paper (2019), sections 2 and 3; Euler-Bernoulli theory.

mod assembly;
mod beam;
mod error;
mod modes;
mod plate;

pub use beam::section;
pub use error::StructureError;
pub use modes::along::BeamShape;
pub use modes::{Modes, PatchModes, PlaceStrain};

use assembly::refinement::{refined, relative_change};
use assembly::solution::{StructureSolution, Structures};
use jounce_spec::{PlatePoint, Spec};
use modes::assembled::{assembled_modes, mass_modes};
use modes::damping::damping_ratios;
use modes::merge::{ModeOrder, merged};
use std::collections::BTreeMap;

/// Returns the modes of a harvester: `reduction.modes` of its assembled structures, and all modes
/// defined in the spec.
///
/// Every mode is mass-normalised. The sign is positive at the free end of the first beam, by name,
/// that moves at least half as far as the furthest end. The mesh is refined until every retained
/// frequency has converged to `reduction.mesh_tolerance`; [`Modes::discretisation_error`] holds the
/// estimates.
///
/// # Errors
/// [`StructureError`], with the place and the value in the spec.
///
/// # Limits
/// Thin plates (no shear), one mesh per plate; frequencies of plates have at most four digits.
/// Slender beams (no shear, no rotary inertia except that of fixed masses), small deflections, at
/// most 200 modes.
pub fn modes(spec: &Spec) -> Result<Modes, StructureError> {
    modes_holding(spec, &[])
}

/// Returns the modes with some masses held fixed, `["table"]` for the clamped beam of Table 2. A
/// held mass has shape 0 and no mode, so each reduces the number of retained modes by one.
///
/// # Errors
/// As [`modes`]; `CannotHold` for a name that is not a mass, `CannotHoldGiven` for a structure
/// defined by its modes.
pub fn modes_holding(spec: &Spec, fixed_masses: &[String]) -> Result<Modes, StructureError> {
    modes_at(spec, fixed_masses, &PlatePlaces::new())
}

/// Returns the modes of [`modes_holding`], with their shapes at more places of plates: `PLATE.NAME`
/// for each name.
///
/// # Errors
/// As [`modes_holding`].
pub fn modes_at(
    spec: &Spec,
    fixed_masses: &[String],
    places: &PlatePlaces,
) -> Result<Modes, StructureError> {
    let structures = Structures::new(spec, fixed_masses)?;
    let (solution, error) = refined(&structures, spec.reduction.mesh_tolerance)?;
    SpecModes::new(spec, (fixed_masses, places), &structures, &solution, error).map(|all| all.modes)
}

/// Returns the modes on a plain mesh of cubic elements of at most `longest_element_m`, as most
/// finite-element programs do; [`Modes::discretisation_error`] is relative to the converged
/// frequencies.
///
/// # Errors
/// As [`modes_holding`]; `MeshTooFine`, and `TooManyModes` for a mesh with fewer unknowns than
/// modes.
pub fn modes_on_cubic_mesh(
    spec: &Spec,
    fixed_masses: &[String],
    longest_element_m: f64,
) -> Result<Modes, StructureError> {
    let structures = Structures::new(spec, fixed_masses)?;
    let (converged, _) = refined(&structures, spec.reduction.mesh_tolerance)?;
    let solution = structures.solve(&structures.cubic_mesh(longest_element_m)?)?;
    let error = relative_change(&solution.frequency_rad_s(), &converged.frequency_rad_s());
    SpecModes::new(
        spec,
        (fixed_masses, &PlatePlaces::new()),
        &structures,
        &solution,
        error,
    )
    .map(|all| all.modes)
}

/// Returns the mode shapes along every beam at `samples` equidistant places, with the modes in the
/// order of [`modes_holding`].
///
/// # Errors
/// As [`modes_holding`].
pub fn shapes_along_beams(
    spec: &Spec,
    fixed_masses: &[String],
    samples: usize,
) -> Result<BTreeMap<String, BeamShape>, StructureError> {
    let structures = Structures::new(spec, fixed_masses)?;
    let (solution, error) = refined(&structures, spec.reduction.mesh_tolerance)?;
    let mut shapes = modes::along::beam_shapes(&solution, samples);
    let none = PlatePlaces::new();
    let all = SpecModes::new(spec, (fixed_masses, &none), &structures, &solution, error)?;
    for shape in shapes.values_mut() {
        shape.shape = shape
            .shape
            .iter()
            .map(|values| all.spread(values))
            .collect();
    }
    Ok(shapes)
}

/// Places of plates with their names, by plate.
pub type PlatePlaces = BTreeMap<String, Vec<(String, PlatePoint)>>;

/// Modes of a spec, and the origin of each.
struct SpecModes {
    modes: Modes,
    /// Merges the modes of the bodies (part 0) with those of the plates.
    with_plates: ModeOrder,
    /// Merges these (part 0) with the modes of every `[modal.NAME]`.
    with_user_modes: ModeOrder,
}

impl SpecModes {
    /// Adds the plates to the solved bodies, retains the lowest modes, sets their damping ratios,
    /// and adds the modes defined in the spec.
    fn new(
        spec: &Spec,
        (fixed_masses, places): (&[String], &PlatePlaces),
        structures: &Structures,
        solution: &StructureSolution,
        error: Vec<f64>,
    ) -> Result<Self, StructureError> {
        let mut parts = vec![assembled_modes(spec, fixed_masses, solution, error)?];
        parts.extend(plate::plate_modes(spec, structures.retained, places)?);
        let (with_plates, assembled) = merged(&parts);
        let with_plates = with_plates.first(structures.retained);
        let mut assembled = assembled.first(structures.retained);
        let of_masses: Vec<_> = mass_modes(solution)
            .into_iter()
            .filter_map(|(mode, ratio)| Some((with_plates.index_of(0, mode)?, ratio)))
            .collect();
        let (damping_ratio, unused_damping_ratios) =
            damping_ratios(&assembled.frequency_rad_s, &of_masses, &spec.damping)?;
        assembled.damping_ratio = damping_ratio;
        let mut parts = vec![assembled];
        for (name, modal) in &spec.modal {
            parts.push(modes::user::user_modes(name, modal)?);
        }
        let (with_user_modes, modes) = merged(&parts);
        let modes = Modes {
            unused_damping_ratios,
            ..modes
        };
        Ok(Self {
            modes,
            with_plates,
            with_user_modes,
        })
    }

    /// Distributes one value per mode of the bodies over all modes.
    fn spread(&self, values: &[f64]) -> Vec<f64> {
        let with_plates = self.with_plates.spread(0, values);
        self.with_user_modes.spread(0, &with_plates)
    }
}
