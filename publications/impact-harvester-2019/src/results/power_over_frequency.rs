//! Figure 6: mean power per force squared over the drive frequency, at 1 Mohm; linear case and
//! three levels of force, stepped up and down.
//!
//! The paper gives neither the levels nor the step. The values 50, 100 and 200 N and 0.1 Hz are
//! guesses; figures 7 to 9 of the paper use two of these levels.

use super::stepped::{DriveLevel, SteppedBranch, stepped};
use crate::harvester::{MEGOHM, PaperCase, PaperHarvester};
use crate::named::NamedStop;
use crate::{NamedFigure, NamedTable, ReproduceError};
use jounce_io::table::{Column, Table};
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_plot::{LineDirection, Scale, SweepLine, SweepLook, sweep};
use rayon::prelude::*;

/// Force levels, N, zero to peak.
pub(crate) const LEVELS_N: [f64; 3] = [50.0, 100.0, 200.0];

/// Force levels, N, for the comparison with the stop that differs from the paper's eq. (5).
pub(crate) const FEWER_LEVELS_N: [f64; 2] = [50.0, 200.0];

/// Curves of figure 6.
pub(crate) struct PowerOverFrequency {
    pub linear: SteppedBranch,
    pub levels: Vec<DriveLevel>,
}

impl PowerOverFrequency {
    /// Computes 4 to 20 Hz in steps of 0.1 Hz; the linear case in closed form in steps of 10 mHz, 1
    /// mHz at its resonance.
    pub fn compute(harvester: &PaperHarvester, levels_n: &[f64]) -> Result<Self, ReproduceError> {
        let frequencies_hz: Vec<f64> = (40..=200).map(|i| f64::from(i) / 10.0).collect();
        harvester
            .control
            .expect(2 * frequencies_hz.len() * levels_n.len());
        let levels = levels_n
            .par_iter()
            .map(|level| stepped(harvester, *level, &frequencies_hz))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(Self {
            linear: linear(harvester)?,
            levels,
        })
    }

    /// Returns figure 6.
    pub fn figure(&self, stop: &NamedStop) -> NamedFigure {
        let line = |label: &str, direction, branch: &SteppedBranch| SweepLine {
            label: label.to_owned(),
            direction,
            parameter: branch.frequency_hz.clone(),
            value: branch.power_w_n2.clone(),
            settled: branch.settled.clone(),
        };
        let mut lines = vec![line("linear", LineDirection::Linear, &self.linear)];
        for level in &self.levels {
            let label = format!("{} N", level.amplitude_n);
            lines.push(line(&label, LineDirection::Up, &level.up));
            lines.push(line(&label, LineDirection::Down, &level.down));
        }
        let figure = sweep(
            "Mean power per force squared",
            &SweepLook::power_over_frequency(Scale::Log),
            &lines,
        );
        let caption = "Figure 6. Mean power over the last 10 s of 20 s at each frequency, divided by the force squared; 1 MΩ. The frequency \
                       steps by 0.1 Hz, up and then down, and the motion is carried over.";
        NamedFigure::new(
            &format!("figure-6{}", stop.suffix),
            &format!("{caption}{}", stop.words),
            figure,
        )
    }

    /// Returns every point of the stepped curves.
    pub fn table(&self, stop: &NamedStop) -> Result<NamedTable, ReproduceError> {
        let ways: Vec<(f64, &str, &SteppedBranch)> = self
            .levels
            .iter()
            .flat_map(|level| {
                [
                    (level.amplitude_n, "up", &level.up),
                    (level.amplitude_n, "down", &level.down),
                ]
            })
            .collect();
        let each = |(amplitude_n, direction, branch): &(f64, &str, &SteppedBranch)| {
            vec![(*amplitude_n, (*direction).to_owned()); branch.frequency_hz.len()]
        };
        let (amplitude_n, direction): (Vec<f64>, Vec<String>) = ways.iter().flat_map(each).unzip();
        let all = |of: fn(&SteppedBranch) -> &Vec<f64>| {
            ways.iter()
                .flat_map(|row| of(row.2).clone())
                .collect::<Vec<f64>>()
        };
        let settled: Vec<bool> = ways.iter().flat_map(|row| row.2.settled.clone()).collect();
        let table = Table::new(vec![
            Column::new("amplitude_n", "N", "Force, peak", amplitude_n),
            Column::new("direction", "", "Stepped", direction),
            Column::new(
                "frequency_hz",
                "Hz",
                "Drive frequency",
                all(|branch| &branch.frequency_hz),
            ),
            Column::new(
                "power_w_n2",
                "W/N^2",
                "Mean power per force squared",
                all(|branch| &branch.power_w_n2),
            ),
            Column::new("settled", "", "Settled", settled),
        ])?;
        let caption = format!(
            "Figure 6: mean power per force squared, stepped up and down.{}",
            stop.words
        );
        Ok(NamedTable::new(
            &format!("figure-6{}", stop.suffix),
            &caption,
            5,
            table,
        ))
    }
}

fn linear(harvester: &PaperHarvester) -> Result<SteppedBranch, ReproduceError> {
    let plant = harvester.plant(PaperCase {
        frequency_hz: 4.0,
        amplitude_n: 1.0,
        resistance_ohm: MEGOHM,
    })?;
    let coarse = (400..=2000).map(|i| f64::from(i) / 100.0);
    let fine = (8600..=8800).map(|i| f64::from(i) / 1000.0);
    let mut frequency_hz: Vec<f64> = coarse
        .filter(|f| !(8.6..=8.8).contains(f))
        .chain(fine)
        .collect();
    frequency_hz.sort_by(f64::total_cmp);
    let results = frf(
        &plant,
        &FrfInput::Force("table".to_owned()),
        &[FrfOutput::Voltage("mfc".to_owned())],
        &frequency_hz,
    )?;
    let power_w_n2 = results
        .iter()
        .flat_map(|result| &result.value)
        .map(|v| v.norm_sqr() / (2.0 * MEGOHM))
        .collect();
    Ok(SteppedBranch {
        frequency_hz,
        power_w_n2,
        ..SteppedBranch::default()
    })
}
