//! Random modal systems with their starts, reproducible from a number.

use super::circuit::circuit;
use super::graze::Graze;
use super::law::{LAWS, law};
use crate::random_specs::Draw;
use jounce_model::contact::Law;
use jounce_model::drive::Wave;
use jounce_model::plant::{Drive, Plant, Signal, Stop, System};
use jounce_model::structure::Modes;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Seed of the harvesters.
const SEED: u64 = 31;

/// Scales for the random parts of a harvester.
pub struct Scales {
    /// Angular frequency of the first mode, rad/s; of a mode without stiffness, its scale.
    pub angular: f64,
    /// Length of gaps and motions, m.
    pub length: f64,
    /// Stiffness of the first mode at the tip, N/m.
    pub stiffness: f64,
    /// Mass of the first mode at the tip, kg.
    pub mass: f64,
}

/// A harvester, its start and its run.
pub struct Drawn {
    pub plant: Plant,
    /// Equal system with the patches of a circuit merged into one.
    pub merged: System,
    /// Physical start `(q, q', V)`.
    pub start: Vec<f64>,
    pub cycles: usize,
    pub tolerance: f64,
    pub graze: Option<Graze>,
}

fn modes(draw: &mut Draw, is_damped: bool) -> (Modes, Scales) {
    let count = draw.one_of(&[1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 4, 5, 6, 8]);
    let mut frequency = vec![TAU * draw.decades(1.0, 300.0)];
    for i in 1..count {
        let next = frequency[i - 1] * draw.within(1.05, 4.5);
        frequency.push(if next < 40.0 * frequency[0] {
            next
        } else {
            1.1 * frequency[i - 1]
        });
    }
    let tip0 = draw.decades(0.3, 30.0);
    let tip: Vec<f64> = (0..count)
        .map(|i| {
            if i == 0 {
                tip0
            } else {
                tip0 * draw.one_of(&[-1.0, 1.0]) * draw.within(0.3, 1.5)
            }
        })
        .collect();
    let scales = Scales {
        angular: frequency[0],
        length: draw.decades(1e-5, 1e-2),
        stiffness: (frequency[0] / tip0).powi(2),
        mass: tip0.powi(-2),
    };
    let mut ratio: Vec<f64> = (0..count)
        .map(|_| match is_damped {
            true => draw.decades(0.05, 1.5),
            false => draw.decades(0.001, 0.1),
        })
        .collect();
    if draw.happens(0.03) {
        ratio = vec![0.0; count];
    }
    if draw.happens(0.03) {
        (frequency[0], ratio[0]) = (0.0, 0.0);
    }
    let side = tip.iter().map(|s| s * draw.within(-0.9, 0.9)).collect();
    let modes = Modes {
        frequency_rad_s: frequency,
        damping_ratio: ratio,
        shape: BTreeMap::from([("tip".into(), tip), ("side".into(), side)]),
        participation_sqrt_kg: (0..count)
            .map(|i| 0.8 / tip0 / (1.0 + i as f64).powi(2))
            .collect(),
        discretisation_error: vec![0.0; count],
        ..Modes::default()
    };
    (modes, scales)
}

/// Draws one or two stops: the second on the other side, on the same side, or at another point.
fn stops(draw: &mut Draw, modes: &Modes, scales: &Scales) -> Vec<Stop> {
    let count = draw.one_of(&[1, 1, 2]);
    let mut stops: Vec<Stop> = Vec::new();
    for number in 0..count {
        let is_at_side = number == 1 && draw.happens(0.3);
        // Two rigid stops only hold the same point.
        let has_rigid = stops.iter().any(|stop| matches!(stop.law, Law::Rigid(_)));
        let laws = if is_at_side && has_rigid {
            &LAWS[1..]
        } else {
            &LAWS[..]
        };
        let name = draw.one_of(laws);
        let law = law(draw, scales, name);
        let sign = match number {
            0 => 1.0,
            _ if draw.happens(0.8) => -1.0,
            _ => 1.0,
        };
        let shape = &modes.shape[if is_at_side { "side" } else { "tip" }];
        let relative = match law {
            Law::Rigid(_) => draw.one_of(&[0.0, 0.3, 1.0, 1.0]) * draw.within(0.5, 1.5),
            _ => draw.one_of(&[0.0, 0.2, 1.0, 1.0, 1.0, -0.2, -1.0]) * draw.within(0.5, 1.5),
        };
        stops.push(Stop {
            name: format!("s{number}"),
            shape: shape.iter().map(|s| sign * s).collect(),
            gap_m: relative * scales.length,
            law,
            bases: Vec::new(),
        });
    }
    stops
}

fn drive(draw: &mut Draw, modes: &Modes, scales: &Scales) -> Drive {
    let ratio = draw.decades(0.3, 3.0);
    let magnified = ((1.0 - ratio * ratio).powi(2) + (0.1 * ratio).powi(2)).sqrt();
    let reach = if draw.happens(0.05) {
        draw.decades(1e-4, 0.1)
    } else {
        draw.decades(0.7, 8.0)
    };
    let force = reach * scales.length * scales.stiffness * magnified;
    // A force on the tip or an acceleration of the base.
    let (shape, amplitude_n) = match draw.happens(0.5) {
        true => (modes.shape["tip"].clone(), force),
        false => {
            let tip = modes.shape["tip"][0];
            let shape: Vec<f64> = modes.participation_sqrt_kg.iter().map(|p| -p).collect();
            let amplitude = force * tip / shape[0].abs();
            (shape, amplitude)
        }
    };
    Drive {
        name: "d".into(),
        shape,
        amplitude_n,
        frequency_hz: ratio * scales.angular / TAU,
        phase_rad: draw.one_of(&[0.0, 0.1, 2.0, 4.0]),
        base: None,
    }
}

fn gravity(draw: &mut Draw, modes: &Modes, scales: &Scales) -> Vec<Signal> {
    if !draw.happens(0.4) {
        return Vec::new();
    }
    let participation = modes.participation_sqrt_kg.clone();
    let sag_m_s2 = scales.length * draw.within(-1.0, 1.0) * scales.angular.powi(2)
        / (modes.shape["tip"][0] * participation[0]);
    vec![Signal {
        name: "gravity".into(),
        shape: participation,
        wave: Wave::Constant(sag_m_s2),
        base: None,
        drawn_from: None,
    }]
}

/// Returns a random start `(q, q', V)` of up to one and a half lengths.
fn random_start(draw: &mut Draw, system: &System, scales: &Scales) -> Vec<f64> {
    let modes = &system.modes;
    let n = modes.len();
    let mut start = vec![0.0; 2 * n + usize::from(!modes.patch.is_empty())];
    for i in 0..n {
        let w = modes.frequency_rad_s[i].max(scales.angular);
        let size = scales.length / modes.shape["tip"][0] / (1.0 + i as f64);
        start[i] = size * draw.within(-1.5, 1.5) * scales.angular / w;
        start[n + i] = size * draw.within(-1.5, 1.5) * scales.angular;
    }
    start
}

fn is_inside_rigid(system: &System, start: &[f64]) -> bool {
    system.stops.iter().any(|stop| {
        let along: f64 = stop.shape.iter().zip(start).map(|(s, q)| s * q).sum();
        matches!(stop.law, Law::Rigid(_)) && along > stop.gap_m * (1.0 - 1e-6)
    })
}

/// Returns harvester number `index`.
pub fn drawn(index: u64) -> Result<Drawn, String> {
    let draw = &mut Draw::new(SEED, index);
    let settles = draw.happens(0.1);
    let (modes, scales) = modes(draw, settles);
    let circuit = circuit(draw, &modes, &scales);
    let mut system = System {
        stops: stops(draw, &modes, &scales),
        drives: vec![drive(draw, &modes, &scales)],
        signals: gravity(draw, &modes, &scales),
        ..System::default()
    };
    let cycles = if settles { 24 } else { draw.one_of(&[2, 3, 4]) };
    let tolerance = draw.one_of(&[1e-10, 1e-10, 1e-10, 1e-8]);
    let merged = circuit.merged(&system, &modes);
    let size = 2 * modes.len() + usize::from(!merged.modes.patch.is_empty());
    let rest = vec![0.0; size];
    let random = random_start(draw, &merged, &scales);
    let start = draw.within(0.0, 1.0);
    let exponent = draw.within(2.0, 12.0);
    let side = draw.one_of(&[-1.0, 1.0]);
    circuit.connect(&mut system, modes);
    let mut all = Drawn {
        plant: plant(&system)?,
        merged,
        start: random,
        cycles,
        tolerance,
        graze: None,
    };
    match start {
        x if x < 0.25 => all.start = rest.clone(),
        x if x < 0.35 => all.start = all.plant.resting_physical(),
        x if x < 0.5 => all.graze(system, side * 10.0_f64.powf(-exponent))?,
        _ => {}
    }
    if is_inside_rigid(&all.merged, &all.start) {
        all.start = rest;
    }
    Ok(all)
}

/// Diagonalises a system; the error is the reason of a refusal.
pub fn plant(system: &System) -> Result<Plant, String> {
    Plant::new(system.clone()).map_err(|error| error.to_string())
}

impl Drawn {
    /// True where two stops on opposite sides of one point leave no play between them.
    pub fn has_no_play(&self) -> bool {
        let [a, b] = &self.merged.stops[..] else {
            return false;
        };
        let is_opposite = a.shape.iter().zip(&b.shape).all(|(a, b)| *a == -b);
        is_opposite && a.gap_m + b.gap_m == 0.0
    }
}
