//! The curve between two neighbouring points of a branch, at any place in between.

use crate::continuation::{Corrected, Corrector, Direction, Metric, Position, Step, Stretch, correct, settle, tangent};
use crate::orbit::{Harvester, Orbit, OrbitMethod, Shooting, Shot};
use crate::study::BranchPoint;

/// Most trials for one zero.
const TRIALS: u32 = 60;

/// Share of its values at the ends below which a value counts as zero.
const ROUNDING: f64 = 1e-11;

/// Half the width of the difference that gives the slope of power, as a share of the piece.
const SLOPE: f64 = 0.02;

/// A place of the piece.
#[derive(Debug)]
pub struct Place {
    /// Share of the way.
    pub x: f64,
    /// Value of the key.
    pub parameter: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
    shot: Shot,
    error: f64,
}

impl Place {
    /// State at the start of the period, energy coordinates.
    pub fn start(&self) -> &[f64] {
        &self.shot.looks[0]
    }
}

/// A zero, and the value that is left there.
#[derive(Debug)]
pub struct Zero {
    pub place: Place,
    pub value: f64,
}

/// A piece of a branch.
pub struct Piece<'h, H> {
    shooting: Shooting<'h, H>,
    corrector: Corrector,
    metric: Metric,
    ahead: Direction,
    cubic: Stretch,
}

impl<'h, H: Harvester> Piece<'h, H> {
    /// Between two points; `None` where shooting does not find them again.
    pub fn new(shooting: Shooting<'h, H>, corrector: Corrector, parameter_scale: f64, [a, b]: [&BranchPoint; 2]) -> Option<Self> {
        let position = |point: &BranchPoint| Position { unknown: point.orbit.start().to_vec(), parameter: point.parameter };
        let (from, to) = (position(a), position(b));
        let metric = Metric::at(&from, parameter_scale);
        let ahead = metric.unit(from.to(&to));
        let step = |guess: Position| {
            let found = correct(&shooting, &corrector, &metric, &ahead, guess.clone());
            // Where the curve is cut at an edge of the range, the chord may stand across nothing.
            let found = found.or_else(|_| settle(&shooting, &corrector, &metric, guess)).ok()?;
            let tangent = tangent(&found.local, &metric, &ahead)?;
            Some(Step { position: found.position, tangent, local: found.local, error: found.error })
        };
        let (start, end) = (step(from)?, step(to)?);
        let cubic = Stretch::between(&metric, (&start.position, &start.tangent), (&end.position, &end.tangent));
        (cubic.length > 0.0).then_some(Self { shooting, corrector, metric, ahead, cubic })
    }

    /// The place at a share of the way, a little beyond the ends too.
    pub fn at(&self, x: f64) -> Option<Place> {
        let guess = self.cubic.at(x * self.cubic.length);
        let Corrected { position, local: shot, error, .. } =
            correct(&self.shooting, &self.corrector, &self.metric, &self.ahead, guess).ok()?;
        Some(Place { x, parameter: position.parameter, mean_power_w: shot.loads_w.iter().sum::<f64>() + 0.0, shot, error })
    }

    /// The orbit at a place, with its multipliers and its error.
    pub fn orbit(&self, place: &Place) -> Option<Orbit> {
        self.shooting.orbit(&place.shot, place.error).ok()
    }

    /// Change of power along the piece, W per share of the way: a difference of fourth order.
    pub fn power_slope_w(&self, x: f64) -> Option<f64> {
        let power_w = |offset: f64| Some(self.at(x + offset * SLOPE)?.mean_power_w);
        Some((8.0 * (power_w(1.0)? - power_w(-1.0)?) - (power_w(2.0)? - power_w(-2.0)?)) / (12.0 * SLOPE))
    }

    /// Change of the key along the piece, per share of the way.
    pub fn parameter_slope(&self, x: f64) -> Option<f64> {
        Some((self.at(x + SLOPE)?.parameter - self.at(x - SLOPE)?.parameter) / (2.0 * SLOPE))
    }

    /// The place between two shares at which power has its maximum, where it rises into the stretch from both ends; a slope below
    /// `noise_w` counts as none.
    pub fn maximum(&self, (from, to): (f64, f64), noise_w: f64) -> Option<Zero> {
        let rises = self.power_slope_w(from)? > 0.0 && self.power_slope_w(to)? < 0.0;
        rises.then(|| self.zero((from, to), noise_w, |piece, place| piece.power_slope_w(place.x))).flatten()
    }

    /// The place between two shares where `value` passes zero, to its own noise, by false position, the value of an end that stays twice
    /// halved (Illinois); `None` without a change of sign.
    pub fn zero(&self, (from, to): (f64, f64), noise: f64, value: impl Fn(&Self, &Place) -> Option<f64>) -> Option<Zero> {
        let look = |x: f64| {
            let place = self.at(x)?;
            let here = value(self, &place)?;
            Some((place, here))
        };
        let ((low_place, mut at_low), (high_place, mut at_high)) = (look(from)?, look(to)?);
        if (at_low > 0.0) == (at_high > 0.0) {
            return None;
        }
        let enough = noise.max(ROUNDING * at_low.abs().max(at_high.abs()));
        let (mut low, mut high) = (low_place.x, high_place.x);
        let mut best = if at_low.abs() < at_high.abs() {
            Zero { place: low_place, value: at_low }
        } else {
            Zero { place: high_place, value: at_high }
        };
        let mut last_is_high = None;
        for _ in 0..TRIALS {
            let mut x = (low * at_high - high * at_low) / (at_high - at_low);
            if !(x > low && x < high) {
                x = 0.5 * (low + high);
            }
            let (place, here) = look(x)?;
            best = Zero { place, value: here };
            let is_high = (here > 0.0) == (at_high > 0.0);
            let stays = if last_is_high == Some(is_high) { 0.5 } else { 1.0 };
            last_is_high = Some(is_high);
            if is_high {
                (high, at_high) = (x, here);
                at_low *= stays;
            } else {
                (low, at_low) = (x, here);
                at_high *= stays;
            }
            if here.abs() <= enough {
                break;
            }
        }
        Some(best)
    }
}
