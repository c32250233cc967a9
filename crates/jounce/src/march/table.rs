//! Everything that a step of one length needs, computed once per plant: exact flow, Duhamel weights of the contact force, rows
//! of the port displacement at the nodes, and the bounds that prove a flight free of contact.

use super::collocation::{COLLOCATION, NODES, legendre};
use super::duhamel::{Duhamel, Responses};
use super::flight_table::FlightTable;
use super::kernel::{Kernel, Layout};
use super::lane::{Lane, WIDTH};
use crate::plant::Pair;
use faer::c64;

/// A row of the state, seen at the nodes and at the end of a step: `value(x_i) = sum_k columns_k y_k + sum_j push_j f_j`.
#[derive(Debug, Clone, Default)]
pub struct Response {
    /// One lane per state in column order: seven nodes and the end.
    pub columns: Vec<Lane>,
    /// One lane per force node.
    pub push: [Lane; NODES],
    /// Sum of `push`: the answer to a constant unit force.
    pub push_sum: Lane,
}

/// Tables of one step length and one port.
#[derive(Debug, Clone)]
pub struct Table {
    /// Length, s.
    pub length_s: f64,
    /// Entries `a, b, c, d` of the flow of the pairs, then the flow of the reals.
    pub pair_flow: [Vec<Lane>; 4],
    /// Flow of the reals.
    pub real_flow: Vec<Lane>,
    /// State at the end of the step per unit nodal force.
    pub push: [Vec<Lane>; NODES],
    /// Displacement of the port.
    pub displacement: Response,
    /// Velocity of the port.
    pub velocity: Response,
    /// Per load: `P b` of its energy meter, integrated over the step against each nodal polynomial.
    pub loads: Vec<Response>,
    /// The same for the damping meter.
    pub damping: Response,
    /// The proof of no contact.
    pub flight: FlightTable,
}

/// What rest on a rigid stop needs on a step, made when it happens.
#[derive(Debug, Clone)]
pub struct Sticking {
    /// Relative acceleration of the port, without the direct share of the force.
    pub acceleration: Response,
    /// From free accelerations at the nodes to the nodal forces that cancel them, kg.
    pub inverse: [[f64; NODES]; NODES],
}

impl Sticking {
    /// For the step of a table.
    pub fn new(kernel: &Kernel, table: &Table) -> Self {
        use faer::linalg::solvers::DenseSolveCore;
        let (plant, h) = (&kernel.plant, table.length_s);
        let unit = unit_responses(kernel, h);
        let blocks = forced(kernel, &unit, &plant.ports[0].force, h);
        let acceleration = Flows::new(kernel, &unit, h).pointwise(&Layout::of(plant), &kernel.acceleration_row(), &blocks);
        let mobility = plant.ports[0].mobility_per_kg;
        let system = faer::Mat::from_fn(NODES, NODES, |i, j| (if i == j { mobility } else { 0.0 }) - acceleration.push[j].0[i]);
        let inverse = system.partial_piv_lu().inverse();
        Self { acceleration, inverse: std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)])) }
    }
}

/// Response of one block to the contact force.
#[derive(Debug, Clone)]
pub(super) struct BlockResponse {
    /// States of the block.
    pub states: Vec<usize>,
    /// Per Legendre force: Legendre coefficients in time of each state of the block.
    pub time: Vec<[Vec<f64>; NODES]>,
}

impl Response {
    fn new(columns: Vec<Lane>, push: [Lane; NODES]) -> Self {
        let push_sum = push.iter().fold(Lane::ZERO, |sum, lane| sum.add(lane));
        Self { columns, push, push_sum }
    }
}

impl Table {
    /// Makes the table of a length.
    pub fn new(kernel: &Kernel, port: usize, length_s: f64) -> Self {
        let plant = &kernel.plant;
        let layout = Layout::of(plant);
        let no_port = || vec![0.0; plant.len()];
        let (displacement, velocity, force) = match plant.ports.get(port) {
            Some(port) => (port.displacement.clone(), port.velocity.clone(), port.force.clone()),
            None => (no_port(), no_port(), no_port()),
        };
        let meter_row = |meter: &crate::plant::EnergyMeter| {
            if plant.ports.is_empty() { no_port() } else { meter.port_row(port).to_vec() }
        };
        let unit = unit_responses(kernel, length_s);
        let blocks = forced(kernel, &unit, &force, length_s);
        let flows = Flows::new(kernel, &unit, length_s);
        let integral = |row: &[f64]| flows.integral(&layout, row, &blocks, length_s);
        Self {
            length_s,
            pair_flow: flows.pair_entries(&layout),
            real_flow: flows.real_entries(&layout),
            push: push(&layout, &blocks),
            displacement: flows.pointwise(&layout, &displacement, &blocks),
            velocity: flows.pointwise(&layout, &velocity, &blocks),
            loads: kernel.meters.loads.iter().map(|meter| integral(&meter_row(meter))).collect(),
            damping: integral(&meter_row(&kernel.meters.damping)),
            flight: FlightTable::new(kernel, &layout, &displacement, &velocity, length_s),
        }
    }
}

/// Nodal coefficients from Legendre coefficients of the force.
fn to_nodal(legendre: &[f64; NODES]) -> [f64; NODES] {
    std::array::from_fn(|j| (0..NODES).map(|b| legendre[b] * COLLOCATION.from_nodal[b][j]).sum())
}

/// One block's answer to each Legendre force on a step, before the size of the force comes in.
struct UnitResponse {
    duhamel: Duhamel,
    responses: Responses,
}

/// Unit answers of the pairs, then of the reals.
fn unit_responses(kernel: &Kernel, h: f64) -> Vec<UnitResponse> {
    let block = &kernel.plant.diagonal.block;
    let pairs = block.pairs.iter().map(crate::plant::Pair::eigenvalue);
    let values = pairs.chain(block.reals.iter().map(|rate| c64::new(*rate, 0.0)));
    values
        .map(|value| {
            let duhamel = Duhamel::new(value * h);
            UnitResponse { responses: duhamel.responses(), duhamel }
        })
        .collect()
}

/// Response of every state to each Legendre force through `force`, as Legendre coefficients in time.
pub(super) fn block_responses(kernel: &Kernel, force: &[f64], h: f64) -> Vec<BlockResponse> {
    forced(kernel, &unit_responses(kernel, h), force, h)
}

fn forced(kernel: &Kernel, unit: &[UnitResponse], force: &[f64], h: f64) -> Vec<BlockResponse> {
    let block = &kernel.plant.diagonal.block;
    let part = |responses: &Responses, factor: c64, imaginary: bool| -> [Vec<f64>; NODES] {
        std::array::from_fn(|b| responses[b].iter().map(|y| if imaginary { (factor * y).im } else { (factor * y).re }).collect())
    };
    let mut all = Vec::with_capacity(block.len());
    for (k, pair) in block.pairs.iter().enumerate() {
        let states = vec![2 * k, 2 * k + 1];
        let [bu, bv] = [force[2 * k] * h, force[2 * k + 1] * h];
        let time = match *pair {
            Pair::Oscillatory { .. } => {
                let (responses, factor) = (&unit[k].responses, c64::new(bu, bv));
                vec![part(responses, factor, false), part(responses, factor, true)]
            }
            Pair::Jordan { .. } => {
                let duhamel = &unit[k].duhamel;
                let v = part(&unit[k].responses, c64::new(bv, 0.0), false);
                let u = std::array::from_fn(|b| {
                    let mut drive: Vec<c64> = v[b].iter().map(|v| c64::new(v * h, 0.0)).collect();
                    drive[b] += bu;
                    duhamel.respond(&drive).iter().map(|y| y.re).collect()
                });
                vec![u, v]
            }
        };
        all.push(BlockResponse { states, time });
    }
    let first = 2 * block.pairs.len();
    for k in 0..block.reals.len() {
        let time = vec![part(&unit[block.pairs.len() + k].responses, c64::new(force[first + k] * h, 0.0), false)];
        all.push(BlockResponse { states: vec![first + k], time });
    }
    all
}

/// State at the end of the step per nodal force: the Legendre series at 1 is the sum of its coefficients.
fn push(layout: &Layout, blocks: &[BlockResponse]) -> [Vec<Lane>; NODES] {
    let states = 2 * layout.pairs + layout.reals;
    let mut ends = vec![[0.0; NODES]; states];
    for block in blocks {
        for (state, time) in block.states.iter().zip(&block.time) {
            ends[*state] = to_nodal(&std::array::from_fn(|b| time[b].iter().sum()));
        }
    }
    std::array::from_fn(|j| layout.pack(&ends.iter().map(|end| end[j]).collect::<Vec<_>>()))
}

/// Flow of every block to every node and to the end.
struct Flows {
    pairs: Vec<[[f64; 4]; WIDTH]>,
    reals: Vec<[f64; WIDTH]>,
    /// `int_0^1 e^{J h x} P_b(x) dx` per block: entries of the 2 x 2 (or 1 x 1) matrix per Legendre polynomial.
    pair_moments: Vec<[[f64; 4]; NODES]>,
    real_moments: Vec<[f64; NODES]>,
}

impl Flows {
    fn new(kernel: &Kernel, unit: &[UnitResponse], h: f64) -> Self {
        let block = &kernel.plant.diagonal.block;
        let time = |i: usize| h * if i < NODES { COLLOCATION.nodes[i] } else { 1.0 };
        // By x -> 1 - x the moments of the flow are the end values of the Duhamel responses, up to sign.
        let sign = |b: usize| if b.is_multiple_of(2) { 1.0 } else { -1.0 };
        let end = |y: &[c64]| y.iter().sum::<c64>();
        let pair_moments = |(pair, unit): (&Pair, &UnitResponse)| -> [[f64; 4]; NODES] {
            let responses = &unit.responses;
            match *pair {
                Pair::Oscillatory { .. } => std::array::from_fn(|b| {
                    let m = end(&responses[b]) * sign(b);
                    [m.re, -m.im, m.im, m.re]
                }),
                Pair::Jordan { .. } => {
                    let duhamel = &unit.duhamel;
                    std::array::from_fn(|b| {
                        let (one, two) = (end(&responses[b]).re * sign(b), end(&duhamel.respond(&responses[b])).re * sign(b));
                        [one, h * two, 0.0, one]
                    })
                }
            }
        };
        Self {
            pairs: block.pairs.iter().map(|pair| std::array::from_fn(|i| pair.flow(time(i)))).collect(),
            reals: block.reals.iter().map(|rate| std::array::from_fn(|i| (rate * time(i)).exp())).collect(),
            pair_moments: block.pairs.iter().zip(unit).map(pair_moments).collect(),
            real_moments: (unit[block.pairs.len()..].iter())
                .map(|unit| std::array::from_fn(|b| end(&unit.responses[b]).re * sign(b)))
                .collect(),
        }
    }

    fn pair_entries(&self, layout: &Layout) -> [Vec<Lane>; 4] {
        std::array::from_fn(|entry| {
            let mut lanes = vec![Lane::ZERO; layout.pair_lanes];
            self.pairs.iter().enumerate().for_each(|(k, flow)| lanes[k / WIDTH].0[k % WIDTH] = flow[NODES][entry]);
            lanes
        })
    }

    fn real_entries(&self, layout: &Layout) -> Vec<Lane> {
        let mut lanes = vec![Lane::ZERO; layout.real_lanes];
        self.reals.iter().enumerate().for_each(|(k, flow)| lanes[k / WIDTH].0[k % WIDTH] = flow[NODES]);
        lanes
    }

    /// A row at the nodes and at the end of the step.
    fn pointwise(&self, layout: &Layout, row: &[f64], blocks: &[BlockResponse]) -> Response {
        let first = 2 * layout.pairs;
        let column = |state: usize| -> Lane {
            Lane(std::array::from_fn(|i| match state.checked_sub(first) {
                Some(real) => row[state] * self.reals[real][i],
                None => {
                    let flow = &self.pairs[state / 2][i];
                    row[state & !1] * flow[state % 2] + row[state | 1] * flow[2 + state % 2]
                }
            }))
        };
        let series = row_series(row, blocks);
        let mut push = [Lane::ZERO; NODES];
        for i in 0..WIDTH {
            let x = if i < NODES { COLLOCATION.nodes[i] } else { 1.0 };
            let basis = legendre(x, series[0].len());
            let at = to_nodal(&std::array::from_fn(|b| series[b].iter().zip(&basis).map(|(y, p)| y * p).sum()));
            (0..NODES).for_each(|j| push[j].0[i] = at[j]);
        }
        Response::new(layout.column_order().into_iter().map(column).collect(), push)
    }

    /// A row integrated over the step against each nodal polynomial.
    fn integral(&self, layout: &Layout, row: &[f64], blocks: &[BlockResponse], h: f64) -> Response {
        let first = 2 * layout.pairs;
        let column = |state: usize| -> Lane {
            let moments: [f64; NODES] = std::array::from_fn(|b| match state.checked_sub(first) {
                Some(real) => row[state] * self.real_moments[real][b],
                None => {
                    let m = &self.pair_moments[state / 2][b];
                    row[state & !1] * m[state % 2] + row[state | 1] * m[2 + state % 2]
                }
            });
            let nodal = to_nodal(&moments);
            Lane(std::array::from_fn(|i| if i < NODES { h * nodal[i] } else { 0.0 }))
        };
        let series = row_series(row, blocks);
        // int P_a y = y_a / (2 a + 1)
        let by_force: [[f64; NODES]; NODES] =
            std::array::from_fn(|b| to_nodal(&std::array::from_fn(|a| series[b][a] / (2 * a + 1) as f64)));
        let nodal: [[f64; NODES]; NODES] = std::array::from_fn(|i| to_nodal(&std::array::from_fn(|b| by_force[b][i])));
        let push = std::array::from_fn(|j| Lane(std::array::from_fn(|i| if i < NODES { h * nodal[i][j] } else { 0.0 })));
        Response::new(layout.column_order().into_iter().map(column).collect(), push)
    }
}

/// Legendre series in time of a row's response to each Legendre force.
fn row_series(row: &[f64], blocks: &[BlockResponse]) -> [Vec<f64>; NODES] {
    let longest = blocks.iter().flat_map(|block| block.time.iter().map(|time| time[0].len())).max().unwrap_or(NODES);
    std::array::from_fn(|b| {
        let mut sum = vec![0.0; longest];
        for block in blocks {
            for (state, time) in block.states.iter().zip(&block.time) {
                sum.iter_mut().zip(&time[b]).for_each(|(s, y)| *s += row[*state] * y);
            }
        }
        sum
    })
}
