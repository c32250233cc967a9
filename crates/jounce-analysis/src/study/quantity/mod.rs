//! Quantity computed at each point.

mod devices;
pub(super) mod evaluation;
mod key_quantities;
mod measure;
pub(super) mod read;
mod table;

use crate::{DiagramOrder, Recognition, SweepOrder};

/// A command and its options.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// One run of `run.duration`.
    Run,
    /// Natural frequencies and damping ratios of the first modes.
    Modes {
        /// Number of modes.
        count: usize,
    },
    /// Highest voltage of the frequency response without contact.
    Frf {
        /// Lowest and highest frequency, Hz.
        range_hz: (f64, f64),
        /// Frequencies, evenly spaced in their logarithm.
        points: usize,
        /// Unit of the voltage per unit of the excitation.
        unit: &'static str,
    },
    /// Runs over a key, each until it has settled.
    Sweep {
        /// The key.
        over: String,
        /// Values, as they were written.
        values: String,
        /// Order of the values.
        direction: SweepOrder,
        /// True: each for `run.duration`.
        fixed_duration: bool,
    },
    /// Motions over a key, each started from the end of the previous one.
    Diagram {
        /// The key.
        over: String,
        /// Values, SI, rising.
        values: Vec<f64>,
        /// Order of the values.
        order: DiagramOrder,
        /// Relative tolerance of the integrations.
        tolerance: f64,
    },
    /// Bifurcation curves over two keys.
    Bifurcations {
        /// The keys.
        keys: [String; 2],
        /// Ends of their ranges, SI.
        ranges: [(f64, f64); 2],
        /// Values at which branches are sought by integration.
        seeds: usize,
        /// Longest period, in drive cycles.
        longest_period: u32,
        /// Relative tolerance of the integrations.
        tolerance: f64,
    },
    /// Attractors from a cloud of starts, and the expected power.
    Basins {
        /// Starts of the cloud.
        starts: usize,
        /// Seed of the cloud.
        seed: u64,
        /// Size of the cloud, in gaps.
        spread: f64,
        /// Recognition of attractors.
        recognition: Recognition,
    },
    /// Highest stable power over a key, and its half-power bandwidth.
    Branch {
        /// The key.
        over: String,
        /// Ends of its range, SI.
        range: (f64, f64),
        /// Values at which branches are sought by integration.
        seeds: usize,
        /// Longest period, in drive cycles.
        longest_period: u32,
        /// Relative tolerance of the integrations.
        tolerance: f64,
    },
    /// Mean power over realisations of noise.
    Ensemble {
        /// Realisations.
        members: usize,
        /// Seed of the realisations.
        seed: u64,
    },
    /// Exact response to noise without contact.
    Noise,
}

impl Quantity {
    /// Returns the options that name a key with its own values, with the key.
    pub(in crate::study) fn swept(&self) -> Vec<(&'static str, &str)> {
        match self {
            Self::Sweep { over, .. } | Self::Diagram { over, .. } | Self::Branch { over, .. } => {
                vec![("over", over)]
            }
            Self::Bifurcations {
                keys: [over, against],
                ..
            } => vec![("over", over), ("against", against)],
            _ => Vec::new(),
        }
    }

    /// Returns the command that computes it.
    pub fn command(&self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Modes { .. } => "modes",
            Self::Frf { .. } => "frf",
            Self::Sweep { .. } => "sweep",
            Self::Diagram { .. } => "diagram",
            Self::Bifurcations { .. } => "bifurcations",
            Self::Basins { .. } => "basins",
            Self::Branch { .. } => "branch",
            Self::Ensemble { .. } => "ensemble",
            Self::Noise => "noise",
        }
    }
}
