//! Why an orbit cannot be had.

use crate::integrate::SensitivityError;

/// An orbit that cannot be computed; `H` says why a harvester cannot be made at a parameter.
#[derive(Debug, thiserror::Error)]
pub enum OrbitError<H: std::error::Error> {
    /// The harvester.
    #[error(transparent)]
    Harvester(H),
    /// The march of a period.
    #[error(transparent)]
    March(#[from] SensitivityError),
    /// No drive, or drives that do not repeat themselves together.
    #[error(
        "{}",
        if *frequencies == 0 {
            "an orbit needs a drive that repeats itself: add a [drive.NAME] with an amplitude and a frequency".to_owned()
        } else {
            format!("an orbit needs drives that repeat themselves together within 100 cycles of the slowest, and these {frequencies} frequencies do not: give frequencies whose ratios are those of small whole numbers, or take out all drives but those of one frequency")
        }
    )]
    Frequencies {
        /// How many there are.
        frequencies: usize,
    },
    /// Harmonic balance of several frequencies.
    #[error(
        "harmonic balance takes drives of one frequency, and these have {frequencies}: use the method shooting"
    )]
    Summed {
        /// How many there are.
        frequencies: usize,
    },
    /// Harmonic balance of a law without a force.
    #[error(
        "stop `{stop}` is rigid: its impulses have no harmonics that harmonic balance could sum; use the method shooting, or a compliant law"
    )]
    Impulsive {
        /// Name of the stop.
        stop: String,
    },
    /// Harmonic balance of a body that nothing brings back.
    #[error(
        "harmonic balance needs a body that comes back by itself, and a body of this harvester has no stiffness: a constant force would move it without end; use the method shooting, or give it a stiffness"
    )]
    Free,
    /// Harmonic balance of diodes and switches.
    #[error(
        "harmonic balance does not know the diodes and switches of circuit `{circuit}`: use the method shooting"
    )]
    Rectified {
        /// Name of the circuit.
        circuit: String,
    },
    /// The eigenvalues of the period map did not converge.
    #[error("the Floquet multipliers could not be computed at drive frequency {frequency_hz} Hz")]
    Multipliers {
        /// Drive frequency, Hz.
        frequency_hz: f64,
    },
}
