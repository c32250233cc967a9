//! Integrator: the state of a run and its advance to a given time.
//!
//! Between contacts the flow is exact, and the certificate limits the step length. In contact the
//! scalar force on a step is a polynomial through seven Gauss nodes, found by fixed-point
//! iteration. The loop alternates the two, and impacts on rigid stops. It is one for any number of
//! ports (see [`crate::multi_port`]).

mod advance;
mod full_state;
mod start;
mod trial;

use crate::contact::step_size_control::RELEASE_ERROR_FACTOR_OF_DERIVATIVE;
use crate::excitation::Excitation;
use crate::flow::layout::StateLayout;
use crate::kernel::Kernel;
use crate::ports::per_port::PerPort;
use crate::ports::phasor::Phasor;
use crate::ports::state::{ContactState, PortState};
use crate::record::energies::MeterReadings;
use crate::record::statistics::{ContactIntegrals, ContactStatistics, WorkCount};
use crate::record::trajectory::{PortForce, Trajectory, TrajectorySegment};
use crate::rectifier::switching::Switching;
use crate::tables::odd_tables::OddTables;
use crate::tables::step_tables::StepTables;
pub(crate) use full_state::FullState;
use jounce_model::plant::Stop;
use jounce_simd::F64x8;
use smallvec::smallvec;
use std::sync::Arc;
pub(crate) use trial::TrialState;

/// Integration in progress.
#[derive(Debug, Clone)]
pub struct Integrator<'k> {
    pub(crate) kernel: &'k Kernel,
    /// Kernel with all bridges blocked; states enter and leave in its coordinates.
    pub(crate) base: &'k Kernel,
    pub(crate) switching: Switching,
    pub(crate) layout: StateLayout,
    pub(crate) tolerance: f64,
    pub(crate) time_s: f64,
    pub(crate) y: Vec<F64x8>,
    pub(crate) odd_tables: OddTables,
    pub(crate) tones: Vec<Phasor>,
    pub(crate) excitation: Excitation,
    pub(crate) ports: PerPort<PortState>,
    pub(crate) flight_level: i32,
    /// Duration of the last flight that ended in a contact, s.
    pub(crate) flight_s: f64,
    /// Error factor of the remaining impulse for a step that ends past the surface (see
    /// [`crate::contact::step_size_control`]).
    pub(crate) release_error_factor: f64,
    pub(crate) integrals: ContactIntegrals,
    pub(crate) work: WorkCount,
    /// Number of polls of the control.
    pub(crate) checks: u8,
    pub(crate) opening: MeterReadings,
    pub(crate) record: Option<Trajectory>,
}

impl Integrator<'_> {
    /// Resolves the ends of contacts finely enough for an accurate derivative of the flow.
    pub(crate) fn resolve_derivative(&mut self) {
        self.release_error_factor = RELEASE_ERROR_FACTOR_OF_DERIVATIVE;
    }

    /// True where the derivative of the flow must be accurate.
    pub(crate) fn resolves_derivative(&self) -> bool {
        self.release_error_factor >= RELEASE_ERROR_FACTOR_OF_DERIVATIVE
    }

    /// Returns the current time, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Returns the state in block coordinates.
    pub fn state(&self) -> Vec<f64> {
        if self.switching.conduction_state == 0 {
            self.block_state()
        } else {
            self.base.plant.from_physical(&self.physical(), self.time_s)
        }
    }

    /// Returns the state in the block coordinates of the current conduction state.
    pub(crate) fn block_state(&self) -> Vec<f64> {
        self.layout.unpack(&self.excitation.full_lanes(&self.y))
    }

    /// Returns the physical state `(q, q', V, i)`.
    pub fn physical(&self) -> Vec<f64> {
        self.kernel
            .plant
            .to_physical(&self.block_state(), self.time_s)
    }

    /// Returns the contact force of each stop at the current time, N; 0 in flight and on a rigid
    /// stop.
    pub fn forces_n(&self) -> Vec<f64> {
        let force = |(port, stop): (&PortState, &Stop)| match port.contact_state {
            ContactState::Contact => stop.law.force_n(port.penetration_m, port.rate_m_s),
            ContactState::Flight => 0.0,
        };
        self.ports
            .iter()
            .zip(&self.kernel.plant.system.stops)
            .map(force)
            .collect()
    }

    /// Returns the contact statistics of all stops since the last [`Integrator::reset_statistics`]:
    /// sums and maxima.
    pub fn statistics(&self) -> ContactStatistics {
        self.statistics_by_stop()
            .iter()
            .fold(ContactStatistics::default(), ContactStatistics::and)
    }

    /// Returns the contact statistics of each stop, in the order of `system.stops`.
    pub fn statistics_by_stop(&self) -> Vec<ContactStatistics> {
        self.ports
            .iter()
            .map(|port| port.statistics)
            .take(self.kernel.plant.system.stops.len())
            .collect()
    }

    /// Returns the largest impact so far in the energy norm, sqrt(J): the tolerance is relative to
    /// it in contact.
    pub fn largest_impact_sqrt_j(&self) -> f64 {
        let size = |port: &PortState| port.impact_velocity_m_s / port.rows.mobility_per_kg.sqrt();
        let stops = self.kernel.plant.system.stops.len();
        self.ports.iter().take(stops).map(size).fold(0.0, f64::max)
    }

    /// Resets the contact statistics, not the energies.
    pub fn reset_statistics(&mut self) {
        let stops = &self.kernel.plant.system.stops;
        self.ports
            .iter_mut()
            .zip(stops)
            .for_each(|(port, stop)| port.reset_statistics(&stop.law));
        self.reset_device_statistics();
    }

    /// Starts to record every step.
    pub fn start_record(&mut self) {
        self.record = Some(Trajectory::default());
    }

    /// Ends the record and returns it.
    pub fn take_record(&mut self) -> Trajectory {
        self.record.take().unwrap_or_default()
    }

    /// Records the next step.
    #[inline(always)]
    pub(crate) fn note(&mut self, length_s: f64, forces: &[PortForce]) {
        if self.record.is_some() {
            self.record_segment(length_s, forces);
        }
    }

    fn record_segment(&mut self, length_s: f64, forces: &[PortForce]) {
        let conduction_state = self.switching.conduction_state;
        let mut state = smallvec![0.0; self.layout.states()];
        self.layout.unpack_into(&self.y, &mut state);
        let segment = TrajectorySegment {
            start_s: self.time_s,
            length_s,
            state,
            sizes: self.excitation.sizes.as_slice().into(),
            forces: forces.into(),
            conduction_state,
        };
        if let Some(record) = &mut self.record {
            record.push(segment);
        }
    }

    /// Returns the tables of a length that is no level.
    pub(crate) fn tables_of_length(&mut self, length_s: f64) -> Arc<StepTables> {
        self.odd_tables
            .of(self.kernel, self.switching.conduction_state, length_s)
    }

    /// Returns the numbers of steps and iterations so far.
    pub fn work(&self) -> WorkCount {
        self.work
    }
}
