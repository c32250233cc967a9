//! A stop and the motion towards it over the period of an orbit.

use jounce_model::plant::Stop;
use jounce_spec::{Side, Spec};
use serde::Serialize;

/// A stop and the motion towards it; one value of each list per time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitStop {
    /// Name.
    pub name: String,
    /// Gap, m.
    pub gap_m: f64,
    /// Beam that meets the stop, and the distance of the stop from its root, m; `None` for a stop
    /// at a mass.
    pub place: Option<(String, f64)>,
    /// True for a stop on the positive side.
    pub above: bool,
    /// Element that carries the stop; `None` for a stop that the spec does not name.
    pub frame: Option<String>,
    /// Displacement towards the stop, m.
    pub displacement_m: Vec<f64>,
    /// Velocity towards the stop, m/s.
    pub velocity_m_s: Vec<f64>,
    /// Contact force, N.
    pub force_n: Vec<f64>,
}

impl OrbitStop {
    pub(super) fn new(spec: &Spec, stop: &Stop, states: &[Vec<f64>], force_n: Vec<f64>) -> Self {
        let of_spec = spec.stop.get(&stop.name);
        let place = of_spec.and_then(|own| {
            let (name, point) = own.at.split_once('.')?;
            let beam = spec.beam.get(name)?;
            let position_m = match point {
                "root" => 0.0,
                "end" => beam.length_m,
                _ => *beam.point.get(point)?,
            };
            Some((name.to_owned(), position_m))
        });
        let project = |from: usize| {
            let sum = |state: &Vec<f64>| -> f64 {
                let terms = stop.shape.iter().zip(&state[from..]);
                terms.map(|(s, x)| s * x).sum()
            };
            states.iter().map(sum).collect()
        };
        Self {
            name: stop.name.clone(),
            gap_m: stop.gap_m,
            place,
            above: of_spec.is_none_or(|own| own.side == Side::Positive),
            frame: of_spec.map(|own| own.frame.clone()),
            displacement_m: project(0),
            velocity_m_s: project(stop.shape.len()),
            force_n,
        }
    }
}
