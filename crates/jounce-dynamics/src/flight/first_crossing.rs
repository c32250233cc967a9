//! End of a flight at the first impact.

use super::crossing::Crossing;
use crate::integrator::{Integrator, TrialState};
use jounce_simd::Simd;

impl Integrator<'_> {
    /// Advances to the first of several crossings.
    #[inline(always)]
    pub(super) fn advance_to_first_crossing<W: Simd>(
        &mut self,
        w: W,
        strikes: &[(usize, Crossing)],
        trial: &mut TrialState,
    ) {
        w.out_of_line(
            #[inline(always)]
            || {
                let mut first = (0, f64::INFINITY, [0.0; 2]);
                for (p, crossing) in strikes {
                    let (after_s, motion) = self.locate(w, *p, *crossing, trial);
                    if after_s < first.1 {
                        first = (*p, after_s, motion);
                    }
                }
                let (p, after_s, motion) = first;
                if strikes.len() > 1 {
                    self.propagate_to(w, after_s, trial);
                }
                self.advance_state(w, after_s, self.time_s + after_s, trial);
                self.set_motion(p, motion);
                self.join(w, p);
            },
        );
    }

    /// Returns the time until a port hits its stop, by Newton on the exact flow inside the proved
    /// interval, and its motion then; the trial state is the state there.
    #[inline(always)]
    fn locate<W: Simd>(
        &self,
        w: W,
        p: usize,
        crossing: Crossing,
        trial: &mut TrialState,
    ) -> (f64, [f64; 2]) {
        let Crossing {
            mut from_s,
            mut guess_s,
            mut to_s,
        } = crossing;
        self.propagate_to(w, guess_s, trial);
        let mut motion = self.motion_after(w, p, guess_s, trial);
        for _ in 0..20 {
            if motion[0] > 0.0 {
                to_s = guess_s
            } else {
                from_s = guess_s
            }
            let newton = guess_s - motion[0] / motion[1];
            let next = if newton >= from_s && newton <= to_s {
                newton
            } else {
                0.5 * (from_s + to_s)
            };
            let change = (next - guess_s).abs();
            self.propagate_from(w, [guess_s, next], trial);
            let before = motion;
            motion = self.motion_after(w, p, next, trial);
            guess_s = next;
            // The error left by Newton is the change times half the relative change of the rate:
            // here roundoff, and `next` has been evaluated.
            let remaining_error = 0.5 * change * ((motion[1] - before[1]) / motion[1]).abs();
            if remaining_error <= 1e-15 * guess_s.min(1.0 / self.kernel.fastest_rad_s) {
                break;
            }
        }
        (guess_s, motion)
    }
}
