//! From responses to modes.

use faer::c64;
use serde::Serialize;
use std::f64::consts::TAU;

use super::close_modes::apart;
use super::likelihood::{ModalFit, fit};
use super::multi_band::stable;
use super::peaks::{ResponsePeak, unexplained};
use super::references::fit_shared;
use super::stabilisation::MAX_DAMPING;
use super::{Band, ModalError, Pole, StablePole};
use crate::spectral::student_95;

/// A pole whose frequency has a standard deviation above this share stands for no mode: the diagram asks as much from order to order.
const MAX_FREQUENCY_DEVIATION: f64 = 0.01;

/// How modes are sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ModalSettings {
    /// Largest order of the denominator.
    pub order: usize,
}

impl Default for ModalSettings {
    fn default() -> Self {
        Self { order: 40 }
    }
}

/// A mode with its uncertainties.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Its standard deviation, Hz.
    pub frequency_deviation_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Its standard deviation.
    pub damping_deviation: f64,
    /// Deviations from a value to an end of its interval of 95 %: Student's, where the deviations rest on few blocks.
    pub quantile_95: f64,
    /// Residue of each response, in displacement per force times rad/s; of several references that to the one which moves the mode most.
    #[serde(skip)]
    pub residue: Vec<c64>,
    /// What each reference moves of the mode, 1 at the largest: by reciprocity its shape at the places of the forces. One number, 1, for one
    /// reference, and for decays.
    #[serde(skip)]
    pub participation: Vec<c64>,
}

impl Mode {
    /// An interval of 95 % reaches this many deviations to both sides, where these are known.
    pub const QUANTILE_95: f64 = 1.959_963_984_540_054;

    /// Half of the interval of 95 % of the frequency, Hz.
    pub fn frequency_half_width_hz(&self) -> f64 {
        self.quantile_95 * self.frequency_deviation_hz
    }

    /// Half of the interval of 95 % of the damping ratio.
    pub fn damping_half_width(&self) -> f64 {
        self.quantile_95 * self.damping_deviation
    }

    /// The residues over the largest of them, so that it is 1: the shape seen by the responses.
    pub fn shape(&self) -> Vec<c64> {
        over_largest(&self.residue)
    }

    /// Outputs and references change sides.
    fn swap(&mut self) {
        let largest = largest(&self.residue);
        let participation = over_largest(&self.residue);
        self.residue = self.participation.iter().map(|b| b * largest).collect();
        self.participation = participation;
    }

    pub(super) fn pole(&self) -> Pole {
        Pole {
            frequency_hz: self.frequency_hz,
            damping_ratio: self.damping_ratio,
        }
    }

    /// True where the interval of its damping ratio reaches down to 0: noise makes such poles, and it may be no mode.
    pub fn is_doubtful(&self) -> bool {
        self.damping_ratio <= self.damping_half_width()
    }

    /// Takes off the damping that an exponential window added, in 1/s. The window moves the pole by its decay, along the real axis.
    pub fn without_decay(&mut self, decay_per_s: f64) {
        let w = TAU * self.frequency_hz;
        let (re, im) = (
            -self.damping_ratio * w + decay_per_s,
            w * (1.0 - self.damping_ratio.powi(2)).max(0.0).sqrt(),
        );
        let size = re.hypot(im);
        (self.frequency_hz, self.damping_ratio) = (size / TAU, -re / size);
    }
}

fn largest(values: &[c64]) -> c64 {
    values
        .iter()
        .copied()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()))
        .unwrap_or(c64::new(1.0, 0.0))
}

fn over_largest(values: &[c64]) -> Vec<c64> {
    let largest = largest(values);
    values.iter().map(|value| value / largest).collect()
}

/// Modes, and what they rest on.
#[derive(Debug, Clone, PartialEq)]
pub struct Identification {
    /// The modes in ascending frequency.
    pub modes: Vec<Mode>,
    /// The stabilisation diagram: at each frequency the poles of the narrowest part of the band that was searched there.
    pub diagram: Vec<StablePole>,
    /// Frequencies of the band, Hz.
    pub frequency_hz: Vec<f64>,
    /// The responses of the band as displacement per force.
    pub measured: Vec<Vec<c64>>,
    /// What the modes give there.
    pub model: Vec<Vec<c64>>,
    /// Squared error over the variance told by the coherence; above 1 the deviations are widened by its root. Over the mean square of the
    /// responses where no variance is told.
    pub misfit: f64,
    /// Peaks of the responses that no mode explains; none are sought in decays.
    pub unexplained: Vec<ResponsePeak>,
}

/// Finds the modes of a band: pLSCF poles in it and in its lower parts, those that are stable, their maximum-likelihood refinement. Peaks of
/// the responses that these do not explain, since the band holds more modes than the order allows, are modes too where a pole that begins at each
/// is then known well.
///
/// # Errors
/// Too few lines, responses that are zero, no stable pole.
pub fn identify(band: &Band, settings: ModalSettings) -> Result<Identification, ModalError> {
    let (diagram, start) = candidates(band, settings)?;
    let mut found = if band.inputs > 1 {
        shared(band, diagram, &start)?
    } else {
        explained(band, diagram, &start)?
    };
    if band.swapped {
        found.modes.iter_mut().for_each(Mode::swap);
    }
    (found.measured, found.model) = (band.in_order(found.measured), band.in_order(found.model));
    Ok(found)
}

/// The modes of maximum likelihood of one reference, those at peaks that they do not explain among them.
fn explained(
    band: &Band,
    diagram: Vec<StablePole>,
    start: &[Pole],
) -> Result<Identification, ModalError> {
    let mut found = refined(band, diagram, start)?;
    found.unexplained = unexplained(band, &found.modes);
    if !found.unexplained.is_empty() {
        let further = found.unexplained.iter().map(|peak| peak.pole());
        let start: Vec<Pole> = found.modes.iter().map(Mode::pole).chain(further).collect();
        // Peaks that are no modes may leave equations without a solution: the poles that stay are enough then.
        if let Ok(more) = refined(band, found.diagram.clone(), &start)
            && more.misfit < found.misfit
        {
            found = more;
            found.unexplained = unexplained(band, &found.modes);
        }
    }
    Ok(found)
}

/// The modes of maximum likelihood of several references.
fn shared(
    band: &Band,
    diagram: Vec<StablePole>,
    start: &[Pole],
) -> Result<Identification, ModalError> {
    let start = apart(&diagram, start, band.inputs);
    let mut found = fit_shared(band, &start).ok_or(none(band))?;
    while let Some(left) = known(band, &found.poles, &found.deviation)? {
        found = fit_shared(band, &left).ok_or(none(band))?;
    }
    let ModalFit {
        poles,
        deviation,
        residue,
        participation,
        model,
        misfit,
        freedom,
        ..
    } = found;
    let mode = |r: usize| {
        let mut mode = mode(
            poles[r],
            deviation[r],
            freedom[r],
            residue.iter().map(|output| output[r]).collect(),
        );
        mode.participation = over_largest(&participation[r]);
        let largest = participation[r]
            .iter()
            .map(|b| b.norm())
            .fold(0.0, f64::max);
        mode.residue.iter_mut().for_each(|a| *a *= largest);
        mode
    };
    identification(
        band,
        diagram,
        (0..poles.len()).map(mode).collect(),
        model,
        misfit,
    )
}

fn mode(
    pole: Pole,
    (frequency_deviation_hz, damping_deviation): (f64, f64),
    freedom: Option<f64>,
    residue: Vec<c64>,
) -> Mode {
    let quantile_95 = freedom.map_or(Mode::QUANTILE_95, student_95);
    let Pole {
        frequency_hz,
        damping_ratio,
    } = pole;
    let participation = vec![c64::new(1.0, 0.0)];
    Mode {
        frequency_hz,
        frequency_deviation_hz,
        damping_ratio,
        damping_deviation,
        quantile_95,
        residue,
        participation,
    }
}

/// The poles that are known well enough to be modes where some are not; none where all are.
fn known(
    band: &Band,
    poles: &[Pole],
    deviation: &[(f64, f64)],
) -> Result<Option<Vec<Pole>>, ModalError> {
    let known = |(pole, deviation): &(&Pole, &(f64, f64))| {
        deviation.0 < MAX_FREQUENCY_DEVIATION * pole.frequency_hz
    };
    let left: Vec<Pole> = poles
        .iter()
        .zip(deviation)
        .filter(known)
        .map(|(pole, _)| *pole)
        .collect();
    if left.is_empty() {
        return Err(none(band));
    }
    Ok((left.len() < poles.len()).then_some(left))
}

/// The stabilisation diagram of a band and the poles that stay.
pub(super) fn candidates(
    band: &Band,
    settings: ModalSettings,
) -> Result<(Vec<StablePole>, Vec<Pole>), ModalError> {
    let (diagram, start) = stable(band, settings)?;
    if start.is_empty() {
        Err(none(band))
    } else {
        Ok((diagram, start))
    }
}

fn none(band: &Band) -> ModalError {
    ModalError::NoMode {
        low_hz: band.low_hz,
        high_hz: band.high_hz,
    }
}

/// The modes of maximum likelihood that begin at some poles; those that turn out to be known to nothing are left out, and the rest fitted anew.
pub(super) fn refined(
    band: &Band,
    diagram: Vec<StablePole>,
    start: &[Pole],
) -> Result<Identification, ModalError> {
    let mut found = fit(band, start).ok_or(none(band))?;
    while let Some(left) = known(band, &found.poles, &found.deviation)? {
        found = fit(band, &left).ok_or(none(band))?;
    }
    let ModalFit {
        poles,
        deviation,
        residue,
        model,
        misfit,
        freedom,
        ..
    } = found;
    let modes = (0..poles.len()).map(|r| {
        mode(
            poles[r],
            deviation[r],
            freedom[r],
            residue.iter().map(|response| response[r]).collect(),
        )
    });
    identification(band, diagram, modes.collect(), model, misfit)
}

/// A pole that the refinement sends out of the band, or damps like none of a structure, takes up what is no mode.
fn identification(
    band: &Band,
    diagram: Vec<StablePole>,
    mut modes: Vec<Mode>,
    model: Vec<Vec<c64>>,
    misfit: f64,
) -> Result<Identification, ModalError> {
    modes.retain(|mode| {
        (band.low_hz..=band.high_hz).contains(&mode.frequency_hz)
            && mode.damping_ratio < MAX_DAMPING
    });
    if modes.is_empty() {
        return Err(none(band));
    }
    modes.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    let (frequency_hz, measured) = (band.frequency_hz.clone(), band.response.clone());
    Ok(Identification {
        modes,
        diagram,
        frequency_hz,
        measured,
        model,
        misfit,
        unexplained: Vec::new(),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::plscf::tests::{POLES, exact, shape};
    use super::super::{ResponseQuantity, mac};
    use super::*;
    use jounce::drive::RandomStream;

    fn lines() -> Vec<f64> {
        (1..1200).map(|k| f64::from(k) * 0.1).collect()
    }

    /// Measured on exact responses: frequencies 3e-16, damping ratios 9e-16, MAC 1 - 5e-16 (two modes 1 Hz apart among them).
    #[test]
    fn exact_responses_give_back_frequencies_damping_and_shapes() {
        let response = exact(&lines(), &POLES, shape, 4, 1);
        let band = Band::new(
            &lines(),
            &response,
            &[],
            1,
            ResponseQuantity::Displacement,
            (1.0, 110.0),
        )
        .unwrap();
        let found = identify(&band, ModalSettings::default()).unwrap();
        assert_eq!(found.modes.len(), 4, "{:?}", found.modes);
        for (r, (mode, pole)) in found.modes.iter().zip(POLES).enumerate() {
            assert!(
                (mode.frequency_hz / pole.frequency_hz - 1.0).abs() < 1e-12,
                "{mode:?}"
            );
            assert!(
                (mode.damping_ratio / pole.damping_ratio - 1.0).abs() < 1e-11,
                "{mode:?}"
            );
            let truth: Vec<c64> = (0..4).map(|o| c64::new(shape(r, o), 0.0)).collect();
            assert!(mac(&mode.residue, &truth) > 1.0 - 1e-12);
            // Mass 1: the residue is phi_o phi_i / (2 j w_d).
            let w = TAU * pole.frequency_hz * (1.0 - pole.damping_ratio.powi(2)).sqrt();
            let residue = c64::new(0.0, -shape(r, 1) * shape(r, 0) / (2.0 * w));
            assert!(
                (mode.residue[1] - residue).norm() < 1e-6 * residue.norm(),
                "{:?} {residue:?}",
                mode.residue[1]
            );
        }
    }

    /// With noise of a known variance the truth lies within 1.96 stated deviations as often as it should: 95 +- 3 % of 100 trials of two
    /// frequencies and damping ratios; measured 96.25 %.
    #[test]
    fn stated_deviations_hold_the_truth_as_often_as_they_say() {
        let frequency_hz: Vec<f64> = (50..300).map(|k| f64::from(k) * 0.2).collect();
        let poles = [
            POLES[0],
            Pole {
                frequency_hz: 40.0,
                damping_ratio: 0.02,
            },
        ];
        let clean = exact(&frequency_hz, &poles, shape, 2, 1);
        let (mut inside, mut all) = (0, 0);
        for seed in 0..100 {
            let mut stream = RandomStream::new(seed, 3);
            let deviation = 0.05;
            let mut noisy = |h: &c64| {
                let [re, im] = stream.normal_pair();
                h + c64::new(re, im) * deviation * h.norm()
            };
            let response: Vec<Vec<c64>> = clean
                .iter()
                .map(|h| h.iter().map(&mut noisy).collect())
                .collect();
            let told = vec![vec![deviation; frequency_hz.len()]; 2];
            let band = Band::new(
                &frequency_hz,
                &response,
                &told,
                1,
                ResponseQuantity::Displacement,
                (10.0, 60.0),
            )
            .unwrap();
            let ModalFit {
                poles: found,
                deviation: stated,
                ..
            } = fit(&band, &poles).unwrap();
            for (r, pole) in poles.iter().enumerate() {
                let off = [
                    (found[r].frequency_hz - pole.frequency_hz) / stated[r].0,
                    (found[r].damping_ratio - pole.damping_ratio) / stated[r].1,
                ];
                inside += off.iter().filter(|off| off.abs() <= 1.96).count();
                all += 2;
            }
        }
        let share = inside as f64 / f64::from(all);
        assert!((0.92..=0.98).contains(&share), "{share}");
    }

    #[test]
    fn noise_has_no_modes() {
        let mut stream = RandomStream::new(5, 0);
        let noise: Vec<c64> = lines()
            .iter()
            .map(|_| {
                let [re, im] = stream.normal_pair();
                c64::new(re, im)
            })
            .collect();
        let band = Band::new(
            &lines(),
            &[noise],
            &[],
            1,
            ResponseQuantity::Displacement,
            (1.0, 110.0),
        )
        .unwrap();
        let found = identify(&band, ModalSettings::default());
        assert!(
            matches!(found, Err(ModalError::NoMode { .. })),
            "{:?}",
            found.map(|found| found.modes)
        );
    }
}
