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
use super::key::{Key, Kind, Named, Single, Slot};

/// Frequency limits of jounce, Hz.
pub(super) const FREQUENCY_LIMITS_HZ: (f64, f64) = (1e-6, 1e6);

/// Tables of a spec.
pub(super) static SPEC: &[Key<Spec>] = &[
    named_tables(
        "beam",
        "uniform beams, clamped at their root",
        &Named {
            get: |s: &Spec| &s.beam,
            open: |s| &mut s.beam,
            blank: beam::blank,
            keys: beam::KEYS,
        },
    ),
    named_tables(
        "plate",
        "rectangular thin plates with clamped, simply supported or free edges",
        &Named {
            get: |s: &Spec| &s.plate,
            open: |s| &mut s.plate,
            blank: plate::blank,
            keys: plate::KEYS,
        },
    ),
    named_tables(
        "patch",
        "piezoelectric patches bonded to beams and plates",
        &Named {
            get: |s: &Spec| &s.patch,
            open: |s| &mut s.patch,
            blank: patch::blank,
            keys: patch::KEYS,
        },
    ),
    named_tables(
        "layer",
        "passive layers on the faces of beams and plates, under the patches: bond lines, shims, coatings",
        &Named {
            get: |s: &Spec| &s.layer,
            open: |s| &mut s.layer,
            blank: layer::blank,
            keys: layer::KEYS,
        },
    ),
    named_tables(
        "mass",
        "rigid masses: on a spring, fixed to a beam or a plate, or free; they may carry beams",
        &Named {
            get: |s: &Spec| &s.mass,
            open: |s| &mut s.mass,
            blank: mass::blank,
            keys: mass::KEYS,
        },
    ),
    named_tables(
        "modal",
        "structures defined by their modes",
        &Named {
            get: |s: &Spec| &s.modal,
            open: |s| &mut s.modal,
            blank: modal::blank,
            keys: modal::KEYS,
        },
    ),
    named_tables(
        "stop",
        "contacts of a point with a body or the ground; without stops the harvester is linear",
        &Named {
            get: |s: &Spec| &s.stop,
            open: |s| &mut s.stop,
            blank: stop::blank,
            keys: stop::KEYS,
        },
    ),
    named_tables(
        "circuit",
        "circuits, each across one patch or several; every patch has one or sets `electrodes = \"open\"`",
        &Named {
            get: |s: &Spec| &s.circuit,
            open: |s| &mut s.circuit,
            blank: circuit::blank,
            keys: circuit::KEYS,
        },
    ),
    named_tables(
        "regulator",
        "regulators between the storage of a circuit and a device",
        &Named {
            get: |s: &Spec| &s.regulator,
            open: |s| &mut s.regulator,
            blank: regulator::blank,
            keys: regulator::KEYS,
        },
    ),
    named_tables(
        "device",
        "electronic devices that regulators supply: wireless sensors with a duty cycle",
        &Named {
            get: |s: &Spec| &s.device,
            open: |s| &mut s.device,
            blank: device::blank,
            keys: device::KEYS,
        },
    ),
    named_tables(
        "drive",
        "excitation: forces, and motions of the ground or of other bases",
        &Named {
            get: |s: &Spec| &s.drive,
            open: |s| &mut s.drive,
            blank: drive::blank,
            keys: drive::KEYS,
        },
    ),
    table(
        "gravity",
        "gravity on all moving parts; displacements are measured from the undeformed position",
        &Single {
            get: |s: &Spec| &s.gravity,
            open: |s| &mut s.gravity,
            keys: gravity::KEYS,
        },
    ),
    table(
        "damping",
        "damping ratios of the modes of beams and plates, ascending in frequency, without the modes of masses",
        &Single {
            get: |s: &Spec| &s.damping,
            open: |s| &mut s.damping,
            keys: settings::DAMPING,
        },
    ),
    table(
        "reduction",
        "number of retained modes and required accuracy of the mesh",
        &Single {
            get: |s: &Spec| &s.reduction,
            open: |s| &mut s.reduction,
            keys: settings::REDUCTION,
        },
    ),
    table(
        "run",
        "integration in time",
        &Single {
            get: |s: &Spec| &s.run,
            open: |s| &mut s.run,
            keys: settings::RUN,
        },
    ),
    table(
        "source",
        "origin of the harvester; it affects no result",
        &Single {
            get: |s: &Spec| &s.source,
            open: |s| &mut s.source,
            keys: source::KEYS,
        },
    ),
];

const fn named_tables(
    name: &'static str,
    doc: &'static str,
    inner: &'static dyn super::key::Inner<Spec>,
) -> Key<Spec> {
    Key::with_slot(name, Kind::Things, doc, Slot::Inner(inner)).optional()
}

const fn table(
    name: &'static str,
    doc: &'static str,
    inner: &'static dyn super::key::Inner<Spec>,
) -> Key<Spec> {
    Key::with_slot(name, Kind::Table, doc, Slot::Inner(inner)).optional()
}
