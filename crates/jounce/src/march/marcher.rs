//! The marcher: the state of a run and its advance to a given time.
//!
//! Between contacts the flow is exact and a step is as long as the certificate allows; in contact the scalar force on a step
//! is a polynomial through seven Gauss nodes, found by fixed point. The loop alternates the two.

use super::collocation::NODES;
use super::energies::Opening;
use super::kernel::{Kernel, Layout};
use super::lane::Lane;
use super::tone::Turning;
use super::totals::{ContactIntegrals, ContactStatistics, WorkCount};
use super::trajectory::{Segment, Trajectory};
use crate::contact::{ContactLaw, Hertz, Law};
use pulp::{Arch, Simd, WithSimd};

/// Whether the point is on the stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    Flight,
    Contact,
}

/// A march that could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MarchError {
    /// The contact force did not converge on any step length.
    #[error(
        "at t = {time_s} s the contact force of stop `{stop}` did not converge, even on a step of {step_s:e} s (penetration {penetration_m:e} m); check its stiffness and damping"
    )]
    ContactDiverged {
        /// Time, s.
        time_s: f64,
        /// Name of the stop.
        stop: String,
        /// Shortest step tried, s.
        step_s: f64,
        /// Penetration at its start, m.
        penetration_m: f64,
    },
    /// The state is no longer a number.
    #[error("at t = {time_s} s the state is not finite; check the amplitude of the drive and the contact law")]
    NotFinite {
        /// Time, s.
        time_s: f64,
    },
    /// Several stops at once.
    #[error("the harvester has {stops} stops; marching takes one stop today")]
    SeveralStops {
        /// Number of stops.
        stops: usize,
    },
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
    pub(super) tones: Vec<Turning>,
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
        let layout = Layout::of(plant);
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
        let fastest = plant.fastest_rad_s().max(f64::MIN_POSITIVE);
        let start = Kernel::level_within(1.0 / fastest);
        let mut marcher = Self {
            kernel,
            layout,
            tolerance,
            time_s,
            y: layout.pack(y),
            next: vec![Lane::ZERO; layout.lanes()],
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
            rows,
            statistics: ContactStatistics::default(),
            work: WorkCount::default(),
            opening: Opening::default(),
            record: None,
        };
        marcher.see::<false>();
        marcher.start_pressed();
        marcher.opening = marcher.readings();
        Ok(marcher)
    }

    /// Starts in contact where the point lies past the stop.
    fn start_pressed(&mut self) {
        let Some(law) = self.kernel.plant.system.stops.first().map(|stop| stop.law) else { return };
        // A point that leaves a rigid stop is past it by roundoff only.
        let leaves = matches!(law, Law::Rigid(_)) && self.rate_m_s < 0.0;
        if self.penetration_m > 0.0 && !leaves {
            self.regime = Regime::Contact;
            // The compressed stop would throw the point off at this speed: the scale of the impulse of a contact that starts at rest.
            self.strike_m_s = (2.0 * law.energy_j(self.penetration_m) * self.rows.mobility_per_kg).sqrt();
        }
    }

    /// Present time, s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// State in block coordinates.
    pub fn state(&self) -> Vec<f64> {
        self.layout.unpack(&self.y)
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
    pub(super) fn note(&mut self, length_s: f64, force_n: Option<[f64; NODES]>) {
        if let Some(record) = &mut self.record {
            record.push(Segment { start_s: self.time_s, length_s, state: self.layout.unpack(&self.y), force_n });
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
            Some(Law::Rigid(law)) => self.advance_rigid(law, end_s),
        }
    }

    fn dispatch<L: ContactLaw>(&mut self, law: L, end_s: f64) -> Result<(), MarchError> {
        Arch::new().dispatch(Advance { marcher: self, law, end_s })
    }

    /// Alternates flight and contact until the end.
    #[inline(always)]
    fn advance<L: ContactLaw, const FMA: bool>(&mut self, law: L, end_s: f64) -> Result<(), MarchError> {
        while self.time_s < end_s {
            match self.regime {
                Regime::Flight => self.flight::<FMA>(end_s)?,
                Regime::Contact => self.contact::<L, FMA>(law, end_s)?,
            }
        }
        Ok(())
    }

    /// Reads penetration and rate off the state.
    #[inline(always)]
    pub(super) fn see<const FMA: bool>(&mut self) {
        let mut motion = (
            super::state::dot::<FMA>(&self.rows.displacement, &self.y) - self.rows.gap_m,
            super::state::dot::<FMA>(&self.rows.velocity, &self.y),
        );
        for tone in &self.tones {
            let (w, v) = tone.motion();
            motion = (motion.0 + w, motion.1 + v);
        }
        (self.penetration_m, self.rate_m_s) = motion;
    }

    /// The state after an exact flow over any time.
    pub(super) fn flown(&self, length_s: f64) -> Vec<Lane> {
        self.layout.pack(&self.kernel.plant.diagonal.block.flow(length_s, &self.layout.unpack(&self.y)))
    }

    /// Exact flow over any time, by one exponential per block.
    pub(super) fn glide(&mut self, length_s: f64, end_s: f64) {
        self.note(length_s, None);
        self.y = self.flown(length_s);
        self.time_s = end_s;
        self.tones.iter_mut().for_each(|tone| tone.set(end_s));
    }
}

/// Carries the loop into code compiled for the vector instructions of this machine.
struct Advance<'m, 'k, L> {
    marcher: &'m mut Marcher<'k>,
    law: L,
    end_s: f64,
}

impl<L: ContactLaw> WithSimd for Advance<'_, '_, L> {
    type Output = Result<(), MarchError>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Self::Output {
        // Machines with vectors of four numbers or more fuse multiply and add.
        if S::F64_LANES >= 4 {
            self.marcher.advance::<L, true>(self.law, self.end_s)
        } else {
            self.marcher.advance::<L, false>(self.law, self.end_s)
        }
    }
}
