//! Start of an integration.

use super::Integrator;
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
        let mut integrator = Self::in_one_conduction_state(kernel, y, time_s, tolerance, &[]);
        integrator.open_switching()?;
        Ok(integrator)
    }

    /// Creates an integrator in the conduction state of a kernel; `held_a` are the currents that
    /// the bridges draw from their storages.
    pub(crate) fn in_one_conduction_state(
        kernel: &'k Kernel,
        y: &[f64],
        time_s: f64,
        tolerance: f64,
        held_a: &[f64],
    ) -> Self {
        let (plant, layout) = (&kernel.plant, kernel.layout);
        let tones: Vec<Phasor> = (0..plant.tones.len())
            .map(|index| Phasor::new(plant, index, time_s))
            .collect();
        let start = Kernel::level_within(1.0 / kernel.fastest_rad_s);
        let contact_level = (start + 3 * LEVELS_PER_OCTAVE).min(Kernel::finest());
        let forced = Excitation::new(kernel, time_s, held_a);
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
            odd_tables: OddTables::default(),
            ports: PerPort::new(count, |port| PortState::new(kernel, port, contact_level)),
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
        integrator.open_ports();
        integrator
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
        self.excitation.open(&self.y);
        for (p, stop) in kernel.plant.system.stops.iter().enumerate() {
            self.update_port(Portable::new(), p);
            let roundoffs = self.start_roundoffs(p);
            self.ports[p].start_pressed(&stop.law, roundoffs);
        }
        for p in kernel.plant.system.stops.len()..count {
            self.update_port(Portable::new(), p);
        }
        self.opening = self.readings();
    }
}
