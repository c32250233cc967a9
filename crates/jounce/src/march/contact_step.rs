//! Contact: collocation of the scalar contact force, step by step, until the point leaves the stop.
//!
//! On a step the penetration at the nodes is `delta = free + D f` with the Duhamel weights `D` of the table, and the force is
//! `f = F(delta, delta')`. `D` is a twofold integration, so the fixed point converges factorially. The force of a Hertz contact
//! starts and ends like `t^1.5`; steps shorten towards both ends by themselves, because the polynomial through the nodes must
//! meet the law at the two ends of the step as well, where it is not made to.

use super::collocation::{COLLOCATION, NODES};
use super::kernel::{Kernel, Layout};
use super::lane::{Lane, WIDTH};
use super::marcher::{MarchError, Marcher, Regime};
use super::peak::interpolated_peak;
use super::state::{add_push, columns, flow, pushed};
use super::table::{Response, Table};
use crate::contact::ContactLaw;
use faer::c64;

/// Most fixed-point iterations of a step; beyond, a shorter step is cheaper.
const MOST_ITERATIONS: u32 = 24;

/// Share of the tolerance that one contact may spend on the error of its impulse.
const IMPULSE_SHARE: f64 = 0.1;

/// A step as solved: nodal penetrations, rates and forces (last place: end of the step).
struct Solved {
    penetration: Lane,
    rate: Lane,
    force: Lane,
    /// Estimated error of the impulse, N s.
    error_n_s: f64,
}

impl Solved {
    /// Leaves the stop before its middle: what comes after is flight, and another contact might hide in it.
    fn mostly_free(&self) -> bool {
        self.penetration.0[NODES] < 0.0 && self.penetration.0[NODES / 2] < 0.0
    }
}

/// The drive over a step: `cos` and `sin` of `w tau` per tone.
type Drive<'a> = &'a [(Lane, Lane)];

impl Marcher<'_> {
    /// Stays in contact until the point leaves the stop or the end is reached.
    #[inline(always)]
    pub(super) fn contact<L: ContactLaw, const FMA: bool>(&mut self, law: L, end_s: f64) -> Result<(), MarchError> {
        let kernel = self.kernel;
        let mut level = self.entry_level;
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / kernel.plant.fastest_rad_s().max(f64::MIN_POSITIVE)) + 3;
        let mut entering = self.penetration_m <= 0.0;
        let mut drive: Vec<(Lane, Lane)> = Vec::with_capacity(self.tones.len());
        let mut odd: Option<Box<Table>> = None;
        while self.time_s < end_s && self.regime == Regime::Contact {
            let remaining = end_s - self.time_s;
            drive.clear();
            let landing = Kernel::length_s(level) >= remaining;
            let table = if landing {
                drive.extend(self.tones.iter().map(|tone| tone.over(remaining)));
                &**odd.insert(Box::new(Table::new(kernel, 0, remaining)))
            } else {
                drive.extend(self.tones.iter_mut().map(|tone| tone.level(level)));
                kernel.table(0, level)
            };
            let allowed = self.tolerance * IMPULSE_SHARE * self.strike_m_s.max(self.rate_m_s.abs()) / self.rows.mobility_per_kg;
            match self.solve::<L, FMA>(law, table, &drive) {
                Some(solved) if solved.error_n_s <= allowed && (level >= safe || !solved.mostly_free()) => {
                    self.take::<L, FMA>(law, table, &drive, &solved);
                    if landing {
                        self.time_s = end_s;
                    }
                    if entering {
                        self.entry_level = if solved.error_n_s < 0.05 * allowed { level - 1 } else { level };
                        entering = false;
                    }
                    level = self.next_level(level, &solved, allowed, table.length_s);
                }
                _ => {
                    self.work.contact_rejections += 1;
                    level = if landing { Kernel::level_within(remaining) + 1 } else { level + 1 };
                    if level > Kernel::finest() {
                        return Err(self.diverged());
                    }
                }
            }
        }
        Ok(())
    }

    /// Solves one step for its nodal forces; `None` when the fixed point does not converge.
    #[inline(always)]
    fn solve<L: ContactLaw, const FMA: bool>(&mut self, law: L, table: &Table, drive: Drive) -> Option<Solved> {
        let mut free = columns::<FMA>(&self.layout, &self.y, &table.displacement.columns);
        let mut free_rate = Lane::ZERO;
        if L::RATE_DEPENDENT {
            free_rate = columns::<FMA>(&self.layout, &self.y, &table.velocity.columns);
        }
        for (tone, (cos, sin)) in self.tones.iter().zip(drive) {
            let z = tone.displacement_m * tone.turn;
            free = free.add_scaled::<FMA>(z.re, cos).add_scaled::<FMA>(-z.im, sin);
            if L::RATE_DEPENDENT {
                let speed = z * c64::new(0.0, tone.angular_frequency_rad_s);
                free_rate = free_rate.add_scaled::<FMA>(speed.re, cos).add_scaled::<FMA>(-speed.im, sin);
            }
        }
        free = free.add(&Lane::splat(-self.rows.gap_m));
        let at_start = law.force_n(self.penetration_m, self.rate_m_s);
        let mut penetration = free.add_scaled::<FMA>(at_start, &table.displacement.push_sum);
        let mut rate = free_rate.add_scaled::<FMA>(at_start, &table.velocity.push_sum);
        let mut force = law_of(law, &penetration, &rate);
        let goal = (0.1 * self.tolerance).clamp(4e-15, 1e-5);
        let mut last_change = f64::INFINITY;
        for iteration in 1..=MOST_ITERATIONS {
            self.work.iterations += 1;
            penetration = pushed::<FMA>(free, &table.displacement.push, &force);
            if L::RATE_DEPENDENT {
                rate = pushed::<FMA>(free_rate, &table.velocity.push, &force);
            }
            let new = law_of(law, &penetration, &rate);
            let mut change = Lane::ZERO;
            for i in 0..NODES {
                change.0[i] = new.0[i] - force.0[i];
            }
            let (change, size) = (change.max_abs(), new.max_abs());
            force = new;
            // The contraction seen so far bounds what is still to come.
            let contraction = if iteration == 1 { 1.0 } else { (change / last_change).min(1.0) };
            if change * contraction <= goal * size {
                return Some(self.judge(law, table, penetration, rate, force, at_start));
            }
            if iteration > 4 && change > last_change {
                return None;
            }
            last_change = change;
        }
        None
    }

    /// Estimates the error of a converged step from the mismatch of polynomial and law at both of its ends.
    #[inline(always)]
    fn judge<L: ContactLaw>(&self, law: L, table: &Table, penetration: Lane, rate: Lane, force: Lane, at_start: f64) -> Solved {
        let c = &*COLLOCATION;
        let (mut start, mut end, mut size) = (0.0, 0.0, 0.0_f64);
        for j in 0..NODES {
            start += c.at_start[j] * force.0[j];
            end += c.at_end[j] * force.0[j];
            size = size.max(force.0[j]);
        }
        let at_end = law.force_n(penetration.0[NODES], rate.0[NODES]);
        let mismatch = (start - at_start).abs().max((end - at_end).abs());
        // Gauss weights square the order of the interpolation for smooth forces and gain less at a kink: 3/2 lies between.
        let ratio = if size > 0.0 { mismatch / size } else { 0.0 };
        let error_n_s = table.length_s * mismatch * ratio.sqrt().min(1.0);
        Solved { penetration, rate, force, error_n_s }
    }

    /// Takes a solved step.
    #[inline(always)]
    fn take<L: ContactLaw, const FMA: bool>(&mut self, law: L, table: &Table, drive: Drive, solved: &Solved) {
        let mut force = solved.force;
        force.0[WIDTH - 1] = 0.0;
        if self.record.is_some() {
            self.note(table.length_s, Some(std::array::from_fn(|j| force.0[j])));
        }
        self.integrate::<L, FMA>(law, table, solved, &force);
        flow::<FMA>(&self.layout, &self.y, table, &mut self.next);
        add_push::<FMA>(table, &force, &mut self.next);
        std::mem::swap(&mut self.y, &mut self.next);
        let started = (self.penetration_m, self.rate_m_s);
        self.time_s += table.length_s;
        for (tone, (cos, sin)) in self.tones.iter_mut().zip(drive) {
            tone.turn *= c64::new(cos.0[WIDTH - 1], sin.0[WIDTH - 1]);
        }
        self.see::<FMA>();
        let statistics = &mut self.statistics;
        let highest = solved.penetration.0.iter().fold(started.0, |max, p| max.max(*p));
        if highest > 0.98 * statistics.max_penetration_m {
            let peak = if started.1 > 0.0 && self.rate_m_s < 0.0 { interpolated_peak(started.0, &solved.penetration) } else { highest };
            statistics.max_penetration_m = statistics.max_penetration_m.max(peak);
        }
        let strongest = if L::RATE_DEPENDENT { solved.force.max_abs() } else { law.force_n(statistics.max_penetration_m, 0.0) };
        statistics.max_force_n = statistics.max_force_n.max(strongest);
        self.work.contact_steps += 1;
        if self.penetration_m < 0.0 {
            self.regime = Regime::Flight;
        }
    }

    /// Adds the step to the contact integrals.
    #[inline(always)]
    fn integrate<L: ContactLaw, const FMA: bool>(&mut self, law: L, table: &Table, solved: &Solved, force: &Lane) {
        let c = &*COLLOCATION;
        self.integrate_force::<FMA>(table, force);
        let statistics = &mut self.statistics;
        // A step on whose end the point has left the stop counts for the share of its nodes in contact.
        for j in 0..NODES {
            if solved.penetration.0[j] > 0.0 {
                statistics.time_s += table.length_s * c.weights[j];
            }
        }
        if L::RATE_DEPENDENT {
            // Work done on the stop less what it stores: the elastic force itself has a kink where a spent contact is left.
            let work: f64 = (0..NODES).map(|j| table.length_s * c.weights[j] * force.0[j] * solved.rate.0[j]).sum();
            self.integrals.loss_j += work + law.energy_j(self.penetration_m) - law.energy_j(solved.penetration.0[NODES]);
        }
    }

    /// Adds the nodal forces of a step to the integrals that the energy meters need.
    #[inline(always)]
    pub(super) fn integrate_force<const FMA: bool>(&mut self, table: &Table, force: &Lane) {
        let c = &*COLLOCATION;
        for (sum, response) in self.integrals.loads_j.iter_mut().zip(&table.loads) {
            *sum += bilinear::<FMA>(&self.layout, &self.y, response, force);
        }
        self.integrals.damping_j += bilinear::<FMA>(&self.layout, &self.y, &table.damping, force);
        let mut weighted = Lane::ZERO;
        for j in 0..NODES {
            weighted.0[j] = table.length_s * c.weights[j] * force.0[j];
        }
        for (sum, tone) in self.integrals.tones_n_s.iter_mut().zip(&mut self.tones) {
            let (cos, sin) = tone.for_length(table.length_s);
            let turned =
                c64::new(Lane::ZERO.add_product::<FMA>(&weighted, &cos).sum(), Lane::ZERO.add_product::<FMA>(&weighted, &sin).sum());
            *sum += tone.turn * turned;
        }
        self.statistics.impulse_n_s += weighted.sum();
    }

    /// Length of the step to come: longer while the error is small, shorter as the end of the contact comes near.
    #[inline(always)]
    fn next_level(&self, level: i32, solved: &Solved, allowed: f64, length_s: f64) -> i32 {
        let mut next = level;
        if solved.error_n_s < 0.1 * allowed {
            next -= 1;
        }
        if self.rate_m_s < 0.0 && self.penetration_m > 0.0 {
            // Time to the stop's surface by the parabola through the last speeds.
            let before = solved.penetration.0[NODES - 1];
            let gap = length_s * (1.0 - COLLOCATION.nodes[NODES - 1]);
            let chord = (self.penetration_m - before) / gap;
            let curvature = (self.rate_m_s - chord) / gap;
            let discriminant = self.rate_m_s * self.rate_m_s - 4.0 * curvature * self.penetration_m;
            if discriminant >= 0.0 {
                let leaving_s = 2.0 * self.penetration_m / (-self.rate_m_s + discriminant.sqrt());
                // What is left of the impulse may be too small to matter: then one step carries the point past the surface.
                let negligible = 2.0 * leaving_s * solved.force.0[NODES - 1] <= allowed;
                let within_s = if negligible { 2.0 * leaving_s } else { 0.6 * leaving_s };
                next = next.max(Kernel::level_within(within_s)).min(level + 12);
            }
        }
        next.max(Kernel::coarsest())
    }

    fn diverged(&self) -> MarchError {
        MarchError::ContactDiverged {
            time_s: self.time_s,
            stop: self.kernel.plant.system.stops[0].name.clone(),
            step_s: Kernel::length_s(Kernel::finest()),
            penetration_m: self.penetration_m,
        }
    }
}

/// `integral f (row . y) dt` over a step.
#[inline(always)]
fn bilinear<const FMA: bool>(layout: &Layout, y: &[Lane], response: &Response, force: &Lane) -> f64 {
    let row = pushed::<FMA>(columns::<FMA>(layout, y, &response.columns), &response.push, force);
    Lane::ZERO.add_product::<FMA>(&row, force).sum()
}

#[inline(always)]
fn law_of<L: ContactLaw>(law: L, penetration: &Lane, rate: &Lane) -> Lane {
    Lane(law.forces_n(&penetration.0, &rate.0))
}
