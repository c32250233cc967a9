//! Derivative of the flow of a march with respect to its start and to one parameter.
//!
//! ```text
//! flight       dy1 = e^{A h} dy
//! contact      dy1 = e^{A h} dy + B X,   (I - J D - J' D') X = J (C dy + dw) + J' (C' dy + dv) + F k
//! entry        dy+ = dy- + b F(0, v) (c dy + dw) / v
//! impact       dy+ = dy- + b m (c' dy + dv) - (b m a - A b p) (c dy + dw) / v,   m = (1 + e) / M
//! ```
//!
//! `J`, `J'` are the slopes of the law at the nodes of the step (N/m, N s/m), `D`, `D'` the Duhamel weights of displacement and
//! velocity, `C`, `C'` their columns, `B` the push to the end of the step: the linearisation of the very equations that the
//! march has solved. `b`, `c`, `c'` are the force column and the rows of the port, `v` the speed at which the stop is struck, `a`
//! the acceleration before it, `p` the impulse. `dw`, `dv` (m, m/s per unit of the parameter) is what a parameter does to the
//! port at a fixed state, `k` what it does to the force, relative to it (see [`Drift`]).
//!
//! Validation: `tests/march/variation.rs` compares with differences of the flow, with its determinant and with closed forms.

use super::collocation::{COLLOCATION, NODES};
use super::kernel::{Kernel, Layout};
use super::lane::Lane;
use super::marcher::{MarchError, Marcher};
use super::state::{columns, pushed};
use super::table::Table;
use super::totals::ContactStatistics;
use super::trajectory::{Segment, Trajectory};
use crate::contact::{ContactLaw, Law, Slopes};
use faer::{Mat, c64};

/// What a parameter does at a fixed state `y`, per unit of the parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drift {
    /// Per tone: change of the complex port displacement (m) and of the angular frequency (rad/s).
    pub tones: Vec<(c64, f64)>,
    /// Change of the gap, m.
    pub gap_m: f64,
    /// Change of the contact force, relative to it.
    pub force_relative: f64,
}

/// A marched stretch with its derivative.
#[derive(Debug, Clone, PartialEq)]
pub struct Variation {
    /// State at the end, block coordinates.
    pub end: Vec<f64>,
    /// `d end / d start`, `n x n`.
    pub jacobian: Mat<f64>,
    /// `d end / d parameter` at a fixed duration.
    pub drift: Vec<f64>,
    /// `d end / d duration`, 1/s.
    pub rate: Vec<f64>,
    /// Contacts on the way.
    pub statistics: ContactStatistics,
    /// Energy delivered to each load, J.
    pub loads_j: Vec<f64>,
    /// The march itself.
    pub trajectory: Trajectory,
}

/// A derivative that does not exist or could not be had.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VariationError {
    /// The march itself.
    #[error(transparent)]
    March(#[from] MarchError),
    /// Rest on a rigid stop.
    #[error(
        "at t = {time_s} s the point comes to rest on the rigid stop, where the derivative of the flow loses rank; use a compliant law or a larger restitution"
    )]
    Rests {
        /// Time, s.
        time_s: f64,
    },
}

impl Variation {
    /// Marches from block coordinates `start` at `start_s` and linearises the flow along the way.
    ///
    /// # Errors
    /// [`VariationError`].
    pub fn march(
        kernel: &Kernel,
        start: &[f64],
        start_s: f64,
        duration_s: f64,
        tolerance: f64,
        drift: &Drift,
    ) -> Result<Self, VariationError> {
        let mut marcher = Marcher::new(kernel, start, start_s, tolerance)?;
        marcher.start_record();
        marcher.advance_to(start_s + duration_s)?;
        let (end, force_n) = (marcher.state(), marcher.force_n());
        let (statistics, loads_j) = (*marcher.statistics(), marcher.energies().loads_j);
        let trajectory = marcher.take_record();
        let mut flow = Flow::new(kernel, drift);
        for (index, segment) in trajectory.segments().iter().enumerate() {
            let next = trajectory.segments().get(index + 1);
            flow.segment(segment, next, &end)?;
        }
        let mut rate = kernel.plant.diagonal.block.apply(&end);
        if let Some(port) = kernel.plant.ports.first() {
            rate.iter_mut().zip(&port.force).for_each(|(rate, b)| *rate += b * force_n);
        }
        let n = end.len();
        let jacobian = Mat::from_fn(n, n, |i, j| flow.rows[i][j]);
        let drift = flow.rows.iter().map(|row| row[n]).collect();
        Ok(Self { end, jacobian, drift, rate, statistics, loads_j, trajectory })
    }
}

/// The linearised flow so far: a row per state, a column per start state and one for the parameter.
struct Flow<'a> {
    kernel: &'a Kernel,
    drift: &'a Drift,
    layout: Layout,
    rows: Vec<Vec<f64>>,
    /// Flight not yet applied, s.
    pending_s: f64,
}

impl<'a> Flow<'a> {
    fn new(kernel: &'a Kernel, drift: &'a Drift) -> Self {
        let n = kernel.plant.len();
        let rows = (0..n).map(|i| (0..=n).map(|j| f64::from(u8::from(i == j))).collect()).collect();
        Self { kernel, drift, layout: Layout::of(&kernel.plant), rows, pending_s: 0.0 }
    }

    /// Passes one step; `next` (or `end`) tells what followed.
    fn segment(&mut self, segment: &Segment, next: Option<&Segment>, end: &[f64]) -> Result<(), VariationError> {
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        let strikes = next.is_some_and(|next| next.force_n.is_some());
        match (segment.force_n, law) {
            (Some(_), Some(Law::Rigid(_))) => return Err(VariationError::Rests { time_s: segment.start_s }),
            (Some(force), Some(Law::Hertz(law))) => self.contact(law, segment, &force),
            (Some(force), Some(Law::KelvinVoigt(law))) => self.contact(law, segment, &force),
            (Some(force), Some(Law::HuntCrossley(law))) => self.contact(law, segment, &force),
            (_, law) => {
                self.pending_s += segment.length_s;
                match law {
                    Some(Law::KelvinVoigt(law)) if strikes => self.entry(law, segment),
                    Some(Law::Rigid(_)) => self.impact(segment, next.map_or(end, |next| &next.state)),
                    _ => {}
                }
            }
        }
        if next.is_none() {
            self.fly();
        }
        Ok(())
    }

    /// Applies the flight that has gathered.
    fn fly(&mut self) {
        if self.pending_s == 0.0 {
            return;
        }
        let block = &self.kernel.plant.diagonal.block;
        for (k, pair) in block.pairs.iter().enumerate() {
            turn(&mut self.rows, k, pair.flow(self.pending_s));
        }
        let first = 2 * block.pairs.len();
        for (k, rate) in block.reals.iter().enumerate() {
            let decay = (rate * self.pending_s).exp();
            self.rows[first + k].iter_mut().for_each(|value| *value *= decay);
        }
        self.pending_s = 0.0;
    }

    /// One step in contact.
    fn contact<L: ContactLaw>(&mut self, law: L, segment: &Segment, force: &[f64; NODES]) {
        self.fly();
        let kernel = self.kernel;
        let level = Kernel::level_within(segment.length_s);
        let odd;
        let table = if Kernel::length_s(level) == segment.length_s {
            kernel.table(0, level)
        } else {
            odd = Table::new(kernel, 0, segment.length_s);
            &odd
        };
        let nodes_s: [f64; NODES] = std::array::from_fn(|i| segment.start_s + segment.length_s * COLLOCATION.nodes[i]);
        let slopes = self.slopes(law, table, segment, force, &nodes_s);
        let width = self.rows.len() + 1;
        let mut right = vec![vec![0.0; width]; NODES];
        for state in 0..self.rows.len() {
            let column = self.column(state);
            let (place, speed) = (&table.displacement.columns[column].0, &table.velocity.columns[column].0);
            for i in 0..NODES {
                let factor = slopes[i].stiffness_n_m * place[i] + slopes[i].damping_n_s_m * speed[i];
                add_scaled(&mut right[i], factor, &self.rows[state]);
            }
        }
        for i in 0..NODES {
            let (dw, dv) = self.port_drift(nodes_s[i]);
            right[i][width - 1] += slopes[i].stiffness_n_m * dw + slopes[i].damping_n_s_m * dv + self.drift.force_relative * force[i];
        }
        let mut matrix = [[0.0; NODES]; NODES];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let (place, speed) = (table.displacement.push[j].0[i], table.velocity.push[j].0[i]);
                *entry = f64::from(u8::from(i == j)) - slopes[i].stiffness_n_m * place - slopes[i].damping_n_s_m * speed;
            }
        }
        eliminate(&mut matrix, &mut right);
        self.flow_of(table);
        for state in 0..self.rows.len() {
            let (lane, place) = self.layout.place(state);
            for j in 0..NODES {
                add_scaled(&mut self.rows[state], table.push[j][lane].0[place], &right[j]);
            }
        }
    }

    /// Slopes of the law at the nodes of a step.
    fn slopes<L: ContactLaw>(
        &self,
        law: L,
        table: &Table,
        segment: &Segment,
        force: &[f64; NODES],
        nodes_s: &[f64; NODES],
    ) -> [Slopes; NODES] {
        let y = self.layout.pack(&segment.state);
        let lane = Lane(std::array::from_fn(|i| if i < NODES { force[i] } else { 0.0 }));
        let penetration = pushed::<false>(columns::<false>(&self.layout, &y, &table.displacement.columns), &table.displacement.push, &lane);
        let rate = pushed::<false>(columns::<false>(&self.layout, &y, &table.velocity.columns), &table.velocity.push, &lane);
        let gap_m = self.kernel.plant.system.stops[0].gap_m;
        std::array::from_fn(|i| {
            let (place, speed) = self.driven(nodes_s[i]);
            let depth = penetration.0[i] + place - gap_m;
            // Past the surface the force is zero whatever the state.
            if depth <= 0.0 { Slopes { stiffness_n_m: 0.0, damping_n_s_m: 0.0 } } else { law.slopes(depth, rate.0[i] + speed) }
        })
    }

    /// A contact whose force starts with a jump.
    fn entry<L: ContactLaw>(&mut self, law: L, segment: &Segment) {
        self.fly();
        let port = &self.kernel.plant.ports[0];
        let before = self.kernel.plant.diagonal.block.flow(segment.length_s, &segment.state);
        let (_, speed) = self.driven(segment.start_s + segment.length_s);
        let rate = dot(&port.velocity, &before) + speed;
        let jump = law.force_n(0.0, rate) / rate;
        let mut struck = self.along(&port.displacement);
        struck[self.rows.len()] += self.port_drift(segment.start_s + segment.length_s).0;
        for (row, b) in self.rows.iter_mut().zip(&port.force) {
            add_scaled(row, b * jump, &struck);
        }
    }

    /// An impact on a rigid stop, if there was one between the end of a flight and the state that followed.
    fn impact(&mut self, segment: &Segment, after: &[f64]) {
        let (plant, port) = (&self.kernel.plant, &self.kernel.plant.ports[0]);
        let block = &plant.diagonal.block;
        let before = block.flow(segment.length_s, &segment.state);
        let time_s = segment.start_s + segment.length_s;
        let (_, driven) = self.driven(time_s);
        let (fast, slow) = (dot(&port.velocity, &before) + driven, dot(&port.velocity, after) + driven);
        let impulse = (fast - slow) / port.mobility_per_kg;
        if fast <= 0.0 || impulse * port.mobility_per_kg <= 1e-9 * fast {
            return;
        }
        self.fly();
        let gain = impulse / fast;
        let turning: f64 = (plant.tones.iter().zip(&port.steady_m))
            .map(|(tone, s)| -(s * c64::cis(tone.angular_frequency_rad_s * time_s)).re * tone.angular_frequency_rad_s.powi(2))
            .sum();
        let acceleration = dot(&self.kernel.acceleration_row(), &before) + turning;
        let (mut struck, mut hastened) = (self.along(&port.displacement), self.along(&port.velocity));
        let (dw, dv) = self.port_drift(time_s);
        struck[self.rows.len()] += dw;
        hastened[self.rows.len()] += dv;
        let kick = block.apply(&port.force);
        for ((row, b), ab) in self.rows.iter_mut().zip(&port.force).zip(&kick) {
            add_scaled(row, b * gain, &hastened);
            add_scaled(row, -(b * gain * acceleration - ab * impulse) / fast, &struck);
        }
    }

    /// `row . dy` for every column.
    fn along(&self, row: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.rows.len() + 1];
        row.iter().zip(&self.rows).for_each(|(factor, values)| add_scaled(&mut sum, *factor, values));
        sum
    }

    /// Displacement and velocity of the port under the drive.
    fn driven(&self, time_s: f64) -> (f64, f64) {
        let plant = &self.kernel.plant;
        (plant.tones.iter().zip(&plant.ports[0].steady_m)).fold((0.0, 0.0), |(place, speed), (tone, s)| {
            let turned = s * c64::cis(tone.angular_frequency_rad_s * time_s);
            (place + turned.re, speed - tone.angular_frequency_rad_s * turned.im)
        })
    }

    /// What the parameter does to displacement and velocity of the port at a fixed state.
    fn port_drift(&self, time_s: f64) -> (f64, f64) {
        let plant = &self.kernel.plant;
        let steady = plant.tones.iter().zip(&plant.ports[0].steady_m);
        steady.zip(&self.drift.tones).fold((-self.drift.gap_m, 0.0), |(place, speed), ((tone, s), (ds, dw))| {
            let w = tone.angular_frequency_rad_s;
            let turn = c64::cis(w * time_s);
            let change = ds + s * c64::new(0.0, time_s * dw);
            let hastened = change * c64::new(0.0, w) + s * c64::new(0.0, *dw);
            (place + (change * turn).re, speed + (hastened * turn).re)
        })
    }

    /// Place of a state among the columns of a table.
    fn column(&self, state: usize) -> usize {
        let pairs = self.layout.pairs;
        if state < 2 * pairs { (state % 2) * pairs + state / 2 } else { state }
    }

    fn flow_of(&mut self, table: &Table) {
        for k in 0..self.layout.pairs {
            let (lane, place) = self.layout.place(2 * k);
            turn(&mut self.rows, k, std::array::from_fn(|entry| table.pair_flow[entry][lane].0[place]));
        }
        let first = 2 * self.layout.pairs;
        for k in 0..self.layout.reals {
            let (lane, place) = self.layout.place(first + k);
            let decay = table.real_flow[lane - 2 * self.layout.pair_lanes].0[place];
            self.rows[first + k].iter_mut().for_each(|value| *value *= decay);
        }
    }
}

/// Turns the two rows of pair `k`.
fn turn(rows: &mut [Vec<f64>], k: usize, [a, b, c, d]: [f64; 4]) {
    let (low, high) = rows.split_at_mut(2 * k + 1);
    for (u, v) in low[2 * k].iter_mut().zip(high[0].iter_mut()) {
        (*u, *v) = (a * *u + b * *v, c * *u + d * *v);
    }
}

#[inline(always)]
fn add_scaled(sum: &mut [f64], factor: f64, values: &[f64]) {
    if factor != 0.0 {
        sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
    }
}

fn dot(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(r, v)| r * v).sum()
}

/// Solves for all right sides at once, by elimination with row exchange; the matrix is the identity plus a small integration.
fn eliminate(matrix: &mut [[f64; NODES]; NODES], right: &mut [Vec<f64>]) {
    for k in 0..NODES {
        let pivot = (k..NODES).max_by(|i, j| matrix[*i][k].abs().total_cmp(&matrix[*j][k].abs())).unwrap_or(k);
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let inverse = 1.0 / matrix[k][k];
        let (row, own) = (matrix[k], std::mem::take(&mut right[k]));
        for i in 0..NODES {
            let factor = matrix[i][k] * inverse;
            if i != k && factor != 0.0 {
                (k..NODES).for_each(|j| matrix[i][j] -= factor * row[j]);
                add_scaled(&mut right[i], -factor, &own);
            }
        }
        right[k] = own;
    }
    for k in 0..NODES {
        let inverse = 1.0 / matrix[k][k];
        right[k].iter_mut().for_each(|value| *value *= inverse);
    }
}
