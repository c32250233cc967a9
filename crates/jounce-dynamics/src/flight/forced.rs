//! Effect of the contact force of one port on another port in flight, on a step of one length.
//!
//! The displacement `z` that the force causes at the other port starts from rest. Its cubic Hermite
//! interpolant over the step is
//!
//! ```text
//! H(x) = z(h) (3 x^2 - 2 x^3) + h z'(h) (x^3 - x^2) + h z'(0) (x^3 - 2 x^2 + x),   x = t / h,
//! ```
//!
//! where `z'(0)` is not zero only for an output whose rate the force changes at once: the current
//! of a patch, which a switch monitors. The response of a fast decay, such as that of conducting
//! diodes, is a polynomial and a decay (see [`crate::force_response::fast_decay`]). The polynomial
//! belongs to `z`, with `z(0) (1 - 3 x^2 + 2 x^3)` as a further term of `H`. The decay belongs to the
//! free motion, with which it nearly cancels where the state follows the force at the start of the
//! step. `z - H` is known as a Legendre series in `x`. No Legendre
//! polynomial exceeds 1 in magnitude. The sum of the magnitudes of the coefficients therefore
//! bounds `|z - H|` on the complete step, and likewise `|z' - H'|`. Both are linear in the nodal
//! forces, so that the bound includes the cancellation between nodes. It holds to the accuracy of
//! the series (see [`crate::force_response::step_response`]). The certificate treats this remainder
//! as a fast part that starts at zero (see [`super::certificate`]).

use crate::flow::state::add_force_response;
use crate::force_response::basis::NODES;
use crate::force_response::fast_decay::StateDecay;
use crate::force_response::output_rows::{OutputRowsTask, RowReading, RowRequest};
use crate::kernel::{ForceBasis, Kernel};
use jounce_simd::{F64x8, LANES, Simd, widest};

/// Legendre coefficients of `3 x^2 - 2 x^3`, of `x^3 - x^2`, of `x^3 - 2 x^2 + x` and of
/// `1 - 3 x^2 + 2 x^3`.
const HERMITE_VALUES: [[f64; 4]; 4] = [
    [0.5, 0.6, 0.0, -0.1],
    [-1.0 / 12.0, -0.05, 1.0 / 12.0, 0.05],
    [1.0 / 12.0, -0.05, -1.0 / 12.0, 0.05],
    [0.5, -0.6, 0.0, 0.1],
];

/// Legendre coefficients of the slopes of the polynomials of [`HERMITE_VALUES`].
const HERMITE_SLOPES: [[f64; 3]; 4] = [
    [1.0, 0.0, -1.0],
    [0.0, 0.5, 0.5],
    [0.0, -0.5, 0.5],
    [-1.0, 0.0, 1.0],
];

/// Effect of a force on another port, one vector per nodal force.
#[derive(Debug, Clone)]
pub struct ForcedFlight {
    /// Displacement (lane 0, m) and velocity (lane 1, m/s) at the end of the step, and velocity
    /// (lane 2) and displacement (lane 3) at its start, without the decays.
    pub ends: [F64x8; NODES],
    /// Decays that add to the free motion.
    pub decays: Vec<StateDecay>,
    /// Coefficients of `z - H`, m, eight per vector.
    rest: Vec<[F64x8; NODES]>,
    /// Coefficients of `z' - H'`, m/s.
    rest_rate: Vec<[F64x8; NODES]>,
}

impl ForcedFlight {
    /// Computes the effect of the force of a port, in a basis, on the port `other_port`.
    pub fn new(
        kernel: &Kernel,
        (port, shape): (usize, ForceBasis),
        other_port: usize,
        length_s: f64,
    ) -> Self {
        let (plant, basis) = (&kernel.plant, kernel.basis(port, shape));
        let pointwise = |row: &[f64]| RowRequest {
            row: row.to_vec(),
            reading: RowReading::Pointwise,
        };
        let observed_port = &plant.ports[other_port];
        let tables = widest(OutputRowsTask {
            block: &plant.diagonal.block,
            layout: &kernel.layout,
            basis,
            reader: basis,
            force: &plant.ports[port].force,
            rows: &[
                pointwise(&observed_port.displacement),
                pointwise(&observed_port.velocity),
            ],
            length_s,
        });
        let mut series = tables.series.into_iter();
        let (mut displacement, mut speed) = (
            series.next().unwrap_or_default(),
            series.next().unwrap_or_default(),
        );
        // A direct effect of the force on the rate adds to the effect through the states.
        let direct = kernel.direct_gain(port, other_port);
        if direct != 0.0 {
            speed.resize(speed.len().max(basis.series.len()), F64x8::ZERO);
            speed
                .iter_mut()
                .zip(&basis.series)
                .for_each(|(lane, force)| *lane = lane.add_scaled(direct, force));
        }
        let started = |row: &[f64], j: usize| -> f64 {
            let decays = tables.decays.iter();
            decays
                .map(|decay| row[decay.state] * decay.start.0[j])
                .sum()
        };
        let ends: [F64x8; NODES] = std::array::from_fn(|j| {
            let [displacement, speed] = [0, 1].map(|row: usize| tables.rows[row].push[j].0[NODES]);
            let ends = [
                displacement,
                speed + direct * basis.at_end.0[j],
                direct * basis.at_start.0[j] + started(&observed_port.velocity, j),
                started(&observed_port.displacement, j),
            ];
            F64x8(std::array::from_fn(|i| ends.get(i).copied().unwrap_or(0.0)))
        });
        subtract_interpolant(&ends, length_s, [&mut displacement, &mut speed]);
        Self {
            ends,
            decays: tables.decays,
            rest: by_force(&displacement),
            rest_rate: by_force(&speed),
        }
    }
}

/// Subtracts the cubic Hermite interpolant of each nodal force from the series of displacement and
/// velocity.
fn subtract_interpolant(
    ends: &[F64x8; NODES],
    length_s: f64,
    [displacement, speed]: [&mut [F64x8]; 2],
) {
    for (j, ends) in ends.iter().enumerate() {
        let [end, end_rate, start_rate, start, ..] = ends.0;
        let ends = [end, length_s * end_rate, length_s * start_rate, start];
        for (ends, (interpolant, slope)) in
            ends.iter().zip(HERMITE_VALUES.iter().zip(&HERMITE_SLOPES))
        {
            displacement
                .iter_mut()
                .zip(interpolant)
                .for_each(|(lane, c)| lane.0[j] -= ends * c);
            speed
                .iter_mut()
                .zip(slope)
                .for_each(|(lane, c)| lane.0[j] -= ends / length_s * c);
        }
    }
}

/// Transposes from one vector per coefficient to one vector per nodal force, eight coefficients at
/// a time.
fn by_force(series: &[F64x8]) -> Vec<[F64x8; NODES]> {
    let of = |rows: &[F64x8]| {
        std::array::from_fn(|j| {
            F64x8(std::array::from_fn(|i| {
                rows.get(i).map_or(0.0, |row| row.0[j])
            }))
        })
    };
    series.chunks(LANES).map(of).collect()
}

/// Returns bounds on `|z - H|` (m) and `|z' - H'|` (m/s) under the nodal forces of several ports:
/// the sums of the magnitudes of their common coefficients.
#[inline(always)]
pub fn rest_bounds<W: Simd>(w: W, flights: &[&ForcedFlight], forces: &[F64x8]) -> [f64; 2] {
    let longest = flights
        .iter()
        .map(|flight| flight.rest.len())
        .max()
        .unwrap_or(0);
    let (mut displacement, mut speed) = (w.zero(), w.zero());
    for chunk in 0..longest {
        let (mut own_displacement, mut own_speed) = (w.zero(), w.zero());
        for (flight, force) in flights.iter().zip(forces) {
            if chunk < flight.rest.len() {
                own_displacement =
                    add_force_response(w, own_displacement, &flight.rest[chunk], force);
                own_speed = add_force_response(w, own_speed, &flight.rest_rate[chunk], force);
            }
        }
        (displacement, speed) = (
            w.add(displacement, w.abs(own_displacement)),
            w.add(speed, w.abs(own_speed)),
        );
    }
    [w.sum(displacement), w.sum(speed)]
}
