//! Acceptance of a solved contact step: state, energy meters and statistics at its end.

use super::peak::interpolated_peak;
use super::separation::separation;
use super::step::{ContactStep, SolvedStep};
use crate::flow::row::FlowRow;
use crate::flow::state::{add_spread_response, dot, spread};
use crate::force_response::basis::NODES;
use crate::integrator::{Integrator, TrialState};
use crate::kernel::ForceBasis;
use crate::ports::state::ContactState;
use crate::record::trajectory::PortForce;
use jounce_linalg::c64;
use jounce_model::contact::ContactLaw;
use jounce_simd::{F64x8, Simd};

/// Share of the largest value so far above which the peak of a step between its nodes may exceed it.
const NEAR_PEAK: f64 = 0.98;

impl Integrator<'_> {
    /// Accepts a solved step of the only port in contact.
    #[inline(always)]
    pub(super) fn accept_step<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
        trial: &mut TrialState,
    ) {
        let force = nodal(&solved.force);
        if self.record.is_some() {
            self.note(step.table.length_s, &[PortForce::new(step, &force)]);
        }
        step.table.flow.apply(w, &self.y, &mut trial.y);
        self.apply_force(w, step, &force, trial);
        self.end_contact_step(w, step, trial);
        self.update_port_in_contact(w, law, step, solved);
    }

    /// Applies the nodal forces of a step, last lane 0: to the state at its end, and to the energy
    /// meters.
    #[inline(always)]
    pub(crate) fn apply_force<W: Simd>(
        &mut self,
        w: W,
        step: &ContactStep,
        force: &F64x8,
        trial: &mut TrialState,
    ) {
        self.push_on(w, step, force, trial);
        self.integrate_force(w, step, force, &trial.from_start);
    }

    /// Advances to the end of a step; the ports are not updated.
    #[inline(always)]
    pub(crate) fn end_contact_step<W: Simd>(
        &mut self,
        w: W,
        step: &ContactStep,
        trial: &mut TrialState,
    ) {
        let length_s = step.table.length_s;
        self.enter_trial(w, length_s, self.time_s + length_s, trial);
        for tone in &mut self.tones {
            tone.turn *= tone.samples[step.port].end();
        }
        self.work.contact_steps += 1;
    }

    /// Sets a port to its state at the end of an accepted step.
    #[inline(always)]
    pub(crate) fn update_port_in_contact<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
    ) {
        let p = step.port;
        let speed = self.excitation.motion_after(p, 0.0)[1]
            + self.tones.iter().map(|tone| tone.motion(p)[1]).sum::<f64>();
        let started = (self.ports[p].penetration_m, self.ports[p].rate_m_s);
        let rate_m_s = dot(w, &self.ports[p].rows.velocity, &self.y) + speed;
        self.set_motion(p, [solved.penetration.0[NODES], rate_m_s]);
        self.observe(w, law, step, solved, started);
        if law.acts_on_both_sides() {
            let port = &mut self.ports[p];
            port.impact_velocity_m_s = port.impact_velocity_m_s.max(port.rate_m_s.abs());
        } else if self.has_left(p, step.table.length_s) {
            let port = &mut self.ports[p];
            port.penetration_m = port.penetration_m.min(0.0);
            port.contact_state = ContactState::Flight;
        }
    }

    /// True where a point is off its stop, or on its surface within roundoff and moves out;
    /// `length_s` is the length of its last step.
    #[inline(always)]
    fn has_left(&self, p: usize, length_s: f64) -> bool {
        let port = &self.ports[p];
        let leaves_next = port.penetration_m < -port.rate_m_s * length_s;
        port.penetration_m < 0.0 || leaves_next && port.penetration_m <= self.distance_roundoff_m(p)
    }

    /// Adds the step to the statistics.
    #[inline(always)]
    fn observe<W: Simd, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        step: &ContactStep,
        solved: &SolvedStep,
        started: (f64, f64),
    ) {
        let (length_s, weights) = (step.table.length_s, &step.basis.weights);
        let port = &mut self.ports[step.port];
        let (end_m, end_m_s) = (port.penetration_m, port.rate_m_s);
        let has_separated = !law.acts_on_both_sides() && end_m < 0.0;
        let since_s = if has_separated {
            let start = [started.0, started.1 * length_s];
            length_s * (1.0 - separation(start, &step.basis.positions, &solved.penetration))
        } else {
            0.0
        };
        port.stay(length_s - since_s);
        let statistics = &mut port.statistics;
        // With two sides, the side of this step.
        let side = if law.acts_on_both_sides() {
            (started.0 + end_m).signum()
        } else {
            1.0
        };
        let depth = w.mul(w.splat(side), w.load(&solved.penetration));
        let highest = w.largest(depth).max(side * started.0);
        if highest > NEAR_PEAK * statistics.max_penetration_m {
            let turns =
                step.shape == ForceBasis::Smooth && side * started.1 > 0.0 && side * end_m_s < 0.0;
            let peak = if turns {
                interpolated_peak(side * started.0, &w.store(depth))
            } else {
                highest
            };
            if peak > statistics.max_penetration_m {
                statistics.max_penetration_m = peak;
                if !law.is_rate_dependent() {
                    statistics.max_force_n = statistics
                        .max_force_n
                        .max(law.force_n(side * peak, 0.0).abs());
                }
            }
        }
        if law.is_rate_dependent() {
            let start_n = law.force_n(started.0, started.1);
            let highest_n = w.largest(w.load(&solved.force)).max(start_n);
            if highest_n > NEAR_PEAK * statistics.max_force_n {
                let peak_n = if step.shape == ForceBasis::Smooth {
                    interpolated_peak(start_n, &solved.force)
                } else {
                    highest_n
                };
                statistics.max_force_n = statistics.max_force_n.max(peak_n);
            }
            // Work done on the stop minus its stored energy: the elastic force itself has a kink
            // where a contact with loss is left.
            let work: f64 = (0..NODES)
                .map(|j| length_s * weights.0[j] * solved.force.0[j] * solved.rate.0[j])
                .sum();
            self.integrals.loss_j += work + law.energy_j(started.0) - law.energy_j(end_m);
        }
    }

    /// Adds the effect of the nodal forces of a step, last lane 0, to the state at its end.
    #[inline(always)]
    pub(crate) fn push_on<W: Simd>(
        &self,
        w: W,
        step: &ContactStep,
        force: &F64x8,
        trial: &mut TrialState,
    ) {
        let column = &self.kernel.vectors[step.port].column;
        step.table
            .duhamel
            .act(w, column, force, &mut trial.y, &mut trial.from_start);
    }

    /// Adds the nodal forces of a step to the integrals that the energy meters need.
    #[inline(always)]
    fn integrate_force<W: Simd>(
        &mut self,
        w: W,
        step: &ContactStep,
        force: &F64x8,
        from_start: &[F64x8],
    ) {
        let (table, basis, p) = (step.table, step.basis, step.port);
        let vectors = &self.kernel.vectors[p];
        let spread = spread(w, force);
        let motion = (from_start, self.y.as_slice());
        for ((sum, row), push) in self
            .integrals
            .loads_j
            .iter_mut()
            .zip(&vectors.loads)
            .zip(&table.loads)
        {
            *sum += metered_j(
                w,
                row,
                motion,
                add_spread_response(w, w.zero(), push, &spread),
                force,
            );
        }
        let response = add_spread_response(w, w.zero(), &table.damping, &spread);
        self.integrals.damping_j += metered_j(w, &vectors.damping, motion, response, force);
        let weighted = w.mul(
            w.mul(w.splat(table.length_s), w.load(&basis.weights)),
            w.load(force),
        );
        self.ports[p].statistics.impulse_n_s += w.sum(weighted);
        let when = (self.time_s, table.length_s);
        self.excitation
            .push(p, &basis.positions, when, &w.store(weighted));
        for (sum, tone) in self.integrals.tones_n_s[p].iter_mut().zip(&self.tones) {
            let (cos, sin) = (
                w.mul(weighted, w.load(&tone.samples[p].cos)),
                w.mul(weighted, w.load(&tone.samples[p].sin)),
            );
            *sum += tone.turn * c64::new(w.sum(cos), w.sum(sin));
        }
    }
}

/// Returns the meter reading of the nodal forces of a step: `integral f (row . y) dt` over the free
/// motion and over the motion that they cause.
#[inline(always)]
fn metered_j<W: Simd>(
    w: W,
    row: &FlowRow,
    (from_start, y): (&[F64x8], &[F64x8]),
    response: W::Register,
    force: &F64x8,
) -> f64 {
    w.sum(w.fma(response, w.load(force), row.read(w, from_start, y)))
}

/// Returns the nodal forces with 0 in the lane of the end of the step.
#[inline(always)]
pub(crate) fn nodal(force: &F64x8) -> F64x8 {
    let mut force = *force;
    force.0[NODES] = 0.0;
    force
}
