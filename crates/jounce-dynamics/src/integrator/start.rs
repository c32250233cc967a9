//! Start of an integration.

use super::{FullState, Integrator};
use crate::contact::step_size_control::RELEASE_ERROR_FACTOR;
use crate::error::IntegrationError;
use crate::excitation::Excitation;
use crate::impact::acceleration::RESOLVED_ROUNDOFFS;
use crate::kernel::Kernel;
use crate::ports::per_port::PerPort;
use crate::ports::phasor::Phasor;
use crate::ports::state::PortState;
use crate::record::energies::MeterReadings;
use crate::record::statistics::{ContactIntegrals, WorkCount};
use crate::rectifier::switching::Switching;
use crate::tables::odd_tables::OddTables;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_simd::{F64x8, Portable};

/// Error of a given start position, relative to the gap; that of the speed is this times the gap and
/// the highest frequency.
const POSITION_ROUNDOFF: f64 = 1e-12;

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
        let mut integrator = Self::in_one_conduction_state(kernel, y, time_s, tolerance);
        integrator.open_switching()?;
        Ok(integrator)
    }

    /// Creates an integrator in the conduction state of a kernel.
    fn in_one_conduction_state(kernel: &'k Kernel, y: &[f64], time_s: f64, tolerance: f64) -> Self {
        let layout = kernel.layout;
        let excitation = Excitation::new(kernel, time_s);
        let contact_level = contact_level(kernel);
        let mut integrator = Self {
            kernel,
            base: kernel,
            switching: Switching::default(),
            layout,
            tolerance,
            time_s,
            y: vec![F64x8::ZERO; layout.lanes()],
            odd_tables: OddTables::default(),
            ports: PerPort::new(kernel.plant.ports.len(), |port| {
                PortState::new(kernel, port, contact_level)
            }),
            flight_level: flight_level(kernel),
            flight_s: f64::INFINITY,
            release_error_factor: RELEASE_ERROR_FACTOR,
            integrals: ContactIntegrals::none(kernel),
            tones: Phasor::of_all(&kernel.plant, time_s),
            excitation,
            work: WorkCount::default(),
            checks: 0,
            opening: MeterReadings::default(),
            record: None,
        };
        integrator.set_state(y);
        integrator.open_ports();
        integrator
    }

    /// Sets the state without its forced part from block coordinates.
    fn set_state(&mut self, y: &[f64]) {
        let forced = self.kernel.plant.forced(&self.excitation.sizes, 0.0);
        let free: Vec<f64> = y.iter().zip(forced).map(|(y, part)| y - part).collect();
        self.layout.pack_into(&free, &mut self.y);
    }

    /// Enters the kernel of another conduction state in a physical state; contacts continue
    /// unchanged. Returns the state in its coordinates.
    pub(crate) fn enter_kernel(&mut self, kernel: &'k Kernel, x: &[f64]) -> FullState {
        (self.kernel, self.layout) = (kernel, kernel.layout);
        self.excitation.enter(kernel, self.time_s, &self.held_a());
        self.y.clear();
        self.y.resize(kernel.layout.lanes(), F64x8::ZERO);
        let block = kernel.plant.from_physical(x, self.time_s);
        self.set_state(&block);
        self.integrals = ContactIntegrals::none(kernel);
        self.tones = Phasor::of_all(&kernel.plant, self.time_s);
        self.enter_ports();
        let state = FullState {
            lanes: kernel.layout.pack(&block),
            block,
            physical: x.to_vec(),
        };
        self.excitation.open(&state.lanes);
        self.opening = self.readings(&state);
        state
    }

    /// Gives the ports of the stops the rows of the kernel, and starts those of its event functions.
    fn enter_ports(&mut self) {
        let kernel = self.kernel;
        let stops = kernel.plant.system.stops.len();
        let contact_level = contact_level(kernel);
        let ports = PerPort::new(kernel.plant.ports.len(), |p| {
            let new = PortState::new(kernel, p, contact_level);
            match p < stops {
                true => PortState {
                    rows: new.rows,
                    gap_m: new.gap_m,
                    ..self.ports[p].clone()
                },
                false => new,
            }
        });
        self.ports = ports;
        self.update_free_ports(Portable::new());
    }

    /// Returns distance (m) and speed (m/s) of a port within which it starts from rest.
    fn start_roundoffs(&self, p: usize) -> [f64; 2] {
        let by_gap_m = POSITION_ROUNDOFF * self.ports[p].gap_m.abs();
        let by_terms_m = RESOLVED_ROUNDOFFS * self.distance_roundoff_m(p);
        let by_terms_m_s = RESOLVED_ROUNDOFFS * f64::EPSILON * self.velocity_terms_m_s(p);
        [
            by_gap_m.max(by_terms_m),
            by_terms_m_s.max(by_gap_m * self.kernel.fastest_rad_s),
        ]
    }

    /// Sets the ports to their first motion, and the energy meters to their first readings.
    fn open_ports(&mut self) {
        let kernel = self.kernel;
        let count = kernel.plant.ports.len();
        let state = self.full_state();
        self.excitation.open(&state.lanes);
        for (p, stop) in kernel.plant.system.stops.iter().enumerate() {
            self.update_port(Portable::new(), p);
            let roundoffs = self.start_roundoffs(p);
            self.ports[p].start_pressed(&stop.law, roundoffs);
        }
        for p in kernel.plant.system.stops.len()..count {
            self.update_port(Portable::new(), p);
        }
        self.opening = self.readings(&state);
    }
}

/// Returns the level of the first flight; without ports nothing limits its steps.
fn flight_level(kernel: &Kernel) -> i32 {
    if kernel.plant.ports.is_empty() {
        Kernel::coarsest()
    } else {
        Kernel::level_within(1.0 / kernel.fastest_rad_s)
    }
}

/// Returns the level of the first step of the first contact.
fn contact_level(kernel: &Kernel) -> i32 {
    (flight_level(kernel) + 3 * LEVELS_PER_OCTAVE).min(Kernel::finest())
}
