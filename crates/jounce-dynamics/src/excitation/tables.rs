//! Parts of the excitation that do not depend on the time, computed once for each kernel.

use super::port::PortExcitation;
use super::row::ExcitationRow;
use crate::flow::Flow;
use crate::flow::layout::StateLayout;
use crate::kernel::Kernel;
use jounce_model::drive::Wave;
use jounce_model::plant::{Forcing, Plant};
use jounce_simd::F64x8;

/// Rows and flows of a kernel under its signals.
#[derive(Debug)]
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
    /// `A^-1` in following blocks, 0 in local ones; empty without signals.
    pub inverse: Flow,
    /// Local blocks; empty without signals.
    pub local: LocalTables,
    /// Longest step under signals that are not silent, s.
    pub limit_s: f64,
}

/// Columns of one signal (see [`Forcing`]).
#[derive(Debug)]
pub(crate) struct SignalColumns {
    pub column: Vec<F64x8>,
    pub rest: Vec<F64x8>,
    pub lag: Vec<F64x8>,
}

/// Local blocks of a plant and what acts on them.
#[derive(Debug, Default)]
pub(crate) struct LocalTables {
    /// Vectors of blocks with a local one, those of pairs first, and 1 for each local block.
    pub vectors: Vec<(usize, F64x8)>,
    /// Column of each signal, and of the force of each port, in local blocks.
    pub columns: Vec<Vec<F64x8>>,
    pub forces: Vec<Vec<F64x8>>,
    /// Largest `|eigenvalue|`, rad/s.
    pub fastest_rad_s: f64,
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
                true => Flow::inverse(&plant.diagonal.block, &kernel.layout, &plant.local),
                false => Flow::default(),
            },
            local: match excited {
                true => LocalTables::of(plant, &kernel.layout),
                false => LocalTables::default(),
            },
            limit_s: plant.local_limit_s(),
        }
    }
}

impl SignalColumns {
    fn of(layout: &StateLayout, forcing: &Forcing) -> Self {
        let [column, rest, lag] =
            [&forcing.column, &forcing.rest, &forcing.lag].map(|b| layout.pack(b));
        Self { column, rest, lag }
    }
}

impl LocalTables {
    fn of(plant: &Plant, layout: &StateLayout) -> Self {
        let local_part = |column: &[f64]| {
            let parts = column.iter().zip(&plant.local);
            let parts = parts.map(|(b, local)| if *local { *b } else { 0.0 });
            layout.pack(&parts.collect::<Vec<f64>>())
        };
        let is_local = local_part(&vec![1.0; plant.len()]);
        let first_real = layout.pair_lanes;
        // Both states of a pair are local, or none.
        let vectors = (0..first_real + layout.real_lanes).map(|k| match k < first_real {
            true => (k, is_local[k]),
            false => (k, is_local[first_real + k]),
        });
        Self {
            vectors: vectors.filter(|(_, is)| *is != F64x8::ZERO).collect(),
            columns: (plant.forcings.iter())
                .map(|forcing| layout.pack(&forcing.local))
                .collect(),
            forces: (plant.ports.iter())
                .map(|port| local_part(&port.force))
                .collect(),
            fastest_rad_s: plant.fastest_local_rad_s(),
        }
    }
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
