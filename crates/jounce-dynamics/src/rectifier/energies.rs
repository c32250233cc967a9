//! Energies of a rectified circuit.

/// Energies that left through one rectified circuit, J, and the charge that passed its diodes.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct RectifiedEnergies {
    /// Delivered to the load across the storage capacitor, or to the device behind its regulator.
    pub load_j: f64,
    /// Delivered to the battery.
    pub battery_j: f64,
    /// Lost in diodes.
    pub diodes_j: f64,
    /// Lost in the switch and its inductor.
    pub switch_j: f64,
    /// Lost by leakage of the storage.
    pub leakage_j: f64,
    /// Lost in the regulator: conversion, idle current and quiescent current.
    pub regulator_j: f64,
    /// Drawn by the conductance of the regulator, which remains while it is on: the integral of the
    /// squared storage voltage times this conductance. It is not part of the sum.
    pub idle_j: f64,
    /// Charge passed to the storage, C.
    pub charge_c: f64,
}

impl RectifiedEnergies {
    /// Returns the energy delivered to the load and the battery, J.
    pub fn delivered_j(&self) -> f64 {
        self.load_j + self.battery_j
    }

    /// Returns the sum of the energies, J.
    pub fn sum_j(&self) -> f64 {
        self.delivered_j() + self.diodes_j + self.switch_j + self.leakage_j + self.regulator_j
    }

    /// Adds the energies of another count.
    pub(crate) fn add(&mut self, other: &Self) {
        self.load_j += other.load_j;
        self.battery_j += other.battery_j;
        self.diodes_j += other.diodes_j;
        self.switch_j += other.switch_j;
        self.leakage_j += other.leakage_j;
        self.regulator_j += other.regulator_j;
        self.idle_j += other.idle_j;
        self.charge_c += other.charge_c;
    }
}
