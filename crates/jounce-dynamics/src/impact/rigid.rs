//! Rigid stop: exact flight between impacts, impacts as velocity jumps, and sticking to the stop.
//!
//! An impact changes the relative speed `v` to `-e v` by the impulse `p = (1 + e) v / M`, with the
//! mobility `M` of the port (1/kg). The energy loss is `(1 - e^2) v^2 / (2 M)`. Where the motion
//! presses the point onto the stop, impacts accumulate in finite time (chatter). Once the speed is
//! below the tolerance, the remaining impacts are omitted and the point sticks. While it sticks the
//! contact force holds its relative acceleration at zero,
//!
//! ```text
//! a . y(t) + a_drive(t) - M f(t) = 0,
//! ```
//!
//! collocated at the nodes of a step as for compliant stops; the point leaves when the force would
//! have to pull.

use super::zeno_guard::ZenoGuard;
use crate::contact::step::ContactStep;
use crate::error::IntegrationError;
use crate::flow::state::{columns, dot};
use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use crate::integrator::Integrator;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::phasor::PhasorSamples;
use crate::ports::state::ContactState;
use crate::record::trajectory::PortForce;
use crate::tables::contact::{ContactTable, StickingTable};
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use faer::c64;
use jounce_model::contact::Rigid;
use jounce_simd::{F64x8, LANES, Portable, Simd};

/// Fraction of the terms of an acceleration that is roundoff.
const ACCELERATION_ROUNDOFF: f64 = 1e-12;

/// Height of a hop, in units of the roundoff of the distance, below which its end cannot be
/// resolved.
const MIN_HOP_HEIGHT: f64 = 64.0;

/// Height of a hop, in units of its distance past the stop at the start, below which it is ignored.
const MIN_HOP_PAST_STOP: f64 = 2.0;

/// Speed after an impact, relative to the scale of speeds, above which a hop is always high enough.
const FAST_HOP_SPEED: f64 = 1e-3;

/// Speed after an impact, relative to the largest impact speed and the tolerance, below which
/// chatter ends.
const CHATTER_SPEED: f64 = 1e-2;

impl Integrator<'_> {
    /// Alternates flight, impacts and sticking until the end.
    #[inline(always)]
    pub(crate) fn advance_rigid<W: Simd>(
        &mut self,
        w: W,
        law: Rigid,
        end_s: f64,
    ) -> Result<(), IntegrationError> {
        let mut rounds = ZenoGuard::default();
        while self.time_s < end_s {
            self.poll()?;
            rounds.count(&self.kernel.plant, self.time_s)?;
            let until_s = self.next_breakpoint(w, end_s);
            match self.ports[0].regime {
                ContactState::Flight => self.flight(w, until_s)?,
                ContactState::Contact if self.ports[0].rate_m_s > 0.0 => self.impact(0, law),
                ContactState::Contact => self.stick(until_s)?,
            }
        }
        Ok(())
    }

    /// Applies one impact; it ends in flight, or in sticking where chatter has ended.
    pub(crate) fn impact(&mut self, p: usize, law: Rigid) {
        let (before, mobility, rebound) = (
            self.ports[p].rate_m_s,
            self.ports[p].rows.mobility_per_kg,
            self.rebound(p, law),
        );
        self.push_by(p, (1.0 + rebound) * before / mobility);
        self.integrals.loss_j += 0.5 * (1.0 - rebound * rebound) * before * before / mobility;
        self.rebounds(p, -rebound * before);
        if rebound == 0.0 && self.ports[p].regime == ContactState::Contact {
            // The omitted bounces, a geometric series, do not count as sticking.
            let omitted_s = 2.0 * law.restitution * before
                / ((1.0 - law.restitution) * self.acceleration_m_s2(p));
            self.ports[p].statistics.sticking_s -= if omitted_s.is_finite() {
                omitted_s
            } else {
                0.0
            };
        }
    }

    /// Returns the ratio of the speeds after and before an impact: the restitution, or zero for a
    /// rebound that is negligible or within roundoff.
    pub(crate) fn rebound(&self, p: usize, law: Rigid) -> f64 {
        let (after, impact_velocity_m_s) = (
            law.restitution * self.ports[p].rate_m_s,
            self.ports[p].impact_velocity_m_s,
        );
        let is_slow = after <= CHATTER_SPEED * self.tolerance * impact_velocity_m_s;
        let is_suppressed =
            || self.is_suppressed_hop(p, [self.reading(Portable::new(), p)[0], after]);
        if is_slow || (after <= FAST_HOP_SPEED * self.speed_m_s(p) && is_suppressed()) {
            0.0
        } else {
            law.restitution
        }
    }

    /// True for a hop that starts at a speed past the stop by roundoff and is pressed back before
    /// it leaves the stop by more than the roundoff of the distance.
    pub(crate) fn is_suppressed_hop(&self, p: usize, [depth_m, rate_m_s]: [f64; 2]) -> bool {
        let rows = &self.ports[p].rows;
        let roundoff_m = f64::EPSILON
            * self
                .terms_of(&rows.displacement)
                .max(rows.tone_scale_m)
                .max(rows.gap_m.abs());
        let least_m = MIN_HOP_HEIGHT * roundoff_m + MIN_HOP_PAST_STOP * depth_m.max(0.0);
        // Where the pressing acceleration is roundoff the point leaves: sticking would release it
        // at once.
        rate_m_s * rate_m_s <= 2.0 * self.acceleration_m_s2(p) * least_m && self.is_pressed(p)
    }

    /// Sets a point that leaves an impact at a speed: it flies, or sticks where it has no speed and
    /// is pressed.
    pub(crate) fn rebounds(&mut self, p: usize, rate_m_s: f64) {
        self.set_motion(p, [0.0, rate_m_s]);
        if rate_m_s != 0.0 || !self.is_pressed(p) {
            self.ports[p].regime = ContactState::Flight;
        }
    }

    /// True where the motion presses a touching point onto its stop: at present, or, where its
    /// acceleration is roundoff, in the next moment.
    pub(super) fn is_pressed(&self, p: usize) -> bool {
        let (acceleration, roundoff) = (
            self.acceleration_m_s2(p),
            self.acceleration_roundoff_m_s2(p),
        );
        acceleration > roundoff || acceleration >= -roundoff && self.jerk_m_s3(p) > 0.0
    }

    /// Returns the magnitude below which the acceleration towards the stop is roundoff, m/s^2.
    pub(crate) fn acceleration_roundoff_m_s2(&self, p: usize) -> f64 {
        let row = self.layout.pack(&self.kernel.acceleration_row(p));
        let free = self.terms_of(&row);
        let size = |tone: &crate::ports::phasor::Phasor| {
            tone.displacement_m[p].norm() * tone.angular_frequency_rad_s.powi(2)
        };
        ACCELERATION_ROUNDOFF
            * (free
                + self.tones.iter().map(size).sum::<f64>()
                + self.excitation.acceleration_after(p, 0.0).abs())
    }

    /// Returns the rate of the acceleration towards the stop without contact force, m/s^3.
    pub(crate) fn jerk_m_s3(&self, p: usize) -> f64 {
        let row = self.layout.pack(
            &self
                .kernel
                .plant
                .diagonal
                .block
                .rate_row(&self.kernel.acceleration_row(p)),
        );
        let of = |tone: &crate::ports::phasor::Phasor| {
            let w = tone.angular_frequency_rad_s;
            acceleration(tone.displacement_m[p] * tone.turn * c64::new(0.0, w), w)
        };
        // The displacement forced by signals is a cubic: a difference is its exact rate.
        let after_s = 1.0 / self.kernel.fastest_rad_s;
        let forced = (self.excitation.acceleration_after(p, after_s)
            - self.excitation.acceleration_after(p, 0.0))
            / after_s;
        dot(Portable::new(), &row, &self.y) + self.tones.iter().map(of).sum::<f64>() + forced
    }

    /// Changes the velocity by an impulse away from the stop, N s.
    pub(crate) fn push_by(&mut self, p: usize, impulse_n_s: f64) {
        if let Some(record) = &mut self.record {
            record.push_impact(p, impulse_n_s);
        }
        let kernel = self.kernel;
        let column = self.layout.pack(&kernel.plant.ports[p].force);
        let middle: Vec<F64x8> = self
            .y
            .iter()
            .zip(&column)
            .map(|(y, b)| y.add_scaled(0.5 * impulse_n_s, b))
            .collect();
        // For the meters, the integral over an instantaneous force is the force times the mean of
        // the states before and after.
        for (sum, meter) in self
            .integrals
            .loads_j
            .iter_mut()
            .zip(&kernel.meters().loads)
        {
            *sum += impulse_n_s
                * dot(
                    Portable::new(),
                    &self.layout.pack(meter.port_row(p)),
                    &middle,
                );
        }
        self.integrals.damping_j += impulse_n_s
            * dot(
                Portable::new(),
                &self.layout.pack(kernel.meters().damping.port_row(p)),
                &middle,
            );
        for (sum, tone) in self.integrals.tones_n_s[p].iter_mut().zip(&self.tones) {
            *sum += tone.turn * impulse_n_s;
        }
        self.excitation.strike_stop(p, impulse_n_s);
        self.ports[p].statistics.impulse_n_s += impulse_n_s;
        self.y
            .iter_mut()
            .zip(&column)
            .for_each(|(y, b)| *y = y.add_scaled(impulse_n_s, b));
    }

    /// Returns the relative acceleration towards the stop without contact force, m/s^2.
    pub(crate) fn acceleration_m_s2(&self, p: usize) -> f64 {
        let row = self.layout.pack(&self.kernel.acceleration_row(p));
        let drive: f64 = self
            .tones
            .iter()
            .map(|tone| {
                acceleration(
                    tone.displacement_m[p] * tone.turn,
                    tone.angular_frequency_rad_s,
                )
            })
            .sum();
        dot(Portable::new(), &row, &self.y) + drive + self.excitation.acceleration_after(p, 0.0)
    }

    /// Returns the scale for speed errors of a sticking port: the largest impact speed, or the
    /// terms of its velocity. The latter are needed where bodies push each other from rest without
    /// any impact.
    pub(crate) fn speed_m_s(&self, p: usize) -> f64 {
        self.ports[p]
            .impact_velocity_m_s
            .max(self.velocity_terms_m_s(p))
    }

    /// Returns the sum of the magnitudes of the terms of the velocity of a port, m/s.
    pub(super) fn velocity_terms_m_s(&self, p: usize) -> f64 {
        self.terms_of(&self.ports[p].rows.velocity)
    }

    /// Returns the sum of the magnitudes of the terms of an output.
    pub(crate) fn terms_of(&self, row: &[F64x8]) -> f64 {
        let terms = |(row, y): (&F64x8, &F64x8)| {
            row.0
                .iter()
                .zip(y.0)
                .map(|(row, y)| (row * y).abs())
                .sum::<f64>()
        };
        row.iter().zip(&self.y).map(terms).sum()
    }

    /// Integrates sticking until the force would have to pull, or until the end.
    fn stick(&mut self, end_s: f64) -> Result<(), IntegrationError> {
        let mut level = self.ports[0].entry_level;
        while self.time_s < end_s {
            let force_now = self.acceleration_m_s2(0) / self.ports[0].rows.mobility_per_kg;
            if !self.is_pressed(0) {
                self.ports[0].regime = ContactState::Flight;
                return Ok(());
            }
            let remaining = end_s - self.time_s;
            let landing = Kernel::length_s(level) >= remaining;
            let odd;
            let (table, sticking) = if landing {
                odd = (
                    ContactTable::new(self.kernel, 0, &SMOOTH_BASIS, remaining),
                    StickingTable::new(self.kernel, 0, &SMOOTH_BASIS, remaining),
                );
                (&odd.0, &odd.1)
            } else {
                (
                    self.kernel.table(0, ForceBasis::Smooth, level),
                    self.kernel.sticking(0, level),
                )
            };
            let (force, mismatch_n) = self.holding_force(table, sticking);
            let size_n = force
                .iter()
                .fold(f64::MIN_POSITIVE, |max, f| max.max(f.abs()));
            // Just before the point leaves, its force is at most the roundoff of its terms.
            let roundoff_n =
                self.acceleration_roundoff_m_s2(0) / self.ports[0].rows.mobility_per_kg;
            let allowed_n = (self.tolerance.max(1e-12) * 1e-2 * size_n).max(roundoff_n);
            let pulls = force.iter().any(|f| *f < 0.0);
            let negligible = force_now * table.length_s
                <= 1e-3 * self.tolerance * self.speed_m_s(0) / self.ports[0].rows.mobility_per_kg;
            if (pulls && !negligible) || mismatch_n > allowed_n {
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
                self.ports[0].regime = ContactState::Flight;
                return Ok(());
            }
            // The mismatch of a polynomial through seven nodes grows with the seventh power of the
            // length.
            if mismatch_n * 2.0_f64.powi(NODES as i32) <= allowed_n {
                level = (level - LEVELS_PER_OCTAVE).max(Kernel::coarsest());
            }
        }
        Ok(())
    }

    /// Returns the nodal forces that hold the point, and their mismatch at the end of the step, N.
    fn holding_force(
        &mut self,
        table: &ContactTable,
        sticking: &StickingTable,
    ) -> ([f64; NODES], f64) {
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
        (
            force,
            (end_by_nodes - end_acceleration / self.ports[0].rows.mobility_per_kg).abs(),
        )
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
        self.excitation
            .pass(self.kernel, table.length_s, self.time_s, &mut self.y);
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

/// Returns the acceleration of a sinusoidal displacement, m/s^2.
pub(crate) fn acceleration(displacement_m: c64, angular_frequency_rad_s: f64) -> f64 {
    -(displacement_m * angular_frequency_rad_s * angular_frequency_rad_s).re
}
