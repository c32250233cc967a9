//! The marcher: the state of a run and its advance to a given time.
//!
//! Between contacts the flow is exact and a step is as long as the certificate allows; in contact the scalar force on a step
//! is a polynomial through seven Gauss nodes, found by fixed point. The loop alternates the two.

use super::basis::NODES;
use super::energies::Opening;
use super::error::MarchError;
use super::forced::Forced;
use super::kernel::{Kernel, Shape};
use super::layout::Layout;
use super::odd_tables::OddTables;
use super::tone::Turning;
use super::totals::{ContactIntegrals, ContactStatistics, WorkCount};
use super::trajectory::{Segment, Trajectory};
use crate::contact::{ContactLaw, Hertz, Law, Rigid};
use crate::wide::{Lane, Portable, Task, Wide, widest};

/// Whether the point is on the stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    Flight,
    Contact,
}

/// A run in progress.
#[derive(Debug, Clone)]
pub struct Marcher<'k> {
    pub(super) kernel: &'k Kernel,
    pub(super) layout: Layout,
    pub(super) tolerance: f64,
    pub(super) time_s: f64,
    pub(super) y: Vec<Lane>,
    pub(super) next: Vec<Lane>,
    pub(super) scratch: Vec<Lane>,
    pub(super) odd_tables: OddTables,
    pub(super) tones: Vec<Turning>,
    pub(super) forced: Forced,
    /// Distance past the stop and its rate at the present time.
    pub(super) penetration_m: f64,
    pub(super) rate_m_s: f64,
    pub(super) regime: Regime,
    pub(super) flight_level: i32,
    pub(super) entry_level: i32,
    /// Largest speed at which the stop was struck so far: the scale of contact impulses.
    pub(super) strike_m_s: f64,
    pub(super) rows: Rows,
    pub(super) statistics: ContactStatistics,
    pub(super) integrals: ContactIntegrals,
    pub(super) work: WorkCount,
    pub(super) opening: Opening,
    pub(super) record: Option<Trajectory>,
}

/// Padded rows of the port.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    pub displacement: Vec<Lane>,
    pub velocity: Vec<Lane>,
    pub gap_m: f64,
    pub mobility_per_kg: f64,
    /// `sum |S| w^4` and `sum |S|` over tones: the drive's share of the flight bound and of the scale of motion.
    pub tone_fourth: f64,
    pub tone_scale_m: f64,
}

impl<'k> Marcher<'k> {
    /// Starts from block coordinates `y` (see [`crate::plant::Plant::from_physical`]) at a time.
    ///
    /// `tolerance` is the wanted relative error of the response.
    ///
    /// # Errors
    /// [`MarchError::SeveralStops`].
    pub fn new(kernel: &'k Kernel, y: &[f64], time_s: f64, tolerance: f64) -> Result<Self, MarchError> {
        let plant = &kernel.plant;
        if plant.ports.len() > 1 {
            return Err(MarchError::SeveralStops { stops: plant.ports.len() });
        }
        let layout = kernel.layout;
        let port = plant.ports.first();
        let steady = |k: usize| port.map_or_else(Default::default, |port| port.steady_m[k]);
        let tones: Vec<Turning> =
            (plant.tones.iter().enumerate()).map(|(k, tone)| Turning::new(tone.angular_frequency_rad_s, steady(k), time_s)).collect();
        let none = vec![0.0; plant.len()];
        let rows = Rows {
            displacement: layout.pack(port.map_or(&none, |port| &port.displacement)),
            velocity: layout.pack(port.map_or(&none, |port| &port.velocity)),
            gap_m: plant.system.stops.first().map_or(f64::INFINITY, |stop| stop.gap_m),
            mobility_per_kg: port.map_or(1.0, |port| port.mobility_per_kg),
            tone_fourth: tones.iter().map(|tone| tone.displacement_m.norm() * tone.angular_frequency_rad_s.powi(4)).sum(),
            tone_scale_m: tones.iter().map(|tone| tone.displacement_m.norm()).sum(),
        };
        let start = Kernel::level_within(1.0 / kernel.fastest_rad_s);
        let forced = Forced::new(kernel, time_s);
        let free: Vec<f64> = y.iter().zip(plant.forced(&forced.sizes, 0.0)).map(|(y, forced)| y - forced).collect();
        let mut marcher = Self {
            kernel,
            layout,
            tolerance,
            time_s,
            y: layout.pack(&free),
            next: vec![Lane::ZERO; layout.lanes()],
            scratch: vec![Lane::ZERO; layout.lanes()],
            odd_tables: OddTables::default(),
            regime: Regime::Flight,
            penetration_m: 0.0,
            rate_m_s: 0.0,
            flight_level: start,
            entry_level: start + 3,
            strike_m_s: 0.0,
            integrals: ContactIntegrals {
                loads_j: vec![0.0; kernel.meters.loads.len()],
                tones_n_s: vec![Default::default(); tones.len()],
                ..ContactIntegrals::default()
            },
            tones,
            forced,
            rows,
            statistics: ContactStatistics::default(),
            work: WorkCount::default(),
            opening: Opening::default(),
            record: None,
        };
        marcher.forced.open(&layout, &marcher.y);
        marcher.see(Portable::new());
        marcher.start_pressed();
        marcher.opening = marcher.readings();
        Ok(marcher)
    }

    /// Starts in contact where the point lies past the stop.
    fn start_pressed(&mut self) {
        let Some(law) = self.kernel.plant.system.stops.first().map(|stop| stop.law) else { return };
        // A point that leaves a rigid stop is past it by roundoff only.
        let leaves = matches!(law, Law::Rigid(_)) && self.rate_m_s < 0.0;
        if law.acts_on_both_sides() || (self.penetration_m > 0.0 && !leaves) {
            self.regime = Regime::Contact;
            // The compressed stop would throw the point off at this speed: the scale of the impulse of a contact that starts at rest.
            self.strike_m_s = (2.0 * law.energy_j(self.penetration_m).max(0.0) * self.rows.mobility_per_kg).sqrt();
        }
    }

    /// Present time, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// State in block coordinates.
    pub fn state(&self) -> Vec<f64> {
        self.forced.whole(&self.layout, &self.y)
    }

    /// Contact force of a compliant stop at the present time, N; 0 in flight and on a rigid stop.
    pub fn force_n(&self) -> f64 {
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        match (self.regime, law) {
            (Regime::Contact, Some(law)) => law.force_n(self.penetration_m, self.rate_m_s),
            _ => 0.0,
        }
    }

    /// Contact statistics since the last [`Marcher::reset_statistics`].
    pub fn statistics(&self) -> &ContactStatistics {
        &self.statistics
    }

    /// Forgets the contact statistics, not the energies.
    pub fn reset_statistics(&mut self) {
        self.statistics = ContactStatistics::default();
        if self.regime == Regime::Contact {
            self.statistics.max_penetration_m = self.penetration_m.max(0.0);
        }
    }

    /// Starts to keep every step.
    pub fn start_record(&mut self) {
        self.record = Some(Trajectory::default());
    }

    /// Ends the record and hands it over.
    pub fn take_record(&mut self) -> Trajectory {
        self.record.take().unwrap_or_default()
    }

    /// Keeps the step that is about to be taken.
    pub(super) fn note(&mut self, length_s: f64, force: Option<(Shape, [f64; NODES])>) {
        if let Some(record) = &mut self.record {
            let sizes = self.forced.sizes.clone();
            record.push(Segment { start_s: self.time_s, length_s, state: self.layout.unpack(&self.y), sizes, force });
        }
    }

    /// Steps and iterations so far.
    pub fn work(&self) -> WorkCount {
        self.work
    }

    /// Marches to a time, landing on it exactly.
    ///
    /// # Errors
    /// [`MarchError::ContactDiverged`], [`MarchError::NotFinite`].
    pub fn advance_to(&mut self, end_s: f64) -> Result<(), MarchError> {
        let law = self.kernel.plant.system.stops.first().map(|stop| stop.law);
        match law {
            None => self.dispatch(Hertz { stiffness: 0.0, exponent: 1.0 }, end_s),
            Some(Law::Hertz(law)) => self.dispatch(law, end_s),
            Some(Law::KelvinVoigt(law)) => self.dispatch(law, end_s),
            Some(Law::HuntCrossley(law)) => self.dispatch(law, end_s),
            Some(Law::Cubic(law)) => self.dispatch(law, end_s),
            Some(Law::Rigid(law)) => widest(AdvanceRigid { marcher: self, law, end_s }),
        }
    }

    /// Passes the breakpoints of the signals that have been reached; returns the next one, or the end if that comes first.
    #[inline(always)]
    pub(super) fn next_breakpoint<W: Wide>(&mut self, w: W, end_s: f64) -> f64 {
        if self.forced.is_due(self.time_s) && self.forced.cross(self.kernel, self.time_s, &mut self.y) {
            self.see(w);
        }
        end_s.min(self.forced.until_s(self.time_s))
    }

    fn dispatch<L: ContactLaw>(&mut self, law: L, end_s: f64) -> Result<(), MarchError> {
        widest(Advance { marcher: self, law, end_s })
    }
}

/// Carries the loop into code compiled for the vector instructions of this machine.
struct Advance<'m, 'k, L> {
    marcher: &'m mut Marcher<'k>,
    law: L,
    end_s: f64,
}

impl<L: ContactLaw> Task for Advance<'_, '_, L> {
    type Output = Result<(), MarchError>;

    /// Alternates flight and contact until the end.
    #[inline(always)]
    fn run<W: Wide>(self, w: W) -> Self::Output {
        let Advance { marcher, law, end_s } = self;
        while marcher.time_s < end_s {
            let until_s = marcher.next_breakpoint(w, end_s);
            match marcher.regime {
                Regime::Flight => marcher.flight(w, until_s)?,
                Regime::Contact => marcher.contact(w, law, until_s)?,
            }
        }
        Ok(())
    }
}

/// The same for a rigid stop.
struct AdvanceRigid<'m, 'k> {
    marcher: &'m mut Marcher<'k>,
    law: Rigid,
    end_s: f64,
}

impl Task for AdvanceRigid<'_, '_> {
    type Output = Result<(), MarchError>;

    #[inline(always)]
    fn run<W: Wide>(self, w: W) -> Self::Output {
        self.marcher.advance_rigid(w, self.law, self.end_s)
    }
}
