//! Errors between a spec and its modes; each names the place, the value and the allowed values.

/// Reason why a spec has no modes.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum StructureError {
    /// A quantity has a value that is not allowed.
    #[error("{place} is {value}; it must be {allowed}")]
    OutOfRange {
        /// Key path, `"beam.beam.length"`.
        place: String,
        /// The value, SI.
        value: f64,
        /// Allowed values.
        allowed: &'static str,
    },
    /// The support of a beam or a mass does not exist.
    #[error(
        "{place} is \"{found}\"; it must be the point of a beam, for a mass also of a plate, or one of ({known})"
    )]
    UnknownSupport {
        /// Key path, `"beam.arm.root"`.
        place: String,
        /// Support in the spec.
        found: String,
        /// Known masses and words.
        known: String,
    },
    /// Beams or masses support each other in a loop.
    #[error("the supports of \"{name}\" form a loop; put one of them on the ground")]
    SupportCycle {
        /// Name of a part of the loop.
        name: String,
    },
    /// A mass on the ground has no degree of freedom.
    #[error(
        "mass.{mass} is on the ground without a spring; give it a stiffness, or on = \"nothing\" for a free mass"
    )]
    MissingSpring {
        /// Name of the mass.
        mass: String,
    },
    /// A free mass has a spring.
    #[error(
        "mass.{mass} has a spring but no support; omit its stiffness, or name the support of the spring"
    )]
    SpringToNothing {
        /// Name of the mass.
        mass: String,
    },
    /// The beam or plate of a patch does not exist.
    #[error("{place}.on is \"{beam}\"; it must be the name of a beam or a plate ({beams})")]
    UnknownBeam {
        /// Key path of the patch or layer.
        place: String,
        /// Beam or plate in the spec.
        beam: String,
        /// Existing beams and plates.
        beams: String,
    },
    /// A patch does not lie within its beam.
    #[error(
        "{patch} covers {start_m} m to {end_m} m of a beam that is {length_m} m long; it must lie within the beam"
    )]
    PatchOutside {
        /// Key path of the patch or layer.
        patch: String,
        /// Start, from the root, m.
        start_m: f64,
        /// End, from the root, m.
        end_m: f64,
        /// Length of the beam, m.
        length_m: f64,
    },
    /// Two patches overlap.
    #[error(
        "{first} ends at {end_m} m and {second} starts at {start_m} m of the same face; patches must not overlap, nor must layers"
    )]
    PatchesOverlap {
        /// Key path of the patch or layer nearer the root.
        first: String,
        /// End of the first, m.
        end_m: f64,
        /// Key path of the other patch or layer.
        second: String,
        /// Start of the other, m.
        start_m: f64,
    },
    /// Two patches at the same position on the two faces have different section models.
    #[error("{first} and {second} cover the same part of the beam; give both the same section")]
    SectionsDiffer {
        /// Key path of the first.
        first: String,
        /// Key path of the second.
        second: String,
    },
    /// A layer lies under only a part of a patch.
    #[error(
        "{layer} covers {start_m} m to {end_m} m, under a part of {patch}; extend it under the complete patch, or end it next to the patch"
    )]
    LayerUnderPart {
        /// Key path of the layer.
        layer: String,
        /// Start of the layer, from the root, m.
        start_m: f64,
        /// End of the layer, m.
        end_m: f64,
        /// Key path of the patch.
        patch: String,
    },
    /// A named point does not lie on its beam.
    #[error("beam.{beam}.point.{point} is {place_m} m; it must be from 0 to {length_m} m")]
    PointOutside {
        /// Name of the beam.
        beam: String,
        /// Name of the point.
        point: String,
        /// Distance from the root, m.
        place_m: f64,
        /// Length of the beam, m.
        length_m: f64,
    },
    /// Only masses on the ground and free masses can be held fixed.
    #[error(
        "cannot hold {} fixed; only a mass on the base or a free mass can be held ({masses})",
        quoted(.names)
    )]
    CannotHold {
        /// Names of the parts to hold.
        names: Vec<String>,
        /// Existing masses.
        masses: String,
    },
    /// A structure defined by its modes cannot be held at a point.
    #[error(
        "cannot hold {} fixed, because the structure there is defined by its modes; give the modes with that point held",
        quoted(.names)
    )]
    CannotHoldGiven {
        /// Names of the parts to hold.
        names: Vec<String>,
    },
    /// No mode would remain.
    #[error(
        "reduction.modes is {wanted} and {held} bodies are held; at least one mode must remain"
    )]
    NoModes {
        /// `reduction.modes`
        wanted: usize,
        /// Number of bodies held fixed.
        held: usize,
    },
    /// More modes are requested than the structure has.
    #[error(
        "{wanted} modes are requested, but the structure has {available}; set reduction.modes to at most {available}"
    )]
    TooManyModes {
        /// Requested number of modes.
        wanted: usize,
        /// Available number of modes, or the limit of this solver.
        available: usize,
    },
    /// Mesh refinement ended before the frequencies converged.
    #[error(
        "the frequencies still change by {change:e} (relative) with {unknowns} unknowns; reduction.mesh_tolerance = {tolerance:e} \
         is below the accuracy of double precision for this structure; try {suggestion:e}"
    )]
    NotConverged {
        /// Largest relative change of a retained frequency in the last refinement.
        change: f64,
        /// Number of unknowns of the last refinement.
        unknowns: usize,
        /// `reduction.mesh_tolerance`
        tolerance: f64,
        /// A tolerance that is attainable.
        suggestion: f64,
    },
    /// Patches, layers and retained modes ask for more elements of a plate than this solver allows.
    #[error(
        "plate.{plate} needs {unknowns} unknowns, more than the {allowed} that are allowed; retain fewer modes, use fewer patches and layers, \
         or let their edges coincide"
    )]
    PlateTooFine {
        /// Name of the plate.
        plate: String,
        /// Number of unknowns.
        unknowns: usize,
        /// Largest number of unknowns.
        allowed: usize,
    },
    /// Refinement of a plate ended before its frequencies converged.
    #[error(
        "the frequencies of plate.{plate} still change by {change:e} (relative) with {unknowns} unknowns, more than {tolerance:e}; \
         retain fewer modes, move patch edges that nearly coincide apart or together, or set reduction.mesh_tolerance to {:e}", (2.0 * change).min(0.1)
    )]
    PlateNotConverged {
        /// Name of the plate.
        plate: String,
        /// Largest relative change of a retained frequency in the last refinement.
        change: f64,
        /// Number of unknowns of the last refinement.
        unknowns: usize,
        /// Required relative change.
        tolerance: f64,
    },
    /// The eigenproblem of a plate has no solution.
    #[error(
        "plate.{plate} has no modes: {reason}; check the units of the plate, its layers, patches and masses"
    )]
    PlateWithoutModes {
        /// Name of the plate.
        plate: String,
        /// Message of the eigensolver.
        reason: String,
    },
    /// The mesh has more unknowns than this solver allows.
    #[error(
        "elements of at most {longest_m} m give {unknowns} unknowns; at most {allowed} are allowed; use longer elements"
    )]
    MeshTooFine {
        /// Requested longest element, m.
        longest_m: f64,
        /// Resulting number of unknowns.
        unknowns: usize,
        /// Largest allowed number.
        allowed: usize,
    },
    /// The eigenproblem is outside the range of double precision.
    #[error(
        "the stiffness and mass of \"{body}\" are outside the range of double precision; check the units of its quantities"
    )]
    NotRepresentable {
        /// A beam or mass of the structure.
        body: String,
    },
    /// There are more flexible modes than damping ratios.
    #[error("{flexible} flexible modes need a damping ratio, but damping.ratios gives {given}; add {} or set damping.beyond", flexible - given)]
    MissingDamping {
        /// Number of retained modes that belong to no mass.
        flexible: usize,
        /// Length of `damping.ratios`.
        given: usize,
    },
    /// A list of a structure defined by its modes has the wrong length.
    #[error("{place} has {found} values; it must have {expected}, one per entry of frequency_hz")]
    WrongLength {
        /// Key path, `"modal.harvester.point.tip"`.
        place: String,
        /// Found number of values.
        found: usize,
        /// Number of modes.
        expected: usize,
    },
}

impl StructureError {
    /// Refuses a value unless it is finite and greater than zero.
    pub(super) fn positive(name: String, value: f64) -> Result<(), Self> {
        Self::require(value > 0.0, name, value, "finite and greater than 0")
    }

    /// Refuses a value unless it is finite and not negative.
    pub(super) fn not_negative(name: String, value: f64) -> Result<(), Self> {
        Self::require(value >= 0.0, name, value, "finite and at least 0")
    }

    /// Refuses a value unless it is finite.
    pub(super) fn finite(name: String, value: f64) -> Result<(), Self> {
        Self::require(true, name, value, "finite")
    }

    /// Refuses a tolerance that is looser than useful or below the accuracy of double precision.
    pub(super) fn tolerance(name: String, value: f64) -> Result<(), Self> {
        Self::require(
            (1e-13..=0.1).contains(&value),
            name,
            value,
            "between 1e-13 and 0.1",
        )
    }

    fn require(within: bool, name: String, value: f64, allowed: &'static str) -> Result<(), Self> {
        if within && value.is_finite() {
            Ok(())
        } else {
            Err(Self::OutOfRange {
                place: name,
                value,
                allowed,
            })
        }
    }
}

/// Returns names in quotes, `"tip", "table"`.
fn quoted(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    quoted.join(", ")
}
