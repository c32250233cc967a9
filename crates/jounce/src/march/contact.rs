//! The way through a contact: which step comes next, and whether it is good enough.
//!
//! The first step has the onset basis, the others are smooth, each as long as its error allows. The force ends like `t^1.5`, which no
//! polynomial follows, so the last steps shorten towards the end of the contact: on a step of length `L` that begins a time `d`
//! before it, the error of the interpolation falls like `rho^-7` with the number of nodes, where `rho + 1/rho = 4 d / L - 2`
//! (Bernstein's ellipse through the singularity). The estimate of [`Step`] goes with its power 3/2.

use super::basis::NODES;
use super::contact_step::{Solved, Step};
use super::error::MarchError;
use super::kernel::{Kernel, Shape};
use super::marcher::{Marcher, Regime};
use crate::contact::ContactLaw;
use crate::wide::Wide;

/// Share of the tolerance that one step may spend on the error of its impulse.
const IMPULSE_SHARE: f64 = 0.1;

/// Factor on the error of a step for twice its length; its power of the length is 8 to 11.
const ERROR_PER_LEVEL: f64 = 500.0;

/// Most levels to go up at once.
const MOST_SPARE: i32 = 3;

/// How much smaller the error is than the power of `rho` says, for an end like `t^1.5`.
const END_GAIN: f64 = 1000.0;

/// Lengths of a step before the end of the contact beyond which the end does not matter: the power of `rho` is above 1e8 there.
const FAR: f64 = 2.0;

impl Step<'_> {
    /// Time from the last node to the end, s.
    fn last_gap_s(&self) -> f64 {
        self.table.length_s * (1.0 - self.basis.places[NODES - 1])
    }
}

impl Solved {
    /// Can be trusted beside its error estimate.
    fn is_sound(&self, shape: Shape, is_short: bool) -> bool {
        match shape {
            Shape::Onset => self.rises(),
            Shape::Smooth => is_short || !self.mostly_free(),
        }
    }

    /// Leaves the stop before its middle: what comes after is flight, and another contact might hide in it.
    fn mostly_free(&self) -> bool {
        self.penetration.0[NODES] < 0.0 && self.penetration.0[NODES / 2] < 0.0
    }

    /// Still going deeper at its end.
    fn rises(&self) -> bool {
        self.penetration.0[NODES] > self.penetration.0[NODES - 1]
    }

    /// Speed at its end, m/s, by the last node.
    fn last_speed_m_s(&self, step: &Step) -> f64 {
        (self.penetration.0[NODES] - self.penetration.0[NODES - 1]) / step.last_gap_s()
    }
}

impl Marcher<'_> {
    /// Stays in contact until the point leaves the stop or the end is reached.
    #[inline(always)]
    pub(super) fn contact<W: Wide, L: ContactLaw>(&mut self, w: W, law: L, end_s: f64) -> Result<(), MarchError> {
        let kernel = self.kernel;
        // Where the motion never leaves the law, no flight carries the fast modes: steps must resolve a disturbance of them, which the
        // motion itself need not show but its derivative does.
        let coarsest = if L::BOTH_SIDES { Kernel::level_within(1.0 / kernel.fastest_rad_s) } else { Kernel::coarsest() };
        let mut level = self.entry_level.max(coarsest);
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / kernel.fastest_rad_s) + 3;
        let mut entering = !L::BOTH_SIDES && self.penetration_m <= 0.0;
        while self.time_s < end_s && self.regime == Regime::Contact {
            let remaining_s = self.forced.remaining_s(self.time_s, end_s);
            let shape = if entering { kernel.first_shape(0) } else { Shape::Smooth };
            let landing = Kernel::length_s(level) >= remaining_s;
            let odd;
            let table = if landing {
                odd = self.odd_tables.of(kernel, shape, remaining_s);
                &odd
            } else {
                kernel.table(0, shape, level)
            };
            let step = self.step_in_contact::<W, L>(w, table, shape, level, landing);
            let solved = self.solve(w, law, &step);
            let allowed = self.allowed_n_s::<L>(&step, solved.as_ref());
            let is_sound = |solved: &Solved| L::BOTH_SIDES || solved.is_sound(shape, level >= safe);
            let accepted = solved.filter(|solved| solved.error_n_s <= allowed && is_sound(solved));
            match accepted {
                Some(solved) => {
                    self.take(w, law, &step, &solved);
                    if landing {
                        self.time_s = end_s;
                    }
                    let longer = level - levels_to_spare(solved.error_n_s, allowed);
                    if entering {
                        self.entry_level = longer;
                        entering = false;
                    }
                    // The error of the onset basis says nothing about the next step.
                    level = if shape == Shape::Onset { level } else { longer };
                    if L::BOTH_SIDES {
                        // Nothing is left or entered: the next call goes on where this one stopped.
                        self.entry_level = if landing { self.entry_level } else { level };
                    } else {
                        level = self.before_leaving(level, &step, &solved, allowed);
                    }
                    level = level.max(coarsest);
                }
                None => {
                    self.work.contact_rejections += 1;
                    level = if landing { Kernel::level_within(remaining_s) + 1 } else { level + 1 };
                    if level > Kernel::finest() {
                        return Err(self.diverged());
                    }
                }
            }
        }
        Ok(())
    }

    /// Error of an impulse that one step may make, N s.
    #[inline(always)]
    fn allowed_n_s<L: ContactLaw>(&self, step: &Step, solved: Option<&Solved>) -> f64 {
        let mut speed_m_s = self.strike_m_s.max(self.rate_m_s.abs());
        if let (true, Some(solved)) = (L::BOTH_SIDES, solved) {
            // Nothing strikes: a march that starts at rest has no other scale than the speed that it takes up.
            speed_m_s = speed_m_s.max((solved.penetration.0[NODES] - self.penetration_m).abs() / step.table.length_s);
        }
        self.tolerance * IMPULSE_SHARE * speed_m_s / self.rows.mobility_per_kg
    }

    /// The level wanted, or a finer one that respects the end of the contact as it is foretold now.
    #[inline(always)]
    fn before_leaving(&self, wanted: i32, step: &Step, solved: &Solved, allowed: f64) -> i32 {
        let Some(leaving_s) = self.foretold_leaving_s(step, solved) else { return wanted };
        if leaving_s >= FAR * Kernel::length_s(wanted) {
            return wanted;
        }
        let left_n_s = leaving_s * solved.force.0[NODES - 1];
        // What is left of the impulse may be too small to matter: then one step carries the point past the surface.
        if 2.0 * left_n_s <= allowed {
            return wanted.max(Kernel::level_within(2.0 * leaving_s));
        }
        let level = Kernel::level_within(leaving_s);
        let is_enough = ellipse_power(leaving_s / Kernel::length_s(level)) * END_GAIN * allowed >= left_n_s;
        wanted.max(if is_enough { level } else { level + 1 })
    }

    /// Time until the penetration ends, by the parabola through the last speeds of a step.
    #[inline(always)]
    fn foretold_leaving_s(&self, step: &Step, solved: &Solved) -> Option<f64> {
        if self.rate_m_s >= 0.0 || self.penetration_m <= 0.0 {
            return None;
        }
        let curvature = (self.rate_m_s - solved.last_speed_m_s(step)) / step.last_gap_s();
        let discriminant = self.rate_m_s * self.rate_m_s - 4.0 * curvature * self.penetration_m;
        let leaving_s = 2.0 * self.penetration_m / (-self.rate_m_s + discriminant.max(0.0).sqrt());
        (discriminant >= 0.0).then_some(leaving_s)
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

/// `rho^10.5` for a step whose length goes `ratio` times into the time to the end of the contact.
#[inline(always)]
fn ellipse_power(ratio: f64) -> f64 {
    let z = 2.0 * ratio - 1.0;
    let rho = z + (z * z - 1.0).max(0.0).sqrt();
    let fourth = (rho * rho) * (rho * rho);
    fourth * fourth * (rho * rho) * rho.sqrt()
}

/// Levels by which a step might have been longer.
#[inline(always)]
fn levels_to_spare(error: f64, allowed: f64) -> i32 {
    let (mut error, mut spare) = (error.max(f64::MIN_POSITIVE) * ERROR_PER_LEVEL, 0);
    while error < allowed && spare < MOST_SPARE {
        (error, spare) = (error * ERROR_PER_LEVEL, spare + 1);
    }
    spare
}
