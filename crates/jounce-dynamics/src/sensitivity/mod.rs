//! Derivative of the flow of an integration with respect to its start and to one parameter.
//!
//! ```text
//! flight       dy1 = e^{A h} dy
//! contact      dy1 = e^{A h} dy + B X,   (I - J D - J' D') X = J (C dy + dw) + J' (C' dy + dv) + F k
//! onset        the same for Dy = dy + y' s,  s = -(c dy + dw) / v,  and back:  dy1 = Dy1 - y1' s
//! entry        dy+ = dy- + b F(0, v) (c dy + dw) / v
//! impact       dy+ = dy- + b m (c' dy + dv) - (b m a - A b p) (c dy + dw) / v,   m = (1 + e) / M
//! ```
//!
//! `J`, `J'` are the slopes of the law at the nodes of the step (N/m, N s/m). `D`, `D'` are the
//! Duhamel weights of displacement and velocity, and `C`, `C'` their columns. `B` is the effect of
//! the nodal forces on the end of the step. This is the linearisation of the equations that the
//! integration has solved; with several ports in contact it is one system for all their nodes. `b`,
//! `c`, `c'` are the force column and the rows of the port, `v` the impact speed, `a` the
//! acceleration before the impact, `p` the impulse. `dw`, `dv` (m, m/s per unit of the parameter)
//! are the derivatives of the motion of the port by the parameter at a fixed state. `k` is the
//! relative derivative of the force (see [`ParameterSensitivity`]).
//!
//! The derivative of a contact that starts like `t^1.5` varies like `t^0.5` at a fixed time, which
//! its basis cannot represent. It varies like `t^1.5` when the time is counted from the start of
//! the contact: hence the shift `s` (s) of the time of the first step.
//!
//! Diodes and switches: see [`conduction_states`]. The derivatives by a parameter are known in one
//! conduction state only: with rectifiers [`ParameterSensitivity`] stays empty.
//!
//! Limits: signals are constant, such as gravity. The shift belongs to the first of contacts that
//! start at the same instant; the basis of the others represents their variation only
//! approximately. Impacts on several rigid stops at the same instant are refused.
//!
//! Validation: `crates/jounce-analysis/tests/integrate/sensitivity` compares with difference
//! quotients of the flow, with its determinant and with closed forms.

mod conduction_states;
mod contact;
mod elimination;
mod parameter_sensitivity;
mod parameters;
mod saltation;
mod tangents;
mod variational_integration;

pub use parameter_sensitivity::ParameterSensitivity;
pub use parameters::{OutputDerivatives, ParameterRequest, StateDerivative};

use crate::error::IntegrationError;
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::record::statistics::ContactStatistics;
use crate::record::trajectory::Trajectory;
use conduction_states::ConductionRoute;
use jounce_linalg::Mat;
use parameters::Parameters;

/// Integrated interval with its derivative.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowSensitivity {
    /// State at the end, block coordinates.
    pub end: Vec<f64>,
    /// `d end / d start`, `n x n`.
    pub jacobian: Mat<f64>,
    /// `d end / d parameter` at a fixed duration.
    pub drift: Vec<f64>,
    /// `d end / d duration`, 1/s.
    pub rate: Vec<f64>,
    /// Contact statistics of the interval.
    pub statistics: ContactStatistics,
    /// Energy delivered to each load and then to each rectified circuit, J.
    pub delivered_j: Vec<f64>,
    /// Trajectory of the integration.
    pub trajectory: Trajectory,
    /// Derivatives of outputs by the parameters of a request.
    pub outputs: OutputDerivatives,
}

/// Error of a derivative that does not exist or cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SensitivityError {
    /// The integration failed.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The motion sticks to a rigid stop.
    #[error(
        "at t = {time_s} s the point comes to rest on the rigid stop `{stop}`, where the derivative of the flow loses rank; use a compliant law or a larger restitution"
    )]
    Rests {
        /// Name of the stop.
        stop: String,
        /// Time, s.
        time_s: f64,
    },
    /// Several impacts on rigid stops occur at one instant.
    #[error(
        "at t = {time_s} s several rigid stops have impacts at the same instant, where the derivative of the flow depends on the direction; use a compliant law or different gaps"
    )]
    StruckTogether {
        /// Time, s.
        time_s: f64,
    },
}

impl FlowSensitivity {
    /// Integrates from block coordinates `start` at `start_s` and linearises the flow along the
    /// trajectory.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn integrate(
        kernel: &Kernel,
        start: &[f64],
        start_s: f64,
        duration_s: f64,
        tolerance: f64,
        drift: &ParameterSensitivity,
    ) -> Result<Self, SensitivityError> {
        let span_s = (start_s, duration_s);
        Self::with_parameters(kernel, start, span_s, tolerance, drift, None)
    }

    /// Does so from a time over a duration, s, and returns the derivatives of outputs by the
    /// parameters of a request too.
    ///
    /// # Errors
    /// [`SensitivityError`].
    pub fn with_parameters(
        kernel: &Kernel,
        start: &[f64],
        (start_s, duration_s): (f64, f64),
        tolerance: f64,
        drift: &ParameterSensitivity,
        request: Option<ParameterRequest<'_>>,
    ) -> Result<Self, SensitivityError> {
        let mut integrator = Integrator::new(kernel, start, start_s, tolerance)?;
        integrator.resolve_derivative();
        integrator.start_record();
        integrator.advance_to(start_s + duration_s)?;
        let (end, statistics, energies) = (
            integrator.state(),
            integrator.statistics(),
            integrator.energies(),
        );
        let delivered_j = energies.delivered_per_element_j().collect();
        let rate = conduction_states::rate(
            integrator.kernel,
            &integrator.physical(),
            integrator.time_s(),
            &integrator.forces_n(),
        );
        let rate = kernel.plant.moving(&rate, integrator.time_s());
        let (end_s, end_conduction_state, block_end) = (
            integrator.time_s(),
            integrator.switching.conduction_state,
            integrator.block_state(),
        );
        let trajectory = integrator.take_record();
        let route = ConductionRoute {
            base: kernel,
            drift,
            trajectory: &trajectory,
            odd_tables: integrator.odd_tables,
            end_s,
            end_conduction_state,
            end: block_end,
            parameters: request.map(|request| Box::new(Parameters::new(kernel, request))),
        };
        let (tangents, parameters) = route.tangents()?;
        let n = end.len();
        let entry = |state: usize, column: usize| tangents.entry(state, column);
        let outputs = parameters.map_or_else(OutputDerivatives::default, |parameters| {
            parameters.finish(n, &entry)
        });
        let jacobian = Mat::from_fn(n, n, |i, j| tangents.entry(i, j));
        let drift = (0..n).map(|i| tangents.entry(i, n)).collect();
        Ok(Self {
            end,
            jacobian,
            drift,
            rate,
            statistics,
            delivered_j,
            trajectory,
            outputs,
        })
    }
}
