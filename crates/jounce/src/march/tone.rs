//! The sinusoidal part of the port displacement, carried along as a turning phasor.

use super::collocation::{COLLOCATION, NODES};
use super::kernel::Kernel;
use super::lane::{Lane, WIDTH};
use faer::c64;

/// One tone at the present time of a march.
#[derive(Debug, Clone)]
pub struct Turning {
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: f64,
    /// `e^{i w t}` at the present time.
    pub turn: c64,
    /// Complex amplitude of the port displacement, m.
    pub displacement_m: c64,
    /// `cos` and `sin` of `w tau` at the nodes and the end, per level.
    levels: Vec<Option<(Lane, Lane)>>,
}

impl Turning {
    /// A tone at a time.
    pub fn new(angular_frequency_rad_s: f64, displacement_m: c64, time_s: f64) -> Self {
        let count = (Kernel::finest() - Kernel::coarsest() + 1) as usize;
        let turn = c64::cis(angular_frequency_rad_s * time_s);
        Self { angular_frequency_rad_s, turn, displacement_m, levels: vec![None; count] }
    }

    /// `cos` and `sin` of `w tau` over a step of a level.
    #[inline(always)]
    pub fn level(&mut self, level: i32) -> (Lane, Lane) {
        let index = (level - Kernel::coarsest()) as usize;
        match self.levels[index] {
            Some(lanes) => lanes,
            None => {
                let lanes = self.over(Kernel::length_s(level));
                self.levels[index] = Some(lanes);
                lanes
            }
        }
    }

    /// The same over a step that may or may not be a level.
    #[inline(always)]
    pub fn for_length(&mut self, length_s: f64) -> (Lane, Lane) {
        let level = Kernel::level_within(length_s);
        if Kernel::length_s(level) == length_s { self.level(level) } else { self.over(length_s) }
    }

    /// `cos` and `sin` of `w tau` over a step of any length.
    pub fn over(&self, length_s: f64) -> (Lane, Lane) {
        let angle = |i: usize| self.angular_frequency_rad_s * length_s * if i < NODES { COLLOCATION.nodes[i] } else { 1.0 };
        let sin_cos: [(f64, f64); WIDTH] = std::array::from_fn(|i| angle(i).sin_cos());
        (Lane(sin_cos.map(|(_, cos)| cos)), Lane(sin_cos.map(|(sin, _)| sin)))
    }

    /// Displacement and velocity of the port at the present time, m and m/s.
    #[inline(always)]
    pub fn motion(&self) -> (f64, f64) {
        let z = self.displacement_m * self.turn;
        (z.re, -self.angular_frequency_rad_s * z.im)
    }

    /// The same after a turn by an angle given by its `cos` and `sin`.
    #[inline(always)]
    pub fn motion_after(&self, cos: f64, sin: f64) -> (f64, f64) {
        let z = self.displacement_m * self.turn * c64::new(cos, sin);
        (z.re, -self.angular_frequency_rad_s * z.im)
    }

    /// Fresh phasor at a time, without the roundoff of many turns.
    #[inline(always)]
    pub fn set(&mut self, time_s: f64) {
        self.turn = c64::cis(self.angular_frequency_rad_s * time_s);
    }
}
