//! Classification of the motion from a start: periodic orbit, torus, chaos, or undecided within the
//! limit.
//!
//! The states at the starts of drive cycles repeat after `p` cycles where `r = |x_k - x_(k-p)|` is
//! small. This is not enough for a motion that settles slowly. With the contraction `c` per period
//! over a window, the remaining distance is `r c / (1 - c)`. A motion is periodic when that is
//! below [`CLOSE`] of the size of the motion at several successive checks, for the smallest such
//! `p`.

use super::flow::{Flow, Motion};
use super::law::Phase;
use super::model::STOPS;

/// Distance to the limit, relative to the size of the motion, within which an orbit counts as
/// reached.
const CLOSE: f64 = 1e-8;

/// Distance over a period, relative to the size of the motion, that may be integration error and
/// roundoff and need not shrink. A motion that contracts by 3e-4 a period or more is within
/// [`CLOSE`] of its orbit there.
const NOISE: f64 = 3e-12;

/// Distance over a part of a period below which this part is the period: far above the remaining
/// distance to the orbit.
const ONE: f64 = 1e-6;

/// Drive cycles between checks, and shortest window for a contraction.
const BETWEEN: usize = 32;

/// Successive checks that must find one period.
const CHECKS: usize = 4;

/// Drive cycles for an exponent, in [`BLOCKS`] blocks after a first one.
const EXPONENT_CYCLES: usize = 1600;

/// Blocks whose scatter gives the error of an exponent.
const BLOCKS: usize = 16;

/// Distance of the neighbour whose growth gives the exponent, relative to the size of the motion:
/// far above roundoff and in the linear range.
const APART: f64 = 1e-7;

/// Drive cycles for the mean power of a motion without a period.
const AVERAGED: usize = 1000;

/// Limits of an integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patience {
    /// Drive cycles after which a motion is not periodic.
    pub cycles: usize,
    /// Longest period tested during the integration, drive cycles. At the end, periods up to a
    /// quarter of the integration are tested.
    pub period: usize,
}

/// Kind of an ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Periodic orbit with this period in drive cycles.
    Periodic(usize),
    /// The distance of neighbours is constant.
    Torus,
    /// Neighbours separate.
    Chaos,
    /// Neighbours converge, but the motion does not repeat yet.
    Unsettled,
    /// The integration was ended.
    Lost,
}

/// Result of a classification.
#[derive(Debug, Clone)]
pub struct Ending {
    pub kind: Kind,
    /// Mean power over the period, or over the last cycles, W.
    pub mean_power_w: f64,
    /// States at the start of each drive cycle of the period, energy coordinates; one state where
    /// there is no period.
    pub strobe: Vec<Vec<f64>>,
    /// Size of the motion in energy coordinates.
    pub size: f64,
    /// Square of that size per drive cycle, W.
    pub power_scale_w: f64,
    /// Largest exponent with its error, 1/cycle, of a motion without a period.
    pub exponent: Option<[f64; 2]>,
    /// Number of drive cycles integrated.
    pub cycles: usize,
}

/// States at the starts of all cycles.
struct History<'f, const N: usize, const D: usize> {
    flow: Flow<'f, N, D>,
    states: Vec<[f64; D]>,
}

impl<const N: usize, const D: usize> History<'_, N, D> {
    /// `|x_k - x_(k-p)|`, evaluated `back` states before the last.
    fn repeats(&self, period: usize, back: usize) -> f64 {
        let last = self.states.len() - 1 - back;
        let (a, b) = (&self.states[last], &self.states[last - period]);
        self.flow
            .model
            .weights
            .square(&std::array::from_fn(|i| a[i] - b[i]))
            .sqrt()
    }

    /// Period within the limit that has been reached. While a motion spirals onto its orbit, a
    /// multiple of the period may be found first. The smallest part over which the states repeat is
    /// the period.
    fn period(&self, longest: usize, size: f64) -> Option<usize> {
        let period = self.reached(longest, size)?;
        let repeats =
            |part: &usize| (0..period).all(|back| self.repeats(*part, back) <= ONE * size);
        (1..=period).find(|part| period.is_multiple_of(*part) && repeats(part))
    }

    fn reached(&self, longest: usize, size: f64) -> Option<usize> {
        (1..=longest).find(|period| {
            let window = period * BETWEEN.div_ceil(*period);
            if self.states.len() <= window + period {
                return false;
            }
            let now = self.repeats(*period, 0);
            if now > CLOSE * size {
                return false;
            }
            let before = self.repeats(*period, window);
            let contraction = (now / before).powf(*period as f64 / window as f64);
            let noise = NOISE * size;
            (now <= noise && before <= noise)
                || (contraction < 1.0 && now * contraction <= CLOSE * size * (1.0 - contraction))
        })
    }

    fn mean_power_w(&self, cycles: usize) -> f64 {
        let model = self.flow.model;
        let energy = |back: usize| self.states[self.states.len() - 1 - back][D - 1];
        (energy(0) - energy(cycles)) / (cycles as f64 * model.cycle_s)
    }

    fn ending(&self, kind: Kind, size: f64, exponent: Option<[f64; 2]>) -> Ending {
        let cycles = self.states.len() - 1;
        let (states, averaged) = match kind {
            Kind::Periodic(period) => (period, period),
            _ => (1, AVERAGED.min(cycles)),
        };
        let model = self.flow.model;
        let strobe = self.states[self.states.len() - states..]
            .iter()
            .map(|y| model.energy_coordinates(y))
            .collect();
        let power_scale_w = size * size / model.cycle_s;
        Ending {
            kind,
            mean_power_w: self.mean_power_w(averaged),
            strobe,
            size,
            power_scale_w,
            exponent,
            cycles,
        }
    }
}

/// Integrates from a physical start `(q, q', V)` until its ending is known.
pub fn classify<const N: usize, const D: usize>(
    flow: Flow<'_, N, D>,
    start: &[f64],
    patience: Patience,
) -> Ending {
    let mut motion = flow.start(flow.model.state(start));
    let mut history = History {
        flow,
        states: Vec::with_capacity(patience.cycles + 1),
    };
    history.states.push(motion.state);
    let (mut candidate, mut times) = (None, 0);
    while history.states.len() <= patience.cycles {
        flow.cycle(&mut motion);
        history.states.push(motion.state);
        if motion.is_lost {
            return history.ending(Kind::Lost, motion.size, None);
        }
        if history.states.len().is_multiple_of(BETWEEN) {
            let period = history.period(patience.period, motion.size);
            times = if period.is_some() && period == candidate {
                times + 1
            } else {
                1
            };
            candidate = period;
            // Enough successive checks also cover several of the longest periods.
            if let Some(period) =
                candidate.filter(|period| times >= CHECKS.max(3 * period / BETWEEN))
            {
                return history.ending(Kind::Periodic(period), motion.size, None);
            }
        }
    }
    if let Some(period) = history.period(patience.cycles / 4, motion.size) {
        return history.ending(Kind::Periodic(period), motion.size, None);
    }
    let exponent = exponent(flow, &motion);
    let [value, error] = exponent;
    let kind = match () {
        () if value > 3.0 * error => Kind::Chaos,
        () if value < -3.0 * error => Kind::Unsettled,
        () => Kind::Torus,
    };
    history.ending(kind, motion.size, Some(exponent))
}

/// Largest exponent of a motion and its error, 1/cycle, from a neighbour that is rescaled after
/// each cycle.
fn exponent<const N: usize, const D: usize>(flow: Flow<'_, N, D>, motion: &Motion<D>) -> [f64; 2] {
    let weights = &flow.model.weights;
    let mut motion = motion.clone();
    let initial_distance = APART * motion.size;
    let mut near: [f64; D] = std::array::from_fn(|i| {
        let weight = weights.0[i];
        motion.state[i]
            + if weight > 0.0 {
                initial_distance / weight / (D as f64).sqrt()
            } else {
                0.0
            }
    });
    let mut means = Vec::with_capacity(BLOCKS + 1);
    for _ in 0..=BLOCKS {
        let mut growth = 0.0;
        for _ in 0..EXPONENT_CYCLES / BLOCKS {
            let mut other = flow.start(near);
            (0..STOPS)
                .filter(|p| motion.phases[*p] == Phase::Resting)
                .for_each(|p| other.phases[p] = Phase::Resting);
            flow.cycle(&mut motion);
            flow.cycle(&mut other);
            let difference: [f64; D] = std::array::from_fn(|i| other.state[i] - motion.state[i]);
            let distance = weights
                .square(&difference)
                .sqrt()
                .max(1e-6 * initial_distance);
            growth += (distance / initial_distance).ln();
            near = std::array::from_fn(|i| {
                motion.state[i] + difference[i] * initial_distance / distance
            });
        }
        means.push(growth / (EXPONENT_CYCLES / BLOCKS) as f64);
    }
    // In the first block the neighbour aligns with the fastest growing direction.
    let means = &means[1..];
    let mean = means.iter().sum::<f64>() / BLOCKS as f64;
    let variance = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (BLOCKS - 1) as f64;
    [mean, (variance / BLOCKS as f64).sqrt()]
}
