//! Integration of the variational equation along a recorded integration in one conduction state,
//! step by step.

use super::SensitivityError;
use super::elimination::NodeSystem;
use super::parameter_sensitivity::ParameterSensitivity;
use super::parameters::Parameters;
use super::tangents::Tangents;
use crate::excitation::row::{ExcitationRow, ExcitationSeries};
use crate::kernel::Kernel;
use crate::ports::phasor::Phasor;
use crate::record::trajectory::{Impact, TrajectorySegment};
use crate::tables::odd_tables::OddTables;
use jounce_model::contact::Law;
use jounce_model::plant::{Port, SignalSample};
use jounce_simd::{F64x8, Simd, Task};

/// Steps of an integration in one conduction state of its bridges.
#[derive(Debug, Clone, Copy)]
pub struct ConductionSegment<'a> {
    /// Steps.
    pub segments: &'a [TrajectorySegment],
    /// Number of steps of the integration before them.
    pub first: usize,
    /// Impacts of the segment; those at its start belong to the previous segment.
    pub impacts: &'a [Impact],
    /// Time of its end, s.
    pub end_s: f64,
    /// State at its end, without the equilibrium under signals.
    pub end: &'a [f64],
}

/// Integration of the variational equation along a segment, in progress.
pub struct VariationalIntegration<'a, 'p> {
    pub(super) kernel: &'a Kernel,
    pub(super) drift: &'a ParameterSensitivity,
    /// Tables of the lengths that are no levels.
    pub(super) odd_tables: &'a mut OddTables,
    segment: ConductionSegment<'a>,
    pub(super) tangents: Tangents,
    /// System of the current contact step.
    pub(super) system: NodeSystem,
    /// Factors of each row of tangents in the right sides of the system.
    pub(super) factors: Vec<F64x8>,
    /// State at the start of the current step.
    pub(super) packed: Vec<F64x8>,
    /// Phasors of the drives.
    pub(super) tones: Vec<Phasor>,
    /// Sample of each signal: they are constant.
    pub(super) sizes: Vec<SignalSample>,
    /// For each port, its motion forced by signals, from the start of a step on.
    pub(super) forced: Vec<ExcitationSeries>,
    /// Flight not yet applied, s.
    pending_s: f64,
    /// Parameters whose derivatives are wanted, next to the one of `drift`.
    pub(super) parameters: Option<Box<Parameters<'p>>>,
}

/// Result of the linearisation of a segment.
pub struct LinearizedSegment<'p> {
    /// Derivatives of the state at the end of the segment.
    pub tangents: Tangents,
    /// Delay of an impact at the end of the segment, s.
    pub delay_s: Option<Vec<F64x8>>,
    /// Parameters with their outputs so far.
    pub parameters: Option<Box<Parameters<'p>>>,
}

impl<'a, 'p> VariationalIntegration<'a, 'p> {
    /// Continues with the derivatives of the state at the start of a segment; `sizes` are the
    /// signal samples.
    pub fn new(
        kernel: &'a Kernel,
        drift: &'a ParameterSensitivity,
        odd_tables: &'a mut OddTables,
        segment: ConductionSegment<'a>,
        sizes: Vec<SignalSample>,
        (tangents, parameters): (Tangents, Option<Box<Parameters<'p>>>),
    ) -> Self {
        let (system, factors) = (
            NodeSystem::new(1, tangents.width),
            vec![F64x8::ZERO; kernel.plant.len()],
        );
        let tones = (0..kernel.plant.tones.len())
            .map(|index| Phasor::new(&kernel.plant, index, 0.0))
            .collect();
        let packed = vec![F64x8::ZERO; kernel.layout.lanes()];
        let series = |port: &Port| {
            ExcitationRow::of(&kernel.plant, &port.displacement).longest_series(&sizes)
        };
        let forced = kernel
            .plant
            .ports
            .iter()
            .filter(|_| !sizes.is_empty())
            .map(series)
            .collect();
        Self {
            kernel,
            drift,
            odd_tables,
            segment,
            tangents,
            system,
            factors,
            packed,
            tones,
            sizes,
            forced,
            pending_s: 0.0,
            parameters,
        }
    }

    /// Passes one step; `after` is the state at its end, `next` the step that follows.
    #[inline(always)]
    fn segment<W: Simd>(
        &mut self,
        w: W,
        segment: &TrajectorySegment,
        after: &[f64],
        next: Option<&TrajectorySegment>,
    ) -> Result<(), SensitivityError> {
        if segment.forces.is_empty() {
            self.flight(w, segment);
        } else {
            if let Some(slot) = segment
                .forces
                .iter()
                .find(|force| matches!(self.law(force.port), Law::Rigid(_)))
            {
                let stop = self.kernel.plant.system.stops[slot.port].name.clone();
                return Err(SensitivityError::Rests {
                    stop,
                    time_s: segment.start_s,
                });
            }
            self.fly(w);
            self.contact(w, segment, after);
        }
        let starts = next.map_or(&[][..], |next| &next.forces);
        for force in starts.iter().filter(|force| {
            !segment
                .forces
                .iter()
                .any(|before| before.port == force.port)
        }) {
            if let law @ Law::KelvinVoigt(_) = self.law(force.port) {
                self.fly(w);
                self.strike(
                    w,
                    law,
                    force.port,
                    (segment.start_s + segment.length_s, after),
                );
            }
        }
        Ok(())
    }

    /// Passes one step in flight.
    #[inline(always)]
    fn flight<W: Simd>(&mut self, w: W, segment: &TrajectorySegment) {
        self.pending_s += segment.length_s;
        if let Some(parameters) = &mut self.parameters {
            let kernel = self.kernel;
            let step = w.out_of_line(
                #[inline(always)]
                || parameters.step(w, kernel, segment),
            );
            parameters.add_outputs(self.kernel, segment, &step, &self.tangents, None, None);
            self.fly(w);
            if let Some(parameters) = &self.parameters {
                parameters.add_end(&step, &mut self.tangents);
            }
        }
    }

    /// Returns the law of the stop of a port.
    #[inline(always)]
    pub(super) fn law(&self, port: usize) -> Law {
        self.kernel.plant.system.stops[port].law
    }

    /// Applies the accumulated flight.
    #[inline(always)]
    pub(super) fn fly<W: Simd>(&mut self, w: W) {
        if self.pending_s == 0.0 {
            return;
        }
        let block = &self.kernel.plant.diagonal.block;
        for (k, pair) in block.pairs.iter().enumerate() {
            self.tangents.turn(w, k, pair.flow(self.pending_s));
        }
        for (k, rate) in block.reals.iter().enumerate() {
            self.tangents
                .decay(w, 2 * block.pairs.len() + k, (rate * self.pending_s).exp());
        }
        self.pending_s = 0.0;
    }

    /// Passes the impacts after a number of steps of the integration, given the state after them;
    /// returns their delay, s.
    #[inline(always)]
    fn impacts<W: Simd>(
        &mut self,
        w: W,
        index: usize,
        time_s: f64,
        after: &[f64],
    ) -> Result<Option<Vec<F64x8>>, SensitivityError> {
        let mut impacts = self
            .segment
            .impacts
            .iter()
            .filter(|impact| impact.after == index);
        let Some(impact) = impacts.next() else {
            return Ok(None);
        };
        if impacts.next().is_some() {
            return Err(SensitivityError::StruckTogether { time_s });
        }
        self.fly(w);
        let earlier = index
            .checked_sub(self.segment.first + 1)
            .and_then(|before| self.segment.segments.get(before));
        Ok(Some(self.impact(w, impact, earlier, (time_s, after))))
    }
}

impl<'p> Task for VariationalIntegration<'_, 'p> {
    type Output = Result<LinearizedSegment<'p>, SensitivityError>;

    #[inline(always)]
    fn run<W: Simd>(mut self, w: W) -> Self::Output {
        let ConductionSegment {
            segments,
            first,
            end_s,
            end,
            ..
        } = self.segment;
        for (index, segment) in segments.iter().enumerate() {
            self.impacts(w, first + index, segment.start_s, &segment.state)?;
            let next = segments.get(index + 1);
            let after = next.map_or(end, |next| &next.state);
            self.segment(w, segment, after, next)?;
        }
        let delay_s = self.impacts(w, first + segments.len(), end_s, end)?;
        self.fly(w);
        Ok(LinearizedSegment {
            tangents: self.tangents,
            delay_s,
            parameters: self.parameters,
        })
    }
}
