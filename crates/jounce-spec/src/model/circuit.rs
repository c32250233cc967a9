//! `[circuit.NAME]`

/// A circuit across one patch or several.
#[derive(Debug, Clone, PartialEq)]
pub struct Circuit {
    /// `patch`: `"mfc"` or `"harvester.mfc"`; empty if `patches` is given.
    pub patch: String,
    /// `patches`: several, `["top", "-bottom"]`; a minus reverses the polarity of a patch.
    pub patches: Vec<String>,
    /// `wiring` of several patches; default parallel.
    pub wiring: Wiring,
    /// `resistance`, ohm, > 0; infinite with a battery or a regulator in its place.
    pub resistance_ohm: f64,
    /// `inductance`, H; `None` without an inductor.
    pub inductance_h: Option<f64>,
    /// `inductor`: connection relative to the resistor; default parallel.
    pub inductor: Wiring,
    /// `interface`; default resistor.
    pub interface: Interface,
    /// `storage`: smoothing capacitor after the diodes, F.
    pub storage_f: Option<f64>,
    /// `battery` instead of the storage capacitor, V.
    pub battery_v: Option<f64>,
    /// `diode_drop` of each of the two conducting diodes, V.
    pub diode_drop_v: f64,
    /// `diode_resistance`: on-resistance of each diode, ohm.
    pub diode_resistance_ohm: f64,
    /// `leakage_resistance` across the storage capacitor, ohm; `None` without.
    pub leakage_ohm: Option<f64>,
    /// `regulator`: name of the regulator that replaces the load; empty if omitted.
    pub regulator: String,
    /// `device`: name of the device that the regulator supplies; empty if omitted.
    pub device: String,
    /// `quality_factor` of the inductor and its switch.
    pub quality_factor: Option<f64>,
    /// `efficiency` of an extraction, 0 to 1.
    pub efficiency: f64,
}

/// Circuit between the patches and the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interface {
    /// `"resistor"`: the load directly across the patches.
    #[default]
    Resistor,
    /// `"bridge"`: a full bridge of diodes.
    Bridge,
    /// `"parallel-sshi"`: a bridge, and an inductor with a switch across the patches.
    ParallelSshi,
    /// `"series-sshi"`: a bridge behind an inductor with a switch.
    SeriesSshi,
    /// `"sece"`: synchronous electric charge extraction.
    Sece,
}

impl Circuit {
    /// Returns a resistor across a patch; every other key has its default.
    pub fn resistor(patch: String, resistance_ohm: f64) -> Self {
        Self {
            patch,
            patches: Vec::new(),
            wiring: Wiring::default(),
            resistance_ohm,
            inductance_h: None,
            inductor: Wiring::default(),
            interface: Interface::default(),
            storage_f: None,
            battery_v: None,
            diode_drop_v: 0.0,
            diode_resistance_ohm: 1.0,
            leakage_ohm: None,
            regulator: String::new(),
            device: String::new(),
            quality_factor: None,
            efficiency: 1.0,
        }
    }

    /// Returns every patch of the circuit with the sign of its connection.
    pub fn connections(&self) -> impl Iterator<Item = (&str, f64)> {
        let single = Some(self.patch.as_str())
            .filter(|patch| !patch.is_empty())
            .map(|patch| (patch, 1.0));
        let several = self.patches.iter().map(|patch| {
            patch
                .strip_prefix('-')
                .map_or((patch.as_str(), 1.0), |name| (name, -1.0))
        });
        single.into_iter().chain(several)
    }
}

/// Connection of two electrical elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wiring {
    /// `"parallel"`: the same voltage.
    #[default]
    Parallel,
    /// `"series"`: the same current.
    Series,
}
