//! Figure 6: mean power per force squared over the drive frequency, at 1 Mohm; linear case and three levels of force, stepped up and down.
//!
//! The paper gives neither the levels nor the step; 50, 100 and 200 N (two of which its figures 7 to 9 name) and 0.1 Hz are guesses.

use super::harvester::{Case, Harvester, MEGOHM};
use super::stepped::{Branch, Level, stepped};
use super::{NamedFigure, NamedTable, ReproduceError};
use crate::linear::steady_power_w;
use crate::picture::{Direction, Scale, SweepLine, SweepLook, sweep};
use crate::table::{Column, Table};
use rayon::prelude::*;

/// Levels of force, N, zero to peak.
pub(super) const LEVELS_N: [f64; 3] = [50.0, 100.0, 200.0];

/// All curves of the figure.
pub(super) struct PowerOverFrequency {
    pub linear: Branch,
    pub levels: Vec<Level>,
}

impl PowerOverFrequency {
    /// 4 to 20 Hz in steps of 0.1 Hz; the linear case in closed form in steps of 5 mHz.
    pub fn compute(harvester: &Harvester) -> Result<Self, ReproduceError> {
        let frequencies_hz: Vec<f64> = (40..=200).map(|i| f64::from(i) / 10.0).collect();
        let levels = LEVELS_N.par_iter().map(|level| stepped(harvester, *level, &frequencies_hz)).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { linear: linear(harvester)?, levels })
    }

    /// Figure 6.
    pub fn figure(&self) -> NamedFigure {
        let line = |label: &str, direction, branch: &Branch| SweepLine {
            label: label.to_owned(),
            direction,
            parameter: branch.frequency_hz.clone(),
            value: branch.power_w_n2.clone(),
            settled: branch.settled.clone(),
        };
        let mut lines = vec![line("linear", Direction::Linear, &self.linear)];
        for level in &self.levels {
            let label = format!("{} N", level.amplitude_n);
            lines.push(line(&label, Direction::Up, &level.up));
            lines.push(line(&label, Direction::Down, &level.down));
        }
        let figure = sweep("Mean power per force squared", &SweepLook::power_over_frequency(Scale::Log), &lines);
        let caption = "Figure 6. Mean power over the last 10 s of 20 s at each frequency, divided by the force squared; 1 MΩ. The frequency \
                       steps by 0.1 Hz, up and then down, and the motion is carried over.";
        NamedFigure::new("figure-6", caption, figure)
    }

    /// Every point of the stepped curves.
    pub fn table(&self) -> Result<NamedTable, ReproduceError> {
        let ways: Vec<(f64, &str, &Branch)> =
            self.levels.iter().flat_map(|level| [(level.amplitude_n, "up", &level.up), (level.amplitude_n, "down", &level.down)]).collect();
        let each = |(amplitude_n, way, branch): &(f64, &str, &Branch)| vec![(*amplitude_n, (*way).to_owned()); branch.frequency_hz.len()];
        let (amplitude_n, direction): (Vec<f64>, Vec<String>) = ways.iter().flat_map(each).unzip();
        let all = |of: fn(&Branch) -> &Vec<f64>| ways.iter().flat_map(|way| of(way.2).clone()).collect::<Vec<f64>>();
        let settled: Vec<bool> = ways.iter().flat_map(|way| way.2.settled.clone()).collect();
        let table = Table::new(vec![
            Column::new("amplitude_n", "N", "Force, peak", amplitude_n),
            Column::new("direction", "", "Stepped", direction),
            Column::new("frequency_hz", "Hz", "Drive frequency", all(|branch| &branch.frequency_hz)),
            Column::new("power_w_n2", "W/N^2", "Mean power per force squared", all(|branch| &branch.power_w_n2)),
            Column::new("settled", "", "Settled", settled),
        ])?;
        Ok(NamedTable::new("figure-6", "Figure 6: mean power per force squared, stepped up and down.", 5, table))
    }
}

fn linear(harvester: &Harvester) -> Result<Branch, ReproduceError> {
    let case = Case { frequency_hz: 4.0, amplitude_n: 1.0, resistance_ohm: MEGOHM };
    let plant = harvester.plant(case)?;
    let mut branch = Branch::default();
    for frequency_hz in (800..=4000).map(|i| f64::from(i) / 200.0) {
        let mut drives = plant.system.drives.clone();
        drives.iter_mut().for_each(|drive| drive.frequency_hz = frequency_hz);
        branch.frequency_hz.push(frequency_hz);
        branch.power_w_n2.push(case.normalised(steady_power_w(&plant.with_drives(drives)?)));
    }
    Ok(branch)
}
