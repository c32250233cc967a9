//! Integrator: the state of a run and its advance to a given time.
//!
//! Between contacts the flow is exact, and the certificate limits the step length. In contact the
//! scalar force on a step is a polynomial through seven Gauss nodes, found by fixed-point
//! iteration. The loop alternates the two. [`super::multi_port`] integrates several ports.

use super::error::IntegrationError;
use super::kernel::Kernel;
use super::multi_port::AdvanceMultiPort;
use crate::contact::step_control::{RELEASE_ERROR_FACTOR, RELEASE_ERROR_FACTOR_OF_DERIVATIVE};
use crate::excitation::Excitation;
use crate::flow::layout::StateLayout;
use crate::ports::per_port::PerPort;
use crate::ports::phasor::Phasor;
use crate::ports::state::{ContactState, PortState};
use crate::record::energies::MeterReadings;
use crate::record::statistics::{ContactIntegrals, ContactStatistics, WorkCount};
use crate::record::trajectory::{PortForce, Trajectory, TrajectorySegment};
use crate::rectifier::switching::Switching;
use crate::tables::ad_hoc::AdHocTables;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_model::contact::{ContactLaw, Hertz, Law, Rigid};
use jounce_model::plant::Stop;
use jounce_simd::{F64x8, Portable, Simd, Task, widest};

/// Polls of the control between two callbacks.
const POLLS_PER_CALLBACK: u8 = 64;

/// Integration in progress.
#[derive(Debug, Clone)]
pub struct Integrator<'k> {
    pub(super) kernel: &'k Kernel,
    /// Kernel with all bridges blocked; states enter and leave in its coordinates.
    pub(super) base: &'k Kernel,
    pub(super) switching: Switching,
    pub(super) layout: StateLayout,
    pub(super) tolerance: f64,
    pub(super) time_s: f64,
    pub(super) y: Vec<F64x8>,
    pub(super) next: Vec<F64x8>,
    /// Integrals of the force of the current step from its start (see
    /// [`crate::force_response::duhamel`]).
    pub(super) from_start: Vec<F64x8>,
    pub(super) ad_hoc_tables: AdHocTables,
    pub(super) tones: Vec<Phasor>,
    pub(super) excitation: Excitation,
    pub(super) ports: PerPort<PortState>,
    pub(super) flight_level: i32,
    /// Duration of the last flight that ended in a contact, s.
    pub(super) flight_s: f64,
    /// Error factor of the remaining impulse for a step that ends past the surface (see
    /// [`crate::contact::step_control`]).
    pub(super) release_error_factor: f64,
    pub(super) integrals: ContactIntegrals,
    pub(super) work: WorkCount,
    /// Number of polls of the control.
    pub(super) checks: u8,
    pub(super) opening: MeterReadings,
    pub(super) record: Option<Trajectory>,
}

impl<'k> Integrator<'k> {
    /// Starts an integration at a time from block coordinates `y` (see
    /// [`jounce_model::plant::Plant::from_physical`]).
    ///
    /// `tolerance` is the wanted relative error of the response.
    ///
    /// # Errors
    /// [`IntegrationError::NotFinite`] for a start that is not finite.
    pub fn new(
        kernel: &'k Kernel,
        y: &[f64],
        time_s: f64,
        tolerance: f64,
    ) -> Result<Self, IntegrationError> {
        if y.iter().any(|value| !value.is_finite()) {
            return Err(IntegrationError::NotFinite { time_s });
        }
        let mut integrator = Self::in_one_regime(kernel, y, time_s, tolerance);
        integrator.open_switching()?;
        Ok(integrator)
    }

    /// Creates an integrator in the conduction state of a kernel.
    pub(super) fn in_one_regime(
        kernel: &'k Kernel,
        y: &[f64],
        time_s: f64,
        tolerance: f64,
    ) -> Self {
        let (plant, layout) = (&kernel.plant, kernel.layout);
        let tones: Vec<Phasor> = (0..plant.tones.len())
            .map(|index| Phasor::new(plant, index, time_s))
            .collect();
        let start = Kernel::level_within(1.0 / kernel.fastest_rad_s);
        let forced = Excitation::new(kernel, time_s);
        let free: Vec<f64> = y
            .iter()
            .zip(plant.forced(&forced.sizes, 0.0))
            .map(|(y, forced)| y - forced)
            .collect();
        let count = plant.ports.len();
        let mut integrator = Self {
            kernel,
            base: kernel,
            switching: Switching::default(),
            layout,
            tolerance,
            time_s,
            y: layout.pack(&free),
            next: vec![F64x8::ZERO; layout.lanes()],
            from_start: vec![F64x8::ZERO; layout.lanes()],
            ad_hoc_tables: AdHocTables::default(),
            ports: PerPort::new(count, |port| {
                PortState::new(
                    plant,
                    &layout,
                    &tones,
                    port,
                    (start + 3 * LEVELS_PER_OCTAVE).min(Kernel::finest()),
                )
            }),
            flight_level: start,
            flight_s: f64::INFINITY,
            release_error_factor: RELEASE_ERROR_FACTOR,
            integrals: ContactIntegrals {
                loads_j: vec![0.0; kernel.meters().loads.len()],
                tones_n_s: PerPort::new(count, |_| vec![Default::default(); tones.len()]),
                ..ContactIntegrals::default()
            },
            tones,
            excitation: forced,
            work: WorkCount::default(),
            checks: 0,
            opening: MeterReadings::default(),
            record: None,
        };
        integrator.excitation.open(&layout, &integrator.y);
        for (p, stop) in plant.system.stops.iter().enumerate() {
            integrator.update_port(Portable::new(), p);
            integrator.ports[p].start_pressed(&stop.law, kernel.fastest_rad_s);
        }
        for p in plant.system.stops.len()..count {
            integrator.update_port(Portable::new(), p);
        }
        integrator.opening = integrator.readings();
        integrator
    }

    /// Resolves the ends of contacts finely enough for an accurate derivative of the flow.
    pub(super) fn resolve_derivative(&mut self) {
        self.release_error_factor = RELEASE_ERROR_FACTOR_OF_DERIVATIVE;
    }

    /// Returns the current time, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Returns the state in block coordinates.
    pub fn state(&self) -> Vec<f64> {
        if self.switching.regime == 0 {
            self.block_state()
        } else {
            self.base.plant.from_physical(&self.physical(), self.time_s)
        }
    }

    /// Returns the state in the block coordinates of the current conduction state.
    pub(super) fn block_state(&self) -> Vec<f64> {
        self.excitation.full_state(&self.layout, &self.y)
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
        let force = |(port, stop): (&PortState, &Stop)| match port.regime {
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

    /// Resets the contact statistics, not the energies.
    pub fn reset_statistics(&mut self) {
        let stops = &self.kernel.plant.system.stops;
        self.ports
            .iter_mut()
            .zip(stops)
            .for_each(|(port, stop)| port.reset_statistics(&stop.law));
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
    pub(super) fn note(&mut self, length_s: f64, forces: &[PortForce]) {
        if let Some(record) = &mut self.record {
            let sizes = self.excitation.sizes.clone();
            let (state, regime) = (self.layout.unpack(&self.y), self.switching.regime);
            record.push(TrajectorySegment {
                start_s: self.time_s,
                length_s,
                state,
                sizes,
                forces: forces.into(),
                regime,
            });
        }
    }

    /// Returns the numbers of steps and iterations so far.
    pub fn work(&self) -> WorkCount {
        self.work
    }

    /// Integrates to a time and lands on it exactly.
    ///
    /// # Errors
    /// Every variant of [`IntegrationError`].
    pub fn advance_to(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        if self.kernel.plant.system.bridges.is_empty() {
            return self.advance_in_regime(end_s);
        }
        while self.time_s < end_s {
            self.advance_in_regime(end_s)?;
            self.change_on_events()?;
        }
        Ok(())
    }

    /// Integrates until the end, or until an event function passes zero.
    fn advance_in_regime(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        if self.kernel.plant.ports.len() > 1 || !self.kernel.plant.guards.is_empty() {
            return widest(AdvanceMultiPort {
                integrator: self,
                end_s,
            });
        }
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        match law {
            None => self.dispatch(
                Hertz {
                    stiffness: 0.0,
                    exponent: 1.0,
                },
                end_s,
            ),
            Some(Law::Hertz(law)) => self.dispatch(law, end_s),
            Some(Law::KelvinVoigt(law)) => self.dispatch(law, end_s),
            Some(Law::HuntCrossley(law)) => self.dispatch(law, end_s),
            Some(Law::Cubic(law)) => self.dispatch(law, end_s),
            Some(Law::Rigid(law)) => widest(AdvanceRigid {
                integrator: self,
                law,
                end_s,
            }),
        }
    }

    /// Passes the breakpoints of the signals up to the current time; returns the next one, or the
    /// end if that is earlier.
    #[inline(always)]
    pub(super) fn next_breakpoint<W: Simd>(&mut self, w: W, end_s: f64) -> f64 {
        if self.excitation.has_breakpoint(self.time_s)
            && self.excitation.cross(self.kernel, self.time_s, &mut self.y)
        {
            self.update_ports(w);
        }
        end_s.min(self.excitation.until_s(self.time_s))
    }

    /// Updates all ports after an impulse of a signal; a port that stuck to a rigid stop and now
    /// moves away enters flight.
    #[inline(always)]
    fn update_ports<W: Simd>(&mut self, w: W) {
        for (p, stop) in self.kernel.plant.system.stops.iter().enumerate() {
            self.update_port(w, p);
            let port = &mut self.ports[p];
            if matches!(stop.law, Law::Rigid(_)) && port.rate_m_s < 0.0 {
                port.regime = ContactState::Flight;
            }
        }
    }

    /// Checks for cancellation, reports progress, and periodically runs the callback.
    #[inline(always)]
    pub(super) fn poll(&mut self) -> Result<(), IntegrationError> {
        self.checks = self.checks.wrapping_add(1);
        if self.kernel.control.is_quiet() && !self.checks.is_multiple_of(POLLS_PER_CALLBACK) {
            Ok(())
        } else {
            self.poll_control()
        }
    }

    #[cold]
    fn poll_control(&self) -> Result<(), IntegrationError> {
        if !self.kernel.control.is_quiet() {
            self.kernel.control.report_progress(self.time_s);
        }
        if self.kernel.control.is_stopped() {
            Err(IntegrationError::Stopped {
                time_s: self.time_s,
            })
        } else {
            Ok(())
        }
    }

    fn dispatch<L: ContactLaw>(&mut self, law: L, end_s: f64) -> Result<(), IntegrationError> {
        widest(Advance {
            integrator: self,
            law,
            end_s,
        })
    }
}

/// Runs the loop in code compiled for the vector instructions of this machine.
struct Advance<'m, 'k, L> {
    integrator: &'m mut Integrator<'k>,
    law: L,
    end_s: f64,
}

impl<L: ContactLaw> Task for Advance<'_, '_, L> {
    type Output = Result<(), IntegrationError>;

    /// Alternates flight and contact until the end.
    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        let Advance {
            integrator,
            law,
            end_s,
        } = self;
        while integrator.time_s < end_s {
            integrator.poll()?;
            let until_s = integrator.next_breakpoint(w, end_s);
            match integrator.ports[0].regime {
                ContactState::Flight => integrator.flight(w, until_s)?,
                ContactState::Contact => integrator.contact(w, law, until_s)?,
            }
        }
        Ok(())
    }
}

/// Runs the loop of a rigid stop.
struct AdvanceRigid<'m, 'k> {
    integrator: &'m mut Integrator<'k>,
    law: Rigid,
    end_s: f64,
}

impl Task for AdvanceRigid<'_, '_> {
    type Output = Result<(), IntegrationError>;

    #[inline(always)]
    fn run<W: Simd>(self, w: W) -> Self::Output {
        self.integrator.advance_rigid(w, self.law, self.end_s)
    }
}
