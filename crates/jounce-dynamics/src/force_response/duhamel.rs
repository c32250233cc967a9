//! Effect of the nodal forces of a step on the blocks: the integrals `int f a dt` and `int f b dt`
//! of the entries of the flow (see [`crate::flow::row`]). They are counted from the start of the
//! step and towards its end.
//!
//! Integrals towards the end move the state: `y(h) = e^{A h} y(0) + int f(t) e^{A (h - t)} c dt`
//! (Duhamel). Integrals from the start give the work of the force on the free motion:
//! `int f(t) r e^{A t} y(0) dt`.
//!
//! Functions with nodes symmetric about the middle of the step need one table for both. Force and
//! table are split into even and odd halves; the halves enter with equal signs from the start and
//! with opposite signs towards the end. Each step reads half as much as with a table for the state
//! and one for each meter.

use super::basis::NODES;
use crate::flow::row::FlowRow;
use crate::flow::state::{add_spread_response, spread};
use jounce_simd::{F64x8, Simd};

/// Middle node.
const MIDDLE_NODE: usize = NODES / 2;

/// Per vector of integrals (`a` of all pairs, `b` of all pairs, single rates), one vector per nodal
/// force.
pub type DuhamelIntegrals = Vec<[F64x8; NODES]>;

/// Integrals of a step.
#[derive(Debug, Clone)]
pub enum Duhamel {
    /// For a symmetric basis: even halves of the nodes up to the middle, then odd halves of the
    /// nodes before it.
    Mirrored(DuhamelIntegrals),
    /// For any basis: from the start, and towards the end.
    Each([DuhamelIntegrals; 2]),
}

impl Duhamel {
    /// Folds the integrals from the start of a symmetric basis.
    pub fn mirrored(from_start: &[[F64x8; NODES]]) -> Self {
        let half = |lanes: &[F64x8; NODES], j: usize, sign: f64| {
            F64x8::ZERO
                .add_scaled(0.5, &lanes[j])
                .add_scaled(0.5 * sign, &lanes[NODES - 1 - j])
        };
        let halves = |lanes: &[F64x8; NODES]| {
            std::array::from_fn(|j| match j {
                ..MIDDLE_NODE => half(lanes, j, 1.0),
                MIDDLE_NODE => lanes[MIDDLE_NODE],
                _ => half(lanes, j - MIDDLE_NODE - 1, -1.0),
            })
        };
        Self::Mirrored(from_start.iter().map(halves).collect())
    }

    /// Returns the vectors of the state at the end of the step per unit nodal force with a given
    /// column.
    pub fn pushes(&self, column: &FlowRow) -> Vec<[F64x8; NODES]> {
        let p = column.pairs.len();
        let unfolded: DuhamelIntegrals;
        let towards_end = match self {
            Self::Mirrored(halves) => {
                let end = |lanes: &[F64x8; NODES], j: usize| match j {
                    ..MIDDLE_NODE => lanes[j].add_scaled(-1.0, &lanes[MIDDLE_NODE + 1 + j]),
                    MIDDLE_NODE => lanes[MIDDLE_NODE],
                    _ => lanes[NODES - 1 - j].add_scaled(1.0, &lanes[MIDDLE_NODE + NODES - j]),
                };
                unfolded = halves
                    .iter()
                    .map(|lanes| std::array::from_fn(|j| end(lanes, j)))
                    .collect();
                &unfolded
            }
            Self::Each([_, towards_end]) => towards_end,
        };
        let product = |a: &F64x8, b: &F64x8| F64x8(std::array::from_fn(|i| a.0[i] * b.0[i]));
        let of_pair = |lane: usize, [along, across]: [usize; 2]| -> [F64x8; NODES] {
            let entries = &column.pairs[lane];
            std::array::from_fn(|j| {
                product(&towards_end[lane][j], &entries[along])
                    .add_scaled(1.0, &product(&towards_end[p + lane][j], &entries[across]))
            })
        };
        let of_real = |(lane, real): (usize, &F64x8)| {
            std::array::from_fn(|j| product(&towards_end[2 * p + lane][j], real))
        };
        let u = (0..p).map(|lane| of_pair(lane, [0, 2]));
        let v = (0..p).map(|lane| of_pair(lane, [1, 3]));
        u.chain(v)
            .chain(column.reals.iter().enumerate().map(of_real))
            .collect()
    }

    /// Adds the effect of nodal forces, last lane 0, on a force column to the state at the end of
    /// the step, and returns the integrals from its start.
    #[inline(always)]
    pub fn act<W: Simd>(
        &self,
        w: W,
        column: &FlowRow,
        force: &F64x8,
        next: &mut [F64x8],
        from_start: &mut [F64x8],
    ) {
        match self {
            Self::Mirrored(halves) => {
                let f = &force.0;
                let mut folded = [w.zero(); NODES];
                for j in 0..MIDDLE_NODE {
                    folded[j] = w.splat(f[j] + f[NODES - 1 - j]);
                    folded[MIDDLE_NODE + 1 + j] = w.splat(f[j] - f[NODES - 1 - j]);
                }
                folded[MIDDLE_NODE] = w.splat(f[MIDDLE_NODE]);
                act_by(
                    w,
                    (column, next, from_start),
                    #[inline(always)]
                    |k: usize| {
                        let lanes: &[F64x8; NODES] = &halves[k];
                        let (mut even, mut odd) = (
                            w.mul(folded[MIDDLE_NODE], w.load(&lanes[MIDDLE_NODE])),
                            w.zero(),
                        );
                        for j in 0..MIDDLE_NODE {
                            even = w.fma(folded[j], w.load(&lanes[j]), even);
                            odd = w.fma(
                                folded[MIDDLE_NODE + 1 + j],
                                w.load(&lanes[MIDDLE_NODE + 1 + j]),
                                odd,
                            );
                        }
                        [w.add(even, odd), w.sub(even, odd)]
                    },
                );
            }
            Self::Each([onward, backward]) => {
                let force = spread(w, force);
                act_by(
                    w,
                    (column, next, from_start),
                    #[inline(always)]
                    |k: usize| {
                        [
                            add_spread_response(w, w.zero(), &onward[k], &force),
                            add_spread_response(w, w.zero(), &backward[k], &force),
                        ]
                    },
                );
            }
        }
    }
}

/// Does so with given integrals from the start and towards the end of each vector.
#[inline(always)]
fn act_by<W: Simd>(
    w: W,
    (column, next, from_start): (&FlowRow, &mut [F64x8], &mut [F64x8]),
    sums: impl Fn(usize) -> [W::Register; 2],
) {
    let p = column.pairs.len();
    for (k, [along_u, along_v, across_u, across_v]) in column.pairs.iter().enumerate() {
        let ([a_start, a], [b_start, b]) = (sums(k), sums(p + k));
        (from_start[k], from_start[p + k]) = (w.store(a_start), w.store(b_start));
        next[k] = w.store(w.fma(
            a,
            w.load(along_u),
            w.fma(b, w.load(across_u), w.load(&next[k])),
        ));
        next[p + k] = w.store(w.fma(
            a,
            w.load(along_v),
            w.fma(b, w.load(across_v), w.load(&next[p + k])),
        ));
    }
    for (k, real) in column.reals.iter().enumerate() {
        let [start, end] = sums(2 * p + k);
        from_start[2 * p + k] = w.store(start);
        next[2 * p + k] = w.store(w.fma(end, w.load(real), w.load(&next[2 * p + k])));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::flow::layout::StateLayout;
    use crate::force_response::basis::{BasisFunctions, SMOOTH_BASIS};
    use crate::force_response::output_rows::{OutputRows, OutputRowsTask};
    use jounce_model::plant::{BlockDiagonal, BlockPair};
    use jounce_simd::{Portable, widest};

    const LENGTH_S: f64 = 2e-3;
    const COLUMN: [f64; 7] = [0.7, -0.4, 1.1, 0.6, 0.3, 0.5, -0.9];
    const FORCE_N: [f64; NODES] = [0.1, 0.9, 0.3, -0.8, 1.4, 0.2, 0.5];

    fn block() -> BlockDiagonal {
        let pairs = vec![
            BlockPair::Oscillatory {
                decay: -9.0,
                frequency: 800.0,
            },
            BlockPair::Jordan { rate: -40.0 },
            BlockPair::FreeBody { rate: -250.0 },
        ];
        BlockDiagonal {
            pairs,
            reals: vec![-700.0],
        }
    }

    /// Computes `int f(t) g(t) dt` over the step, in `t = h r^2`, in which onset functions are
    /// smooth.
    fn integral(basis: &BasisFunctions, g: impl Fn(f64) -> Vec<f64>) -> Vec<f64> {
        let (panels, mut sum) = (40, vec![0.0; COLUMN.len()]);
        for p in 0..panels {
            for i in 0..NODES {
                let r = (f64::from(p) + SMOOTH_BASIS.positions[i]) / f64::from(panels);
                let force: f64 = basis
                    .at(r * r)
                    .iter()
                    .zip(&FORCE_N)
                    .map(|(phi, f)| phi * f)
                    .sum();
                let weight =
                    force * LENGTH_S * SMOOTH_BASIS.weights.0[i] * 2.0 * r / f64::from(panels);
                sum.iter_mut()
                    .zip(g(r * r * LENGTH_S))
                    .for_each(|(sum, g)| *sum += weight * g);
            }
        }
        sum
    }

    fn worst(a: &[f64], b: &[f64]) -> f64 {
        let size = b.iter().fold(0.0_f64, |max, b| max.max(b.abs()));
        a.iter()
            .zip(b)
            .fold(0.0, |max, (a, b)| max.max((a - b).abs() / size))
    }

    const LAYOUT: StateLayout = StateLayout {
        pairs: 3,
        reals: 1,
        pair_lanes: 1,
        real_lanes: 1,
    };

    fn duhamel(block: &BlockDiagonal, basis: &BasisFunctions, is_folded: bool) -> Duhamel {
        let OutputRows {
            from_start,
            towards_end,
            ..
        } = widest(OutputRowsTask {
            block,
            layout: &LAYOUT,
            basis,
            reader: basis,
            force: &COLUMN,
            rows: &[],
            length_s: LENGTH_S,
        });
        if is_folded {
            Duhamel::mirrored(&from_start)
        } else {
            Duhamel::Each([from_start, towards_end])
        }
    }

    fn unit(state: usize) -> [f64; 7] {
        std::array::from_fn(|i| if i == state { 1.0 } else { 0.0 })
    }

    #[test]
    fn force_and_motion_meet_as_quadrature_says() {
        let (w, block, layout) = (Portable::new(), block(), &LAYOUT);
        let onset = BasisFunctions::onset(1.5).unwrap();
        let column = FlowRow::column(layout, &block, &COLUMN);
        let force = F64x8(std::array::from_fn(|j| {
            FORCE_N.get(j).copied().unwrap_or(0.0)
        }));
        // Onset functions are truncated after 64 Legendre terms.
        for (basis, is_folded, within) in [
            (&*SMOOTH_BASIS, true, 1e-14),
            (&*SMOOTH_BASIS, false, 1e-14),
            (&onset, false, 1e-7),
        ] {
            let duhamel = duhamel(&block, basis, is_folded);
            let (mut end, mut integrals) = (layout.pack(&[0.0; 7]), layout.pack(&[0.0; 7]));
            duhamel.act(w, &column, &force, &mut end, &mut integrals);
            let end_state = layout.unpack(&end);
            assert!(
                worst(
                    &end_state,
                    &integral(basis, |t| block.flow(LENGTH_S - t, &COLUMN))
                ) < within,
                "{end_state:?}"
            );
            let pushes = duhamel.pushes(&column);
            let summed = (0..7).map(|state| {
                let (lane, position) = layout.locate(state);
                (0..NODES)
                    .map(|j| pushes[lane][j].0[position] * FORCE_N[j])
                    .sum()
            });
            assert!(worst(&summed.collect::<Vec<f64>>(), &end_state) < 1e-14);
            // Each state separately, read by a row over all of them.
            let row = [1.3, -0.2, 0.5, 0.8, -0.6, 0.9, 2.0];
            let crossed = FlowRow::row(layout, &block, &row);
            let read: Vec<f64> = (0..7)
                .map(|state| w.sum(crossed.read(w, &integrals, &layout.pack(&unit(state)))))
                .collect();
            let along = |t: f64| {
                (0..7)
                    .map(|state| {
                        block
                            .flow(t, &unit(state))
                            .iter()
                            .zip(&row)
                            .map(|(y, r)| y * r)
                            .sum()
                    })
                    .collect()
            };
            assert!(worst(&read, &integral(basis, along)) < within, "{read:?}");
        }
    }
}
