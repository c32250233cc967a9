//! Properties of each kind of quantity: its name, its units, its dimension.

use super::dimension::Dimension;
use super::quantity::Quantity;

impl Quantity {
    /// Returns the kind with its article: `"a length"`.
    pub fn kind(self) -> &'static str {
        self.kind_and_exponents().0
    }

    pub(super) fn dimension(self) -> Dimension {
        let dimension = Dimension::new(self.kind_and_exponents().1);
        match self {
            Self::ContactStiffness { exponent } => {
                dimension.times(Self::Length.dimension(), 1.0 - exponent)
            }
            _ => dimension,
        }
    }

    /// Returns the kind, and the exponents of kg, m, s, A and rad; of a contact stiffness those for
    /// the exponent 1.
    fn kind_and_exponents(self) -> (&'static str, [i8; 5]) {
        match self {
            Self::Length => ("a length", [0, 1, 0, 0, 0]),
            Self::Mass => ("a mass", [1, 0, 0, 0, 0]),
            Self::Volume => ("a volume", [0, 3, 0, 0, 0]),
            Self::Time => ("a time", [0, 0, 1, 0, 0]),
            Self::Frequency => ("a frequency", [0, 0, -1, 0, 0]),
            Self::Force => ("a force", [1, 1, -2, 0, 0]),
            Self::Pressure => ("a pressure", [1, -1, -2, 0, 0]),
            Self::Density => ("a density", [1, -3, 0, 0, 0]),
            Self::ChargePerForce => ("a piezoelectric charge coefficient", [-1, -1, 3, 1, 0]),
            Self::Capacitance => ("a capacitance", [-1, -2, 4, 2, 0]),
            Self::Resistance => ("a resistance", [1, 2, -3, -2, 0]),
            Self::Stiffness => ("a stiffness", [1, 0, -2, 0, 0]),
            Self::ContactStiffness { .. } => ("a contact stiffness", [1, 0, -2, 0, 0]),
            Self::Damping => ("a damping coefficient", [1, 0, -1, 0, 0]),
            Self::InverseSpeed => ("an inverse speed", [0, -1, 1, 0, 0]),
            Self::Speed => ("a speed", [0, 1, -1, 0, 0]),
            Self::Acceleration => ("an acceleration", [0, 1, -2, 0, 0]),
            Self::AccelerationPsd => ("a power spectral density of acceleration", [0, 2, -3, 0, 0]),
            Self::ForcePsd => ("a power spectral density of force", [2, 2, -3, 0, 0]),
            Self::Angle => ("an angle", [0, 0, 0, 0, 1]),
            Self::RotaryInertia => ("a rotary inertia", [1, 2, 0, 0, 0]),
            Self::RotaryStiffness => ("a rotary stiffness", [1, 2, -2, 0, -1]),
            Self::Inductance => ("an inductance", [1, 2, -2, -2, 0]),
            Self::Permittivity => ("a permittivity", [-1, -3, 4, 2, 0]),
            Self::Voltage => ("a voltage", [1, 2, -3, -1, 0]),
            Self::Current => ("a current", [0, 0, 0, 1, 0]),
            Self::Power => ("a power", [1, 2, -3, 0, 0]),
            Self::Strain => ("a strain", [0, 0, 0, 0, 0]),
        }
    }

    /// Returns the units that fit, the most usual first.
    pub fn units(self) -> Vec<String> {
        let units: &[&str] = match self {
            Self::Length => &["mm", "um", "cm", "m"],
            Self::Volume => &["m^3", "cm^3", "mm^3"],
            Self::Mass => &["kg", "g", "mg"],
            Self::Time => &["s", "ms", "min", "h"],
            Self::Frequency => &["Hz", "kHz", "1/min"],
            Self::Force => &["N", "mN", "kN"],
            Self::Pressure => &["GPa", "MPa", "Pa", "N/m^2"],
            Self::Density => &["kg/m^3", "g/cm^3"],
            Self::ChargePerForce => &["pC/N", "pm/V", "m/V"],
            Self::Capacitance => &["nF", "pF", "uF", "F"],
            Self::Resistance => &["ohm", "kohm", "Mohm"],
            Self::Stiffness => &["N/m", "kN/m", "N/mm"],
            Self::ContactStiffness { exponent } => {
                return vec![per_metre(exponent), format!("k{}", per_metre(exponent))];
            }
            Self::Damping => &["N s/m", "kg/s"],
            Self::InverseSpeed => &["s/m", "s/mm"],
            Self::Speed => &["m/s", "mm/s"],
            Self::Acceleration => &["m/s^2", "g"],
            Self::AccelerationPsd => &["(m/s^2)^2/Hz", "g^2/Hz"],
            Self::ForcePsd => &["N^2/Hz"],
            Self::Angle => &["deg", "rad"],
            Self::RotaryInertia => &["kg m^2", "g mm^2", "kg mm^2"],
            Self::RotaryStiffness => &["N m/rad", "kN m/rad", "N mm/rad"],
            Self::Inductance => &["H", "mH", "kH"],
            Self::Permittivity => &["nF/m", "pF/m", "F/m"],
            Self::Voltage => &["V", "mV", "kV"],
            Self::Current => &["mA", "uA", "nA", "A"],
            Self::Power => &["W", "mW", "uW"],
            Self::Strain => &["ppm", "ustrain", "%", "um/m"],
        };
        units.iter().map(|unit| (*unit).to_owned()).collect()
    }

    /// Returns the SI unit of the value.
    pub fn si_unit(self) -> String {
        match self {
            Self::Length => "m".to_owned(),
            Self::Mass => "kg".to_owned(),
            Self::Pressure => "Pa".to_owned(),
            Self::ChargePerForce => "m/V".to_owned(),
            Self::Capacitance => "F".to_owned(),
            Self::Current => "A".to_owned(),
            Self::Angle => "rad".to_owned(),
            Self::Permittivity => "F/m".to_owned(),
            Self::Strain => "strain".to_owned(),
            other => other.units().swap_remove(0),
        }
    }

    /// Returns ` (did you mean X?)` for the unit of this kind that a text spells with other capitals,
    /// else for the longest one that it begins with; without one, an empty text.
    pub(super) fn near(self, unit: &str) -> String {
        let units = self.units();
        let equal = units.iter().find(|known| known.eq_ignore_ascii_case(unit));
        let begun = units
            .iter()
            .filter(|known| unit.starts_with(known.as_str()));
        let Some(near) = equal.or(begun.max_by_key(|known| known.len())) else {
            return String::new();
        };
        let rest = unit.strip_prefix(near.as_str()).unwrap_or_default();
        let note = match rest.trim_matches('_').to_lowercase().as_str() {
            "rms" | "peak" | "pk" | "pp" => {
                "; the key specifies whether the value is rms or zero to peak, a unit does not"
            }
            _ => "",
        };
        format!(" (did you mean {near}?{note})")
    }

    pub(super) fn expectation(self) -> String {
        let units = self.units();
        format!("expected {} in {}", self.kind(), units.join(", "))
    }

    /// Returns the units for printing with their powers of ten relative to SI, ascending.
    pub(super) fn scales(self) -> Vec<(String, i32)> {
        let scales: &[(&str, i32)] = match self {
            Self::Length => &[("nm", -9), ("um", -6), ("mm", -3), ("m", 0)],
            Self::Volume => &[("mm^3", -9), ("cm^3", -6), ("m^3", 0)],
            Self::Mass => &[("mg", -6), ("g", -3), ("kg", 0)],
            Self::Time => &[("us", -6), ("ms", -3), ("s", 0)],
            Self::Frequency => &[("uHz", -6), ("mHz", -3), ("Hz", 0), ("kHz", 3), ("MHz", 6)],
            Self::Force => &[("mN", -3), ("N", 0), ("kN", 3)],
            Self::Pressure => &[("Pa", 0), ("kPa", 3), ("MPa", 6), ("GPa", 9)],
            Self::ChargePerForce => &[("pC/N", -12), ("nC/N", -9)],
            Self::Capacitance => &[("pF", -12), ("nF", -9), ("uF", -6), ("mF", -3), ("F", 0)],
            Self::Resistance => &[("ohm", 0), ("kohm", 3), ("Mohm", 6), ("Gohm", 9)],
            Self::Stiffness => &[("N/m", 0), ("kN/m", 3), ("MN/m", 6)],
            Self::RotaryInertia => &[("g mm^2", -9), ("kg mm^2", -6), ("kg m^2", 0)],
            Self::RotaryStiffness => &[("N mm/rad", -3), ("N m/rad", 0), ("kN m/rad", 3)],
            Self::Inductance => &[("uH", -6), ("mH", -3), ("H", 0), ("kH", 3)],
            Self::Permittivity => &[("pF/m", -12), ("nF/m", -9), ("F/m", 0)],
            Self::Voltage => &[("mV", -3), ("V", 0), ("kV", 3)],
            Self::Current => &[("nA", -9), ("uA", -6), ("mA", -3), ("A", 0)],
            Self::Power => &[("uW", -6), ("mW", -3), ("W", 0)],
            Self::Strain => &[("ppm", -6), ("strain", 0)],
            other => return vec![(other.si_unit(), 0)],
        };
        scales
            .iter()
            .map(|(unit, power)| ((*unit).to_owned(), *power))
            .collect()
    }
}

fn per_metre(exponent: f64) -> String {
    if exponent == 1.0 {
        "N/m".to_owned()
    } else {
        format!("N/m^{exponent}")
    }
}
