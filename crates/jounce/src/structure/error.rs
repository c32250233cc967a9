//! What can go wrong between a spec and its modes; each error names the place, the value and what is allowed.

/// Why a spec has no modes.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum StructureError {
    /// A quantity is not what it must be.
    #[error("{place} is {value}: it must be {allowed}")]
    OutOfRange {
        /// Key path, `"beam.beam.length"`.
        place: String,
        /// The value, SI.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A beam or a mass stands on something that is not there.
    #[error("{place} is \"{found}\": it must be the point of a beam or one of ({known})")]
    UnknownSupport {
        /// Key path, `"beam.arm.root"`.
        place: String,
        /// What it says.
        found: String,
        /// Masses and words that are known.
        known: String,
    },
    /// Beams or masses that stand on each other and on nothing else.
    #[error(
        "nothing holds \"{name}\" up: follow what it stands on and let one of them stand on the ground"
    )]
    SupportCycle {
        /// One of them.
        name: String,
    },
    /// A mass on the ground that nothing lets move.
    #[error(
        "mass.{mass} stands on the ground without a spring: give it a stiffness, or on = \"nothing\" for a free mass"
    )]
    MissingSpring {
        /// Name of the mass.
        mass: String,
    },
    /// A free mass with a spring.
    #[error(
        "mass.{mass} stands on nothing and has a spring: leave out its stiffness, or name what the spring is fixed to"
    )]
    SpringToNothing {
        /// Name of the mass.
        mass: String,
    },
    /// A patch sits on a beam that is not there.
    #[error("{place}.on is \"{beam}\": it must be the name of a beam ({beams})")]
    UnknownBeam {
        /// Key path of the patch or layer.
        place: String,
        /// What it sits on.
        beam: String,
        /// The beams there are.
        beams: String,
    },
    /// A patch does not lie within its beam.
    #[error(
        "{patch} covers {start_m} m to {end_m} m of a beam that is {length_m} m long: it must lie within the beam"
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
    /// Two patches cover the same place.
    #[error(
        "{first} ends at {end_m} m and {second} starts at {start_m} m of the same face: patches must not overlap, nor layers"
    )]
    PatchesOverlap {
        /// Key path of the patch or layer nearer the root.
        first: String,
        /// Where it ends, m.
        end_m: f64,
        /// Key path of the other.
        second: String,
        /// Where that one starts, m.
        start_m: f64,
    },
    /// Two patches on the two faces of one stretch with different rules of section.
    #[error("{first} and {second} cover the same stretch: give both the same section")]
    SectionsDiffer {
        /// Key path of one.
        first: String,
        /// Key path of the other.
        second: String,
    },
    /// A layer that lies under part of a patch.
    #[error(
        "{layer} covers {start_m} m to {end_m} m, under a part of {patch}: let it reach under the whole patch or end beside it"
    )]
    LayerUnderPart {
        /// Key path of the layer.
        layer: String,
        /// Its start, from the root, m.
        start_m: f64,
        /// Its end, m.
        end_m: f64,
        /// Key path of the patch.
        patch: String,
    },
    /// A named point does not lie on its beam.
    #[error("beam.{beam}.point.{point} is {place_m} m: it must lie between 0 and {length_m} m")]
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
    /// Only masses on the ground, or free, can be held fixed.
    #[error("cannot hold \"{name}\" fixed: only a mass can be held ({masses})")]
    CannotHold {
        /// What was to be held.
        name: String,
        /// The masses there are.
        masses: String,
    },
    /// A structure given by its modes cannot be held at a point.
    #[error(
        "cannot hold \"{name}\" fixed: it belongs to a structure given by its modes; give the modes with that point held"
    )]
    CannotHoldGiven {
        /// What was to be held.
        name: String,
    },
    /// The reduction asks for no mode at all.
    #[error(
        "reduction.modes is {wanted} and {held} bodies are held: at least one mode must remain"
    )]
    NoModes {
        /// `reduction.modes`
        wanted: usize,
        /// Number of bodies held fixed.
        held: usize,
    },
    /// The reduction asks for more modes than there are.
    #[error(
        "{wanted} modes are asked for and the structure has {available}: set reduction.modes to at most {available}"
    )]
    TooManyModes {
        /// Number of modes asked for.
        wanted: usize,
        /// Number of modes there are, or that this solver takes.
        available: usize,
    },
    /// Refinement ended before the frequencies had converged.
    #[error(
        "the frequencies still change by {change:e} (relative) with {unknowns} unknowns: reduction.mesh_tolerance = {tolerance:e} \
         is below what double precision gives for this structure; try {suggestion:e}"
    )]
    NotConverged {
        /// Largest relative change of a kept frequency in the last refinement.
        change: f64,
        /// Number of unknowns of the last refinement.
        unknowns: usize,
        /// `reduction.mesh_tolerance`
        tolerance: f64,
        /// A tolerance that would have been met.
        suggestion: f64,
    },
    /// A mesh with more unknowns than this solver takes.
    #[error(
        "elements of at most {longest_m} m make {unknowns} unknowns: at most {allowed} are taken; use longer elements"
    )]
    MeshTooFine {
        /// Longest element asked for, m.
        longest_m: f64,
        /// Number of unknowns this makes.
        unknowns: usize,
        /// Largest number taken.
        allowed: usize,
    },
    /// Numbers so large or so small that the eigenproblem cannot be written in double precision.
    #[error(
        "the stiffness and mass of \"{body}\" are outside the range of double precision: check the units of its quantities"
    )]
    NotRepresentable {
        /// A beam or mass of the structure.
        body: String,
    },
    /// There are more flexible modes than damping ratios.
    #[error("{flexible} flexible modes need a damping ratio and damping.ratios gives {given}: add {} or set damping.beyond", flexible - given)]
    MissingDamping {
        /// Number of kept modes that belong to no mass.
        flexible: usize,
        /// Length of `damping.ratios`.
        given: usize,
    },
    /// A list of a structure given by its modes has the wrong length.
    #[error("{place} has {found} values: it must have {expected}, one per entry of frequency_hz")]
    WrongLength {
        /// Key path, `"modal.harvester.point.tip"`.
        place: String,
        /// Number of values found.
        found: usize,
        /// Number of modes.
        expected: usize,
    },
}

impl StructureError {
    /// Refuses a value unless it is finite and greater than zero.
    pub(super) fn positive(place: String, value: f64) -> Result<(), Self> {
        Self::require(value > 0.0, place, value, "finite and greater than 0")
    }

    /// Refuses a value unless it is finite and not negative.
    pub(super) fn not_negative(place: String, value: f64) -> Result<(), Self> {
        Self::require(value >= 0.0, place, value, "finite and at least 0")
    }

    /// Refuses a value unless it is finite.
    pub(super) fn finite(place: String, value: f64) -> Result<(), Self> {
        Self::require(true, place, value, "finite")
    }

    /// Refuses a tolerance that is looser than useful or tighter than double precision.
    pub(super) fn tolerance(place: String, value: f64) -> Result<(), Self> {
        Self::require(
            (1e-13..=0.1).contains(&value),
            place,
            value,
            "between 1e-13 and 0.1",
        )
    }

    fn require(within: bool, place: String, value: f64, allowed: &'static str) -> Result<(), Self> {
        if within && value.is_finite() {
            Ok(())
        } else {
            Err(Self::OutOfRange {
                place,
                value,
                allowed,
            })
        }
    }
}
