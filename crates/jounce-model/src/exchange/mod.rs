//! Exchange of structures with other programs, as matrices and as circuits.
//!
//! A structure in any coordinates `u` (degrees of freedom), with the voltages `v` of its electrodes,
//! an acceleration `a` of its base and forces `F` on its points:
//!
//! ```text
//! M u'' + D u' + K u = theta v + P^T F - M b a,    x = P u
//! C v + G (integral of v) + theta^T u + (charge into the circuit) = 0
//! ```
//!
//! | file | matrix | rows x columns |
//! |---|---|---|
//! | `mass`, `stiffness`, `damping` | `M`, `K`, `D` | degrees of freedom, both |
//! | `coupling` | `theta`, force per voltage | degrees of freedom x electrodes |
//! | `capacitance`, `conductance` | `C`, `G`, both diagonal | electrodes, both |
//! | `points` | `P`, displacement of each point | points x degrees of freedom |
//! | `base` | `b`, displacement with the base | degrees of freedom x 1 |
//! | `shapes` | shapes of modes, in place of those of `M` and `K` | degrees of freedom x modes |
//! | `frequency_hz` | frequency of each of these modes, Hz | modes x 1 |
//!
//! [`Names`] names points and electrodes. Jounce writes modal coordinates, in which `M` is the
//! identity, and reads any coordinates, which it reduces to modes.

mod export;
mod faults;
mod import;
mod names;
mod projection;
mod spice;

pub use export::modal_matrices;
pub use faults::ExchangeFaults;
pub use import::{ImportSettings, ImportedModes, import_modes};
pub use names::{NameKind, Names};
pub use spice::netlist;

use jounce_sparse::MatrixEntries;
use std::collections::BTreeMap;

/// Names of the matrices, without the extension of their files, and what each is.
pub const MATRICES: [(&str, &str); 10] = [
    ("mass", "mass"),
    ("stiffness", "stiffness"),
    ("damping", "viscous damping"),
    (
        "coupling",
        "force on each degree of freedom per voltage of each electrode",
    ),
    ("capacitance", "clamped capacitance of each electrode"),
    ("conductance", "leakage of each electrode"),
    ("points", "displacement of each point per degree of freedom"),
    (
        "base",
        "displacement of each degree of freedom with the base",
    ),
    (
        "shapes",
        "displacement of each degree of freedom in each mode",
    ),
    ("frequency_hz", "frequency of each mode of the shapes"),
];

/// Matrices by name, with the names of points and electrodes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MatrixSet {
    /// Matrices of [`MATRICES`] that exist.
    pub matrix: BTreeMap<String, MatrixEntries>,
    /// Names of points and electrodes.
    pub names: Names,
}
