//! Why an orbit cannot be had.

use crate::march::VariationError;

/// An orbit that cannot be computed; `H` says why a harvester cannot be made at a parameter.
#[derive(Debug, thiserror::Error)]
pub enum OrbitError<H: std::error::Error> {
    /// The harvester.
    #[error(transparent)]
    Harvester(H),
    /// The march of a period.
    #[error(transparent)]
    March(#[from] VariationError),
    /// No drive, or drives of several frequencies.
    #[error("an orbit needs a drive of one frequency; this harvester has {frequencies} drive frequencies")]
    Frequencies {
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
    /// Harmonic balance of several contact forces.
    #[error("harmonic balance takes one stop; this harvester has {stops}: use the method shooting, which takes any number")]
    SeveralStops {
        /// How many there are.
        stops: usize,
    },
    /// Harmonic balance under gravity.
    #[error("harmonic balance does not know the constant force of gravity; use the method shooting, or take [gravity] out")]
    Gravity,
    /// Harmonic balance of diodes and switches.
    #[error("harmonic balance does not know the diodes and switches of circuit `{circuit}`: use the method shooting")]
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
