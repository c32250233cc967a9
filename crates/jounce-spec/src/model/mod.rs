//! The validated spec in SI units. One struct per kind of element; the user chooses the names.

mod beam;
mod circuit;
mod contact_bodies;
mod damping;
mod device;
mod drive;
mod gravity;
mod lamina;
mod layer;
mod mass;
mod modal;
mod patch;
mod plate;
mod reduction;
mod regulator;
mod run;
mod source;
mod stop;

pub use beam::Beam;
pub use circuit::{Circuit, Interface, Wiring};
pub use contact_bodies::{BodyShape, ContactBodies, ContactBody};
pub use damping::Damping;
pub use device::Device;
pub use drive::{Drive, DriveKind, DriveSignal, FrequencySweep, GROUND};
pub use gravity::Gravity;
pub use lamina::Lamina;
pub use layer::Layer;
pub use mass::{Mass, NO_SUPPORT};
pub use modal::{Modal, ModalPatch};
pub(crate) use patch::FIBRE_COMPOSITE_PREFIX;
pub use patch::{
    AcrossFibres, Composite, Electrodes, Face, Patch, PatchFoils, PatchPores, PoreShape, Section,
};
pub use plate::{Edge, OnPlate, Plate, PlateArea, PlatePoint};
pub use reduction::Reduction;
pub use regulator::{CHIP_LIBRARY, CHIPS, Chip, Regulator};
pub use run::{Run, Start};
pub use source::Source;
pub use stop::{ForceTable, Side, Stop, StopLaw};

use std::collections::BTreeMap;

/// A complete spec: elements by name, quantities in SI units, references resolved.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spec {
    /// `[beam.NAME]`
    pub beam: BTreeMap<String, Beam>,
    /// `[plate.NAME]`
    pub plate: BTreeMap<String, Plate>,
    /// `[patch.NAME]`
    pub patch: BTreeMap<String, Patch>,
    /// `[layer.NAME]`
    pub layer: BTreeMap<String, Layer>,
    /// `[mass.NAME]`
    pub mass: BTreeMap<String, Mass>,
    /// `[modal.NAME]`
    pub modal: BTreeMap<String, Modal>,
    /// `[stop.NAME]`
    pub stop: BTreeMap<String, Stop>,
    /// `[circuit.NAME]`
    pub circuit: BTreeMap<String, Circuit>,
    /// `[regulator.NAME]`
    pub regulator: BTreeMap<String, Regulator>,
    /// `[device.NAME]`
    pub device: BTreeMap<String, Device>,
    /// `[drive.NAME]`
    pub drive: BTreeMap<String, Drive>,
    /// `[gravity]`
    pub gravity: Gravity,
    /// `[damping]`
    pub damping: Damping,
    /// `[reduction]`
    pub reduction: Reduction,
    /// `[run]`
    pub run: Run,
    /// `[source]`
    pub source: Source,
}

impl Spec {
    /// Removes all circuits and leaves the electrodes of every patch open.
    pub fn open_circuits(&mut self) {
        self.circuit.clear();
        self.regulator.clear();
        self.device.clear();
        let modal = self
            .modal
            .values_mut()
            .flat_map(|modal| modal.patch.values_mut().map(|patch| &mut patch.electrodes));
        self.patch
            .values_mut()
            .map(|patch| &mut patch.electrodes)
            .chain(modal)
            .for_each(|electrodes| *electrodes = Electrodes::Open);
    }

    /// Returns the plate and the point that a name such as `"plate.corner"` refers to.
    pub fn plate_point(&self, name: &str) -> Option<(&Plate, PlatePoint)> {
        let (plate, point) = name.split_once('.')?;
        let plate = self.plate.get(plate)?;
        Some((plate, *plate.point.get(point)?))
    }

    /// True if a support is this mass, or a mass without a spring that is fixed to it.
    pub fn is_fixed_to(&self, support: &str, mass: &str) -> bool {
        let mut support = support;
        for _ in 0..=self.mass.len() {
            match self.mass.get(support) {
                _ if support == mass => return true,
                Some(support_mass) if support_mass.stiffness_n_m.is_none() => {
                    support = &support_mass.on
                }
                _ => return false,
            }
        }
        false
    }
}
