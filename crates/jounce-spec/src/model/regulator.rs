//! `[regulator.NAME]`

/// A voltage regulator between a storage capacitor and a device.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Regulator {
    /// `chip`: integrated circuit of the library that supplies the values omitted here; empty if
    /// omitted.
    #[serde(skip)]
    pub chip: String,
    /// `start_voltage`: storage voltage at which the regulator starts, V.
    pub start_v: f64,
    /// `stop_voltage`: storage voltage at which it stops, V.
    pub stop_v: f64,
    /// `output_voltage`, V.
    pub output_v: f64,
    /// `efficiency` of the converter, 0 to 1.
    pub efficiency: f64,
    /// `idle_current` drawn from the storage while off, at the start voltage, A; proportional to
    /// the storage voltage.
    pub idle_a: f64,
    /// `quiescent_current` drawn from the storage while on, A.
    pub quiescent_a: f64,
}

/// An integrated circuit of the library.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Chip {
    /// Name in a spec.
    pub name: &'static str,
    /// Its regulator, whose `chip` is empty.
    #[serde(flatten)]
    pub regulator: Regulator,
    /// Source of the numbers.
    pub source: &'static str,
}

/// Names of the integrated circuits in a spec.
pub const CHIPS: &[&str] = &["LTC3588-1", "BQ25570"];

/// All integrated circuits.
pub const CHIP_LIBRARY: &[Chip] = &[
    Chip {
        name: "LTC3588-1",
        regulator: Regulator {
            chip: String::new(),
            start_v: 5.05,
            stop_v: 3.67,
            output_v: 3.3,
            efficiency: 0.85,
            idle_a: 450e-9,
            quiescent_a: 950e-9,
        },
        source: "Linear Technology, LTC3588-1 data sheet: output of 3.3 V, typical thresholds of the undervoltage lockout \
         (1.8 V and 2.5 V: 4.04 V and 2.87 V), typical quiescent currents; efficiency nominal. The data sheet's bridge drops \
         0.4 V at 10 uA over both diodes; its shunt at 20 V is not part of the model",
    },
    Chip {
        name: "BQ25570",
        regulator: Regulator {
            chip: String::new(),
            start_v: 2.8,
            stop_v: 2.39,
            output_v: 1.8,
            efficiency: 0.9,
            idle_a: 445e-9,
            quiescent_a: 488e-9,
        },
        source: "Texas Instruments, bq25570 data sheet (SLUSBH2): typical quiescent currents with the buck converter disabled \
         and enabled; thresholds and output as set by the resistors of the evaluation module; efficiency nominal. The boost \
         charger is not part of the model: the rectifier charges the storage directly",
    },
];

impl Chip {
    /// Returns the integrated circuit with a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        CHIP_LIBRARY.iter().find(|chip| chip.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_spec_are_the_library() {
        let names = CHIP_LIBRARY.iter().map(|chip| chip.name);
        assert!(names.eq(CHIPS.iter().copied()));
    }
}
