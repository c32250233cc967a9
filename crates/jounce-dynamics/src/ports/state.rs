//! State of one port during an integration.

use super::phasor::Phasor;
use crate::flow::layout::StateLayout;
use crate::kernel::Kernel;
use crate::multi_port::{Clearance, SpeedBound};
use crate::record::statistics::ContactStatistics;
use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_simd::F64x8;
use std::sync::{Arc, OnceLock};

/// Contact state of a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactState {
    /// The point is off the stop.
    Flight,
    /// The point is on the stop.
    Contact,
}

/// Port at the current time of an integration.
#[derive(Debug, Clone)]
pub struct PortState {
    /// Distance past the stop, m.
    pub penetration_m: f64,
    /// Its rate, m/s.
    pub rate_m_s: f64,
    /// Contact state.
    pub contact_state: ContactState,
    /// Desired level of the next step in contact ...
    pub level: i32,
    /// ... and whether a contact begins with it.
    pub entering: bool,
    /// Iterations of the last step.
    pub iterations: u32,
    /// Level at which the next contact starts.
    pub entry_level: i32,
    /// Largest impact speed so far, m/s: the scale of contact impulses.
    pub impact_velocity_m_s: f64,
    /// Time at which the last contact began, s.
    pub entered_s: f64,
    /// Duration of the current contact since it began, or since the last reset, s.
    pub contact_duration_s: f64,
    /// Bounds on the motion since the last update.
    pub clearance: Clearance,
    /// Gap, m; infinite without a stop.
    pub gap_m: f64,
    /// Rows of the port.
    pub rows: Arc<PortRows>,
    /// Statistics since the last reset.
    pub statistics: ContactStatistics,
}

/// Padded rows of a port.
#[derive(Debug, Clone)]
pub struct PortRows {
    /// Displacement towards the stop.
    pub displacement: Vec<F64x8>,
    /// Velocity towards the stop.
    pub velocity: Vec<F64x8>,
    /// Velocity lost per unit impulse, 1/kg.
    pub mobility_per_kg: f64,
    /// `sum |S| w^4` over tones: contribution of the drive to the flight bound.
    pub tone_fourth: f64,
    /// `sum |S|`: contribution of the drive to the scale of motion.
    pub tone_scale_m: f64,
    /// Bound on the speed of the port, for use with several ports.
    pub speed_bound: Option<SpeedBound>,
    /// Rows and columns for a rigid stop, computed at the first use.
    rigid: OnceLock<RigidRows>,
}

/// Padded rows and columns of a port for impacts and sticking.
#[derive(Debug, Clone)]
pub struct RigidRows {
    /// Relative acceleration without contact forces.
    pub acceleration: Vec<F64x8>,
    /// Its rate.
    pub jerk: Vec<F64x8>,
    /// Change of the state by a unit impulse.
    pub force: Vec<F64x8>,
    /// Change of the state that moves the port by a unit displacement away from its stop.
    pub shift: Vec<F64x8>,
}

impl PortState {
    /// Creates a port in flight that is not yet updated; contacts start at a level.
    pub fn new(kernel: &Kernel, port: usize, entry_level: i32) -> Self {
        Self {
            gap_m: (kernel.plant.ports.get(port)).map_or(f64::INFINITY, |port| port.gap_m),
            penetration_m: 0.0,
            rate_m_s: 0.0,
            contact_state: ContactState::Flight,
            level: entry_level,
            entering: false,
            iterations: 1,
            entry_level,
            impact_velocity_m_s: 0.0,
            entered_s: f64::NEG_INFINITY,
            contact_duration_s: 0.0,
            clearance: Clearance::default(),
            rows: Arc::clone(&kernel.port_rows()[port]),
            statistics: ContactStatistics::default(),
        }
    }

    /// Starts in contact where the point is past the stop or where the law acts on both sides. A
    /// point that touches at rest, within the roundoff of its distance and its speed, starts from
    /// rest: it sticks to a rigid stop, and flies at once if it is not pressed.
    pub fn start_pressed(&mut self, law: &Law, [roundoff_m, roundoff_m_s]: [f64; 2]) {
        let is_rigid = matches!(law, Law::Rigid(_));
        let touches = self.penetration_m.abs() <= roundoff_m;
        if touches && self.rate_m_s.abs() <= roundoff_m_s && !law.acts_on_both_sides() {
            if is_rigid {
                self.contact_state = ContactState::Contact;
            } else {
                self.penetration_m = 0.0;
            }
            self.rate_m_s = 0.0;
            return;
        }
        // A point that leaves a rigid stop is past it by roundoff only.
        let leaves = is_rigid && self.rate_m_s < 0.0;
        if law.acts_on_both_sides() || (self.penetration_m > 0.0 && !leaves) {
            self.contact_state = ContactState::Contact;
            // The compressed stop would throw the point off at this speed: the impulse scale of a
            // contact that starts at rest.
            self.impact_velocity_m_s =
                (2.0 * law.energy_j(self.penetration_m).max(0.0) * self.rows.mobility_per_kg)
                    .sqrt();
        }
    }

    /// Adds time in contact.
    #[inline(always)]
    pub fn stay(&mut self, length_s: f64) {
        self.contact_duration_s += length_s;
        self.statistics.time_s += length_s;
        self.statistics.max_contact_duration_s = self
            .statistics
            .max_contact_duration_s
            .max(self.contact_duration_s);
    }

    /// Resets the statistics. A contact in progress counts immediately with its current values,
    /// which it may never reach again.
    pub fn reset_statistics(&mut self, law: &Law) {
        self.contact_duration_s = 0.0;
        self.statistics = ContactStatistics::default();
        if self.contact_state == ContactState::Contact {
            let depth_m = if law.acts_on_both_sides() {
                self.penetration_m.abs()
            } else {
                self.penetration_m.max(0.0)
            };
            self.statistics.max_penetration_m = depth_m;
            self.statistics.max_force_n = law.force_n(self.penetration_m, self.rate_m_s).abs();
        }
    }
}

impl PortRows {
    /// Returns the rows of a port, or those of none.
    pub fn new(plant: &Plant, layout: &StateLayout, tones: &[Phasor], index: usize) -> Self {
        let none = vec![0.0; plant.len()];
        let port = plant.ports.get(index);
        let size = |tone: &Phasor| tone.displacement_m[index].norm();
        Self {
            displacement: layout.pack(port.map_or(&none, |port| &port.displacement)),
            velocity: layout.pack(port.map_or(&none, |port| &port.velocity)),
            mobility_per_kg: port.map_or(1.0, |port| port.mobility_per_kg),
            tone_fourth: tones
                .iter()
                .map(|tone| size(tone) * tone.angular_frequency_rad_s.powi(4))
                .sum(),
            tone_scale_m: tones.iter().map(size).sum(),
            speed_bound: SpeedBound::of(plant, layout, tones, index),
            rigid: OnceLock::new(),
        }
    }

    /// Returns the rows and columns for the rigid stop of a port.
    pub fn rigid(&self, kernel: &Kernel, index: usize) -> &RigidRows {
        self.rigid.get_or_init(|| RigidRows::of(kernel, index))
    }
}

impl RigidRows {
    fn of(kernel: &Kernel, index: usize) -> Self {
        let (plant, layout) = (&kernel.plant, &kernel.layout);
        let port = &plant.ports[index];
        let acceleration = kernel.acceleration_row(index);
        let shape = &plant.system.stops[index].shape;
        let inverse = &plant.diagonal.from_physical;
        let moved = |i: usize| -> f64 {
            let terms = shape.iter().enumerate().map(|(j, s)| inverse[(i, j)] * s);
            -terms.sum::<f64>() / port.mobility_per_kg
        };
        let shift: Vec<f64> = (0..plant.len()).map(moved).collect();
        Self {
            jerk: layout.pack(&plant.diagonal.block.rate_row(&acceleration)),
            acceleration: layout.pack(&acceleration),
            force: layout.pack(&port.force),
            shift: layout.pack(&shift),
        }
    }
}
