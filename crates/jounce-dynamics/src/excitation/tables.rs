//! Parts of the excitation that do not depend on the time, computed once for each kernel.

use super::port::PortExcitation;
use super::row::ExcitationRow;
use crate::flow::Flow;
use crate::kernel::Kernel;
use jounce_model::drive::Wave;

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
