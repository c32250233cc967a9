//! Numbers of each quantity, with their names and units.

use super::{Quantity, devices};
use jounce_io::table::{Column, Values};
use jounce_spec::Spec;

/// One number of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::study) struct Measure {
    name: String,
    unit: &'static str,
    about: &'static str,
    kind: MeasureKind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum MeasureKind {
    Number,
    Count,
    Flag,
}

pub(super) fn number(name: &str, unit: &'static str, about: &'static str) -> Measure {
    Measure {
        name: name.to_owned(),
        unit,
        about,
        kind: MeasureKind::Number,
    }
}

fn count(name: &str, about: &'static str) -> Measure {
    Measure {
        name: name.to_owned(),
        unit: "",
        about,
        kind: MeasureKind::Count,
    }
}

impl Measure {
    /// Returns a column of its values; a failed point is NaN, 0 or false.
    pub(in crate::study) fn column(&self, values: Vec<f64>) -> Column {
        let values: Values = match self.kind {
            MeasureKind::Number => values.into(),
            MeasureKind::Count => values
                .into_iter()
                .map(|value| value as u64)
                .collect::<Vec<u64>>()
                .into(),
            MeasureKind::Flag => values
                .into_iter()
                .map(|value| value == 1.0)
                .collect::<Vec<bool>>()
                .into(),
        };
        Column::new(&self.name, self.unit, self.about, values)
    }
}

impl Quantity {
    /// Returns the descriptions of its numbers for a spec, in order.
    pub(in crate::study) fn measures(&self, spec: &Spec) -> Vec<Measure> {
        match self {
            Self::Run => [run(), devices::measures(spec)].concat(),
            Self::Modes { count } => modes(*count),
            Self::Frf { unit, .. } => frf(unit),
            Self::Sweep { .. } => sweep(),
            Self::Diagram { .. } => diagram(),
            Self::Bifurcations { .. } => bifurcations(),
            Self::Basins { .. } => basins(),
            Self::Branch { .. } => branch(),
            Self::Ensemble { .. } => [ensemble(), devices::measures(spec)].concat(),
            Self::Noise => noise(),
        }
    }
}

fn power() -> Measure {
    number("mean_power_w", "W", "mean power of all loads")
}

fn residual() -> Measure {
    number(
        "energy_residual_relative",
        "",
        "energy residual over the largest energy",
    )
}

fn run() -> Vec<Measure> {
    vec![
        power(),
        number(
            "voltage_rms_v",
            "V",
            "voltage of the first load, else of what the first rectifier feeds, rms",
        ),
        number("max_penetration_m", "m", "largest penetration of the stop"),
        number("max_contact_force_n", "N", "largest contact force"),
        number("contact_rate_hz", "Hz", "contacts per second"),
        number("contact_duty", "", "share of the time in contact"),
        Measure {
            name: "settled".to_owned(),
            unit: "",
            about: "settled when it was averaged",
            kind: MeasureKind::Flag,
        },
        count("period_cycles", "period in drive cycles, 0 for none"),
        residual(),
    ]
}

fn modes(count: usize) -> Vec<Measure> {
    (1..=count)
        .flat_map(|mode| {
            let frequency = number(
                &format!("frequency_{mode}_hz"),
                "Hz",
                "undamped short-circuit frequency",
            );
            [
                frequency,
                number(&format!("damping_ratio_{mode}"), "", "damping ratio"),
            ]
        })
        .collect()
}

fn frf(unit: &'static str) -> Vec<Measure> {
    vec![
        number(
            "peak_voltage",
            unit,
            "largest voltage of the first load, or of the first patch where there is none",
        ),
        number("peak_frequency_hz", "Hz", "frequency of it"),
    ]
}

fn sweep() -> Vec<Measure> {
    vec![
        number("peak_power_w", "W", "highest mean power"),
        number("peak_parameter", "", "value of the key there, SI"),
        number("average_power_w", "W", "average of the mean powers"),
        count("unsettled", "points that had not settled"),
    ]
}

fn diagram() -> Vec<Measure> {
    vec![
        number("peak_power_w", "W", "highest mean power"),
        number("peak_parameter", "", "value of the key there, SI"),
        count(
            "longest_period_cycles",
            "longest period that was found, in drive cycles",
        ),
        number(
            "aperiodic_fraction",
            "",
            "share of the motions without a period",
        ),
        count("lost", "runs that failed"),
    ]
}

fn bifurcations() -> Vec<Measure> {
    vec![
        count("curves", "curves that were found"),
        count("folds", "those of them that are folds"),
        number(
            "fold_low",
            "",
            "lowest value of the first key on a fold, SI",
        ),
        number(
            "fold_high",
            "",
            "highest value of the first key on a fold, SI",
        ),
    ]
}

fn basins() -> Vec<Measure> {
    vec![
        number(
            "expected_power_w",
            "W",
            "power to be expected from a start of the cloud",
        ),
        number(
            "expected_power_low_w",
            "W",
            "lower end of its 95 % interval",
        ),
        number(
            "expected_power_high_w",
            "W",
            "upper end of its 95 % interval",
        ),
        count("attractors", "attractors that were found"),
        number(
            "highest_power_w",
            "W",
            "mean power of the attractor that gives most",
        ),
        number("highest_fraction", "", "share of the starts that end on it"),
        number(
            "undecided_fraction",
            "",
            "share of the starts for which no attractor was proved",
        ),
        count("lost", "runs that failed"),
    ]
}

fn branch() -> Vec<Measure> {
    vec![
        number("peak_power_w", "W", "highest stable mean power"),
        number("peak_parameter", "", "value of the key there, SI"),
        number(
            "half_power_bandwidth",
            "",
            "width over which a stable orbit has half of it, SI",
        ),
        count("branches", "branches that were found"),
        count("bifurcations", "bifurcations on them"),
    ]
}

fn ensemble() -> Vec<Measure> {
    vec![
        power(),
        number(
            "mean_power_half_width_w",
            "W",
            "half the width of its 95 % interval",
        ),
        number("contact_rate_hz", "Hz", "contacts per second"),
        number(
            "max_impact_velocity_m_s",
            "m/s",
            "largest speed at which a contact began",
        ),
        residual(),
    ]
}

fn noise() -> Vec<Measure> {
    vec![
        power(),
        number("voltage_rms_v", "V", "voltage of the first load, rms"),
        number(
            "statistical_bandwidth_hz",
            "Hz",
            "statistical bandwidth of that voltage",
        ),
        number(
            "reached_hz",
            "Hz",
            "how often the gap of the first stop would be reached",
        ),
        number(
            "share_beyond",
            "",
            "share of the time that would be spent beyond it",
        ),
    ]
}
