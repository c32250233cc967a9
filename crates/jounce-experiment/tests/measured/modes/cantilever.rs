//! A steel cantilever with only the amplitude spectrum of its response to a hit recorded.

use crate::samples::real;
use jounce_data::read;
use jounce_identification::modal::{ModalSettings, identify_decays};
use jounce_identification::response::Decays;

/// Highest lines of the spectrum, Hz, as noted with the data.
const NOTED_HZ: [f64; 3] = [6.57, 41.47, 117.93];

/// Natural frequencies of the recording.
fn natural_frequencies_hz() -> Option<Vec<f64>> {
    let spectrum = read::file(&real("hrshm_cantilever/impulse_FFT_data.lvm")?)
        .unwrap_or_else(|fault| panic!("{fault}"))
        .recordings
        .remove(0);
    let decays = Decays::of_spectrum(&spectrum, &[]).expect("amplitudes over even lines");
    let identification =
        identify_decays(&decays, (2.0, 160.0), ModalSettings { order: 20 }).expect("modes");
    Some(
        identification
            .modes
            .iter()
            .map(|mode| mode.frequency_hz)
            .collect(),
    )
}

/// Lines are 0.0853 Hz apart, so a line may be 0.043 Hz from its mode. Measured: 6.603, 41.451 and
/// 117.941 Hz.
#[test]
fn the_modes_of_a_cantilever_come_from_its_amplitude_spectrum() {
    let Some(identified_hz) = natural_frequencies_hz() else {
        return;
    };
    eprintln!("{identified_hz:.4?} Hz");
    assert_eq!(identified_hz.len(), 3, "{identified_hz:?}");
    for (identified_hz, noted_hz) in identified_hz.iter().zip(NOTED_HZ) {
        assert!(
            (identified_hz - noted_hz).abs() < 0.0427,
            "{identified_hz} {noted_hz}"
        );
    }
}
