//! Acceptance of a joint step: state, statistics, energies, record.

use crate::contact::nodal;
use crate::contact::step::{ContactStep, SolvedStep};
use crate::flow::state::add_force_response;
use crate::force_response::basis::NODES;
use crate::integrator::{Integrator, TrialState};
use crate::ports::small_list::SmallList;
use crate::ports::state::ContactState;
use crate::record::trajectory::PortForce;
use crate::tables::joint::{JointTables, StepLength};
use jounce_model::contact::Law;
use jounce_simd::{F64x8, Simd};

impl Integrator<'_> {
    /// Accepts a solved step, given the free motion to its end; the tables hold the effects of
    /// several ports on each other.
    #[inline(always)]
    pub(super) fn accept_joint_step<W: Simd>(
        &mut self,
        w: W,
        length: StepLength,
        steps: &[ContactStep],
        solved: &[SolvedStep],
        tables: Option<&JointTables>,
        trial: &mut TrialState,
    ) {
        w.out_of_line(
            #[inline(always)]
            || {
                let forces: SmallList<F64x8> = solved
                    .iter()
                    .map(|solution| nodal(&solution.force))
                    .collect();
                if self.record.is_some() {
                    let noted: SmallList<PortForce> = steps
                        .iter()
                        .zip(&forces)
                        .map(|(step, force)| PortForce::new(step, force))
                        .collect();
                    self.note(length.seconds(), &noted);
                }
                for (step, force) in steps.iter().zip(&forces) {
                    self.apply_force(w, step, force, trial);
                }
                if let Some(tables) = tables {
                    self.integrate_crossed(w, tables, &forces);
                }
                self.end_contact_step(w, &steps[0], trial);
                for p in 0..self.kernel.plant.ports.len() {
                    if self.ports[p].contact_state == ContactState::Flight
                        && !self.ports[p].clearance.is_unseen
                    {
                        self.update_port(w, p);
                    }
                }
                self.update_ports_in_contact(w, length.level, steps, solved);
            },
        );
    }

    /// Sets every port in contact to the end of the step.
    #[inline(always)]
    fn update_ports_in_contact<W: Simd>(
        &mut self,
        w: W,
        level: i32,
        steps: &[ContactStep],
        solved: &[SolvedStep],
    ) {
        let allowed = self.allowed_with_others_n_s(steps, solved);
        for (step, solution) in steps.iter().zip(solved) {
            let p = step.port;
            if let Law::Rigid(_) = self.law(p) {
                self.update_port(w, p);
                self.observe_rest(p, step.table.length_s, &solution.force);
                self.reset_onto_stop(p);
                self.ports[p].level = self.next_level_sticking(level, step, solution, allowed);
                continue;
            }
            self.update_port_in_contact(w, self.law(p), step, solution);
            let entering = std::mem::take(&mut self.ports[p].entering);
            self.ports[p].level =
                self.next_level(self.law(p), level, step, solution, (allowed, entering));
        }
    }

    /// Adds the work of the force of each port on the motion caused by the forces of the others.
    #[inline(always)]
    fn integrate_crossed<W: Simd>(&mut self, w: W, tables: &JointTables, forces: &[F64x8]) {
        for (from, force) in forces.iter().enumerate() {
            for (to, force_there) in forces.iter().enumerate() {
                if from == to {
                    continue;
                }
                let cross = tables.cross(from, to);
                for (sum, load) in self.integrals.loads_j.iter_mut().zip(&cross.loads) {
                    *sum += work(w, load, force, force_there);
                }
                self.integrals.damping_j += work(w, &cross.damping, force, force_there);
            }
        }
    }
}

/// Returns `force_there . (push force)`.
#[inline(always)]
fn work<W: Simd>(w: W, push: &[F64x8; NODES], force: &F64x8, force_there: &F64x8) -> f64 {
    w.sum(w.mul(
        add_force_response(w, w.zero(), push, force),
        w.load(force_there),
    ))
}
