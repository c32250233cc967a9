//! Derivative of a plant by a key of the spec, from the plants at changed values of the key.
//!
//! The coefficients of the equations are smooth functions of the keys, without the resonances and
//! contacts of the motion, so that few values give them to roundoff. The weights are those of the
//! derivative of the polynomial through the values, of fourth order. Where modes cross at the value of
//! the key, their order jumps; there the derivative through fewer values differs, and there is none.

use super::super::{AnalysisError, Model};
use jounce_model::plant::{Coefficients, PlantDerivative, PlantError, System};
use jounce_spec::NumericKey;

/// Largest step of the key, relative to its scale.
const STEP: f64 = 2e-4;

/// Difference of the two derivatives, relative to the size of one, above which the coefficients are not
/// smooth: a jump gives 1/7.
const NOT_SMOOTH: f64 = 1e-2;

/// Places in steps of half the largest one, with their weights per such step in the derivative, and in
/// the derivative of lower order.
const CENTRAL: [(f64, [f64; 2]); 4] = [
    (1.0, [2.0 / 3.0, 0.5]),
    (-1.0, [-2.0 / 3.0, -0.5]),
    (2.0, [-1.0 / 12.0, 0.0]),
    (-2.0, [1.0 / 12.0, 0.0]),
];

/// The same on one side, where the spec allows no value on the other.
const ONE_SIDED: [(f64, [f64; 2]); 5] = [
    (0.0, [-25.0 / 12.0, -1.5]),
    (1.0, [4.0, 2.0]),
    (2.0, [-3.0, -0.5]),
    (3.0, [4.0 / 3.0, 0.0]),
    (4.0, [-0.25, 0.0]),
];

/// Systems at values of a key, with their weights in the derivative by the key, and in that of lower
/// order.
pub struct WeightedSystems(Vec<([f64; 2], System)>);

impl WeightedSystems {
    /// Builds the systems near the model; `scale` is a size of the key over which results change
    /// noticeably.
    ///
    /// # Errors
    /// The spec allows no value on either side, or the system cannot be built.
    pub fn of(base: &Model, key: &NumericKey, scale: f64) -> Result<Self, AnalysisError> {
        let step = 0.5 * STEP * scale;
        let value = key.get(&base.spec)?;
        let at = |places: &[(f64, [f64; 2])], side: f64| {
            let system = |(place, weights): &(f64, [f64; 2])| {
                let mut spec = base.spec.clone();
                key.set(&mut spec, value + side * place * step)?;
                Ok((
                    weights.map(|weight| weight / (side * step)),
                    base.system(&spec)?,
                ))
            };
            places
                .iter()
                .map(system)
                .collect::<Result<Vec<_>, AnalysisError>>()
        };
        let sided = || at(&ONE_SIDED, 1.0).or_else(|_| at(&ONE_SIDED, -1.0));
        at(&CENTRAL, 1.0)
            .or_else(|error| sided().map_err(|_| error))
            .map(Self)
    }

    /// Returns the derivative of the plant of a model.
    ///
    /// # Errors
    /// [`PlantError::NoDerivative`].
    pub fn plant_derivative(&self, base: &Model) -> Result<PlantDerivative, PlantError> {
        let of = |(weights, system): &([f64; 2], System)| Ok((*weights, Coefficients::of(system)?));
        let parts = self
            .0
            .iter()
            .map(of)
            .collect::<Result<Vec<_>, PlantError>>()?;
        let weighted = |weight: fn(&[f64; 2]) -> f64| {
            let part = |(weights, part): &([f64; 2], Coefficients)| (weight(weights), part.clone());
            Coefficients::combined(&parts.iter().map(part).collect::<Vec<_>>())
        };
        let change = weighted(|weights| weights[0])?;
        let lower_order = weighted(|weights| weights[1])?;
        let scale = weighted(|weights| weights[0].abs())?;
        if change.distance(&lower_order, &scale) > NOT_SMOOTH {
            return Err(PlantError::NoDerivative {
                part: "modes that cross at this value".to_owned(),
            });
        }
        let plant = &base.kernel.plant;
        let mut derivative = PlantDerivative::of(plant, &change)?;
        for (index, port) in derivative.ports.iter_mut().enumerate() {
            let law = |system: &System| system.stops[index].law;
            if self
                .0
                .iter()
                .any(|(_, system)| law(system) != plant.system.stops[index].law)
            {
                port.laws = self
                    .0
                    .iter()
                    .map(|(weights, system)| (weights[0], law(system)))
                    .collect();
            }
        }
        Ok(derivative)
    }

    /// Returns the derivative of a function of the system.
    pub fn derivative(&self, value: impl Fn(&System) -> f64) -> f64 {
        self.0
            .iter()
            .map(|(weights, system)| weights[0] * value(system))
            .sum()
    }
}
