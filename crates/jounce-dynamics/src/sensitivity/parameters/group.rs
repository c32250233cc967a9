//! Derivatives of a plant by up to eight parameters, one in each lane of a vector.

use jounce_linalg::c64;
use jounce_model::contact::Law;
use jounce_model::drive::Wave;
use jounce_model::plant::{Plant, PlantDerivative};
use jounce_simd::{F64x8, LANES};

/// Changes of the equations by the parameters of a group, block coordinates. Those of rates include
/// the stretch of the period.
#[derive(Debug)]
pub struct ParameterGroup<'a> {
    /// Change of `A`, row by row.
    pub rates: Vec<F64x8>,
    /// Change of the rate under constant drives.
    pub constant: Vec<F64x8>,
    /// Changes of the ports.
    pub ports: Vec<GroupPort<'a>>,
    /// Changes of the tones.
    pub tones: Vec<GroupTone>,
    /// Changes of the loads: of the row and of the factor.
    pub loads: Vec<(Vec<F64x8>, F64x8)>,
}

/// Changes of a port.
#[derive(Debug)]
pub struct GroupPort<'a> {
    /// Row of the displacement, and of the velocity.
    pub rows: [Vec<F64x8>; 2],
    /// Column of a lasting force, and of an impulse.
    pub columns: [Vec<F64x8>; 2],
    /// Complex displacement of each tone, m.
    pub steady_m: Vec<[F64x8; 2]>,
    /// Gap, m.
    pub gap_m: F64x8,
    /// Impulse of a rigid stop per speed, kg.
    pub impulse_kg: F64x8,
    /// Laws at changed values of each parameter, with their weights in the derivative.
    pub laws: [&'a [(f64, Law)]; LANES],
}

/// Changes of a tone.
#[derive(Debug)]
pub struct GroupTone {
    /// Steady state.
    pub steady: Vec<[F64x8; 2]>,
    /// Angular frequency, rad/s.
    pub angular_frequency_rad_s: F64x8,
}

impl<'a> ParameterGroup<'a> {
    /// Packs up to eight derivatives.
    pub fn of(plant: &Plant, derivatives: &'a [PlantDerivative]) -> Self {
        let n = plant.len();
        let unit = |j: usize| {
            (0..n)
                .map(|k| f64::from(u8::from(k == j)))
                .collect::<Vec<f64>>()
        };
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|j| plant.diagonal.block.apply(&unit(j)))
            .collect();
        let rate = |i: usize, j: usize| {
            lanes(derivatives, |by| {
                by.rates[(i, j)] + by.stretch * columns[j][i]
            })
        };
        let constant = constant(plant);
        let tone = |k: usize| GroupTone {
            steady: (0..n)
                .map(|i| complex(derivatives, |by| by.tones[k].steady[i]))
                .collect(),
            angular_frequency_rad_s: lanes(derivatives, |by| by.tones[k].angular_frequency_rad_s),
        };
        let count = derivatives.first().map_or(0, |by| by.loads.len());
        let load = |k: usize| {
            let row = (0..n).map(|i| lanes(derivatives, |by| by.loads[k].row[i]));
            let factor = lanes(derivatives, |by| by.loads[k].factor_per_ohm);
            (row.collect(), factor)
        };
        Self {
            rates: (0..n * n).map(|k| rate(k / n, k % n)).collect(),
            constant: (0..n)
                .map(|i| lanes(derivatives, |by| by.constant[i] + by.stretch * constant[i]))
                .collect(),
            ports: (0..plant.system.stops.len())
                .map(|index| GroupPort::of(plant, derivatives, index))
                .collect(),
            tones: (0..plant.tones.len()).map(tone).collect(),
            loads: (0..count).map(load).collect(),
        }
    }
}

/// Returns a number of each derivative.
fn lanes(derivatives: &[PlantDerivative], read: impl Fn(&PlantDerivative) -> f64) -> F64x8 {
    F64x8(std::array::from_fn(|l| {
        derivatives.get(l).map_or(0.0, &read)
    }))
}

/// Returns the real and the imaginary parts of a number of each derivative.
fn complex(derivatives: &[PlantDerivative], read: impl Fn(&PlantDerivative) -> c64) -> [F64x8; 2] {
    [
        lanes(derivatives, |by| read(by).re),
        lanes(derivatives, |by| read(by).im),
    ]
}

/// Returns the rate of the state under the constant drives of a plant.
fn constant(plant: &Plant) -> Vec<f64> {
    let mut sum = vec![0.0; plant.len()];
    for (signal, forcing) in plant.system.signals.iter().zip(&plant.forcings) {
        if let Wave::Constant(size) = signal.wave {
            let pairs = sum.iter_mut().zip(&forcing.column);
            pairs.for_each(|(sum, b)| *sum += b * size);
        }
    }
    sum
}

impl<'a> GroupPort<'a> {
    /// Packs the changes of a port.
    fn of(plant: &Plant, derivatives: &'a [PlantDerivative], index: usize) -> Self {
        let list = |read: &dyn Fn(&PlantDerivative, usize) -> f64| -> Vec<F64x8> {
            (0..plant.len())
                .map(|i| lanes(derivatives, |by| read(by, i)))
                .collect()
        };
        let force = &plant.ports[index].force;
        let laws = |by: &'a PlantDerivative| -> &'a [(f64, Law)] { &by.ports[index].laws };
        Self {
            rows: [
                list(&|by, i| by.ports[index].displacement[i]),
                list(&|by, i| by.ports[index].velocity[i]),
            ],
            columns: [
                list(&|by, i| by.ports[index].force[i] + by.stretch * force[i]),
                list(&|by, i| by.ports[index].force[i]),
            ],
            steady_m: (0..plant.tones.len())
                .map(|k| complex(derivatives, |by| by.ports[index].steady_m[k]))
                .collect(),
            gap_m: lanes(derivatives, |by| by.ports[index].gap_m),
            impulse_kg: lanes(derivatives, |by| by.ports[index].impulse_kg),
            laws: std::array::from_fn(|l| derivatives.get(l).map_or(&[][..], laws)),
        }
    }

    /// Returns the changes of penetration (m) and rate (m/s) at a fixed part `y` of the state that
    /// the tones do not force.
    pub fn drift(
        &self,
        plant: &Plant,
        port: usize,
        (time_s, y): (f64, &[f64]),
        tones: &[GroupTone],
    ) -> [F64x8; 2] {
        let along = |row: &[F64x8]| {
            row.iter()
                .zip(y)
                .fold(F64x8::ZERO, |sum, (row, y)| sum.add_scaled(*y, row))
        };
        let [penetration, rate] = self.of_tones(plant, port, time_s, tones);
        [
            along(&self.rows[0])
                .add_scaled(-1.0, &self.gap_m)
                .add_scaled(1.0, &penetration),
            along(&self.rows[1]).add_scaled(1.0, &rate),
        ]
    }

    /// Returns the parts of the tones in the changes of displacement (m) and velocity (m/s).
    pub fn of_tones(
        &self,
        plant: &Plant,
        port: usize,
        time_s: f64,
        tones: &[GroupTone],
    ) -> [F64x8; 2] {
        let (mut displacement, mut velocity) = (F64x8::ZERO, F64x8::ZERO);
        for (k, tone) in plant.tones.iter().enumerate() {
            let w = tone.angular_frequency_rad_s;
            let turn = c64::cis(w * time_s);
            let [re, im] = &self.steady_m[k];
            let moving = turn * c64::new(0.0, w);
            let steady = plant.ports[port].steady_m[k] * turn * c64::new(0.0, 1.0);
            displacement = displacement
                .add_scaled(turn.re, re)
                .add_scaled(-turn.im, im);
            velocity = velocity
                .add_scaled(moving.re, re)
                .add_scaled(-moving.im, im)
                .add_scaled(steady.re, &tones[k].angular_frequency_rad_s);
        }
        [displacement, velocity]
    }
}
