//! `[modal.NAME]`

use std::collections::BTreeMap;

use super::Electrodes;

/// A structure defined by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct Modal {
    /// `frequency_hz`: plain numbers, Hz, ascending; 0 for a rigid-body mode.
    pub frequency_hz: Vec<f64>,
    /// `damping_ratio`
    pub damping_ratio: Vec<f64>,
    /// `participation_sqrt_kg`: mass times mass-normalised shape, summed over the structure,
    /// kg^1/2, one per mode; empty if omitted.
    pub participation_sqrt_kg: Vec<f64>,
    /// `[modal.NAME.point]`: mass-normalised shape at each point, kg^-1/2.
    pub point: BTreeMap<String, Vec<f64>>,
    /// `[modal.NAME.patch.PATCH]`
    pub patch: BTreeMap<String, ModalPatch>,
}

/// A patch of a structure defined by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalPatch {
    /// `coupling_n_per_v`: plain numbers, one per mode.
    pub coupling_n_per_v: Vec<f64>,
    /// `capacitance`
    pub capacitance_f: f64,
    /// `leakage_resistance` across the capacitance, ohm; `None` if omitted.
    pub leakage_ohm: Option<f64>,
    /// `electrodes`; by default a circuit names the patch.
    pub electrodes: Electrodes,
}
