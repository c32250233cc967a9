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
use super::level::PER_OCTAVE;
use super::marcher::Marcher;
use super::port_state::{PortState, Regime};
use crate::contact::ContactLaw;
use crate::wide::Wide;

/// Share of the tolerance that one step may spend on the error of its impulse.
pub(super) const IMPULSE_SHARE: f64 = 0.1;

/// Share of that which the first step of a contact may spend: its estimate sees the end of the step alone, and what it misses acts on
/// all that follows. With this share the mean power of a run is ten times nearer to its limit for 5 % more steps.
const ONSET_SHARE: f64 = 0.01;

/// Factors on the error of a step for 1.5 times its length, and from there to twice its length; its power of the length is 8 to 11.
const ERROR_PER_LEVEL: [f64; 2] = [38.0, 13.0];

/// Most levels to go up at once.
const MOST_SPARE: i32 = 3 * PER_OCTAVE;

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
    /// Time integral of the magnitude of the force, N s.
    #[inline(always)]
    fn size_n_s<W: Wide>(&self, w: W, step: &Step) -> f64 {
        step.table.length_s * w.sum(w.mul(w.load(&step.basis.weights), w.abs(w.load(&self.force))))
    }

    /// Can be trusted beside its error estimate.
    pub(super) fn is_sound(&self, shape: Shape, is_short: bool) -> bool {
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
    /// The only port stays in contact until it leaves its stop or the end is reached.
    #[inline(always)]
    pub(super) fn contact<W: Wide, L: ContactLaw>(&mut self, w: W, law: L, end_s: f64) -> Result<(), MarchError> {
        let port = &self.ports[0];
        let start = (port.entry_level, !law.acts_on_both_sides() && port.penetration_m <= 0.0);
        self.stay(w, law, (0, false), start, end_s)?;
        Ok(())
    }

    /// A port stays in contact until it leaves its stop or the end is reached; beside others, also until one of these has to be watched
    /// or the end is near. Starts with a step of a level, which enters the contact or does not, and says the same of the next one.
    #[inline(always)]
    pub(super) fn stay<W: Wide, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        (p, beside_others): (usize, bool),
        (level, mut entering): (i32, bool),
        end_s: f64,
    ) -> Result<(i32, bool), MarchError> {
        let kernel = self.kernel;
        let both_sides = law.acts_on_both_sides();
        let mut level = level.max(coarsest(law, kernel));
        // On steps this short no second contact can follow the first.
        let safe = Kernel::level_within(1.0 / kernel.fastest_rad_s) + 3 * PER_OCTAVE;
        while self.time_s < end_s && self.ports[p].regime == Regime::Contact {
            let remaining_s = self.forced.remaining_s(self.time_s, end_s);
            let shape = if entering { kernel.first_shape(p) } else { Shape::Smooth };
            let landing = Kernel::length_s(level) >= remaining_s;
            if beside_others && (landing || !self.all_stay_clear(w, Kernel::length_s(level), (p, 0.0))) {
                break;
            }
            let odd;
            let table = if landing {
                odd = self.odd_tables.of(kernel, shape, remaining_s);
                &odd
            } else {
                kernel.table(p, shape, level)
            };
            let step = self.step_in_contact(w, law, (table, p), shape, level, landing);
            let solved = self.solve(w, law, &step);
            let allowed = self.allowed_n_s(law, &step, solved.as_ref());
            let is_sound = |solved: &Solved| both_sides || solved.is_sound(shape, level >= safe);
            let accepted = solved.filter(|solved| solved.error_n_s <= share(shape) * allowed && is_sound(solved));
            match accepted {
                Some(solved) => {
                    if beside_others && !self.all_stay_clear(w, table.length_s, (p, solved.size_n_s(w, &step))) {
                        break;
                    }
                    self.take(w, law, &step, &solved);
                    if landing {
                        self.time_s = end_s;
                    }
                    // Where nothing is left or entered, the next call goes on at the level at which this one stopped.
                    let starts_next = entering || (both_sides && !landing);
                    level = self.next_level(law, level, &step, &solved, (allowed, starts_next));
                    entering = false;
                }
                None => {
                    self.work.contact_rejections += 1;
                    level = if landing { Kernel::level_within(remaining_s) + 1 } else { level + PER_OCTAVE };
                    if level > Kernel::finest() {
                        return Err(self.diverged(p));
                    }
                }
            }
        }
        Ok((level, entering))
    }

    /// Error of the impulse of a port that one step may make, N s.
    #[inline(always)]
    pub(super) fn allowed_n_s<L: ContactLaw>(&self, law: L, step: &Step, solved: Option<&Solved>) -> f64 {
        let port = &self.ports[step.port];
        let mut speed_m_s = port.strike_m_s.max(port.rate_m_s.abs());
        if let (true, Some(solved)) = (law.acts_on_both_sides(), solved) {
            // Nothing strikes: a march that starts at rest has no other scale than the speed that it takes up.
            speed_m_s = speed_m_s.max((solved.penetration.0[NODES] - port.penetration_m).abs() / step.table.length_s);
        }
        self.tolerance * IMPULSE_SHARE * speed_m_s / port.rows.mobility_per_kg
    }

    /// Level wanted of the step after one of `level` that has been taken; `starts_next` says that the next contact starts at it too.
    #[inline(always)]
    pub(super) fn next_level<L: ContactLaw>(
        &mut self,
        law: L,
        level: i32,
        step: &Step,
        solved: &Solved,
        (allowed, starts_next): (f64, bool),
    ) -> i32 {
        let longer = level - levels_to_spare(level, solved.error_n_s, share(step.shape) * allowed);
        if starts_next {
            self.ports[step.port].entry_level = longer;
        }
        // The error of the onset basis says nothing about the next step.
        let level = if step.shape == Shape::Onset { level } else { longer };
        let level = if law.acts_on_both_sides() { level } else { self.before_leaving(level, step, solved, allowed) };
        level.max(coarsest(law, self.kernel))
    }

    /// The level wanted, or a finer one that respects the end of the contact as it is foretold now.
    #[inline(always)]
    fn before_leaving(&self, wanted: i32, step: &Step, solved: &Solved, allowed: f64) -> i32 {
        let Some(leaving_s) = foretold_leaving_s(&self.ports[step.port], step, solved) else { return wanted };
        if leaving_s >= FAR * Kernel::length_s(wanted) {
            return wanted;
        }
        let left_n_s = leaving_s * solved.force.0[NODES - 1];
        // What is left of the impulse may be too small to matter: then one step carries the point past the surface.
        if 2.0 * left_n_s <= allowed {
            return wanted.max(Kernel::level_within(2.0 * leaving_s));
        }
        let whole = Kernel::level_within(leaving_s);
        let is_enough = |level: &i32| ellipse_power(leaving_s / Kernel::length_s(*level)) * END_GAIN * allowed >= left_n_s;
        wanted.max((whole..whole + PER_OCTAVE).find(is_enough).unwrap_or(whole + PER_OCTAVE))
    }

    pub(super) fn diverged(&self, p: usize) -> MarchError {
        MarchError::ContactDiverged {
            time_s: self.time_s,
            stop: self.kernel.plant.system.stops[p].name.clone(),
            step_s: Kernel::length_s(Kernel::finest()),
            penetration_m: self.ports[p].penetration_m,
        }
    }
}

/// Share of the allowed error that a step may spend.
#[inline(always)]
pub(super) fn share(shape: Shape) -> f64 {
    match shape {
        Shape::Onset => ONSET_SHARE,
        Shape::Smooth => 1.0,
    }
}

/// Coarsest level of a contact step. Where the motion never leaves the law, no flight carries the fast modes: steps must resolve a
/// disturbance of them, which the motion itself need not show but its derivative does.
#[inline(always)]
fn coarsest<L: ContactLaw>(law: L, kernel: &Kernel) -> i32 {
    if law.acts_on_both_sides() { Kernel::level_within(1.0 / kernel.fastest_rad_s) } else { Kernel::coarsest() }
}

/// Time until the penetration ends, by the parabola through the last speeds of a step.
#[inline(always)]
fn foretold_leaving_s(port: &PortState, step: &Step, solved: &Solved) -> Option<f64> {
    if port.rate_m_s >= 0.0 || port.penetration_m <= 0.0 {
        return None;
    }
    let curvature = (port.rate_m_s - solved.last_speed_m_s(step)) / step.last_gap_s();
    let discriminant = port.rate_m_s * port.rate_m_s - 4.0 * curvature * port.penetration_m;
    let leaving_s = 2.0 * port.penetration_m / (-port.rate_m_s + discriminant.max(0.0).sqrt());
    (discriminant >= 0.0).then_some(leaving_s)
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
fn levels_to_spare(level: i32, error: f64, allowed: f64) -> i32 {
    let mut spare = 0;
    let factor = |spare: i32| ERROR_PER_LEVEL[((level - spare) & 1) as usize];
    let mut longer = error.max(f64::MIN_POSITIVE) * factor(0);
    while longer < allowed && spare < MOST_SPARE {
        spare += 1;
        longer *= factor(spare);
    }
    spare
}
