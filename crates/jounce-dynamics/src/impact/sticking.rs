//! Sticking of the only port to its rigid stop, step by step, until the force would have to pull.

use super::acceleration::acceleration;
use crate::contact::step::ContactStep;
use crate::error::IntegrationError;
use crate::flow::state::columns;
use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use crate::integrator::Integrator;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::phasor::PhasorSamples;
use crate::ports::state::ContactState;
use crate::record::trajectory::PortForce;
use crate::tables::contact::{ContactTable, StickingTable};
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_linalg::c64;
use jounce_simd::{F64x8, LANES, Portable, Simd};

impl Integrator<'_> {
    /// Integrates sticking until the force would have to pull, or until the end.
    pub(super) fn stick(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        let mut level = self.ports[0].entry_level;
        while self.time_s < end_s {
            let force_now = self.acceleration_m_s2(0) / self.ports[0].rows.mobility_per_kg;
            if !self.is_pressed(0) {
                self.ports[0].contact_state = ContactState::Flight;
                return Ok(());
            }
            let remaining = end_s - self.time_s;
            let landing = Kernel::length_s(level) >= remaining;
            let odd;
            let tables = if landing {
                odd = self.tables_of_length(remaining);
                &odd
            } else {
                self.kernel.tables(level)
            };
            let table = tables.contact(self.kernel, (0, ForceBasis::Smooth));
            let sticking = tables.sticking(self.kernel, 0);
            let (force, [end_n, mismatch_n]) = self.holding_force(table, sticking);
            let error_n = self.force_error_n(&force);
            // The last node lies before the end of the step.
            let pulls = force.iter().any(|f| *f < -error_n) || end_n < -error_n;
            let negligible = force_now * table.length_s
                <= 1e-3 * self.tolerance * self.speed_m_s(0) / self.ports[0].rows.mobility_per_kg;
            if (pulls && !negligible) || mismatch_n > error_n {
                level = if landing {
                    Kernel::level_within(remaining) + 1
                } else {
                    level + LEVELS_PER_OCTAVE
                };
                if level > Kernel::finest() {
                    return Err(IntegrationError::NotFinite {
                        time_s: self.time_s,
                    });
                }
                continue;
            }
            self.commit_sticking(table, &force.map(|f| f.max(0.0)));
            if landing {
                self.time_s = end_s;
            }
            if pulls {
                self.ports[0].contact_state = ContactState::Flight;
                return Ok(());
            }
            // The mismatch of a polynomial through seven nodes grows with the seventh power of the
            // length.
            if mismatch_n * 2.0_f64.powi(NODES as i32) <= error_n {
                level = (level - LEVELS_PER_OCTAVE).max(Kernel::coarsest());
            }
        }
        Ok(())
    }

    /// Returns the error to which nodal forces that hold the point are known, N.
    fn force_error_n(&self, force: &[f64; NODES]) -> f64 {
        let size_n = force
            .iter()
            .fold(f64::MIN_POSITIVE, |max, f| max.max(f.abs()));
        // Just before the point leaves, its force is at most the roundoff of its terms.
        let roundoff_n = self.acceleration_roundoff_m_s2(0) / self.ports[0].rows.mobility_per_kg;
        (self.tolerance.max(1e-12) * 1e-2 * size_n).max(roundoff_n)
    }

    /// Returns the nodal forces that hold the point, and at the end of the step this force and its
    /// mismatch, N.
    fn holding_force(
        &mut self,
        table: &ContactTable,
        sticking: &StickingTable,
    ) -> ([f64; NODES], [f64; 2]) {
        let w = Portable::new();
        let mut free = w.store(columns(
            w,
            &self.layout,
            &self.y,
            &sticking.acceleration.columns,
            w.zero(),
        ));
        for tone in &mut self.tones {
            let samples =
                PhasorSamples::over(tone.angular_frequency_rad_s, &SMOOTH_BASIS, table.length_s);
            tone.samples[0] = samples;
            for i in 0..LANES {
                let phasor = tone.displacement_m[0]
                    * tone.turn
                    * c64::new(samples.cos.0[i], samples.sin.0[i]);
                free.0[i] += acceleration(phasor, tone.angular_frequency_rad_s);
            }
        }
        for (free, node) in free.0.iter_mut().zip(SMOOTH_BASIS.positions) {
            *free += self.excitation.acceleration_after(0, node * table.length_s);
        }
        let force: [f64; NODES] =
            std::array::from_fn(|i| (0..NODES).map(|j| sticking.inverse[i][j] * free.0[j]).sum());
        let end_by_nodes: f64 = (0..NODES)
            .map(|j| SMOOTH_BASIS.at_end.0[j] * force[j])
            .sum();
        let end_acceleration: f64 = free.0[NODES]
            + (0..NODES)
                .map(|j| sticking.acceleration.push[j].0[NODES] * force[j])
                .sum::<f64>();
        let end_n = end_acceleration / self.ports[0].rows.mobility_per_kg;
        (force, [end_by_nodes, (end_by_nodes - end_n).abs()])
    }

    /// Takes a step under given nodal forces and resets the point onto the stop to roundoff.
    fn commit_sticking(&mut self, table: &ContactTable, force: &[f64; NODES]) {
        let lane = F64x8(std::array::from_fn(
            |i| if i < NODES { force[i] } else { 0.0 },
        ));
        let w = Portable::new();
        let step = ContactStep::with_prescribed_force(0, table);
        self.note(table.length_s, &[PortForce::new(&step, &lane)]);
        table.flow.apply(w, &self.y, &mut self.next);
        self.push_on(w, &step, &lane);
        self.integrate_force(w, &step, &lane);
        std::mem::swap(&mut self.y, &mut self.next);
        self.time_s += table.length_s;
        self.tones.iter_mut().for_each(|tone| tone.set(self.time_s));
        self.excitation.pass(
            w,
            self.kernel,
            table.length_s,
            self.time_s,
            (&self.next, &mut self.y),
        );
        self.update_port(w, 0);
        self.observe_rest(0, table.length_s, &lane);
        self.reset_onto_stop(0);
    }

    /// Adds a step of sticking to the statistics.
    pub(crate) fn observe_rest(&mut self, p: usize, length_s: f64, force: &F64x8) {
        let port = &mut self.ports[p];
        port.statistics.max_force_n = force
            .0
            .iter()
            .fold(port.statistics.max_force_n, |max, f| max.max(*f));
        port.statistics.sticking_s += length_s;
        port.stay(length_s);
    }

    /// Removes the drift of collocation: the constraint acts on the acceleration, so that position
    /// and speed drift by roundoff.
    pub(crate) fn reset_onto_stop(&mut self, p: usize) {
        let (plant, port) = (&self.kernel.plant, &self.ports[p]);
        let mobility = port.rows.mobility_per_kg;
        let shape = &plant.system.stops[p].shape;
        let shift: Vec<f64> = shape
            .iter()
            .map(|s| -s * port.penetration_m / mobility)
            .collect();
        let inverse = &plant.diagonal.from_physical;
        let correction: Vec<f64> = (0..plant.len())
            .map(|i| {
                shift
                    .iter()
                    .enumerate()
                    .map(|(j, q)| inverse[(i, j)] * q)
                    .sum()
            })
            .collect();
        let correction = self.layout.pack(&correction);
        let column = self.layout.pack(&plant.ports[p].force);
        let impulse = port.rate_m_s / mobility;
        for ((y, correction), b) in self.y.iter_mut().zip(&correction).zip(&column) {
            *y = y.add_scaled(1.0, correction).add_scaled(impulse, b);
        }
        self.set_motion(p, [0.0, 0.0]);
    }
}
