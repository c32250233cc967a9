//! Figures 12 and 13: a record that changes between two solutions, segmented.

use crate::named::column;
use crate::{NamedFigure, NamedTable, paper_spec};
use jounce_control::Control;
use jounce_io::table::Table;
use jounce_model::structure;
use jounce_signal::{Samples, Window};

use super::{ExperimentError, NOISE, RATE_HZ, RECORD_S};
use jounce_experiment::draw::{segment_section, segment_spectra, segments, spectrogram_of};
use jounce_experiment::rig::{Disturbance, Sensor, ShakerTest, shaker_test};
use jounce_experiment::segmentation::{
    self, Candidate, SegmentMatches, Segmentation, match_segments,
};
use jounce_experiment::solution::{Solution, SolutionSearch, solutions, start_of};
use jounce_signal::spectral::{MeanPower, Segments, mean_power, spectrogram};

/// The paper's drive and load, at the force for which the powers of the model's solutions have the
/// measured ratio.
const DRIVE_HZ: f64 = 13.5;
const LOAD_OHM: f64 = 1e5;
const SETTINGS: [(&str, &str); 3] = [
    ("drive.shaker.frequency", "13.5 Hz"),
    ("drive.shaker.amplitude", "42 N"),
    ("circuit.load.resistance", "100 kohm"),
];
/// Solutions in the record, with their start times, s.
const SHOWN_SOLUTIONS: [(&str, f64); 3] = [("1a", 0.0), ("3a", 31.0), ("1a", 63.0)];
/// Mean powers of the paper's two segments, W.
const PAPER_W: [f64; 2] = [31.1e-6, 48.1e-6];
/// Drift of the shaker: an assumption, not given in the paper.
const WANDER: Disturbance = Disturbance {
    amplitude_ratio: 2e-3,
    frequency_ratio: 5e-5,
    memory_s: 5.0,
    amplitude_drift: 0.0,
    frequency_drift: 0.0,
};
/// Maximum distance of a matching solution.
const MAX_SOLUTION_DISTANCE: f64 = 0.2;
/// Drive cycles in a segment of the spectrogram, and the overlap.
const SEGMENT_CYCLES: f64 = 24.0;
const OVERLAP: f64 = 0.5;

/// Record with its analysis.
pub(super) struct Alternating {
    voltage_v: Vec<f64>,
    found: Segmentation,
    powers: Vec<MeanPower>,
    matches: Vec<SegmentMatches>,
    known: Vec<Solution>,
}

impl Alternating {
    /// Records the model and analyses the record.
    pub fn compute(control: &Control) -> Result<Self, ExperimentError> {
        let spec = paper_spec(&SETTINGS)?;
        let known = solutions(
            &spec,
            &SolutionSearch {
                starts: 8,
                ..SolutionSearch::default()
            },
            control,
        )?;
        let test = ShakerTest {
            rate_hz: RATE_HZ,
            duration_s: RECORD_S,
            before_s: 0.0,
            starts: SHOWN_SOLUTIONS
                .iter()
                .map(|(id, at_s)| Ok((*at_s, start_of(&known, id)?)))
                .collect::<Result<_, ExperimentError>>()?,
            disturbance: WANDER,
            accelerometers: Vec::new(),
            sensor: Sensor {
                noise_ratio: NOISE,
                bits: Some(16),
            },
            seed: 1,
        };
        let record = shaker_test(&spec, &structure::modes(&spec)?, &test, control)?;
        let voltage_v = record.channel("mfc.voltage")?.values.clone();
        let samples = Samples::new(&voltage_v, RATE_HZ)?;
        let result = segmentation::segments(&samples, DRIVE_HZ)?;
        let power = |range: (usize, usize)| -> Result<MeanPower, ExperimentError> {
            Ok(mean_power(
                &Samples::new(&voltage_v[range.0..range.1], RATE_HZ)?,
                LOAD_OHM,
                false,
            )?)
        };
        let powers = result
            .segments
            .iter()
            .map(|segment| power(segment.inner))
            .collect::<Result<_, _>>()?;
        let matches = result
            .segments
            .iter()
            .map(|segment| {
                match_segments(&samples, DRIVE_HZ, segment, &known, MAX_SOLUTION_DISTANCE)
            })
            .collect();
        Ok(Self {
            found: result,
            powers,
            matches,
            known,
            voltage_v,
        })
    }

    pub fn summary(&self) -> Vec<String> {
        let simulated: Vec<String> = SHOWN_SOLUTIONS
            .iter()
            .map(|(id, at_s)| format!("{id} from {at_s} s"))
            .collect();
        let result: Vec<String> = (self.found.segments.iter().zip(&self.matches))
            .map(|(segment, matches)| {
                format!(
                    "{} from {:.2} s",
                    matches.id().unwrap_or("no solution"),
                    segment.start_s
                )
            })
            .collect();
        let powers: Vec<f64> = self.powers.iter().map(|power| power.mean_power_w).collect();
        let (low, high) = powers
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), power| {
                (low.min(*power), high.max(*power))
            });
        vec![
            format!(
                "Simulated. A record of {RECORD_S} s at {RATE_HZ} Hz: 13.5 Hz, 100 kΩ, 42 N, a \
                force that the paper does not print. Input: {}; the disturbance that moves the \
                beam from one solution to the other is not modelled. The shaker drifts by {} % in \
                amplitude, noise is {} % of the signal. Segmentation finds, without these inputs: \
                {}; changes are located within {:.2} s.",
                simulated.join(", "),
                100.0 * WANDER.amplitude_ratio,
                100.0 * NOISE,
                result.join(", "),
                self.found.uncertainty_s
            ),
            format!(
                "The mean powers of the two solutions have the ratio {:.2}; the paper's segments \
                have {:.1} and {:.1} µW, ratio {:.2}. The paper's second segment has lines at \
                half the drive frequency. The model's upper solution repeats after three cycles \
                and has lines at thirds of it; the model has no solution of two cycles there.",
                high / low,
                1e6 * PAPER_W[0],
                1e6 * PAPER_W[1],
                PAPER_W[1] / PAPER_W[0]
            ),
        ]
    }

    pub fn table(&self) -> Result<NamedTable, ExperimentError> {
        let (segments, powers, matches) = (&self.found.segments, &self.powers, &self.matches);
        let nearest = |heading, distance: fn(&Candidate) -> f64| {
            column(matches, heading, |matches| {
                matches.candidates.first().map_or(f64::NAN, distance)
            })
        };
        let table = Table::new(vec![
            column(segments, ("start_s", "s", "From"), |segment| {
                segment.start_s
            }),
            column(segments, ("end_s", "s", "To"), |segment| segment.end_s),
            column(
                segments,
                ("period_cycles", "", "Period, drive cycles (0: none)"),
                |segment| segment.period.cycles.unwrap_or(0) as u64,
            ),
            column(powers, ("mean_power_w", "W", "Mean power"), |power| {
                power.mean_power_w
            }),
            column(powers, ("half_width_w", "W", "± 95 %"), |power| {
                power.half_width_w
            }),
            column(
                matches,
                ("solution", "", "Solution of the model"),
                |matches| matches.id().unwrap_or("none").to_owned(),
            ),
            nearest(("model_power_w", "W", "Its mean power"), |c| c.mean_power_w),
            nearest(("waveform_distance", "", "Distance of its waveform"), |c| {
                c.waveform_distance.unwrap_or(f64::NAN)
            }),
            nearest(("spectrum_distance", "", "Distance of its spectrum"), |c| {
                c.spectrum_distance.unwrap_or(f64::NAN)
            }),
        ])?;
        let caption = format!(
            "Segments of the record of figure 12 (simulated), compared with the {} solutions of \
            the model.",
            self.known.len()
        );
        Ok(NamedTable::new("figure-12-segments", &caption, 4, table))
    }

    pub fn figures(&self) -> Result<Vec<NamedFigure>, ExperimentError> {
        let samples = Samples::new(&self.voltage_v, RATE_HZ)?;
        let (quantity, unit) = ("Voltage", "V");
        let length = (SEGMENT_CYCLES / DRIVE_HZ * RATE_HZ / 2.0).round() as usize * 2;
        let over_time = spectrogram(&samples, &Segments::new(length, OVERLAP, Window::Hann)?)?;
        let figures = [
            (
                "figure-12",
                "Figure 12, simulated: the voltage at 13.5 Hz and 100 kΩ, and its rms by segments.",
                segments(
                    "Voltage at 13.5 Hz (simulated)",
                    quantity,
                    unit,
                    &samples,
                    &self.found,
                ),
            ),
            (
                "figure-12-section",
                "Simulated. One value for each drive cycle of the same record.",
                segment_section(
                    "One value for each drive cycle (simulated)",
                    quantity,
                    unit,
                    &samples,
                    &self.found,
                    DRIVE_HZ,
                ),
            ),
            (
                "figure-12-spectrogram",
                "Simulated. Peak amplitudes of the same record over time: segments of 24 drive cycles, half overlapping, Hann window.",
                spectrogram_of(
                    "Spectrogram of the voltage (simulated)",
                    quantity,
                    unit,
                    &over_time,
                    Some(DRIVE_HZ),
                ),
            ),
            (
                "figure-13",
                "Figure 13, simulated: spectra of the voltage (Hann window, peak amplitudes) for \
                the segments of figure 12.",
                segment_spectra(
                    "Spectra of the segments (simulated)",
                    quantity,
                    unit,
                    &samples,
                    &self.found,
                    DRIVE_HZ,
                )?,
            ),
        ];
        Ok(figures
            .into_iter()
            .map(|(name, caption, figure)| NamedFigure::new(name, caption, figure))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Segmentation recovers the inputs: three segments, each change within a block (measured 0.11
    /// s), each solution by name, waveforms within 0.003, powers within 0.4 % of the orbits'. The
    /// amplitude drifts by 0.2 %.
    #[test]
    fn the_record_is_cut_where_it_was_put_together() {
        let result =
            Alternating::compute(&Control::default()).unwrap_or_else(|fault| panic!("{fault}"));
        assert_eq!(result.found.segments.len(), SHOWN_SOLUTIONS.len());
        for (k, (id, at_s)) in SHOWN_SOLUTIONS.into_iter().enumerate() {
            let (segment, matches) = (&result.found.segments[k], &result.matches[k]);
            let first = &matches.candidates[0];
            let power = result.powers[k].mean_power_w / first.mean_power_w - 1.0;
            eprintln!(
                "{id}: {:.3} s off, waveform {:.4?}, power {power:.1e} off",
                segment.start_s - at_s,
                first.waveform_distance
            );
            assert_eq!(matches.id(), Some(id));
            assert!(
                (segment.start_s - at_s).abs() < result.found.uncertainty_s && power.abs() < 5e-3,
                "{segment:?} {power}"
            );
            assert!(
                first
                    .waveform_distance
                    .is_some_and(|distance| distance < 0.02),
                "{first:?}"
            );
        }
    }
}
