//! Errors of the computation of an orbit.

use jounce_dynamics::SensitivityError;

/// Error of the computation of an orbit; `H` is the error of building a harvester at a parameter.
#[derive(Debug, thiserror::Error)]
pub enum OrbitError<H: std::error::Error> {
    /// The harvester cannot be built.
    #[error(transparent)]
    Harvester(H),
    /// The integration over a period failed.
    #[error(transparent)]
    Integration(#[from] SensitivityError),
    /// No periodic drive, or drives without a common period.
    #[error(
        "{}",
        if *frequencies == 0 {
            "an orbit needs a periodic drive: add a [drive.NAME] with an amplitude and a frequency".to_owned()
        } else {
            format!("an orbit needs drives with a common period of at most 100 cycles of the slowest, and these {frequencies} frequencies have none: choose frequencies in ratios of small integers, or remove all drives but those of one frequency")
        }
    )]
    Frequencies {
        /// Number of frequencies.
        frequencies: usize,
    },
    /// Harmonic balance with several drive frequencies.
    #[error(
        "harmonic balance needs drives of one frequency, and these have {frequencies}: use the method shooting"
    )]
    Summed {
        /// Number of frequencies.
        frequencies: usize,
    },
    /// Harmonic balance with a law that has no force.
    #[error(
        "stop `{stop}` is rigid: harmonic balance cannot sum the harmonics of its impulses; use the method shooting, or a compliant law"
    )]
    Impulsive {
        /// Name of the stop.
        stop: String,
    },
    /// Harmonic balance with a free body.
    #[error(
        "harmonic balance needs a stiffness on every body, and a body of this harvester has no stiffness: a constant force would move it without limit; use the method shooting, or add a stiffness"
    )]
    Free,
    /// Harmonic balance with diodes or switches.
    #[error(
        "harmonic balance does not support the diodes and switches of circuit `{circuit}`: use the method shooting"
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
