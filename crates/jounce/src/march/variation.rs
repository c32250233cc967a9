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
use super::lane::{Lane, WIDTH};
use super::marcher::{MarchError, Marcher};
use super::state::{columns, pushed};
use super::table::Table;
use super::totals::ContactStatistics;
use super::trajectory::{Segment, Trajectory};
use crate::contact::{ContactLaw, Law, Slopes};
use faer::{Mat, c64};
use pulp::{Arch, Simd, WithSimd};

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
        let jacobian = Mat::from_fn(n, n, |i, j| flow.entry(i, j));
        let drift = (0..n).map(|i| flow.entry(i, n)).collect();
        Ok(Self { end, jacobian, drift, rate, statistics, loads_j, trajectory })
    }
}

/// The linearised flow so far: a row of lanes per state; its numbers belong to the start states, the one after them to the parameter.
struct Flow<'a> {
    kernel: &'a Kernel,
    drift: &'a Drift,
    layout: Layout,
    states: usize,
    /// Lanes per row.
    width: usize,
    rows: Vec<Lane>,
    /// Flight not yet applied, s.
    pending_s: f64,
}

/// Rows of nodal forces of a step.
type NodeRows = [Vec<Lane>; NODES];

impl<'a> Flow<'a> {
    fn new(kernel: &'a Kernel, drift: &'a Drift) -> Self {
        let states = kernel.plant.len();
        let width = (states + 1).div_ceil(WIDTH);
        let mut rows = vec![Lane::ZERO; states * width];
        (0..states).for_each(|i| rows[i * width + i / WIDTH].0[i % WIDTH] = 1.0);
        Self { kernel, drift, layout: Layout::of(&kernel.plant), states, width, rows, pending_s: 0.0 }
    }

    /// Derivative of a state by a start state, or by the parameter.
    fn entry(&self, state: usize, column: usize) -> f64 {
        self.rows[state * self.width + column / WIDTH].0[column % WIDTH]
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
                    Some(Law::KelvinVoigt(law)) if strikes => self.strike(law, segment),
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
            self.turn(k, pair.flow(self.pending_s));
        }
        for (k, rate) in block.reals.iter().enumerate() {
            self.decay(k, (rate * self.pending_s).exp());
        }
        self.pending_s = 0.0;
    }

    /// One step in contact, in code compiled for the vector instructions of this machine.
    fn contact<L: ContactLaw>(&mut self, law: L, segment: &Segment, force: &[f64; NODES]) {
        Arch::new().dispatch(Pass { flow: self, law, segment, force });
    }

    #[inline(always)]
    fn pass<L: ContactLaw, const FMA: bool>(&mut self, law: L, segment: &Segment, force: &[f64; NODES]) {
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
        let mut right: NodeRows = std::array::from_fn(|_| vec![Lane::ZERO; self.width]);
        for state in 0..self.states {
            let column = self.column(state);
            let (place, speed) = (&table.displacement.columns[column].0, &table.velocity.columns[column].0);
            let row = &self.rows[state * self.width..(state + 1) * self.width];
            for i in 0..NODES {
                let factor = slopes[i].stiffness_n_m * place[i] + slopes[i].damping_n_s_m * speed[i];
                add_scaled::<FMA>(&mut right[i], factor, row);
            }
        }
        for i in 0..NODES {
            let (dw, dv) = self.port_drift(nodes_s[i]);
            let own = slopes[i].stiffness_n_m * dw + slopes[i].damping_n_s_m * dv + self.drift.force_relative * force[i];
            right[i][self.states / WIDTH].0[self.states % WIDTH] += own;
        }
        let mut matrix = [[0.0; NODES]; NODES];
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let (place, speed) = (table.displacement.push[j].0[i], table.velocity.push[j].0[i]);
                *entry = f64::from(u8::from(i == j)) - slopes[i].stiffness_n_m * place - slopes[i].damping_n_s_m * speed;
            }
        }
        eliminate::<FMA>(&mut matrix, &mut right);
        self.flow_of(table);
        for (state, row) in self.rows.chunks_exact_mut(self.width).enumerate() {
            let (lane, place) = self.layout.place(state);
            for (push, right) in table.push.iter().zip(&right) {
                add_scaled::<FMA>(row, push[lane].0[place], right);
            }
        }
    }

    /// Slopes of the law at the nodes of a step.
    #[inline(always)]
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
    fn strike<L: ContactLaw>(&mut self, law: L, segment: &Segment) {
        self.fly();
        let port = &self.kernel.plant.ports[0];
        let before = self.kernel.plant.diagonal.block.flow(segment.length_s, &segment.state);
        let (_, speed) = self.driven(segment.start_s + segment.length_s);
        let rate = dot(&port.velocity, &before) + speed;
        let jump = law.force_n(0.0, rate) / rate;
        let struck = self.along(&port.displacement, self.port_drift(segment.start_s + segment.length_s).0);
        for (row, b) in self.rows.chunks_exact_mut(self.width).zip(&port.force) {
            add_scaled::<false>(row, b * jump, &struck);
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
        let (dw, dv) = self.port_drift(time_s);
        let (struck, hastened) = (self.along(&port.displacement, dw), self.along(&port.velocity, dv));
        let kick = block.apply(&port.force);
        for ((row, b), ab) in self.rows.chunks_exact_mut(self.width).zip(&port.force).zip(&kick) {
            add_scaled::<false>(row, b * gain, &hastened);
            add_scaled::<false>(row, -(b * gain * acceleration - ab * impulse) / fast, &struck);
        }
    }

    /// `row . dy` for every column, and what the parameter adds to it.
    fn along(&self, row: &[f64], drift: f64) -> Vec<Lane> {
        let mut sum = vec![Lane::ZERO; self.width];
        row.iter().zip(self.rows.chunks_exact(self.width)).for_each(|(factor, values)| add_scaled::<false>(&mut sum, *factor, values));
        sum[self.states / WIDTH].0[self.states % WIDTH] += drift;
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

    #[inline(always)]
    fn flow_of(&mut self, table: &Table) {
        for k in 0..self.layout.pairs {
            let (lane, place) = self.layout.place(2 * k);
            self.turn(k, std::array::from_fn(|entry| table.pair_flow[entry][lane].0[place]));
        }
        for k in 0..self.layout.reals {
            let (lane, place) = self.layout.place(2 * self.layout.pairs + k);
            self.decay(k, table.real_flow[lane - 2 * self.layout.pair_lanes].0[place]);
        }
    }

    /// Turns the two rows of pair `k`.
    #[inline(always)]
    fn turn(&mut self, k: usize, [a, b, c, d]: [f64; 4]) {
        let (low, high) = self.rows.split_at_mut((2 * k + 1) * self.width);
        for (u, v) in low[2 * k * self.width..].iter_mut().zip(high.iter_mut()) {
            for i in 0..WIDTH {
                (u.0[i], v.0[i]) = (a * u.0[i] + b * v.0[i], c * u.0[i] + d * v.0[i]);
            }
        }
    }

    /// Shrinks the row of real state `k`.
    #[inline(always)]
    fn decay(&mut self, k: usize, factor: f64) {
        let first = (2 * self.layout.pairs + k) * self.width;
        self.rows[first..first + self.width].iter_mut().for_each(|lane| *lane = lane.map(|value| value * factor));
    }
}

/// A step to be passed.
struct Pass<'p, 'a, L> {
    flow: &'p mut Flow<'a>,
    law: L,
    segment: &'p Segment,
    force: &'p [f64; NODES],
}

impl<L: ContactLaw> WithSimd for Pass<'_, '_, L> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        // Machines with vectors of four numbers or more fuse multiply and add.
        if S::F64_LANES >= 4 {
            self.flow.pass::<L, true>(self.law, self.segment, self.force);
        } else {
            self.flow.pass::<L, false>(self.law, self.segment, self.force);
        }
    }
}

#[inline(always)]
fn add_scaled<const FMA: bool>(sum: &mut [Lane], factor: f64, values: &[Lane]) {
    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum = sum.add_scaled::<FMA>(factor, value));
}

fn dot(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(r, v)| r * v).sum()
}

/// Solves for all right sides at once, by elimination with row exchange; the matrix is the identity plus a small integration.
#[inline(always)]
fn eliminate<const FMA: bool>(matrix: &mut [[f64; NODES]; NODES], right: &mut NodeRows) {
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
                add_scaled::<FMA>(&mut right[i], -factor, &own);
            }
        }
        right[k] = own;
    }
    for k in 0..NODES {
        let inverse = 1.0 / matrix[k][k];
        right[k].iter_mut().for_each(|lane| *lane = lane.map(|value| value * inverse));
    }
}
