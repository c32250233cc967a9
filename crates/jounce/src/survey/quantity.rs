//! What is computed at each point.

use crate::table::{Column, Values};

/// A command and its options.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// One run of `run.duration`.
    Run,
    /// Natural frequencies and damping ratios of the first modes.
    Modes {
        /// How many.
        count: usize,
    },
    /// Attractors from a cloud of starts, and the power to be expected.
    Basins {
        /// Starts of the cloud.
        starts: usize,
        /// Seed of the cloud.
        seed: u64,
        /// Size of the cloud, in gaps.
        spread: f64,
        /// Relative tolerance of the marches.
        tolerance: f64,
    },
    /// Highest stable power over a key, and its half-power bandwidth.
    Branch {
        /// The key.
        over: String,
        /// Ends of its range, SI.
        range: (f64, f64),
        /// Values at which branches are sought by marching.
        seeds: usize,
        /// Longest period, in drive cycles.
        longest_period: u32,
        /// Relative tolerance of the marches.
        tolerance: f64,
    },
    /// Mean power over realisations of noise.
    Ensemble {
        /// Realisations.
        members: usize,
        /// Their seed.
        seed: u64,
    },
}

/// One number that a quantity gives.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measure {
    name: String,
    unit: &'static str,
    about: &'static str,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Number,
    Count,
    Flag,
}

impl Quantity {
    /// The command that computes it.
    pub fn command(&self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Modes { .. } => "modes",
            Self::Basins { .. } => "basins",
            Self::Branch { .. } => "branch",
            Self::Ensemble { .. } => "ensemble",
        }
    }

    /// The numbers that it gives, in order.
    pub(super) fn measures(&self) -> Vec<Measure> {
        let number = |name: &str, unit, about| Measure { name: name.to_owned(), unit, about, kind: Kind::Number };
        let count = |name: &str, about| Measure { name: name.to_owned(), unit: "", about, kind: Kind::Count };
        let power = number("mean_power_w", "W", "mean power of all loads");
        let residual = number("energy_residual_relative", "", "energy residual over the largest energy");
        match self {
            Self::Run => vec![
                power,
                number("voltage_rms_v", "V", "voltage of the first load, rms"),
                number("max_penetration_m", "m", "largest penetration of the stop"),
                number("max_contact_force_n", "N", "largest contact force"),
                number("contact_rate_hz", "Hz", "contacts per second"),
                number("contact_duty", "", "share of the time in contact"),
                Measure { name: "settled".to_owned(), unit: "", about: "settled when it was averaged", kind: Kind::Flag },
                count("period_cycles", "period in drive cycles, 0 for none"),
                residual,
            ],
            Self::Modes { count } => (1..=*count)
                .flat_map(|mode| {
                    let frequency = number(&format!("frequency_{mode}_hz"), "Hz", "undamped short-circuit frequency");
                    [frequency, number(&format!("damping_ratio_{mode}"), "", "damping ratio")]
                })
                .collect(),
            Self::Basins { .. } => vec![
                number("expected_power_w", "W", "power to be expected from a start of the cloud"),
                number("expected_power_low_w", "W", "lower end of its 95 % interval"),
                number("expected_power_high_w", "W", "upper end of its 95 % interval"),
                count("attractors", "attractors that were found"),
                number("highest_power_w", "W", "mean power of the attractor that gives most"),
                number("highest_fraction", "", "share of the starts that end on it"),
                count("lost", "marches that failed"),
            ],
            Self::Branch { .. } => vec![
                number("peak_power_w", "W", "highest stable mean power"),
                number("peak_parameter", "", "value of the key there, SI"),
                number("half_power_bandwidth", "", "width over which a stable orbit has half of it, SI"),
                count("branches", "branches that were found"),
                count("bifurcations", "bifurcations on them"),
            ],
            Self::Ensemble { .. } => vec![
                power,
                number("mean_power_half_width_w", "W", "half the width of its 95 % interval"),
                number("contact_rate_hz", "Hz", "contacts per second"),
                number("max_strike_m_s", "m/s", "largest speed at which a contact began"),
                residual,
            ],
        }
    }
}

impl Measure {
    /// A column of its values; what failed is NaN, 0 or false.
    pub(super) fn column(&self, values: Vec<f64>) -> Column {
        let values: Values = match self.kind {
            Kind::Number => values.into(),
            Kind::Count => values.into_iter().map(|value| value as u64).collect::<Vec<u64>>().into(),
            Kind::Flag => values.into_iter().map(|value| value == 1.0).collect::<Vec<bool>>().into(),
        };
        Column::new(&self.name, self.unit, self.about, values)
    }
}
