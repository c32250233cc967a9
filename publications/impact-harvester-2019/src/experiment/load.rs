//! Figures 10 and 11: mean power over the load from records, normalised by the mean square of the
//! base acceleration.

use crate::{NamedFigure, NamedTable, paper_spec};
use jounce_analysis::run::StartState;
use jounce_control::Control;
use jounce_io::table::{Column, Table};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_plot::{LineDirection, SweepLine, power_against_resistance};
use jounce_signal::Samples;
use rayon::prelude::*;

use super::{ExperimentError, NOISE, RATE_HZ, RECORD_S};
use jounce_experiment::rig::{Disturbance, Sensor, ShakerTest, shaker_test};
use jounce_signal::spectral::mean_power;

/// Drive of the experiment. The paper prints only the frequencies; the forces are those of its
/// figures 8 and 9.
#[derive(Debug, Clone, Copy)]
pub(super) struct Case {
    number: u32,
    frequency: &'static str,
    amplitude: &'static str,
}

/// Figure 10.
pub(super) const ABOVE_RESONANCE: Case = Case {
    number: 10,
    frequency: "13.5 Hz",
    amplitude: "200 N",
};
/// Figure 11.
pub(super) const BELOW_RESONANCE: Case = Case {
    number: 11,
    frequency: "6 Hz",
    amplitude: "50 N",
};

const LOADS_OHM: [f64; 6] = [1e4, 3e4, 6e4, 1e5, 2e5, 1e6];
/// Gaps; the second is so large that the stop is never reached.
const GAPS: [&str; 2] = ["1 mm", "1 m"];
/// Transient before the record: without contact the first mode decays to 1 % in 44 s.
const BEFORE_S: f64 = 60.0;

/// Result of one record.
#[derive(Debug, Clone, Copy)]
struct Point {
    resistance_ohm: f64,
    power_w: f64,
    half_width_w: f64,
    mean_square_m2_s4: f64,
}

/// One figure.
pub(super) struct PowerOverLoad {
    case: Case,
    impact: Vec<Point>,
    linear: Vec<Point>,
}

impl PowerOverLoad {
    /// Computes a record for each load, with and without the stop.
    pub fn compute(case: Case, control: &Control) -> Result<Self, ExperimentError> {
        let all: Vec<(usize, f64)> = (0..GAPS.len())
            .flat_map(|gap| LOADS_OHM.map(|ohm| (gap, ohm)))
            .collect();
        control.expect(all.len());
        let record_counted = |(gap, ohm): &(usize, f64)| {
            recorded((case, GAPS[*gap], *ohm), control).inspect(|_| control.count())
        };
        let points = all
            .par_iter()
            .map(record_counted)
            .collect::<Result<Vec<Point>, _>>()?;
        let (impact, linear) = points.split_at(LOADS_OHM.len());
        Ok(Self {
            case,
            impact: impact.to_vec(),
            linear: linear.to_vec(),
        })
    }

    /// Smallest and largest ratio of power per mean square with impact to that without.
    pub fn gains(&self) -> (f64, f64) {
        let per = |point: &Point| point.power_w / point.mean_square_m2_s4;
        let gains = self
            .impact
            .iter()
            .zip(&self.linear)
            .map(|(impact, linear)| per(impact) / per(linear));
        gains.fold((f64::INFINITY, 0.0), |(low, high), gain| {
            (low.min(gain), high.max(gain))
        })
    }

    /// Load of the highest point, with and without impact, ohm.
    fn best_ohm(&self) -> [f64; 2] {
        let best_of = |points: &[Point]| {
            points
                .iter()
                .max_by(|a, b| a.power_w.total_cmp(&b.power_w))
                .map_or(f64::NAN, |p| p.resistance_ohm)
        };
        [best_of(&self.impact), best_of(&self.linear)]
    }

    pub fn figure(&self) -> NamedFigure {
        let line = |label: &str, direction, points: &[Point]| SweepLine {
            label: label.to_owned(),
            direction,
            parameter: points.iter().map(|point| point.resistance_ohm).collect(),
            value: points
                .iter()
                .map(|point| point.power_w / point.mean_square_m2_s4)
                .collect(),
            settled: Vec::new(),
        };
        let lines = [
            line("without impact", LineDirection::Linear, &self.linear),
            line("with impact", LineDirection::Independent, &self.impact),
        ];
        let Case {
            number,
            frequency,
            amplitude,
        } = self.case;
        let title = format!(
            "Mean power per mean square of the base's acceleration at {frequency} (simulated)"
        );
        let caption = format!(
            "Figure {number}, simulated: mean power of records of {RECORD_S} s at {RATE_HZ} Hz, {frequency} and {amplitude}, over the load, \
             per mean square of the base's acceleration. The dotted lines mark the best loads."
        );
        NamedFigure::new(
            &format!("figure-{number}"),
            &caption,
            power_against_resistance(&title, "W/(m/s^2)^2", &lines),
        )
    }

    pub fn table(&self) -> Result<NamedTable, ExperimentError> {
        let rows = || self.impact.iter().chain(&self.linear);
        let number = |value: &dyn Fn(&Point) -> f64| rows().map(value).collect::<Vec<f64>>();
        let impact: Vec<bool> = (0..rows().count()).map(|k| k < self.impact.len()).collect();
        let table = Table::new(vec![
            Column::new("impact", "", "With impact", impact),
            Column::new(
                "resistance_ohm",
                "ohm",
                "Load",
                number(&|point| point.resistance_ohm),
            ),
            Column::new(
                "mean_power_w",
                "W",
                "Mean power",
                number(&|point| point.power_w),
            ),
            Column::new(
                "half_width_w",
                "W",
                "± 95 %",
                number(&|point| point.half_width_w),
            ),
            Column::new(
                "mean_square_base_m2_s4",
                "m^2/s^4",
                "Mean square of the base",
                number(&|point| point.mean_square_m2_s4),
            ),
            Column::new(
                "power_per_mean_square",
                "W/(m/s^2)^2",
                "Power over it",
                number(&|point| point.power_w / point.mean_square_m2_s4),
            ),
        ])?;
        // No caption: the figure shows the table, the files contain it.
        Ok(NamedTable::new(
            &format!("figure-{}", self.case.number),
            "",
            4,
            table,
        ))
    }
}

/// Compares the records with the statements of the paper.
pub(super) fn summary(loads: &[PowerOverLoad]) -> Vec<String> {
    let sentence = |load: &PowerOverLoad| {
        let ((low, high), [impact, linear]) = (load.gains(), load.best_ohm());
        format!(
            "At {} and {} the records with impact give {low:.2} to {high:.2} times the power of \
            those without, per mean square of the base's acceleration; the maxima are at {:.0} kΩ \
            with impact and {:.0} kΩ without.",
            load.case.frequency,
            load.case.amplitude,
            impact / 1e3,
            linear / 1e3
        )
    };
    let first = format!(
        "Simulated. Each point is a record of {RECORD_S} s at {RATE_HZ} Hz with noise of {} % on every channel, taken {BEFORE_S} s after a start \
         from rest. The paper does not print the forces of its experiment; those of its figures 8 and 9 are used. It finds the harvester with \
         impact better at 13.5 Hz, the linear one better at 6 Hz, and slightly smaller best loads with impact.",
        100.0 * NOISE
    );
    std::iter::once(first)
        .chain(loads.iter().map(sentence))
        .collect()
}

fn recorded(
    (case, gap, resistance_ohm): (Case, &str, f64),
    control: &Control,
) -> Result<Point, ExperimentError> {
    let load = format!("{resistance_ohm} ohm");
    let settings = [
        ("drive.shaker.frequency", case.frequency),
        ("drive.shaker.amplitude", case.amplitude),
        ("stop.tip.gap", gap),
        ("circuit.load.resistance", &load),
    ];
    let spec = paper_spec(&settings)?;
    let modes = structure::modes(&spec)?;
    let plant = Plant::new(System::assemble(&spec, modes.clone())?)?;
    let test = ShakerTest {
        rate_hz: RATE_HZ,
        duration_s: RECORD_S,
        before_s: BEFORE_S,
        starts: vec![(0.0, StartState::rest(&plant))],
        disturbance: Disturbance::NONE,
        accelerometers: Vec::new(),
        sensor: Sensor {
            noise_ratio: NOISE,
            bits: Some(16),
        },
        seed: resistance_ohm as u64,
    };
    let record = shaker_test(&spec, &modes, &test, control)?;
    let voltage = Samples::new(&record.channel("mfc.voltage")?.values, RATE_HZ)?;
    let base = Samples::new(&record.channel("base.acceleration")?.values, RATE_HZ)?;
    let power = mean_power(&voltage, resistance_ohm, false)?;
    Ok(Point {
        resistance_ohm,
        power_w: power.mean_power_w,
        half_width_w: power.half_width_w,
        mean_square_m2_s4: base.rms().powi(2) - base.mean().powi(2),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_model::linear::{FrfInput, FrfOutput, frf, steady_power_w};

    /// Without contact the power of a record and the mean square of its base match the closed
    /// forms; noise of 1 % adds 1e-4 to both.
    #[test]
    fn a_record_without_contact_has_the_power_of_the_closed_form() -> Result<(), ExperimentError> {
        let settings = [
            ("drive.shaker.frequency", "13.5 Hz"),
            ("drive.shaker.amplitude", "200 N"),
        ];
        let spec = paper_spec(
            &[
                &settings[..],
                &[
                    ("stop.tip.gap", "1 m"),
                    ("circuit.load.resistance", "100 kohm"),
                ],
            ]
            .concat(),
        )?;
        let plant = Plant::new(System::assemble(&spec, structure::modes(&spec)?)?)?;
        let table = [FrfOutput::Acceleration("table".to_owned())];
        let base = frf(
            &plant,
            &FrfInput::Force("table".to_owned()),
            &table,
            &[13.5],
        )?[0]
            .value[0]
            .norm()
            * 200.0;
        let result = recorded((ABOVE_RESONANCE, "1 m", 1e5), &Control::default())?;
        let (power, square) = (
            result.power_w / steady_power_w(&plant) - 1.0,
            result.mean_square_m2_s4 / (0.5 * base * base) - 1.0,
        );
        eprintln!("power {power:.1e}, mean square {square:.1e} off");
        assert!(
            power.abs() < 2e-3 && square.abs() < 1e-3,
            "{power:e} {square:e}"
        );
        let one = PowerOverLoad {
            case: ABOVE_RESONANCE,
            impact: vec![result],
            linear: vec![result],
        };
        assert!(
            one.gains() == (1.0, 1.0)
                && one.table()?.table.rows() == 2
                && one.figure().figure.to_svg().is_ok()
        );
        assert!(summary(&[one])[1].contains("1.00 to 1.00 times"));
        Ok(())
    }
}
