//! Parts of the excitation that do not depend on the time, computed once for each kernel.

use super::port::PortExcitation;
use super::row::{ExcitationRow, fastest_rad_s};
use crate::flow::Flow;
use crate::flow::layout::StateLayout;
use crate::kernel::Kernel;
use jounce_model::drive::Wave;
use jounce_model::plant::{Forcing, Plant, SignalSample};
use jounce_simd::F64x8;

/// Rows and flows of a kernel under its signals.
#[derive(Debug, Default)]
pub(crate) struct ExcitationTables {
    /// Excitation of each port before the first signal; none without signals.
    pub ports: Vec<PortExcitation>,
    /// For each meter with a quadratic form (each load, then damping) and port, the row `P b` over
    /// the signals; none without signals.
    pub readings: Vec<Vec<ExcitationRow>>,
    /// Index of the only signal with breakpoints.
    pub moving: Option<usize>,
    /// Flow over the pieces of this signal where it is evenly sampled, and their length, s.
    pub piece: Option<(f64, Flow)>,
    /// Columns of the signals.
    pub signals: Vec<SignalColumns>,
    /// Column of the force of each port; none without signals.
    pub forces: Vec<Vec<F64x8>>,
    /// `A^-1` in blocks that follow a signal, 0 in those that are local to all of them; empty without
    /// signals.
    pub inverse: Flow,
    /// Vectors of blocks with one that is local to a signal, those of pairs first.
    pub local: Vec<LocalVector>,
    /// For each signal, the largest `|eigenvalue|` of its local blocks, rad/s.
    pub fastest_rad_s: Vec<f64>,
}

/// Columns of one signal (see [`Forcing`]).
#[derive(Debug)]
pub(crate) struct SignalColumns {
    pub column: Vec<F64x8>,
    pub rest: Vec<F64x8>,
    pub lag: Vec<F64x8>,
    /// The column in local blocks, 0 in following ones.
    pub local: Vec<F64x8>,
    /// 1 in following blocks, 0 in local ones.
    pub is_following: Vec<F64x8>,
}

/// Vector of blocks with one that is local to a signal.
#[derive(Debug)]
pub(crate) struct LocalVector {
    /// Index among the vectors of blocks, those of pairs first.
    pub index: usize,
    /// For each signal, 1 in the blocks that are local to it.
    pub is_local: Vec<F64x8>,
}

impl LocalVector {
    /// Returns 1 in the blocks that are local to a signal that is not 0.
    #[inline(always)]
    pub fn driven(&self, sizes: &[SignalSample]) -> F64x8 {
        let signals = self.is_local.iter().zip(sizes);
        signals
            .filter(|(_, size)| **size != [0.0; 2])
            .fold(F64x8::ZERO, |driven, (is_local, _)| {
                F64x8(std::array::from_fn(|i| driven.0[i].max(is_local.0[i])))
            })
    }
}

impl ExcitationTables {
    pub fn of(kernel: &Kernel) -> Self {
        let (plant, meters) = (&kernel.plant, kernel.meters());
        let excited = !plant.forcings.is_empty();
        let ports = plant.ports.iter().filter(|_| excited);
        let quadratic = meters.loads.iter().chain([&meters.damping]);
        let readings = quadratic.filter(|_| excited).map(|meter| {
            (0..plant.ports.len())
                .map(|port| ExcitationRow::of(plant, meter.port_row(port)))
                .collect()
        });
        Self {
            ports: ports.map(|port| PortExcitation::of(plant, port)).collect(),
            readings: readings.collect(),
            moving: moving(kernel),
            piece: even_piece(kernel),
            signals: (plant.forcings.iter())
                .map(|forcing| SignalColumns::of(&kernel.layout, forcing))
                .collect(),
            forces: (plant.ports.iter().filter(|_| excited))
                .map(|port| kernel.layout.pack(&port.force))
                .collect(),
            inverse: match excited {
                true => Flow::inverse(&plant.diagonal.block, &kernel.layout, &local_to_all(plant)),
                false => Flow::default(),
            },
            local: local_vectors(plant, &kernel.layout),
            fastest_rad_s: fastest_rad_s(plant),
        }
    }
}

impl SignalColumns {
    fn of(layout: &StateLayout, forcing: &Forcing) -> Self {
        let [column, rest, lag, local] =
            [&forcing.column, &forcing.rest, &forcing.lag, &forcing.local].map(|b| layout.pack(b));
        Self {
            column,
            rest,
            lag,
            local,
            is_following: indicator(layout, forcing.is_local.iter().map(|local| !local)),
        }
    }
}

/// Returns 1 in some states, 0 in the others.
fn indicator(layout: &StateLayout, states: impl Iterator<Item = bool>) -> Vec<F64x8> {
    let values: Vec<f64> = states.map(|is_one| f64::from(u8::from(is_one))).collect();
    layout.pack(&values)
}

/// Returns the states of blocks that are local to all signals; these include all free ones.
fn local_to_all(plant: &Plant) -> Vec<bool> {
    let is_local = |state: usize| plant.forcings.iter().all(|forcing| forcing.is_local[state]);
    (0..plant.len()).map(is_local).collect()
}

/// Returns the vectors of blocks with one that is local to a signal.
fn local_vectors(plant: &Plant, layout: &StateLayout) -> Vec<LocalVector> {
    let of_signal = |forcing: &Forcing| indicator(layout, forcing.is_local.iter().copied());
    let signals: Vec<Vec<F64x8>> = plant.forcings.iter().map(of_signal).collect();
    let first_real = layout.pair_lanes;
    let vector = |index: usize| {
        // Both states of a pair are local, or none.
        let lane = if index < first_real {
            index
        } else {
            first_real + index
        };
        LocalVector {
            index,
            is_local: signals.iter().map(|signal| signal[lane]).collect(),
        }
    };
    (0..first_real + layout.real_lanes)
        .map(vector)
        .filter(|vector| vector.is_local.iter().any(|is| *is != F64x8::ZERO))
        .collect()
}

/// Returns the index of the only signal with breakpoints.
fn moving(kernel: &Kernel) -> Option<usize> {
    let signals = kernel.plant.system.signals.iter().enumerate();
    let mut moving = signals.filter(|(_, signal)| !signal.wave.is_constant());
    let (first, _) = moving.next()?;
    moving.next().is_none().then_some(first)
}

/// Returns the flow over the pieces of the only signal with breakpoints, where it is evenly
/// sampled, and their length, s.
fn even_piece(kernel: &Kernel) -> Option<(f64, Flow)> {
    let plant = &kernel.plant;
    let Wave::Sampled { step_s, .. } = plant.system.signals[moving(kernel)?].wave else {
        return None;
    };
    let flow = Flow::over(&plant.diagonal.block, &kernel.layout, step_s);
    Some((step_s, flow))
}
