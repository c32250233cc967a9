//! Tables of a bifurcation diagram.

use super::{DiagramPoint, DiagramResult, SectionPoint};
use crate::error::Error;
use jounce_analysis::{AttractorTrack, TrackPoint};
use jounce_io::table::{Column, Table};

impl DiagramResult {
    /// Returns the table of the points of the Poincare sections.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn table(&self) -> Result<Table, Error> {
        let rows: Vec<(&DiagramPoint, &SectionPoint)> = self
            .points
            .iter()
            .flat_map(|point| point.section.iter().map(move |section| (point, section)))
            .collect();
        let number = |name: &str, unit: &str, about: &str, value: fn(&DiagramPoint) -> f64| {
            let values = rows.iter().map(|(point, _)| value(point));
            Column::new(name, unit, about, values.collect::<Vec<f64>>())
        };
        let count = |name: &str, about: &str, value: fn(&DiagramPoint) -> u64| {
            let values: Vec<u64> = rows.iter().map(|(point, _)| value(point)).collect();
            Column::new(name, "", about, values)
        };
        let text = |name: &str, about: &str, value: fn(&DiagramPoint) -> &str| {
            let values = rows.iter().map(|(point, _)| value(point).to_owned());
            Column::new(name, "", about, values.collect::<Vec<String>>())
        };
        let mut columns = vec![
            number("parameter", &self.unit, &self.key, |point| point.parameter),
            text("direction", "direction of the sweep", |point| {
                point.direction.name()
            }),
            count("start", "number of the start in its cloud", |point| {
                point.start as u64
            }),
            text(
                "attractor",
                "id of the attractor, with direction starts only",
                |point| point.attractor.as_deref().unwrap_or_default(),
            ),
            text("motion", "orbit, chaos, torus or undecided", |point| {
                point.motion.name()
            }),
            count(
                "period_cycles",
                "period in drive cycles, 0 without a period",
                |point| u64::from(point.period_cycles),
            ),
            count(
                "contacts_per_period",
                "contacts per period, 0 without a period",
                |point| point.contacts_per_period,
            ),
            number("mean_power_w", "W", "mean power of all loads", |point| {
                point.mean_power_w
            }),
        ];
        columns.extend(section_columns(&rows));
        Ok(Table::new(columns)?)
    }

    /// Returns the table of each attractor at each value; `None` when stepped.
    ///
    /// # Errors
    /// [`Error::Table`].
    pub fn attractors_table(&self) -> Result<Option<Table>, Error> {
        let Some(attractors) = &self.attractors else {
            return Ok(None);
        };
        let samples: Vec<(&AttractorTrack, &TrackPoint)> = attractors
            .iter()
            .flat_map(|attractor| attractor.seen.iter().map(move |sample| (attractor, sample)))
            .collect();
        let number = |name: &str, unit: &str, about: &str, value: fn(&TrackPoint) -> f64| {
            let values: Vec<f64> = samples.iter().map(|(_, sample)| value(sample)).collect();
            Column::new(name, unit, about, values)
        };
        let id = samples.iter().map(|(attractor, _)| attractor.id.clone());
        let id: Vec<String> = id.collect();
        Ok(Some(Table::new(vec![
            Column::new("id", "", "id of the attractor", id),
            number("parameter", &self.unit, &self.key, |sample| {
                sample.parameter
            }),
            number("mean_power_w", "W", "mean power of all loads", |sample| {
                sample.mean_power_w
            }),
            number("fraction", "", "share of the starts", |sample| {
                sample.fraction
            }),
            number(
                "fraction_low",
                "",
                "lower end of the 95 % interval of the share",
                |sample| sample.fraction_low,
            ),
            number(
                "fraction_high",
                "",
                "upper end of the 95 % interval of the share",
                |sample| sample.fraction_high,
            ),
        ])?))
    }
}

/// Returns the columns of the state at the start of a drive cycle.
fn section_columns(rows: &[(&DiagramPoint, &SectionPoint)]) -> [Column; 3] {
    let number = |name: &str, unit: &str, about: &str, value: fn(&SectionPoint) -> f64| {
        let values: Vec<f64> = rows.iter().map(|(_, section)| value(section)).collect();
        Column::new(name, unit, about, values)
    };
    [
        number(
            "displacement_m",
            "m",
            "displacement towards the stop at the start of a drive cycle",
            |section| section.displacement_m,
        ),
        number(
            "velocity_m_s",
            "m/s",
            "velocity towards the stop",
            |section| section.velocity_m_s,
        ),
        number("voltage_v", "V", "voltage of the first patch", |section| {
            section.voltage_v
        }),
    ]
}
