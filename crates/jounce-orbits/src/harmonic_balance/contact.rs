//! Contact intervals of a motion: their edges are roots of the trigonometric polynomial.

use super::fourier_grid::FourierGrid;
use super::motion::PortMotion;
use jounce_linalg::c64;
use std::f64::consts::TAU;

/// Samples per harmonic of the motion.
const SAMPLES_PER_HARMONIC: usize = 4;

/// Bisections that refine an edge from one sampling interval to roundoff.
const BISECTIONS: u32 = 52;

/// Interval in contact, rad; `to` may lie beyond the end of the period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactInterval {
    /// Start.
    pub from: f64,
    /// End.
    pub to: f64,
}

/// Sample of the motion.
#[derive(Debug, Clone, Copy)]
struct MotionSample {
    angle: f64,
    touches: bool,
}

/// Returns the grid on which a motion of some harmonics is sampled.
pub fn grid(harmonics: usize) -> FourierGrid {
    FourierGrid::new(SAMPLES_PER_HARMONIC * harmonics)
}

/// Returns all contacts of a period.
pub fn contacts(motion: &PortMotion, grid: &FourierGrid) -> Vec<ContactInterval> {
    let samples = motion_samples(motion, grid);
    let Some(first) = samples.iter().position(|sample| !sample.touches) else {
        return vec![ContactInterval { from: 0.0, to: TAU }];
    };
    let mut contact_intervals = Vec::new();
    let mut from = None;
    let repeated = samples.iter().map(|sample| MotionSample {
        angle: sample.angle + TAU,
        ..*sample
    });
    let round: Vec<MotionSample> = samples[first..]
        .iter()
        .copied()
        .chain(repeated.take(first + 1))
        .collect();
    for pair in round.windows(2) {
        match (pair[0].touches, pair[1].touches) {
            (false, true) => from = Some(edge(motion, pair[0].angle, pair[1].angle)),
            (true, false) => {
                let to = edge(motion, pair[1].angle, pair[0].angle);
                contact_intervals
                    .extend(from.take().map(|from| within(ContactInterval { from, to })));
            }
            _ => {}
        }
    }
    contact_intervals
}

/// Shifts a contact so that it begins in the period.
fn within(contact: ContactInterval) -> ContactInterval {
    let turns = if contact.from >= TAU { TAU } else { 0.0 };
    ContactInterval {
        from: contact.from - turns,
        to: contact.to - turns,
    }
}

/// Returns samples on the grid, and at the turning points between them that may pass the surface.
fn motion_samples(motion: &PortMotion, grid: &FourierGrid) -> Vec<MotionSample> {
    let mut spectrum: Vec<c64> = motion.depth.iter().map(|c| c * 0.5).collect();
    spectrum[0] *= 2.0;
    spectrum.resize(grid.samples / 2 + 1, c64::new(0.0, 0.0));
    let depths = grid.values(&spectrum);
    spectrum
        .iter_mut()
        .enumerate()
        .for_each(|(n, c)| *c *= c64::new(0.0, n as f64 * motion.step_rad_s));
    let rates = grid.values(&spectrum);
    let (count, width) = (grid.samples, TAU / grid.samples as f64);
    let mut samples = Vec::with_capacity(count + 8);
    for k in 0..count {
        let (current, next) = (
            (depths[k], rates[k]),
            (depths[(k + 1) % count], rates[(k + 1) % count]),
        );
        let (angle, touches) = (k as f64 * width, motion.touches(current));
        samples.push(MotionSample { angle, touches });
        let side = current.0.signum();
        let turns_back = current.1 * side < 0.0 && next.1 * side > 0.0 && next.0 * side > 0.0;
        let reach_m = (current.1.abs().max(next.1.abs())) * width / motion.step_rad_s;
        if turns_back && current.0.abs().min(next.0.abs()) < reach_m {
            let angle = turning(motion, angle, angle + width);
            samples.push(MotionSample {
                angle,
                touches: motion.touches(motion.at(angle)),
            });
        }
    }
    samples
}

/// Returns the turning point between two angles with rates of opposite sign, precise enough for a
/// sample (Illinois method).
fn turning(motion: &PortMotion, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (motion.at(low).1, motion.at(high).1);
    let mut angle = 0.5 * (low + high);
    for _ in 0..6 {
        angle = (low * at_high - high * at_low) / (at_high - at_low);
        let rate = motion.at(angle).1;
        if (rate > 0.0) == (at_high > 0.0) {
            (high, at_high, at_low) = (angle, rate, 0.5 * at_low);
        } else {
            (low, at_low, at_high) = (angle, rate, 0.5 * at_high);
        }
    }
    angle
}

/// Returns the edge between an angle out of contact and one in contact: a root of the depth, unless
/// the law releases earlier.
fn edge(motion: &PortMotion, out: f64, inside: f64) -> f64 {
    let (mut out, mut inside) = (out, inside);
    let mut guess = 0.5 * (out + inside);
    for _ in 0..BISECTIONS {
        let (depth_m, rate_m_s) = motion.at(guess);
        if motion.touches((depth_m, rate_m_s)) {
            inside = guess;
        } else {
            out = guess;
        }
        let newton = guess - depth_m * motion.step_rad_s / rate_m_s;
        if (newton - guess).abs() < 4.0 * f64::EPSILON * TAU {
            return newton;
        }
        let within = (newton - out) * (newton - inside) < 0.0;
        guess = if within { newton } else { 0.5 * (out + inside) };
        if (inside - out).abs() < 4.0 * f64::EPSILON * TAU {
            break;
        }
    }
    guess
}
