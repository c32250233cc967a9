//! Quantities that a limit can name.

use super::Size;
use jounce_analysis::Model;
use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_orbits::OrbitQuantity;
use jounce_spec::Quantity;

/// Quantity with a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitedQuantity {
    /// Largest value on every attractor that a start reaches, or in a run.
    Peak(OrbitQuantity),
    /// Expected power of a start, or mean power of a run, W; the limit is a lower one.
    MeanPower,
    /// Share of the starts that reach the main orbit; the limit is a lower one.
    BasinFraction,
    /// Distance of the frequency of the drive from the nearest fold of the main orbit, Hz; the limit
    /// is a lower one.
    FoldDistance,
    /// Size of the harvester.
    Size(Size),
}

/// Unit of a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LimitUnit {
    /// Plain number, or ppm.
    Number,
    /// Quantity of specs.
    Of(Quantity),
}

impl LimitUnit {
    /// Reads a value, SI.
    ///
    /// # Errors
    /// A message with what is expected.
    pub fn read(self, text: &str) -> Result<f64, String> {
        match self {
            Self::Of(quantity) => quantity.read(text).map_err(|error| error.to_string()),
            Self::Number => {
                let (number, scale) = match text.trim().strip_suffix("ppm") {
                    Some(number) => (number, 1e-6),
                    None => (text, 1.0),
                };
                let value = number.trim().parse::<f64>();
                value.map(|value| scale * value).map_err(|_| {
                    let expected = "a number, such as 6e-4 or 0.9, or \"600 ppm\"";
                    format!("\"{text}\" is no value; write {expected}")
                })
            }
        }
    }
}

/// Returns all quantities of a model that a limit can name, with an example of each.
pub fn allowed(model: &Model) -> Vec<(String, LimitedQuantity, LimitUnit, &'static str)> {
    let plant = &model.kernel.plant;
    let hertz = LimitUnit::Of(Quantity::Frequency);
    let mut all = vec![
        (
            "mean_power".to_owned(),
            LimitedQuantity::MeanPower,
            LimitUnit::Of(Quantity::Power),
            "\"1 mW\"",
        ),
        (
            "basin_fraction".to_owned(),
            LimitedQuantity::BasinFraction,
            LimitUnit::Number,
            "0.9",
        ),
        (
            "fold_distance".to_owned(),
            LimitedQuantity::FoldDistance,
            hertz,
            "\"0.2 Hz\"",
        ),
    ];
    if !model.spec.beam.is_empty() || !model.spec.plate.is_empty() {
        let sizes = [
            (
                "mass",
                Size::Mass,
                LimitUnit::Of(Quantity::Mass),
                "\"50 g\"",
            ),
            (
                "length",
                Size::Length,
                LimitUnit::Of(Quantity::Length),
                "\"300 mm\"",
            ),
            (
                "volume",
                Size::Volume,
                LimitUnit::Of(Quantity::Volume),
                "\"20 cm^3\"",
            ),
        ];
        for (name, size, unit, example) in sizes {
            all.push((name.to_owned(), LimitedQuantity::Size(size), unit, example));
        }
    }
    all.extend(
        peaks(plant)
            .into_iter()
            .map(|(name, quantity, unit, example)| {
                (name, LimitedQuantity::Peak(quantity), unit, example)
            }),
    );
    all
}

/// Returns the peaks that a limit can name.
fn peaks(plant: &Plant) -> Vec<(String, OrbitQuantity, LimitUnit, &'static str)> {
    let mut all = Vec::new();
    let volt = LimitUnit::Of(Quantity::Voltage);
    for (index, (name, patch)) in plant.system.modes.patch.iter().enumerate() {
        if !patch.strain.is_empty() {
            let quantity = OrbitQuantity::Strain(index);
            all.push((
                format!("patch.{name}.strain"),
                quantity,
                LimitUnit::Number,
                "\"600 ppm\"",
            ));
        }
        let quantity = OrbitQuantity::Voltage(index);
        all.push((format!("patch.{name}.voltage"), quantity, volt, "\"100 V\""));
    }
    let (newton, meter) = (Quantity::Force, Quantity::Length);
    for (index, stop) in plant.system.stops.iter().enumerate() {
        let name = &stop.name;
        if !matches!(stop.law, Law::Rigid(_)) {
            let (quantity, unit) = (OrbitQuantity::ContactForce(index), LimitUnit::Of(newton));
            all.push((
                format!("stop.{name}.contact_force"),
                quantity,
                unit,
                "\"10 N\"",
            ));
        }
        let (quantity, unit) = (OrbitQuantity::Displacement(index), LimitUnit::Of(meter));
        all.push((
            format!("stop.{name}.displacement"),
            quantity,
            unit,
            "\"20 mm\"",
        ));
    }
    all
}
