//! Keys of every table of a spec, one file per kind of element.

mod beam;
mod circuit;
mod contact_bodies;
mod device;
mod drive;
mod drive_signal;
mod electrodes;
mod gravity;
mod layer;
mod mass;
mod modal;
mod patch;
mod plate;
mod pores;
mod regulator;
mod settings;
mod source;
mod stop;
mod stop_law;

pub(super) use contact_bodies::no_number;

use super::Spec;
use super::key::{Element, Elements, Key, Keyed, Kind, Slot};

/// Frequency limits of jounce, Hz.
pub(super) const FREQUENCY_LIMITS_HZ: (f64, f64) = (1e-6, 1e6);

impl Keyed for Spec {
    const KEYS: &'static [Key<Self>] = SPEC;

    fn blank() -> Self {
        Self::default()
    }
}

/// Tables of a spec.
static SPEC: &[Key<Spec>] = &[
    named_tables(
        "beam",
        "uniform beams, clamped at their root",
        |s: &Spec| &s.beam,
        |s| &mut s.beam,
    ),
    named_tables(
        "plate",
        "rectangular thin plates with clamped, simply supported or free edges",
        |s: &Spec| &s.plate,
        |s| &mut s.plate,
    ),
    named_tables(
        "patch",
        "piezoelectric patches bonded to beams and plates",
        |s: &Spec| &s.patch,
        |s| &mut s.patch,
    ),
    named_tables(
        "layer",
        "passive layers on the faces of beams and plates, under the patches: bond lines, shims, coatings",
        |s: &Spec| &s.layer,
        |s| &mut s.layer,
    ),
    named_tables(
        "mass",
        "rigid masses: on a spring, fixed to a beam or a plate, or free; they may carry beams",
        |s: &Spec| &s.mass,
        |s| &mut s.mass,
    ),
    named_tables(
        "modal",
        "structures defined by their modes",
        |s: &Spec| &s.modal,
        |s| &mut s.modal,
    ),
    named_tables(
        "stop",
        "contacts of a point with a body or the ground; without stops the harvester is linear",
        |s: &Spec| &s.stop,
        |s| &mut s.stop,
    ),
    named_tables(
        "circuit",
        "circuits, each across one patch or several; every patch has one or sets `electrodes = \"open\"`",
        |s: &Spec| &s.circuit,
        |s| &mut s.circuit,
    ),
    named_tables(
        "regulator",
        "regulators between the storage of a circuit and a device",
        |s: &Spec| &s.regulator,
        |s| &mut s.regulator,
    ),
    named_tables(
        "device",
        "electronic devices that regulators supply: wireless sensors with a duty cycle",
        |s: &Spec| &s.device,
        |s| &mut s.device,
    ),
    named_tables(
        "drive",
        "excitation: forces, and motions of the ground or of other bases",
        |s: &Spec| &s.drive,
        |s| &mut s.drive,
    ),
    table(
        "gravity",
        "gravity on all moving parts; displacements are measured from the undeformed position",
        |s: &Spec| &s.gravity,
        |s| &mut s.gravity,
    ),
    table(
        "damping",
        "damping ratios of the modes of beams and plates, ascending in frequency, without the modes of masses",
        |s: &Spec| &s.damping,
        |s| &mut s.damping,
    ),
    table(
        "reduction",
        "number of retained modes and required accuracy of the mesh",
        |s: &Spec| &s.reduction,
        |s| &mut s.reduction,
    ),
    table(
        "run",
        "integration in time",
        |s: &Spec| &s.run,
        |s| &mut s.run,
    ),
    table(
        "source",
        "origin of the harvester; it affects no result",
        |s: &Spec| &s.source,
        |s| &mut s.source,
    ),
];

const fn named_tables(
    name: &'static str,
    doc: &'static str,
    get: fn(&Spec) -> &dyn Elements,
    open: fn(&mut Spec) -> &mut dyn Elements,
) -> Key<Spec> {
    Key::with_slot(name, Kind::Things, doc, Slot::Things { get, open }).optional()
}

const fn table(
    name: &'static str,
    doc: &'static str,
    get: fn(&Spec) -> &dyn Element,
    open: fn(&mut Spec) -> &mut dyn Element,
) -> Key<Spec> {
    Key::with_slot(name, Kind::Table, doc, Slot::Table { get, open }).optional()
}
