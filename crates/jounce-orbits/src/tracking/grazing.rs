//! Grazing condition: displacement and speed of the port at the time of a turning point, which is
//! an additional unknown.
//!
//! ```text
//! c . x(t) - gap = 0,   c' . x(t) = 0,   d/du = c Phi(t),   d/dt = the speed and the acceleration
//! ```
//!
//! `Phi` is the derivative of the flow up to that time. Where two turning points of the motion meet
//! on the surface, the curve has a cusp over the parameters, and the distance of a turning point
//! ceases to exist. With the time as an unknown the curve is smooth there, and continues as the
//! curve of the other turning point.
//!
//! Source: A. B. Nordmark, J. Sound Vib. 145 (1991) 279 (grazing); V. I. Arnold, Catastrophe Theory (Springer, 1992), ch. 2 (cusps).

use super::condition::Gradient;
use crate::orbit::sampled_motion::port_motion;
use crate::{ShootingEvaluation, nearest_turn};
use jounce_dynamics::{FlowSensitivity, ParameterSensitivity, SensitivityError};
use jounce_linalg::{Mat, norm};

/// Half width of the difference quotient for the acceleration, drive cycles.
const HALF_DIFFERENCE_CYCLES: f64 = 1e-5;

/// Change of the time that is scaled like a change of the state by its size, drive cycles.
const TIME_SCALE_CYCLES: f64 = 0.1;

/// Turning point on the surface of a stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrazingPoint {
    /// Index of the port.
    pub port: usize,
    /// Time in the period, drive cycles.
    pub phase_cycles: f64,
    /// Change of the time that is scaled like a unit change of the state.
    pub unit_cycles: f64,
}

impl GrazingPoint {
    /// Returns the turning point of an orbit nearest to a surface; `None` without one.
    pub fn of(evaluation: &ShootingEvaluation) -> Option<Self> {
        let cycle_s = evaluation.cycle_s();
        let unit_cycles = TIME_SCALE_CYCLES / norm(&evaluation.strobe_states[0]);
        nearest_turn(evaluation).map(|turn| Self {
            port: turn.port,
            phase_cycles: turn.cycle as f64 + turn.time_s / cycle_s,
            unit_cycles,
        })
    }

    /// Returns the grazing point at another value of its unknown, which is zero here.
    pub(super) fn with_unknown(self, unknown: f64) -> Self {
        Self {
            phase_cycles: self.phase_cycles + unknown * self.unit_cycles,
            ..self
        }
    }
}

/// Returns displacement relative to the scale of the motion and speed per drive cycle at a time,
/// with their gradients. The derivatives by the parameters are difference quotients. `scale`
/// belongs to shooting.
pub fn gradients(
    touch: GrazingPoint,
    evaluation: &ShootingEvaluation,
    neighbours: [&ShootingEvaluation; 2],
    differences: [f64; 2],
    (scale, tolerance): (&[f64], f64),
) -> Result<Vec<Gradient>, SensitivityError> {
    let plant = &evaluation.kernel.plant;
    let scale_m = plant.scale_m();
    let motion = |evaluation: &ShootingEvaluation, delay_cycles: f64| {
        let cycles = evaluation.trajectories.len() as f64;
        let phase = touch.phase_cycles.rem_euclid(cycles);
        let cycle = (phase as usize).min(evaluation.trajectories.len() - 1);
        let cycle_s = evaluation.period_s / cycles;
        let [past_m, rate_m_s] = port_motion(
            evaluation,
            touch.port,
            (cycle, (phase - cycle as f64 + delay_cycles) * cycle_s),
        );
        [past_m / scale_m, rate_m_s * cycle_s / scale_m]
    };
    let (current, before, after) = (
        motion(evaluation, 0.0),
        motion(evaluation, -HALF_DIFFERENCE_CYCLES),
        motion(evaluation, HALF_DIFFERENCE_CYCLES),
    );
    let perturbed = [motion(neighbours[0], 0.0), motion(neighbours[1], 0.0)];
    let by_phase = [
        current[1],
        (after[1] - before[1]) / (2.0 * HALF_DIFFERENCE_CYCLES),
    ];
    let flow = flow_until(touch, evaluation, scale, tolerance)?;
    let cycle_s = evaluation.cycle_s();
    let rows = [
        (&plant.ports[touch.port].displacement, 1.0 / scale_m),
        (&plant.ports[touch.port].velocity, cycle_s / scale_m),
    ];
    let gradient = |k: usize| {
        let (row, unit) = rows[k];
        let by = |j: usize| {
            row.iter()
                .enumerate()
                .map(|(i, c)| unit * c * flow[(i, j)])
                .sum()
        };
        Gradient {
            value: current[k],
            by_unknown: (0..scale.len()).map(by).collect(),
            by_parameters: [0, 1].map(|p| (perturbed[p][k] - current[k]) / differences[p]),
            by_phase: by_phase[k],
            power_curvature: None,
            is_resonant: false,
        }
    };
    Ok(vec![gradient(0), gradient(1)])
}

/// Returns the derivative of the state at a time by the state at the start of the period.
fn flow_until(
    touch: GrazingPoint,
    evaluation: &ShootingEvaluation,
    scale: &[f64],
    tolerance: f64,
) -> Result<Mat<f64>, SensitivityError> {
    let plant = &evaluation.kernel.plant;
    let n = scale.len();
    let cycle_s = evaluation.cycle_s();
    let phase = touch
        .phase_cycles
        .rem_euclid(evaluation.trajectories.len() as f64);
    let into = &plant.diagonal.from_physical;
    let mut flow = Mat::from_fn(n, n, |i, j| into[(i, j)] / scale[j]);
    for (cycle, state) in evaluation
        .strobe_states
        .iter()
        .enumerate()
        .take(phase as usize + 1)
    {
        let physical: Vec<f64> = state.iter().zip(scale).map(|(u, w)| u / w).collect();
        let until_s = cycle_s * (phase - cycle as f64).min(1.0);
        let start = plant.from_physical(&physical, 0.0);
        flow = &FlowSensitivity::integrate(
            &evaluation.kernel,
            &start,
            0.0,
            until_s,
            tolerance,
            &ParameterSensitivity::default(),
        )?
        .jacobian
            * &flow;
    }
    Ok(flow)
}
