//! Sinusoidal part of the port displacement, propagated as a rotating phasor.

use super::per_port::PerPort;
use crate::force_response::basis::{BasisFunctions, NODES};
use crate::kernel::{ForceBasis, Kernel};
use jounce_linalg::c64;
use jounce_model::plant::Plant;
use jounce_simd::{F64x8, LANES, Simd};

/// Tone at the current time of an integration.
#[derive(Debug, Clone)]
pub struct Phasor {
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: f64,
    /// `e^{i w t}` at the current time.
    pub turn: c64,
    /// Complex amplitude of the displacement of each port, m.
    pub displacement_m: PerPort<c64>,
    /// Samples of the tone over the current step, at the nodes and the end, for each port.
    pub samples: PerPort<PhasorSamples>,
    /// `e^{i w h}` for each level.
    ends: Vec<Option<c64>>,
    /// `cos` and `sin` of `w tau` at the nodes and the end, per port and level: smooth basis, then
    /// onset.
    levels: PerPort<[Vec<Option<Box<PhasorSamples>>>; 2]>,
}

/// `cos` and `sin` of `w tau` over a step: at the seven nodes and at its end.
#[derive(Debug, Clone, Copy)]
pub struct PhasorSamples {
    /// `cos`.
    pub cos: F64x8,
    /// `sin`.
    pub sin: F64x8,
}

impl Phasor {
    /// Returns all tones of a plant at a time.
    pub fn of_all(plant: &Plant, time_s: f64) -> Vec<Self> {
        let tones = 0..plant.tones.len();
        tones.map(|index| Self::new(plant, index, time_s)).collect()
    }
}

impl PhasorSamples {
    /// Samples a tone over a step of any length.
    pub fn over(angular_frequency_rad_s: f64, basis: &BasisFunctions, length_s: f64) -> Self {
        let sin_cos: [(f64, f64); LANES] = basis
            .positions
            .map(|x| (angular_frequency_rad_s * length_s * x).sin_cos());
        Self {
            cos: F64x8(sin_cos.map(|(_, cos)| cos)),
            sin: F64x8(sin_cos.map(|(sin, _)| sin)),
        }
    }

    /// Returns `e^{i w h}`.
    #[inline(always)]
    pub fn end(&self) -> c64 {
        c64::new(self.cos.0[NODES], self.sin.0[NODES])
    }

    /// Returns `Re(z e^{i w tau})`.
    #[inline(always)]
    pub fn real<W: Simd>(&self, w: W, z: c64, sum: W::Register) -> W::Register {
        w.fma(
            w.splat(-z.im),
            w.load(&self.sin),
            w.fma(w.splat(z.re), w.load(&self.cos), sum),
        )
    }
}

impl Phasor {
    /// Creates tone number `index` of a plant at a time.
    pub fn new(plant: &Plant, index: usize, time_s: f64) -> Self {
        let (angular_frequency_rad_s, ports) = (
            plant.tones[index].angular_frequency_rad_s,
            plant.ports.len(),
        );
        Self {
            angular_frequency_rad_s,
            turn: c64::cis(angular_frequency_rad_s * time_s),
            displacement_m: PerPort::new(ports, |port| {
                plant
                    .ports
                    .get(port)
                    .map_or_else(c64::default, |port| port.steady_m[index])
            }),
            samples: PerPort::new(ports, |_| PhasorSamples {
                cos: F64x8::ZERO,
                sin: F64x8::ZERO,
            }),
            ends: vec![None; Kernel::count()],
            levels: PerPort::new(ports, |_| {
                [vec![None; Kernel::count()], vec![None; Kernel::count()]]
            }),
        }
    }

    /// Returns `e^{i w h}` of a level.
    #[inline(always)]
    pub fn end(&mut self, level: i32) -> c64 {
        let angle = self.angular_frequency_rad_s * Kernel::length_s(level);
        *self.ends[Kernel::index(level)].get_or_insert_with(|| c64::cis(angle))
    }

    /// Sets `samples` of a port to the samples over a level.
    #[inline(always)]
    pub fn swing_over(&mut self, kernel: &Kernel, port: usize, shape: ForceBasis, level: i32) {
        let frequency = self.angular_frequency_rad_s;
        let make = || {
            Box::new(PhasorSamples::over(
                frequency,
                kernel.basis(port, shape),
                Kernel::length_s(level),
            ))
        };
        self.samples[port] =
            **self.levels[port][shape.index()][Kernel::index(level)].get_or_insert_with(make);
    }

    /// Returns displacement and velocity of a port at the current time, m and m/s.
    #[inline(always)]
    pub fn motion(&self, port: usize) -> [f64; 2] {
        self.motion_after(port, c64::new(1.0, 0.0))
    }

    /// Returns displacement and velocity of a port after a rotation.
    #[inline(always)]
    pub fn motion_after(&self, port: usize, turn: c64) -> [f64; 2] {
        let z = self.displacement_m[port] * self.turn * turn;
        [z.re, -self.angular_frequency_rad_s * z.im]
    }

    /// Sets the phasor at a time, without the roundoff of many rotations.
    #[inline(always)]
    pub fn set(&mut self, time_s: f64) {
        self.turn = c64::cis(self.angular_frequency_rad_s * time_s);
    }
}
