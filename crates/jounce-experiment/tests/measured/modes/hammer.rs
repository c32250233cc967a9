//! Five hammer hits on a real structure, against an independent package and the values noted with
//! the data.

use crate::samples::real;
use jounce_data::read;
use jounce_data::recording::Recording;
use jounce_identification::contact;
use jounce_identification::modal::{Band, ModalSettings, ResponseQuantity, identify};
use jounce_identification::response::{ChannelChoice, Excitation, MeasuredResponses};
use jounce_signal::spectral::{
    Estimator, FrequencyResponse, HitSearch, ImpactSettings, Segments, SpectrumAverages,
    WindowBias, hits,
};
use jounce_signal::{Samples, Window};

fn records() -> Option<Vec<Recording>> {
    let paths: Option<Vec<_>> = (1..=5)
        .map(|k| real(&format!("pyfrf_hammer/measurements_{k}.npy")))
        .collect();
    let first = |path| {
        read::file(path)
            .unwrap_or_else(|fault| panic!("{fault}"))
            .recordings
            .remove(0)
    };
    Some(paths?.iter().map(|path| first(path)).collect())
}

fn averaged(records: &[Recording], estimator: Estimator) -> FrequencyResponse {
    let segments = Segments::new(25_600, 0.0, Window::Rectangular).expect("segments");
    let mut averages = SpectrumAverages::new(12_801);
    for record in records {
        let transform = |channel: usize| {
            segments.transform(
                &Samples::new(&record.channels[channel].values, 25_600.0).expect("samples"),
                0,
                0.0,
            )
        };
        averages.add(&transform(0), &transform(1)).expect("lines");
    }
    averages
        .response(
            segments.frequency_hz(25_600.0),
            estimator,
            WindowBias::Whole,
        )
        .expect("five blocks")
}

/// Values of pyFRF 1.5.0 (`FRF(25600, exc, resp, window="none", fft_len=25600)`,
/// `get_FRF(estimator, "accelerance")`, `get_coherence()`), lines 900, 2640, 3669 and 4128 Hz.
/// Measured here: equal within 7e-16.
#[test]
fn responses_and_coherence_are_those_of_an_independent_package() {
    let Some(records) = records() else { return };
    let expected = [
        (
            Estimator::H1,
            [
                (900, 13.906155214158728, 455.7567454751131),
                (2640, 107.85660937874253, -302.42749185890216),
                (3669, 670.8860200167446, 2945.097328904028),
                (4128, -491.2940803047045, -2579.944139575573),
            ],
        ),
        (
            Estimator::H2,
            [
                (900, 13.908802743797352, 455.8435149288597),
                (2640, 107.8703446304775, -302.46600519393274),
                (3669, 671.8543856237653, 2949.348320693317),
                (4128, -492.14370676259597, -2584.405802943277),
            ],
        ),
        (
            Estimator::Hv { noise_ratio: 1.0 },
            [
                (900, 13.908802731065673, 455.843514511595),
                (2640, 107.87034449726725, -302.4660048204142),
                (3669, 671.8543855177808, 2949.3483202280595),
                (4128, -492.14370663962933, -2584.40580229754),
            ],
        ),
    ];
    for (estimator, lines) in expected {
        let responses = averaged(&records, estimator);
        for (line, re, im) in lines {
            let error =
                (responses.value[line].re - re).hypot(responses.value[line].im - im) / re.hypot(im);
            assert!(error < 1e-12, "{estimator:?} {line}: {error:e}");
        }
    }
    let coherence = averaged(&records, Estimator::H1).coherence;
    for (line, expected) in [
        (900, 0.9998096507882533),
        (2640, 0.9998726688805711),
        (3669, 0.9985586674318991),
        (4128, 0.9982736212081619),
    ] {
        assert!(
            (coherence[line] - expected).abs() < 1e-9 && coherence[line] >= 0.998,
            "{line}: {}",
            coherence[line]
        );
    }
}

#[test]
fn hits_have_their_noted_peaks_and_contact_times() {
    let Some(records) = records() else { return };
    for (record, peak) in records.iter().zip([68.6, 83.7, 85.4, 88.9, 76.5]) {
        let force = Samples::new(&record.channels[0].values, 25_600.0).expect("samples");
        let impacts = hits(&force, HitSearch::default()).expect("a hit");
        assert_eq!(impacts.len(), 1);
        assert!(
            (impacts[0].peak_force_n - peak).abs() < 0.06,
            "{peak}: {:?}",
            impacts[0]
        );
        assert!(
            (0.26e-3..0.32e-3).contains(&impacts[0].contact_time_s),
            "{:?}",
            impacts[0]
        );
        // Seven samples per pulse do not show Hertz's law (exponents 0.64 to 0.97, deviation 0.11
        // to 0.22), but they are few and include the filter of the amplifier. Restitution 0.66 to
        // 0.71 by the asymmetry.
        let law = contact::fit(&force, &impacts[0], None).unwrap_or_else(|fault| panic!("{fault}"));
        assert!(
            law.exponent < 1.2
                && law.exponent_deviation > 0.1
                && (0.6..0.8).contains(&law.restitution),
            "{law:?}"
        );
    }
}

/// The same resonances in bands that begin far from 0. Some of these cannot be solved with the
/// z-domain circle counted from 0 Hz.
#[test]
fn bands_far_from_zero_hold_the_same_modes() {
    let Some(records) = records() else { return };
    let responses = averaged(&records, Estimator::H1);
    let deviation: Vec<f64> = (0..responses.value.len())
        .map(|k| responses.relative_deviation(k))
        .collect();
    let bands = [
        ((500.0, 1500.0), vec![900.0]),
        ((800.0, 1000.0), vec![900.0]),
        ((2400.0, 2900.0), vec![2640.2]),
        ((3500.0, 4300.0), vec![3668.7, 4127.5]),
    ];
    for (between_hz, resonances) in bands {
        let (value, deviation) = (
            std::slice::from_ref(&responses.value),
            std::slice::from_ref(&deviation),
        );
        let band = Band::new(
            &responses.frequency_hz,
            value,
            deviation,
            1,
            ResponseQuantity::Acceleration,
            between_hz,
        )
        .expect("a band");
        let identified =
            identify(&band, ModalSettings::default()).unwrap_or_else(|fault| panic!("{fault}"));
        for expected in resonances {
            let error = |hz: f64| (hz / expected - 1.0).abs();
            let nearest = identified
                .modes
                .iter()
                .map(|mode| mode.frequency_hz)
                .min_by(|a, b| error(*a).total_cmp(&error(*b)));
            eprintln!(
                "{between_hz:?} Hz, {} modes: {nearest:?} Hz",
                identified.modes.len()
            );
            assert!(
                nearest.is_some_and(|hz| error(hz) < 1e-3),
                "no mode at {expected} Hz: {:?}",
                identified.modes
            );
        }
    }
}

/// Natural frequencies of sdypy-EMA 0.31 (least-squares complex frequency, order 40, 500 to 5000
/// Hz, poles nearest to the noted resonances). Measured: 900.147, 2640.255, 3668.794 and 4127.524
/// Hz, within 0.0141 %. With the band up to 5000 Hz the mode at 4128 Hz, which has neighbours at
/// 4093 and 4163 Hz, is not stable, and is not found.
#[test]
fn modes_are_those_of_an_independent_package() {
    let Some(records) = records() else { return };
    let responses = averaged(&records, Estimator::H1);
    let deviation: Vec<f64> = (0..responses.value.len())
        .map(|k| responses.relative_deviation(k))
        .collect();
    let band = Band::new(
        &responses.frequency_hz,
        std::slice::from_ref(&responses.value),
        &[deviation],
        1,
        ResponseQuantity::Acceleration,
        (500.0, 4300.0),
    );
    let identified = identify(&band.expect("a band"), ModalSettings::default())
        .unwrap_or_else(|fault| panic!("{fault}"));
    for expected in [900.020, 2640.196, 3668.706, 4128.050] {
        let near = identified
            .modes
            .iter()
            .any(|mode| (mode.frequency_hz / expected - 1.0).abs() < 1e-3);
        assert!(near, "no mode at {expected} Hz: {:?}", identified.modes);
    }
    // One sensor and unequal hits: the misfit of the model is far above the coherence variance, and
    // widens the deviations.
    assert!(
        identified.misfit > 1.0
            && identified
                .modes
                .iter()
                .all(|mode| mode.frequency_deviation_hz > 0.01)
    );
}

/// The band up to 12.8 kHz has more modes than order 40 can represent: the missing ones are found
/// at their peaks.
#[test]
#[ignore = "long: runs with ./test --long"]
fn modes_are_found_in_the_full_band() {
    let Some(records) = records() else { return };
    let chosen = ChannelChoice {
        excitation: Excitation::Force("channel 2".to_owned()),
        responses: Vec::new(),
    };
    let responses = MeasuredResponses::of_hits(&records, &chosen, &ImpactSettings::default())
        .unwrap_or_else(|fault| panic!("{fault}"));
    let identification = identify(
        &Band::of(&responses, (0.0, 12_800.0)).expect("a band"),
        ModalSettings::default(),
    )
    .expect("modes");
    let modes: Vec<(f64, f64)> = identification
        .modes
        .iter()
        .map(|mode| (mode.frequency_hz, mode.frequency_half_width_hz()))
        .collect();
    eprintln!(
        "{modes:.2?}, misfit {:.1}, unexplained {:?}",
        identification.misfit, identification.unexplained
    );
    for expected in [900.020, 2640.196, 3668.706, 4128.050] {
        assert!(
            modes
                .iter()
                .any(|(hz, _)| (hz / expected - 1.0).abs() < 1e-3),
            "no mode at {expected} Hz: {modes:?}"
        );
    }
}
